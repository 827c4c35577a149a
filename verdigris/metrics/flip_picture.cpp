// SPDX-License-Identifier: MIT
#include "verdigris/color/magma.h"
#include "verdigris/metrics/flip.h"

namespace verdigris {

Image<SrgbU8> flip_picture(const Image<float>& map) {
    return magma(map, 1);
}

}  // namespace verdigris
