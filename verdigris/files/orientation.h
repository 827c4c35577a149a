// SPDX-License-Identifier: MIT
// Turning a picture as its EXIF orientation asks. Used inside this room only.
#pragma once

#include <utility>

#include "verdigris/pixels/image.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {

/// Orientations 5..8 exchange width and height [EXIF, 4.6.4].
inline bool swaps_sides(int orientation) {
    return orientation >= 5;
}

/// The picture as it is to be shown. Orientation 1, or anything unknown, costs nothing.
template <class P>
Image<P> oriented(Image<P> image, int orientation) {
    if (orientation < 2 || orientation > 8) return image;
    const int w = image.width(), h = image.height();
    auto out =
        swaps_sides(orientation) ? Image<P>::for_overwrite(h, w) : Image<P>::for_overwrite(w, h);
    // chosen: 32 rows keep the columns read by a turned picture within the cache.
    parallel_rows(out.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            P* to = out.row(y);
            for (int x = 0; x < out.width(); ++x) {
                switch (orientation) {
                    case 2:
                        to[x] = image(w - 1 - x, y);
                        break;
                    case 3:
                        to[x] = image(w - 1 - x, h - 1 - y);
                        break;
                    case 4:
                        to[x] = image(x, h - 1 - y);
                        break;
                    case 5:
                        to[x] = image(y, x);
                        break;
                    case 6:
                        to[x] = image(y, h - 1 - x);
                        break;
                    case 7:
                        to[x] = image(w - 1 - y, h - 1 - x);
                        break;
                    default:
                        to[x] = image(w - 1 - y, x);
                        break;
                }
            }
        }
    });
    return out;
}

}  // namespace verdigris
