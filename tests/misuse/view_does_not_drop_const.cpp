// SPDX-License-Identifier: MIT
// A view of constant pixels cannot become one of writable pixels.
#include "verdigris/pixels/image.h"
using namespace verdigris;
void write(ImageView<float>);
void use(Image<float>& image) {
#ifdef WRONG
    write(static_cast<const Image<float>&>(image).view());
#else
    write(image.view());
#endif
}
