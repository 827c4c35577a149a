// SPDX-License-Identifier: MIT
// Is a recording another one in disguise? Re-encoded or rescaled, its bytes and frames are others,
// but the grain of its surface is the same.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "verdigris/evaluate/windows.h"
#include "verdigris/observe/observe.h"

namespace verdigris {

/// The surface at a few moments, coarse, with its place in the frame.
struct SurfacePrint {
    static constexpr int kSide = 48;    ///< cells per side of the crop
    static constexpr int kMoments = 3;  ///< the middles of as many equal parts
    static constexpr int kOutside = -1;

    /// Left, top, width, height of the crop as shares of the frame.
    std::array<double, 4> place{0, 0, 1, 1};
    /// kMoments x kSide x kSide, row-major: mean luma in 1e-4 of full scale, kOutside where less
    /// than half of a cell is specimen. Empty: the samples are too small, or show too little of
    /// one.
    std::vector<int> cells;

    bool empty() const { return cells.empty(); }
};

/// Of the samples in `usable`, on the specimen (an empty mask: everywhere). Cost: three samples.
SurfacePrint surface_print(const Observation& observation, SampleRange usable);

/// How alike the grains of two surfaces are where the frame shows both: Pearson's correlation of
/// what is finer than a sixth of the shared part, mean over the moments, the best of small shifts;
/// in [-1, 1]. 0 where either is empty or they share too little of the frame.
double surface_likeness(const SurfacePrint& a, const SurfacePrint& b);

/// From here on two recordings are taken for one: between what was measured of re-encodings (0.66
/// and more) and of different specimens (0.33 and less), docs/PROTOCOL.md.
inline constexpr double kNearCopy = 0.5;

/// "a and b show one specimen ...: near copies of one recording".
std::string near_copy_sentence(const std::string& a, const std::string& b, double likeness);

}  // namespace verdigris
