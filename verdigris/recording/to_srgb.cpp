// SPDX-License-Identifier: MIT
#include "verdigris/recording/to_srgb.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/coded_row.h"
#include "verdigris/recording/transfer.h"

namespace verdigris {
namespace {

// chosen: 32 rows of even a small frame are more than the 10 us a task should last, and 32 pixels
// across keep the turned case (columns become rows) within few cache lines.
constexpr int kRowsPerRun = 32;

Rect coded_from_shown(const FrameFormat& format, Rect shown) {
    const int w = format.coded_width, h = format.coded_height;
    switch (format.rotation) {
        case 90:
            return {shown.y, h - shown.x - shown.width, shown.height, shown.width};
        case 180:
            return {w - shown.x - shown.width, h - shown.y - shown.height, shown.width,
                    shown.height};
        case 270:
            return {w - shown.y - shown.height, shown.x, shown.height, shown.width};
        default:
            return shown;
    }
}

bool inside(Rect inner, Rect outer) {
    return inner.x >= outer.x && inner.y >= outer.y && inner.width >= 0 && inner.height >= 0 &&
           inner.x + inner.width <= outer.x + outer.width &&
           inner.y + inner.height <= outer.y + outer.height;
}

// Whole chroma samples and one more on each side; without subsampling nothing is shared between
// pixels and nothing is added.
void widen(int& begin, int& length, int shift, int limit) {
    if (shift == 0) return;
    const int first = (begin >> shift) - 1, last = ((begin + length - 1) >> shift) + 1;
    const int from = std::max(first << shift, 0), to = std::min((last + 1) << shift, limit);
    begin = from;
    length = to - from;
}

// Puts a converted stretch of a coded row where it is shown.
class Placer {
  public:
    Placer(const FrameFormat& format, Rect crop, Image<SrgbF>& out)
        : rotation_(format.rotation), from_(coded_from_shown(format, crop)), out_(out) {}

    /// The coded samples that make rows [run.begin, run.end) of the result.
    Rect source(RowRun run) const {
        const int n = run.end - run.begin;
        switch (rotation_) {
            case 90:
                return {from_.x + run.begin, from_.y, n, from_.height};
            case 180:
                return {from_.x, from_.y + from_.height - run.end, from_.width, n};
            case 270:
                return {from_.x + from_.width - run.end, from_.y, n, from_.height};
            default:
                return {from_.x, from_.y + run.begin, from_.width, n};
        }
    }
    /// Where a coded stretch can be written directly, or null.
    SrgbF* direct(int y) { return rotation_ == 0 ? out_.row(y - from_.y) : nullptr; }
    void place(int x, int y, int n, const SrgbF* pixels) {
        const int column = x - from_.x, row = y - from_.y;
        if (rotation_ == 90) {
            for (int i = 0; i < n; ++i) out_.row(column + i)[from_.height - 1 - row] = pixels[i];
        } else if (rotation_ == 180) {
            SrgbF* line = out_.row(from_.height - 1 - row);
            for (int i = 0; i < n; ++i) line[from_.width - 1 - column - i] = pixels[i];
        } else if (rotation_ == 270) {
            for (int i = 0; i < n; ++i) out_.row(from_.width - 1 - column - i)[row] = pixels[i];
        }
    }

  private:
    int rotation_;
    Rect from_;
    Image<SrgbF>& out_;
};

}  // namespace

Rect coded_rect(const FrameFormat& format, Rect shown) {
    Rect rect = coded_from_shown(format, shown);
    widen(rect.x, rect.width, format.chroma_shift_x, format.coded_width);
    widen(rect.y, rect.height, format.chroma_shift_y, format.coded_height);
    return rect;
}

Image<SrgbF> srgb_from_planes(const PlaneSet& planes, const FrameFormat& format, Rect crop) {
    return srgb_from_part(planes, {0, 0, format.coded_width, format.coded_height}, format, crop);
}

Image<SrgbF> srgb_from_part(const PlaneSet& part, Rect coded, const FrameFormat& format,
                            Rect crop) {
    if (!inside(coded_from_shown(format, crop), coded)) {
        throw Error(ErrorCode::usage, "the crop does not lie inside the frame");
    }
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(crop.width, crop.height);
    const bool as_coded = shown_as_coded(format.transfer, format.primaries);
    Placer placer(format, crop, out);
    parallel_rows(crop.height, kRowsPerRun, [&](RowRun run) {
        const Rect source = placer.source(run);
        CodedRow row(part, coded, format);
        std::vector<SrgbF> stretch(std::size_t(std::max(source.width, 0)));
        for (int y = source.y; y < source.y + source.height; ++y) {
            SrgbF* direct = placer.direct(y);
            SrgbF* pixels = direct ? direct : stretch.data();
            row.read(source.x, y, source.width, pixels);
            if (!as_coded) {
                for (int i = 0; i < source.width; ++i) {
                    pixels[i] = srgb_from_coded(pixels[i], format.transfer, format.primaries);
                }
            }
            if (!direct) placer.place(source.x, y, source.width, pixels);
        }
    });
    return out;
}

}  // namespace verdigris
