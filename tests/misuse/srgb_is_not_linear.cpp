// SPDX-License-Identifier: MIT
// Encoded and linear pixels do not mix.
#include "verdigris/color/color.h"
#include "verdigris/pixels/image.h"
using namespace verdigris;
void shade(ImageView<const LinearF>);
void use(const Image<SrgbF>& encoded, const Image<LinearF>& linear) {
#ifdef WRONG
    shade(encoded);
#else
    (void)encoded;
    shade(linear);
#endif
}
