// SPDX-License-Identifier: MIT
#include "verdigris/observe/sample_line.h"

#include <algorithm>
#include <cmath>

#include "verdigris/observe/bin_accumulator.h"
#include "verdigris/observe/noise.h"
#include "verdigris/observe/shrink.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/recording/code_scale.h"
#include "verdigris/recording/to_srgb.h"
#include "verdigris/recording/transfer.h"

namespace verdigris {
namespace {

constexpr int kLongestContext = 10;  // the paper's sweep goes to n = 10 [Paper]
constexpr int kOften =
    20;  // chosen: a 20th of the samples; the lamp's glint on a plate stays, others pass

constexpr int kTileWidth = 64, kTileHeight = 32;

void between(const SampleCodes& a, const SampleCodes& b, float t, SampleCodes& out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float p = a[i], q = b[i];
        out[i] = std::uint16_t(p + t * (q - p) + 0.5f);
    }
}

struct Range {
    double low = 65535, high = 0;
};

// Signed, as baseline x86 compares sixteen bits only so.
Range range_of(const Plane& plane, Rect part) {
    std::int16_t low = 32767, high = -32768;
    for (int y = part.y; y < part.y + part.height; ++y) {
        const auto* row =
            reinterpret_cast<const std::uint16_t*>(plane.data + y * plane.stride_bytes) +
            part.x * plane.channels;
        for (int i = 0; i < part.width * plane.channels; ++i) {
            const auto v = std::int16_t(row[i] ^ 0x8000);
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    return {double(low) + 32768, double(high) + 32768};
}

}  // namespace

ClipRecord::ClipRecord(const SampleLayout& layout)
    : layout_(layout), history_(layout.width(), layout.height()) {}

// Whether a pixel of `tile` (shown coordinates) can be saturated or black, from the extremes of the
// planes behind it alone. Most tiles cannot, and their color need not be made.
bool ClipRecord::may_clip(const PlaneSet& planes, Rect tile) const {
    const FrameFormat& format = layout_.format;
    if (!shown_as_coded(format.transfer, format.primaries)) return true;
    const Rect coded = coded_rect(format, tile);
    std::array<Range, 3> ranges;
    for (int p = 0; p < planes.count; ++p) {
        const Rect all = plane_rect(format, p, layout_.coded);
        Rect part = plane_rect(format, p, coded);
        part.x -= all.x, part.y -= all.y;
        ranges[std::size_t(p)] = range_of(planes.plane[std::size_t(p)], part);
    }
    const CodeScale scale(format);
    const double low = scale.luma(ranges[0].low), high = scale.luma(ranges[0].high);
    double most = high;  // no channel is above
    if (format.model == PixelModel::yuv) {
        const auto swing = [&](Range r) {
            return std::max(std::fabs(scale.chroma(r.low)), std::fabs(scale.chroma(r.high)));
        };
        const double cb = swing(ranges[1]), cr = swing(ranges[2]);
        most += std::max({std::fabs(scale.red_cr) * cr, std::fabs(scale.blue_cb) * cb,
                          std::fabs(scale.green_cb) * cb + std::fabs(scale.green_cr) * cr});
    }
    // The largest channel is never below the luma, a mean of the three. (Of RGB planes `low` is
    // the least of all channels: a safe bound as well.)
    constexpr double kSafe = 1e-4;
    return low <= double(kBlack) + kSafe || most >= double(kSaturated) - kSafe;
}

void ClipRecord::add_tile(std::uint16_t now, const PlaneSet& planes, Rect tile) {
    const Rect& shown = layout_.shown;
    const Rect part{shown.x + tile.x, shown.y + tile.y, tile.width, tile.height};
    if (!may_clip(planes, part)) return;
    const Image<SrgbF> pixels = srgb_from_part(planes, layout_.coded, layout_.format, part);
    for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
            if (!is_clipped(pixels(x, y))) continue;
            History& h = history_(tile.x + x, tile.y + y);
            if (h.times < 65535) ++h.times;
            h.before = h.latest;
            h.latest = now;
        }
    }
}

void ClipRecord::add(int position, const SampleCodes& sample) {
    const auto now = std::uint16_t(std::min(position + 1, 65535));
    const PlaneSet planes = layout_.planes(sample.data());
    const int width = layout_.width();
    parallel_rows(layout_.height(), kTileHeight, [&](RowRun run) {
        for (int x = 0; x < width; x += kTileWidth) {
            add_tile(now, planes,
                     {x, run.begin, std::min(kTileWidth, width - x), run.end - run.begin});
        }
    });
}

Mask ClipRecord::mask(int count) const {
    const int width = history_.width(), height = history_.height();
    Mask hit(width, height), wide(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const History& h = history_(x, y);
            const bool recent = h.latest > 0 && h.latest > count - kLongestContext;
            const bool twice = h.before > 0 && h.before > count - std::max(count / 3, 1);
            const bool often = h.times >= 2 && kOften * int(h.times) >= count;
            if (recent || twice || often) hit(x, y) = kInside;
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
                    wide(x, y) = std::max(wide(x, y), hit(u, v));
                }
            }
        }
    }
    return wide;
}

SampleLine::SampleLine(std::vector<int> bins, const SampleLayout& layout,
                       const std::filesystem::path& store, bool looking)
    : layout_(layout),
      bins_(std::move(bins)),
      sink_(make_sample_sink(store, layout)),
      clips_(layout) {
    const int count = int(bins_.size());
    if (looking) look_at_ = evenly(count, std::min(count, kMaxLooks));
    look_.frame_width = layout.width();
    look_.frame_height = layout.height();
}

SampleCodes& SampleLine::buffer() {
    sink_->wait();  // of the two buffers it may still be writing either
    SampleCodes& next = buffers_[1 - last_];
    next.resize(layout_.codes());
    return next;
}

void SampleLine::give(int bin, int frames) {
    const SampleCodes& given = buffers_[1 - last_];
    for (; next_ < bins_.size() && bins_[next_] < bin; ++next_) {
        const int empty = bins_[next_];
        if (last_bin_ < 0) {
            emit(empty, 0, given);
        } else {
            SampleCodes filled(layout_.codes());
            between(buffers_[last_], given, float(empty - last_bin_) / float(bin - last_bin_),
                    filled);
            emit(empty, 0, filled);
            sink_->wait();
        }
    }
    if (next_ < bins_.size() && bins_[next_] == bin) {
        ++next_;
        emit(bin, frames, given);
    }
    last_ = 1 - last_;
    last_bin_ = bin;
}

void SampleLine::emit(int bin, int frames, const SampleCodes& codes) {
    const int position = int(kept_.size());
    clips_.add(position, codes);
    if (std::binary_search(look_at_.begin(), look_at_.end(), position)) {
        const int factor = std::max(layout_.width(), layout_.height()) / kLookSide;
        look_.frames.push_back(look_sized(shrunk_sample(layout_, codes, factor)));
        look_.index.push_back(position);
        look_.decodable = position + 1;
    }
    kept_.push_back({bin, frames});
    sink_->append(codes);
}

}  // namespace verdigris
