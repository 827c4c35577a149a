// SPDX-License-Identifier: MIT
// Push-pull [Gortler1996]: averages of what is known, level by level down to one pixel, then holes
// filled from the level above. Touches a third more pixels than the image has, whatever the size
// of the glint.
#include "verdigris/material/luma_fill.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "verdigris/color/convert.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

struct Level {
    Image<float> value, weight;  ///< weight in [0, 1]; value means nothing where it is 0
};

Level half(const Level& fine) {
    const int width = (fine.value.width() + 1) / 2, height = (fine.value.height() + 1) / 2;
    Level coarse{Image<float>(width, height), Image<float>(width, height)};
    parallel_rows(height, 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < width; ++x) {
                float sum = 0, weight = 0;
                for (int fy = 2 * y; fy < std::min(2 * y + 2, fine.value.height()); ++fy) {
                    for (int fx = 2 * x; fx < std::min(2 * x + 2, fine.value.width()); ++fx) {
                        sum += fine.weight(fx, fy) * fine.value(fx, fy);
                        weight += fine.weight(fx, fy);
                    }
                }
                coarse.value(x, y) = weight > 0 ? sum / weight : 0;
                coarse.weight(x, y) = std::min(weight, 1.0f);
            }
        }
    });
    return coarse;
}

/// Bilinear read of the coarse level at the center of fine pixel (x, y).
float above(const Image<float>& coarse, int x, int y) {
    const float u = std::clamp((float(x) + 0.5f) / 2 - 0.5f, 0.0f, float(coarse.width() - 1));
    const float v = std::clamp((float(y) + 0.5f) / 2 - 0.5f, 0.0f, float(coarse.height() - 1));
    const int x0 = int(u), y0 = int(v);
    const int x1 = std::min(x0 + 1, coarse.width() - 1), y1 = std::min(y0 + 1, coarse.height() - 1);
    const float s = u - float(x0), t = v - float(y0);
    return (1 - t) * ((1 - s) * coarse(x0, y0) + s * coarse(x1, y0)) +
           t * ((1 - s) * coarse(x0, y1) + s * coarse(x1, y1));
}

void pull(Level& fine, const Level& coarse) {
    parallel_rows(fine.value.height(), 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < fine.value.width(); ++x) {
                const float w = fine.weight(x, y);
                if (w >= 1) continue;
                fine.value(x, y) = w * fine.value(x, y) + (1 - w) * above(coarse.value, x, y);
            }
        }
    });
}

/// One pass of neighbor averages inside the holes only, which takes the facets off the pyramid.
void relax(const Image<float>& from, const Image<float>& known, Image<float>& to) {
    const int width = from.width(), height = from.height();
    parallel_rows(height, 32, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const int up = std::max(y - 1, 0), down = std::min(y + 1, height - 1);
            for (int x = 0; x < width; ++x) {
                const int left = std::max(x - 1, 0), right = std::min(x + 1, width - 1);
                to(x, y) =
                    known(x, y) > 0
                        ? from(x, y)
                        : 0.25f * (from(x, up) + from(x, down) + from(left, y) + from(right, y));
            }
        }
    });
}

/// Values of the specimen with the holes interpolated from around them; false if there is no hole
/// or nothing to interpolate from.
bool fill_holes(Image<float>& values, const Mask& specimen, const Mask& holes) {
    std::vector<Level> levels(1);
    levels[0] = {values.clone(), Image<float>(values.width(), values.height())};
    bool any_known = false, any_hole = false;
    for (std::size_t i = 0; i < values.pixel_count(); ++i) {
        if (!specimen.empty() && specimen.pixels()[i] == 0) continue;
        if (holes.pixels()[i] != 0) {
            any_hole = true;
            continue;
        }
        levels[0].weight.pixels()[i] = 1;
        any_known = true;
    }
    if (!any_known || !any_hole) return false;

    while (levels.back().value.width() > 1 || levels.back().value.height() > 1) {
        levels.push_back(half(levels.back()));
    }
    for (std::size_t i = levels.size() - 1; i-- > 0;) pull(levels[i], levels[i + 1]);
    Image<float> smooth = levels[0].value.clone();
    constexpr int kPasses = 8;  // chosen: even, facets of the finest levels are 2 to 4 pixels wide
    for (int pass = 0; pass < kPasses; pass += 2) {
        relax(levels[0].value, levels[0].weight, smooth);
        relax(smooth, levels[0].weight, levels[0].value);
    }
    values = std::move(levels[0].value);
    return true;
}

}  // namespace

Image<float> fill_luma(const Image<SrgbF>& canvas, const Mask& specimen, const Mask& clipped) {
    const int width = canvas.width(), height = canvas.height();
    Image<float> fill = Image<float>::for_overwrite(width, height);
    std::fill(fill.pixels().begin(), fill.pixels().end(), -1.0f);
    if (clipped.empty()) return fill;
    Image<float> values(width, height);
    std::transform(canvas.pixels().begin(), canvas.pixels().end(), values.pixels().begin(),
                   [](const SrgbF& c) { return luma(c); });
    if (!fill_holes(values, specimen, clipped)) return fill;
    for (std::size_t i = 0; i < fill.pixel_count(); ++i) {
        const bool on_specimen = specimen.empty() || specimen.pixels()[i] != 0;
        if (on_specimen && clipped.pixels()[i] != 0) fill.pixels()[i] = values.pixels()[i];
    }
    return fill;
}

bool fill_values(Image<float>& values, const Mask& specimen, const Mask& clipped) {
    Image<float> filled = values.clone();
    if (!fill_holes(filled, specimen, clipped)) return false;
    for (std::size_t i = 0; i < values.pixel_count(); ++i) {
        const bool on_specimen = specimen.empty() || specimen.pixels()[i] != 0;
        if (on_specimen && clipped.pixels()[i] != 0) values.pixels()[i] = filled.pixels()[i];
    }
    return true;
}

void fill_colors(Image<SrgbF>& image, const Mask& specimen, const Mask& holes) {
    for (float SrgbF::*channel : {&SrgbF::r, &SrgbF::g, &SrgbF::b}) {
        Image<float> values(image.width(), image.height());
        for (std::size_t i = 0; i < values.pixel_count(); ++i) {
            values.pixels()[i] = image.pixels()[i].*channel;
        }
        if (!fill_holes(values, specimen, holes)) return;
        for (std::size_t i = 0; i < values.pixel_count(); ++i) {
            const bool on_specimen = specimen.empty() || specimen.pixels()[i] != 0;
            if (on_specimen && holes.pixels()[i] != 0) {
                image.pixels()[i].*channel = values.pixels()[i];
            }
        }
    }
}

}  // namespace verdigris
