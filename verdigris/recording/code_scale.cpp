// SPDX-License-Identifier: MIT
#include "verdigris/recording/code_scale.h"

#include <cmath>

namespace verdigris {

CodeScale::CodeScale(const FrameFormat& format) {
    const bool real = format.type == SampleType::f32;
    const double top = real ? 1.0 : std::exp2(format.bits) - 1;
    const double step = real ? 1 / 255.0 : std::exp2(format.bits - 8);
    const double middle = real ? 0.5 : 128 * step;
    const double point = std::exp2(format.fraction_bits);
    offset = format.full_range ? 0 : 16 * step * point;
    gain = 1 / ((format.full_range ? top : 219 * step) * point);
    chroma_offset = middle * point;
    chroma_gain = 1 / ((format.full_range ? top : 224 * step) * point);
    const double kr = format.kr, kb = format.kb, kg = 1 - kr - kb;
    red_cr = 2 * (1 - kr);
    blue_cb = 2 * (1 - kb);
    green_cb = -2 * kb * (1 - kb) / kg;
    green_cr = -2 * kr * (1 - kr) / kg;
}

}  // namespace verdigris
