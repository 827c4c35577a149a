// SPDX-License-Identifier: MIT
// Samples that note which of them are read (internal).
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "verdigris/observe/observe.h"

namespace verdigris {

class WatchedStore final : public SampleStore {
  public:
    explicit WatchedStore(std::shared_ptr<const SampleStore> samples)
        : samples_(std::move(samples)), read_(std::size_t(samples_->count())) {}
    int count() const override { return samples_->count(); }
    int width() const override { return samples_->width(); }
    int height() const override { return samples_->height(); }
    Image<SrgbF> image(int index) const override {
        read_[std::size_t(index)] = true;
        return samples_->image(index);
    }
    /// Increasing.
    std::vector<int> read() const {
        std::vector<int> out;
        for (std::size_t i = 0; i < read_.size(); ++i) {
            if (read_[i]) out.push_back(int(i));
        }
        return out;
    }

  private:
    std::shared_ptr<const SampleStore> samples_;
    mutable std::vector<std::atomic<bool>> read_;
};

}  // namespace verdigris
