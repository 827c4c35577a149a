// SPDX-License-Identifier: MIT
#include "verdigris/observe/sample_layout.h"

#include <algorithm>
#include <cmath>

#include "verdigris/error.h"
#include "verdigris/observe/bin_accumulator.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/to_srgb.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 64;

int plane_count(const FrameFormat& format) {
    return format.model == PixelModel::yuv ? 3 : 1;
}

}  // namespace

std::size_t SampleLayout::codes() const {
    std::size_t sum = 0;
    for (int p = 0; p < plane_count(format); ++p) {
        const Rect r = plane_rect(format, p, coded);
        sum += std::size_t(r.width) * std::size_t(r.height) * (is_rgb() ? 3 : 1);
    }
    return sum;
}

PlaneSet SampleLayout::planes(const std::uint16_t* codes) const {
    PlaneSet set;
    set.count = plane_count(format);
    const int channels = is_rgb() ? 3 : 1;
    for (int p = 0; p < set.count; ++p) {
        const Rect r = plane_rect(format, p, coded);
        const auto row = std::size_t(r.width) * std::size_t(channels);
        set.plane[std::size_t(p)] = {reinterpret_cast<const std::byte*>(codes),
                                     std::ptrdiff_t(row * sizeof(std::uint16_t)),
                                     r.width,
                                     r.height,
                                     channels,
                                     SampleType::u16};
        codes += row * std::size_t(r.height);
    }
    return set;
}

void SampleLayout::check() const {
    constexpr int kMost = 1 << 20;  // as many pixels across as any file can have
    const auto within = [](int v, int least, int most) { return v >= least && v <= most; };
    const int w = format.coded_width, h = format.coded_height;
    const bool turned = format.rotation % 180 != 0;
    const bool ok =
        within(w, 1, kMost) && within(h, 1, kMost) && within(format.bits, 8, 16) &&
        within(format.fraction_bits, 0, 16 - format.bits) &&
        (format.rotation == 0 || format.rotation == 90 || format.rotation == 180 ||
         format.rotation == 270) &&
        within(format.chroma_shift_x, 0, 2) && within(format.chroma_shift_y, 0, 2) &&
        format.kr > 0 && format.kb > 0 && format.kr + format.kb < 1 &&
        std::fabs(format.chroma_x) <= 4 && std::fabs(format.chroma_y) <= 4 &&
        within(shown.x, 0, kMost) && within(shown.y, 0, kMost) && within(shown.width, 1, kMost) &&
        within(shown.height, 1, kMost) && shown.x + shown.width <= (turned ? h : w) &&
        shown.y + shown.height <= (turned ? w : h) && coded == coded_rect(format, shown);
    if (!ok) throw Error(ErrorCode::bad_input, "the layout of the samples makes no sense");
}

SampleLayout rgb_layout(int width, int height) {
    SampleLayout layout;
    layout.format.model = PixelModel::rgb;
    layout.format.type = SampleType::u16;
    layout.format.bits = 16;
    layout.format.coded_width = width;
    layout.format.coded_height = height;
    layout.coded = layout.shown = {0, 0, width, height};
    return layout;
}

SampleLayout plane_layout(const FrameFormat& format, Rect shown) {
    if (format.model != PixelModel::yuv || format.type == SampleType::f32) {
        throw Error(ErrorCode::usage, "only planes of integers can be stored as they are");
    }
    SampleLayout layout;
    layout.format = format;
    layout.format.type = SampleType::u16;
    layout.format.fraction_bits = 16 - format.bits;
    layout.shown = shown;
    layout.coded = coded_rect(format, shown);
    return layout;
}

Image<SrgbF> rows_of_sample(const SampleLayout& layout, const std::uint16_t* codes, int begin,
                            int end) {
    const Rect part{layout.shown.x, layout.shown.y + begin, layout.shown.width, end - begin};
    return srgb_from_part(layout.planes(codes), layout.coded, layout.format, part);
}

void pack_rgb(const Image<SrgbF>& image, SampleCodes& out) {
    parallel_rows(image.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const int n = 3 * image.width();
            const float* from = &image.row(y)->r;
            std::uint16_t* to = out.data() + std::size_t(y) * std::size_t(n);
            for (int i = 0; i < n; ++i) {  // as u16_from_srgb, but vectorizable
                const float v = from[i] > 0 ? std::min(from[i], 1.0f) : 0.0f;
                to[i] = std::uint16_t(int(v * 65535.0f + 0.5f));
            }
        }
    });
}

}  // namespace verdigris
