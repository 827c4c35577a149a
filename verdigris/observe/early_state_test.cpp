// SPDX-License-Identifier: MIT
#include "verdigris/observe/early_state.h"

#include <gtest/gtest.h>

#include <vector>

namespace verdigris {
namespace {

/// Sample i is gray at values[i].
class GrayStore : public SampleStore {
  public:
    explicit GrayStore(std::vector<float> values) : values_(std::move(values)) {}
    int count() const override { return int(values_.size()); }
    int width() const override { return 5; }
    int height() const override { return 4; }
    Image<SrgbF> image(int index) const override {
        Image<SrgbF> image(5, 4);
        const float v = values_[std::size_t(index)];
        for (SrgbF& p : image.pixels()) p = {v, v / 2, v / 4};
        return image;
    }

  private:
    std::vector<float> values_;
};

Image<SrgbF> early_of(std::vector<float> values) {
    Observation observation;
    observation.store = std::make_shared<GrayStore>(std::move(values));
    return early_state(observation);
}

TEST(EarlyState, OutvotesOneBadFrameAndIgnoresLaterOnes) {
    const Image<SrgbF> early = early_of({0.9f, 0.4f, 0.5f, 0.1f, 0.0f});
    EXPECT_EQ(early(4, 3), (SrgbF{0.5f, 0.25f, 0.125f}));
}

TEST(EarlyState, TakesWhatThereIs) {
    EXPECT_EQ(early_of({0.4f})(0, 0).r, 0.4f);
    EXPECT_FLOAT_EQ(early_of({0.4f, 0.6f})(0, 0).r, 0.5f);
}

}  // namespace
}  // namespace verdigris
