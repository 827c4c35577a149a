// SPDX-License-Identifier: MIT
// The line of kept samples: fills empty bins from their neighbors, remembers where samples were
// saturated, hands them to the store.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "verdigris/observe/look.h"
#include "verdigris/observe/observe.h"
#include "verdigris/observe/sample_store.h"

namespace verdigris {

/// Where samples were saturated, and when. Per pixel: how often, and the two latest times.
class ClipRecord {
  public:
    explicit ClipRecord(const SampleLayout& layout);
    void add(int position, const SampleCodes& sample);
    /// What must not steer a fit, of `count` samples: saturated in one of the last 10 (the longest
    /// context of the paper), in two of the last third, or in a 20th of all (the lamp's glint, even
    /// if the surface has become matte since). Dilated by one pixel: demosaicing and blur carry a
    /// glint that far.
    Mask mask(int count) const;

  private:
    bool may_clip(const PlaneSet& planes, Rect tile) const;
    void add_tile(std::uint16_t now, const PlaneSet& planes, Rect tile);

    struct History {
        std::uint16_t times = 0, latest = 0, before = 0;  ///< positions + 1
    };
    SampleLayout layout_;
    Image<History> history_;
};

class SampleLine {
  public:
    /// `bins`: the bins to keep, increasing. With `looking`, a look at the samples is taken as
    /// they pass.
    SampleLine(std::vector<int> bins, const SampleLayout& layout,
               const std::filesystem::path& store, bool looking);

    /// Where the next sample to be given is made. Every code must be written.
    SampleCodes& buffer();
    /// What was made in buffer() is the sample of a kept bin; bins in between that were not given
    /// are interpolated.
    void give(int bin, int frames);
    /// Bins after the last given one are dropped.
    std::shared_ptr<const SampleStore> finish() { return sink_->finish(); }

    /// What went to the store: bin, frames (0: interpolated).
    struct Kept {
        int bin = 0, frames = 0;
    };
    const std::vector<Kept>& kept() const { return kept_; }
    /// Evenly spaced samples; frames are samples here.
    Look take_look() { return std::move(look_); }
    Mask clipped() const { return clips_.mask(int(kept_.size())); }

  private:
    void emit(int bin, int frames, const SampleCodes& codes);
    SampleLayout layout_;
    std::vector<int> bins_;
    std::size_t next_ = 0;  ///< into bins_
    // The last sample given, and the next. Before the sink, which may be writing one when an
    // exception ends us, and waits when it is destroyed.
    std::array<SampleCodes, 2> buffers_;
    std::size_t last_ = 0;  ///< into buffers_
    std::unique_ptr<SampleSink> sink_;
    ClipRecord clips_;
    std::vector<Kept> kept_;
    int last_bin_ = -1;
    std::vector<int> look_at_;
    Look look_;
};

}  // namespace verdigris
