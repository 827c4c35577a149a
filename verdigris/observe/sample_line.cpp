// SPDX-License-Identifier: MIT
#include "verdigris/observe/sample_line.h"

#include <algorithm>

#include "verdigris/observe/noise.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kLongestContext = 10;  // the paper's sweep goes to n = 10 [Paper]
constexpr int kOften =
    20;  // chosen: a 20th of the samples; the lamp's glint on a plate stays, others pass
constexpr int kRowsPerRun = 32;

Image<SrgbF> between(const Image<SrgbF>& a, const Image<SrgbF>& b, float t) {
    auto out = Image<SrgbF>::for_overwrite(a.width(), a.height());
    for (std::size_t i = 0; i < out.pixel_count(); ++i) {
        const SrgbF p = a.pixels()[i], q = b.pixels()[i];
        out.pixels()[i] = {p.r + t * (q.r - p.r), p.g + t * (q.g - p.g), p.b + t * (q.b - p.b)};
    }
    return out;
}

}  // namespace

ClipRecord::ClipRecord(int width, int height) : history_(width, height) {}

void ClipRecord::add(int position, const Image<SrgbF>& sample) {
    const auto now = std::uint16_t(std::min(position + 1, 65535));
    parallel_rows(sample.height(), kRowsPerRun, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < sample.width(); ++x) {
                if (!is_clipped(sample(x, y))) continue;
                History& h = history_(x, y);
                if (h.times < 65535) ++h.times;
                h.before = h.latest;
                h.latest = now;
            }
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

SampleLine::SampleLine(std::vector<int> bins, int width, int height,
                       const std::filesystem::path& store, bool looking)
    : bins_(std::move(bins)), sink_(make_sample_sink(store, width, height)), clips_(width, height) {
    const int count = int(bins_.size());
    if (looking) look_at_ = evenly(count, std::min(count, kMaxLooks));
    look_.frame_width = width;
    look_.frame_height = height;
}

void SampleLine::give(int bin, int frames, Image<SrgbF> image) {
    for (; next_ < bins_.size() && bins_[next_] < bin; ++next_) {
        const int empty = bins_[next_];
        Image<SrgbF> filled =
            last_bin_ < 0
                ? image.clone()
                : between(last_, image, float(empty - last_bin_) / float(bin - last_bin_));
        emit(empty, 0, std::move(filled));
    }
    last_ = image.clone();
    last_bin_ = bin;
    if (next_ < bins_.size() && bins_[next_] == bin) {
        ++next_;
        emit(bin, frames, std::move(image));
    }
}

void SampleLine::emit(int bin, int frames, Image<SrgbF> image) {
    const int position = int(kept_.size());
    clips_.add(position, image);
    if (std::binary_search(look_at_.begin(), look_at_.end(), position)) {
        look_.frames.push_back(look_sized(image));
        look_.index.push_back(position);
        look_.decodable = position + 1;
    }
    kept_.push_back({bin, frames});
    sink_->append(std::move(image));
}

}  // namespace verdigris
