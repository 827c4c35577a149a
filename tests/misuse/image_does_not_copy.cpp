// SPDX-License-Identifier: MIT
// A large image is never copied by accident.
#include "verdigris/pixels/image.h"
using namespace verdigris;
Image<float> use(const Image<float>& image) {
#ifdef WRONG
    return image;
#else
    return image.clone();
#endif
}
