// SPDX-License-Identifier: MIT
// Draws docs/images/simulated_presets.png: every preset at eight ages.
//   draw_presets OUT.png SEED (7 if left out)
#include <cairo.h>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "verdigris/simulate/simulate.h"

namespace {

using namespace verdigris;

constexpr int kAges = 8, kTile = 116, kGap = 6, kLabel = 92, kHead = 30;

// The square about the specimen, as a crop would show it, scaled to a tile by Cairo.
void draw_tile(cairo_t* context, ImageView<const SrgbU8> frame, double x, double y) {
    const int width = frame.width(), height = frame.height();
    cairo_surface_t* picture = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    unsigned char* bytes = cairo_image_surface_get_data(picture);
    const int stride = cairo_image_surface_get_stride(picture);
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const SrgbU8 c = frame(column, row);
            unsigned char* to = bytes + row * stride + column * 4;
            to[0] = c.b, to[1] = c.g, to[2] = c.r;
        }
    }
    cairo_surface_mark_dirty(picture);
    const double side = std::min(width, height), scale = kTile / side;
    cairo_save(context);
    cairo_rectangle(context, x, y, kTile, kTile);
    cairo_clip(context);
    cairo_translate(context, x - (width - side) / 2 * scale, y - (height - side) / 2 * scale);
    cairo_scale(context, scale, scale);
    cairo_set_source_surface(context, picture, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_BEST);
    cairo_paint(context);
    cairo_restore(context);
    cairo_surface_destroy(picture);
}

void draw_text(cairo_t* context, double x, double y, const std::string& text, double anchor) {
    cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, 14);
    cairo_text_extents_t extent;
    cairo_text_extents(context, text.c_str(), &extent);
    cairo_set_source_rgb(context, 0.86, 0.86, 0.86);
    cairo_move_to(context, x - anchor * extent.x_advance, y);
    cairo_show_text(context, text.c_str());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        std::fprintf(stderr, "usage: draw_presets OUT.png [seed]\n");
        return 2;
    }
    const int rows = int(preset_names().size());
    cairo_surface_t* surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, kLabel + kAges * (kTile + kGap) + kGap,
                                   kHead + rows * (kTile + kGap) + kGap);
    cairo_t* context = cairo_create(surface);
    cairo_set_source_rgb(context, 0.11, 0.11, 0.12);
    cairo_paint(context);
    for (int row = 0; row < rows; ++row) {
        SimulationSpec spec = preset_spec(preset_names()[std::size_t(row)]);
        spec.seed = argc == 3 ? std::uint64_t(std::atoll(argv[2])) : 7;
        const double top = kHead + row * (kTile + kGap);
        draw_text(context, kLabel - 10, top + kTile / 2.0 + 5, spec.preset, 1);
        int tile = 0;
        simulate(spec, {.frame8 =
                            [&](int i, ImageView<const SrgbU8> frame) {
                                // Evenly over the recording, its last frame included.
                                if (i != tile * (spec.frames.count - 1) / (kAges - 1)) return;
                                const double left = kLabel + tile * (kTile + kGap);
                                draw_tile(context, frame, left, top);
                                if (row == 0) {
                                    draw_text(
                                        context, left + kTile / 2.0, kHead - 10,
                                        fmt::format("{:.1f} units", frame_unit(spec.frames, i)),
                                        0.5);
                                }
                                ++tile;
                            },
                        .frame16 = {},
                        .state = {}});
    }
    const bool written = cairo_surface_write_to_png(surface, argv[1]) == CAIRO_STATUS_SUCCESS;
    cairo_destroy(context);
    cairo_surface_destroy(surface);
    if (!written) std::fprintf(stderr, "draw_presets: %s cannot be written\n", argv[1]);
    return written ? 0 : 1;
}
