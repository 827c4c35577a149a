// SPDX-License-Identifier: MIT
#include "verdigris/deliver/sheet_canvas.h"

#include <cairo.h>

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "verdigris/error.h"

namespace verdigris {
namespace {

constexpr int kMaxSide = 32767;  // of a cairo image surface

struct DestroySurface {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, DestroySurface>;
using CairoContext = std::unique_ptr<cairo_t, DestroyContext>;

void check(cairo_status_t status) {
    if (status == CAIRO_STATUS_SUCCESS) return;
    throw Error(ErrorCode::failed, std::string("the contact sheet could not be drawn: ") +
                                       cairo_status_to_string(status));
}

void set_ink(cairo_t* cr, Ink ink) {
    cairo_set_source_rgb(cr, (ink.rgb >> 16 & 255) / 255.0, (ink.rgb >> 8 & 255) / 255.0,
                         (ink.rgb & 255) / 255.0);
}

// Gray antialiasing without hinting: the same glyphs whatever the desktop's font settings.
void set_font(cairo_t* cr, const TextStyle& style) {
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cr, options);
    cairo_font_options_destroy(options);
    cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, style.size);
}

// What DejaVu has no letter for (Chinese, say) becomes "?" rather than an empty box: cairo's text
// calls look into one font only. manifest.json has the title as it is.
std::string with_letters(cairo_t* cr, const std::string& text) {
    cairo_glyph_t* glyphs = nullptr;
    cairo_text_cluster_t* clusters = nullptr;
    int glyph_count = 0, cluster_count = 0;
    cairo_text_cluster_flags_t flags{};
    check(cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(cr), 0, 0, text.data(),
                                           int(text.size()), &glyphs, &glyph_count, &clusters,
                                           &cluster_count, &flags));
    std::string drawn;
    std::size_t byte = 0;
    int glyph = 0;
    for (int i = 0; i < cluster_count; ++i) {
        const cairo_text_cluster_t& cluster = clusters[i];
        const bool known = std::all_of(glyphs + glyph, glyphs + glyph + cluster.num_glyphs,
                                       [](const cairo_glyph_t& g) { return g.index != 0; });
        drawn += known ? text.substr(byte, std::size_t(cluster.num_bytes)) : "?";
        byte += std::size_t(cluster.num_bytes);
        glyph += cluster.num_glyphs;
    }
    cairo_glyph_free(glyphs);
    cairo_text_cluster_free(clusters);
    return drawn;
}

}  // namespace

struct SheetCanvas::State {
    int width, height;
    CairoSurface surface;
    CairoContext cr;

    State(int w, int h)
        : width(w),
          height(h),
          surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, w, h)),
          cr(cairo_create(surface.get())) {
        check(cairo_surface_status(surface.get()));
        check(cairo_status(cr.get()));
    }
};

TextWidth measure(const TextStyle& style) {
    const std::shared_ptr<cairo_surface_t> surface(
        cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), &cairo_surface_destroy);
    const std::shared_ptr<cairo_t> cr(cairo_create(surface.get()), &cairo_destroy);
    set_font(cr.get(), style);
    return [surface, cr](const std::string& text) {
        cairo_text_extents_t extents{};
        cairo_text_extents(cr.get(), with_letters(cr.get(), text).c_str(), &extents);
        check(cairo_status(cr.get()));
        return extents.x_advance;
    };
}

double text_width(const std::string& text, const TextStyle& style) {
    return measure(style)(text);
}

SheetCanvas::SheetCanvas(int width, int height, Ink background) {
    if (width > kMaxSide || height > kMaxSide) {
        throw Error(ErrorCode::failed, "the contact sheet would be larger than 32767 pixels");
    }
    state_ = std::make_unique<State>(width, height);
    set_ink(state_->cr.get(), background);
    cairo_paint(state_->cr.get());
}

SheetCanvas::~SheetCanvas() = default;

void SheetCanvas::fill(Rect rect, Ink ink, double radius) {
    cairo_t* cr = state_->cr.get();
    set_ink(cr, ink);
    const double x = rect.x, y = rect.y, w = rect.width, h = rect.height;
    if (radius <= 0) {
        cairo_rectangle(cr, x, y, w, h);
    } else {
        constexpr double kQuarter = std::numbers::pi / 2;
        cairo_new_sub_path(cr);
        cairo_arc(cr, x + w - radius, y + radius, radius, -kQuarter, 0);
        cairo_arc(cr, x + w - radius, y + h - radius, radius, 0, kQuarter);
        cairo_arc(cr, x + radius, y + h - radius, radius, kQuarter, 2 * kQuarter);
        cairo_arc(cr, x + radius, y + radius, radius, 2 * kQuarter, 3 * kQuarter);
        cairo_close_path(cr);
    }
    cairo_fill(cr);
}

void SheetCanvas::frame(Rect rect, Ink ink) {
    cairo_t* cr = state_->cr.get();
    set_ink(cr, ink);
    cairo_set_line_width(cr, 1);
    cairo_set_dash(cr, nullptr, 0, 0);
    cairo_rectangle(cr, rect.x - 0.5, rect.y - 0.5, rect.width + 1, rect.height + 1);
    cairo_stroke(cr);
}

void SheetCanvas::line(double x0, double y0, double x1, double y1, Ink ink, double width,
                       bool dashed) {
    cairo_t* cr = state_->cr.get();
    const double dash[] = {6, 6};
    set_ink(cr, ink);
    cairo_set_line_width(cr, width);
    cairo_set_dash(cr, dash, dashed ? 2 : 0, 0);
    cairo_move_to(cr, x0, y0);
    cairo_line_to(cr, x1, y1);
    cairo_stroke(cr);
}

void SheetCanvas::text(double x, double y, const std::string& text, const TextStyle& style) {
    cairo_t* cr = state_->cr.get();
    set_font(cr, style);
    set_ink(cr, style.ink);
    cairo_move_to(cr, x, y);
    cairo_show_text(cr, with_letters(cr, text).c_str());
    check(cairo_status(cr));
}

void SheetCanvas::picture(int x, int y, ImageView<const SrgbU8> image) {
    cairo_surface_t* surface = state_->surface.get();
    cairo_surface_flush(surface);
    unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    const Rect sheet{0, 0, state_->width, state_->height};
    for (int row = 0; row < image.height(); ++row) {
        if (y + row < 0 || y + row >= sheet.height) continue;
        auto* out = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t(y + row) * stride);
        const SrgbU8* in = image.row(row);
        const int first = std::max(0, -x), last = std::min(image.width(), sheet.width - x);
        for (int column = first; column < last; ++column) {
            const SrgbU8 c = in[column];
            out[x + column] = 0xFF000000u | unsigned(c.r) << 16 | unsigned(c.g) << 8 | c.b;
        }
    }
    cairo_surface_mark_dirty(surface);
}

Image<SrgbU8> SheetCanvas::pixels() const {
    cairo_surface_t* surface = state_->surface.get();
    check(cairo_status(state_->cr.get()));
    cairo_surface_flush(surface);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    Image<SrgbU8> image = Image<SrgbU8>::for_overwrite(state_->width, state_->height);
    for (int y = 0; y < state_->height; ++y) {
        const auto* in = reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t(y) * stride);
        SrgbU8* out = image.row(y);
        for (int x = 0; x < state_->width; ++x) {
            out[x] = {std::uint8_t(in[x] >> 16 & 255), std::uint8_t(in[x] >> 8 & 255),
                      std::uint8_t(in[x] & 255)};
        }
    }
    return image;
}

}  // namespace verdigris
