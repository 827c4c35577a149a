// SPDX-License-Identifier: MIT
// Draws docs/images/copper_color_path.png: what a growing film looks like. draw_color_path OUT.png
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "verdigris/color/convert.h"
#include "verdigris/copper/copper.h"

namespace {

using namespace verdigris;

constexpr int kLeft = 232, kStrip = 1000, kRight = 20, kRow = 46, kGap = 6, kTop = 72;
constexpr double kMostNm = 200;

SurfaceOptics smooth_film() {
    SurfaceOptics optics;
    optics.thickness_spread = 0;
    optics.brown_limit = false;
    return optics;
}

class Sheet {
  public:
    Sheet(int width, int height)
        : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
          context_(cairo_create(surface_)) {
        cairo_set_source_rgb(context_, 0.11, 0.11, 0.12);
        cairo_paint(context_);
    }
    ~Sheet() {
        cairo_destroy(context_);
        cairo_surface_destroy(surface_);
    }
    Sheet(const Sheet&) = delete;
    Sheet& operator=(const Sheet&) = delete;

    void column(int x, int y, int height, SrgbF c) {
        cairo_set_source_rgb(context_, double(c.r), double(c.g), double(c.b));
        cairo_rectangle(context_, x, y, 1, height);
        cairo_fill(context_);
    }
    /// `anchor` 0 left, 0.5 middle, 1 right.
    void text(double x, double y, const std::string& words, double anchor, double size = 14) {
        cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                               CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(context_, size);
        cairo_text_extents_t extent;
        cairo_text_extents(context_, words.c_str(), &extent);
        cairo_set_source_rgb(context_, 0.85, 0.85, 0.85);
        cairo_move_to(context_, x - anchor * extent.x_advance, y);
        cairo_show_text(context_, words.c_str());
    }
    bool save(const char* path) {
        return cairo_surface_write_to_png(surface_, path) == CAIRO_STATUS_SUCCESS;
    }

  private:
    cairo_surface_t* surface_;
    cairo_t* context_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: draw_color_path OUT.png\n");
        return 2;
    }
    constexpr int kRows = 8, kAxis = 40;
    Sheet sheet(kLeft + kStrip + kRight, kTop + kRows * (kRow + kGap) + 2 * kAxis + 8);
    int y = kTop;
    const auto strip = [&](const std::string& label, const SurfaceOptics& optics,
                           const std::function<SurfaceState(double)>& state_at) {
        sheet.text(kLeft - 10, y + kRow / 2 + 5, label, 1);
        for (int x = 0; x < kStrip; ++x) {
            const Spectrum s = surface_reflectance(state_at((x + 0.5) / kStrip), optics);
            sheet.column(kLeft + x, y, kRow, encoded_from_linear(linear_from_reflectance(s)));
        }
        y += kRow + kGap;
    };
    const auto axis = [&](double least, double most, double step, const char* unit, int x0,
                          int width) {
        for (double v = least; v <= most + 1e-9; v += step) {
            const bool last = v + step > most + 1e-9;
            char words[32];
            std::snprintf(words, sizeof words, "%g%s", v, last ? unit : "");
            sheet.text(x0 + width * (v - least) / (most - least), y + 14, words,
                       last         ? 1
                       : v == least ? 0
                                    : 0.5);
        }
        y += kAxis;
    };

    // Names where a film of half Cu2O has them (verdigris/copper/color_path_test.cpp).
    struct Name {
        double nm;
        const char* words;
    };
    int tier = 0;
    for (const Name& name : {Name{0, "copper"},
                             {10, "gold"},
                             {20, "red-brown"},
                             {29, "violet"},
                             {38, "blue"},
                             {48, "silver"},
                             {80, "second gold"},
                             {105, "rose"},
                             {128, "blue"},
                             {142, "green"},
                             {175, "third order, washed out"}}) {
        sheet.text(kLeft + name.nm / kMostNm * kStrip, 28 + 18 * tier, name.words,
                   name.nm == 0 ? 0 : 0.5);
        tier = (tier + 1) % 3;  // neighbors do not fit side by side
    }
    for (const double f : {1.0, 0.75, 0.5, 0.25, 0.0}) {
        char label[64];
        std::snprintf(label, sizeof label, "%g %% Cu\xE2\x82\x82O, %g %% CuO", 100 * f,
                      100 * (1 - f));
        strip(label, smooth_film(), [f](double t) { return SurfaceState{t * kMostNm, f, 0}; });
    }
    strip("default chemistry, smooth", smooth_film(), [](double t) {
        return SurfaceState{t * kMostNm, cu2o_fraction(t * kMostNm), 0};
    });
    strip("half Cu\xE2\x82\x82O, default surface", SurfaceOptics{}, [](double t) {
        return SurfaceState{t * kMostNm, 0.5, 0};
    });
    axis(0, kMostNm, 20, " nm", kLeft, kStrip);
    strip("to brown, then green over it", SurfaceOptics{}, [](double t) {
        return t < 0.5 ? SurfaceState{200 + 1600 * t, 0.4, 0}
                       : SurfaceState{1000, 0.4, 24 * (t - 0.5)};
    });
    axis(200, 1000, 200, " nm", kLeft, kStrip / 2 - 10);
    y -= kAxis;
    axis(0, 12, 3, " \xC2\xB5m of patina", kLeft + kStrip / 2, kStrip / 2);
    if (!sheet.save(argv[1])) {
        std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
        return 1;
    }
    return 0;
}
