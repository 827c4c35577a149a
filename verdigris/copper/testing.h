// SPDX-License-Identifier: MIT
// What the tests of this room share.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/color/delta_e.h"
#include "verdigris/copper/surface.h"

namespace verdigris {

/// A smooth film of one thickness in a pixel, without the brown crust: what the reference colors
/// were computed for.
inline SurfaceOptics ideal_film() {
    SurfaceOptics optics;
    optics.thickness_spread = 0;
    optics.brown_limit = false;
    return optics;
}

inline Lab lab_of(LinearF linear) {
    return lab_from_xyz(xyz_from_linear(linear));
}

/// Numbers that docs/models/copper.md quotes: verdigris_copper_test | grep measured
inline void measured(const char* what, double value) {
    std::printf("measured: %s: %.3g\n", what, value);
}

struct ReferenceColor {
    double nm;
    std::array<Lab, 5> lab;  ///< at the shares of Cu2O in kReferenceFractions
};
inline constexpr std::array<double, 5> kReferenceFractions{1, 0.75, 0.5, 0.25, 0};

/// The color path, computed once with an independent program (libtorch, 2026) and rounded to whole
/// units of Lab: rounding alone is worth up to 0.8 CIEDE2000.
inline const std::vector<ReferenceColor> kReferencePath{
    {0, {{{90, 12, 15}, {90, 12, 15}, {90, 12, 15}, {90, 12, 15}, {90, 12, 15}}}},
    {4, {{{86, 16, 24}, {86, 16, 23}, {86, 16, 21}, {86, 16, 20}, {86, 15, 19}}}},
    {8, {{{80, 23, 37}, {80, 22, 33}, {80, 21, 29}, {80, 20, 26}, {80, 19, 23}}}},
    {12, {{{71, 36, 54}, {71, 33, 45}, {71, 30, 38}, {72, 27, 32}, {73, 24, 28}}}},
    {16, {{{60, 53, 66}, {60, 47, 54}, {60, 41, 44}, {61, 35, 36}, {63, 30, 30}}}},
    {20, {{{51, 64, 47}, {47, 61, 45}, {47, 53, 40}, {49, 44, 33}, {51, 35, 28}}}},
    {24, {{{49, 53, 20}, {40, 60, 16}, {35, 60, 16}, {35, 52, 17}, {38, 40, 17}}}},
    {28, {{{55, 30, 10}, {42, 37, 0}, {31, 46, -7}, {25, 49, -9}, {26, 40, -4}}}},
    {32, {{{64, 14, 10}, {50, 15, -1}, {37, 19, -12}, {25, 25, -20}, {19, 27, -23}}}},
    {36, {{{71, 6, 12}, {58, 5, 2}, {46, 4, -8}, {34, 5, -17}, {24, 5, -24}}}},
    {40, {{{76, 4, 14}, {65, 1, 5}, {54, 0, -3}, {43, -1, -11}, {33, -3, -18}}}},
    {48, {{{82, 3, 17}, {74, 1, 11}, {66, 0, 5}, {57, -1, -1}, {48, -2, -7}}}},
    {56, {{{85, 2, 21}, {79, 2, 16}, {72, 1, 10}, {65, 1, 5}, {58, 1, 0}}}},
    {64, {{{86, 3, 27}, {81, 2, 21}, {76, 3, 15}, {70, 3, 10}, {64, 3, 6}}}},
    {72, {{{85, 5, 35}, {81, 4, 27}, {77, 4, 21}, {72, 4, 15}, {67, 5, 10}}}},
    {80, {{{83, 10, 43}, {80, 8, 34}, {76, 7, 26}, {73, 6, 20}, {68, 6, 14}}}},
    {90, {{{75, 27, 43}, {74, 19, 37}, {73, 14, 30}, {71, 11, 24}, {68, 9, 18}}}},
    {100, {{{63, 54, 20}, {65, 37, 25}, {66, 25, 25}, {66, 17, 23}, {65, 12, 19}}}},
    {110, {{{51, 63, -11}, {52, 52, -2}, {56, 36, 8}, {59, 24, 14}, {60, 16, 15}}}},
    {120, {{{52, 20, -17}, {45, 35, -23}, {46, 33, -13}, {51, 24, -2}, {54, 17, 6}}}},
    {130, {{{62, -21, -3}, {49, -12, -20}, {44, 4, -23}, {45, 11, -15}, {48, 10, -5}}}},
    {140, {{{71, -24, 13}, {58, -31, -6}, {49, -24, -17}, {45, -10, -18}, {46, -2, -12}}}},
    {160, {{{76, 2, 32}, {69, -9, 18}, {61, -15, 6}, {55, -16, -3}, {50, -12, -7}}}},
    {180, {{{69, 34, 21}, {68, 17, 20}, {64, 6, 15}, {60, 0, 9}, {56, -3, 3}}}},
    {200, {{{58, 46, -5}, {58, 34, 1}, {60, 21, 7}, {59, 11, 8}, {58, 6, 7}}}},
    {250, {{{68, -9, 16}, {60, -22, 4}, {55, -16, -4}, {52, -7, -5}, {52, -1, -3}}}},
    {300, {{{59, 23, -1}, {58, 19, -0}, {58, 10, 2}, {56, 3, 2}, {54, 0, 2}}}},
    {400, {{{60, 11, 1}, {57, 8, -1}, {56, 3, -0}, {55, -1, 0}, {54, -1, 0}}}},
};

}  // namespace verdigris
