// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/held_recording.h"

#include <algorithm>
#include <span>

#include "verdigris/files/sha256.h"
#include "verdigris/observe/noise.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kAtOnce = 32;  // chosen: keeps the cores busy between two reports of progress

/// `body(i)` for every sample, in parallel, reporting.
template <class Body>
void each_sample(SampleRange range, std::string_view stage, const Progress& progress,
                 const Body& body) {
    for (int begin = range.begin; begin < range.end; begin += kAtOnce) {
        report(progress, stage, begin - range.begin, range.count());
        parallel_for(std::min(kAtOnce, range.end - begin), [&](int i) { body(begin + i); });
    }
    report(progress, stage, range.count(), range.count());
}

/// Empty if nothing is clipped.
Mask clipped_and_beside(const Image<SrgbF>& frame) {
    Mask mask;
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
            if (!is_clipped(frame(x, y))) continue;
            if (mask.empty()) mask = Mask(frame.width(), frame.height());
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, frame.height() - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, frame.width() - 1); ++u) {
                    mask(u, v) = kInside;
                }
            }
        }
    }
    return mask;
}

}  // namespace

HeldRecording::HeldRecording(const Observation& observation, SampleRange usable,
                             const Progress& progress)
    : usable_(usable), frames_(std::size_t(usable.count())), clipped_(std::size_t(usable.count())) {
    each_sample(usable, "load", progress, [&](int sample) {
        const auto i = std::size_t(sample - usable.begin);
        frames_[i] = observation.store->image(sample);
        clipped_[i] = clipped_and_beside(frames_[i]);
    });
}

void HeldRecording::clipped(const std::vector<int>& samples, int context, Mask& out) const {
    if (!out.same_size(width(), height())) out = Mask(width(), height());
    std::ranges::fill(out.pixels(), std::uint8_t(0));
    for (int i = 0; i < context; ++i) {
        const Mask& mask = clipped_[std::size_t(samples[std::size_t(i)] - usable_.begin)];
        if (mask.empty()) continue;
        std::ranges::transform(mask.pixels(), out.pixels(), out.pixels().begin(),
                               [](std::uint8_t a, std::uint8_t b) { return a | b; });
    }
}

std::vector<std::string> frame_hashes(const SampleStore& samples, SampleRange usable,
                                      const Progress& progress) {
    std::vector<std::string> hashes(std::size_t(usable.count()));
    each_sample(usable, "hash", progress, [&](int sample) {
        const Image<SrgbF> image = samples.image(sample);
        Sha256 hash;
        hash.update(std::as_bytes(image.pixels()));
        hashes[std::size_t(sample - usable.begin)] = hash.hex();
    });
    return hashes;
}

}  // namespace verdigris
