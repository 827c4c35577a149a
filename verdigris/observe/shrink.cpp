// SPDX-License-Identifier: MIT
#include "verdigris/observe/shrink.h"

#include <algorithm>
#include <cstdint>

#include "verdigris/observe/bin_accumulator.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/transfer.h"

namespace verdigris {
namespace {

constexpr int kRowsPerRun = 16;

bool divides(const SampleLayout& layout, int factor) {
    for (int p = 0; p < 3; ++p) {
        const Rect r = plane_rect(layout.format, p, layout.coded);
        if (r.width % factor != 0 || r.height % factor != 0) return false;
    }
    return true;
}

// Whole frames only: of a part, the chroma around it is stored as well.
bool is_whole_frame(const SampleLayout& layout) {
    const FrameFormat& f = layout.format;
    const bool turned = f.rotation % 180 != 0;
    const int width = turned ? f.coded_height : f.coded_width;
    const int height = turned ? f.coded_width : f.coded_height;
    return layout.shown == Rect{0, 0, width, height};
}

Rect divided(Rect r, int factor) {
    return {r.x / factor, r.y / factor, r.width / factor, r.height / factor};
}

SampleLayout shrunk_layout(const SampleLayout& layout, int factor) {
    SampleLayout out = layout;
    FrameFormat& f = out.format;
    f.coded_width /= factor;
    f.coded_height /= factor;
    // A box's center is its first sample's place plus (factor - 1) / 2 samples of its plane.
    const double half = 0.5 * (factor - 1);
    f.chroma_x = (f.chroma_x + half * ((1 << f.chroma_shift_x) - 1)) / factor;
    f.chroma_y = (f.chroma_y + half * ((1 << f.chroma_shift_y) - 1)) / factor;
    out.coded = divided(layout.coded, factor);
    out.shown = divided(layout.shown, factor);
    return out;
}

void shrink_plane(const Plane& plane, int factor, std::uint16_t* out) {
    const int width = plane.width / factor, area = factor * factor;
    parallel_rows(plane.height / factor, kRowsPerRun, [&](RowRun run) {
        std::vector<std::uint32_t> sums(std::size_t(plane.width));
        for (int y = run.begin; y < run.end; ++y) {
            std::fill(sums.begin(), sums.end(), 0u);
            for (int i = 0; i < factor; ++i) {
                const auto* row = reinterpret_cast<const std::uint16_t*>(
                    plane.data + (std::ptrdiff_t(y) * factor + i) * plane.stride_bytes);
                for (std::size_t x = 0; x < sums.size(); ++x) sums[x] += row[x];
            }
            std::uint16_t* to = out + std::size_t(y) * std::size_t(width);
            for (int x = 0; x < width; ++x) {
                const std::uint32_t* box = sums.data() + std::size_t(x) * std::size_t(factor);
                std::uint32_t sum = std::uint32_t(area) / 2;
                for (int i = 0; i < factor; ++i) sum += box[i];
                to[x] = std::uint16_t(sum / std::uint32_t(area));
            }
        }
    });
}

}  // namespace

int shrink_factor(const SampleLayout& layout, int wanted) {
    if (layout.is_rgb() || !is_whole_frame(layout) ||
        !shown_as_coded(layout.format.transfer, layout.format.primaries)) {
        return 1;
    }
    constexpr int kMost = 256;  // 2^16 codes of 16 bit sum up to less than 2^32
    int factor = std::clamp(wanted, 1, kMost);
    while (!divides(layout, factor)) --factor;
    return factor;
}

Image<SrgbF> shrunk_sample(const SampleLayout& layout, const SampleCodes& codes, int wanted) {
    const int factor = shrink_factor(layout, wanted);
    if (factor == 1) return rows_of_sample(layout, codes.data(), 0, layout.height());
    const SampleLayout small = shrunk_layout(layout, factor);
    SampleCodes shrunk(small.codes());
    const PlaneSet from = layout.planes(codes.data());
    std::uint16_t* to = shrunk.data();
    for (int p = 0; p < from.count; ++p) {
        const Plane& plane = from.plane[std::size_t(p)];
        shrink_plane(plane, factor, to);
        to += std::size_t(plane.width / factor) * std::size_t(plane.height / factor);
    }
    return rows_of_sample(small, shrunk.data(), 0, small.height());
}

}  // namespace verdigris
