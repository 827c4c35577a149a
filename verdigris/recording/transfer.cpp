// SPDX-License-Identifier: MIT
#include "verdigris/recording/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "verdigris/color/convert.h"

namespace verdigris {
namespace {

// [BT2408] 2.1: HDR reference white, the level of graphics and of a 100 % diffuse reflector.
constexpr float kReferenceWhite = 203.0f;

// [BT2100] table 4: the inverse of the PQ curve, in cd/m2.
float nits_from_pq(float v) {
    constexpr float m1 = 2610.0f / 16384.0f, m2 = 2523.0f / 4096.0f * 128.0f;
    constexpr float c1 = 3424.0f / 4096.0f, c2 = 2413.0f / 4096.0f * 32.0f,
                    c3 = 2392.0f / 4096.0f * 32.0f;
    const float p = std::pow(v, 1 / m2);
    return 10000.0f * std::pow(std::max(p - c1, 0.0f) / (c2 - c3 * p), 1 / m1);
}

// [BT2100] table 5: the inverse of the HLG curve, scene light in [0, 1].
float scene_from_hlg(float v) {
    constexpr float a = 0.17883277f, b = 1 - 4 * a, c = 0.55991073f;
    return v <= 0.5f ? v * v / 3.0f : (std::exp((v - c) / a) + b) / 12.0f;
}

// [BT2100] table 5: the opto-optical transfer of the reference display, 1000 cd/m2 and so gamma
// 1.2; the luma weights are those of BT.2020, whose primaries HLG prescribes.
LinearF light_from_hlg(SrgbF v) {
    const LinearF scene{scene_from_hlg(v.r), scene_from_hlg(v.g), scene_from_hlg(v.b)};
    const float y = 0.2627f * scene.r + 0.6780f * scene.g + 0.0593f * scene.b;
    const float gain = 1000.0f * std::pow(y, 0.2f) / kReferenceWhite;
    return {gain * scene.r, gain * scene.g, gain * scene.b};
}

LinearF light_from_coded(SrgbF v, Transfer transfer) {
    const auto each = [&](auto curve) { return LinearF{curve(v.r), curve(v.g), curve(v.b)}; };
    switch (transfer) {
        case Transfer::linear:
            return each([](float x) { return x; });
        case Transfer::gamma22:
            return each([](float x) { return std::pow(x, 2.2f); });
        case Transfer::gamma28:
            return each([](float x) { return std::pow(x, 2.8f); });
        case Transfer::pq:
            return each([](float x) { return nits_from_pq(x) / kReferenceWhite; });
        case Transfer::hlg:
            return light_from_hlg(v);
        case Transfer::display:
            break;
    }
    return linear_from_srgb(v);
}

// BT.709 from wider primaries, in linear light. derived from the chromaticities in [BT2020] table
// 3 and [SMPTE-EG432] (P3 with a D65 white) against [BT709]; the white is the same, so rows sum
// to 1. The test derives them again.
using Matrix = std::array<std::array<float, 3>, 3>;
constexpr Matrix kBt709FromBt2020{{{1.660491f, -0.587641f, -0.072850f},
                                   {-0.124550f, 1.132900f, -0.008349f},
                                   {-0.018151f, -0.100579f, 1.118730f}}};
constexpr Matrix kBt709FromP3{{{1.224940f, -0.224940f, 0.000000f},
                               {-0.042057f, 1.042057f, 0.000000f},
                               {-0.019638f, -0.078636f, 1.098274f}}};

LinearF times(const Matrix& m, LinearF c) {
    return {m[0][0] * c.r + m[0][1] * c.g + m[0][2] * c.b,
            m[1][0] * c.r + m[1][1] * c.g + m[1][2] * c.b,
            m[2][0] * c.r + m[2][1] * c.g + m[2][2] * c.b};
}

float unit(float v) {
    return v > 0 ? std::min(v, 1.0f) : 0.0f;
}

}  // namespace

bool shown_as_coded(Transfer transfer, Primaries primaries) {
    return transfer == Transfer::display && primaries != Primaries::bt2020 &&
           primaries != Primaries::display_p3;
}

SrgbF srgb_from_coded(SrgbF coded, Transfer transfer, Primaries primaries) {
    if (shown_as_coded(transfer, primaries)) return coded;
    LinearF light = light_from_coded(coded, transfer);
    if (primaries == Primaries::bt2020) light = times(kBt709FromBt2020, light);
    if (primaries == Primaries::display_p3) light = times(kBt709FromP3, light);
    return srgb_from_linear(LinearF{unit(light.r), unit(light.g), unit(light.b)});
}

}  // namespace verdigris
