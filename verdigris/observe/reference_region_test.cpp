// SPDX-License-Identifier: MIT
#include "verdigris/observe/reference_region.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/observe/testing/drifting_store.h"

namespace verdigris {
namespace {

using testing::DriftingScene;
using testing::FunctionStore;

FunctionStore still(const DriftingScene& scene, FunctionStore::Pixel pixel) {
    return {scene.width, scene.height, 30, std::move(pixel)};
}

TEST(ReferenceRegion, IsTheBackdropAwayFromThePlate) {
    const DriftingScene scene;
    const auto store = still(scene, [&](int x, int y, int t) { return scene.undrifted(x, y, t); });
    const ReferenceRegion region = find_reference_region(store, scene.specimen());
    ASSERT_TRUE(region.found());
    EXPECT_EQ(region.margin, 1);
    const int distance = int(0.06 * scene.height);  // 3 pixels
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            const bool near = x >= 30 - distance && x < 66 + distance && y >= 18 && y < 48;
            if (near) {
                EXPECT_EQ(region.mask(x, y), 0) << x << "," << y;
            }
            // The border of the picture is no edge of the backdrop.
            if (x < 20) {
                EXPECT_EQ(region.mask(x, y), kInside) << x << "," << y;
            }
        }
    }
}

TEST(ReferenceRegion, KnowsAppearanceOnlyAndNothingThatComesLater) {
    const DriftingScene scene;
    const auto later = [&](bool changes) {
        return still(scene, [&scene, changes](int x, int y, int t) {
            if (changes && t >= 20) return SrgbF{0.9f, 0.2f, float(x) / 96};
            if (t == 3) return SrgbF{1, 1, 1};  // one flash is outvoted
            return scene.undrifted(x, y, 0);
        });
    };
    const ReferenceRegion a = find_reference_region(later(false), scene.specimen());
    const ReferenceRegion b = find_reference_region(later(true), scene.specimen());
    ASSERT_TRUE(a.found());
    EXPECT_TRUE(std::ranges::equal(a.mask.pixels(), b.mask.pixels()));
}

TEST(ReferenceRegion, LeavesOutWhatIsColoredBlackOrOverexposed) {
    const DriftingScene scene;
    const auto store = still(scene, [&](int x, int y, int) {
        if (x < 24) return SrgbF{0.6f, 0.42f, 0.33f};
        if (y < 12) return SrgbF{0.02f, 0.02f, 0.02f};
        if (y >= 54) return SrgbF{0.99f, 0.99f, 0.99f};
        return scene.undrifted(x, y, 0);
    });
    const ReferenceRegion region = find_reference_region(store, scene.specimen());
    ASSERT_TRUE(region.found());
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            if (x < 24 || y < 12 || y >= 54) {
                EXPECT_EQ(region.mask(x, y), 0) << x << "," << y;
            }
        }
    }
}

TEST(ReferenceRegion, ComesCloserWhereACropLeavesARimOnly) {
    // An automatic crop pads the specimen by 8 % and keeps nothing else.
    const DriftingScene scene{128, 128};
    Mask specimen(128, 128);
    for (int y = 9; y < 119; ++y) std::fill_n(specimen.row(y) + 9, 110, kInside);
    const auto store = still(scene, [](int x, int y, int) {
        const bool plate = x >= 9 && x < 119 && y >= 9 && y < 119;
        return plate ? SrgbF{0.6f, 0.4f, 0.3f} : SrgbF{0.5f, 0.5f, 0.5f};
    });
    const ReferenceRegion region = find_reference_region(store, specimen);
    ASSERT_TRUE(region.found()) << region.sentence;
    EXPECT_LT(region.margin, 1);
    EXPECT_NE(region.sentence.find("distance"), std::string::npos);
    EXPECT_EQ(region.mask(9, 64), 0);
    EXPECT_EQ(region.mask(0, 64), kInside);
}

TEST(ReferenceRegion, SaysWhyThereIsNone) {
    const DriftingScene scene;
    const auto copper = still(scene, [](int, int, int) { return SrgbF{0.6f, 0.4f, 0.3f}; });
    const ReferenceRegion none = find_reference_region(copper, scene.specimen());
    EXPECT_FALSE(none.found());
    EXPECT_TRUE(none.mask.empty());
    EXPECT_NE(none.sentence.find("no reference region"), std::string::npos);

    Mask everything(scene.width, scene.height);
    std::ranges::fill(everything.pixels(), kInside);
    const auto gray = still(scene, [](int, int, int) { return SrgbF{0.5f, 0.5f, 0.5f}; });
    EXPECT_FALSE(find_reference_region(gray, everything).found());
}

TEST(ReferenceRegion, TheMedianOfAnEvenCountIsTheMiddleOfTheTwo) {
    const FunctionStore store(2, 1, 4, [](int, int, int t) {
        const float v[]{0.2f, 0.9f, 0.4f, 0.5f};
        return SrgbF{v[t], v[t], 0};
    });
    EXPECT_NEAR(median_of_first(store, 4)(1, 0).r, 0.45f, 1e-5);
    EXPECT_NEAR(median_of_first(store, 3)(1, 0).g, 0.4f, 1e-5);
    EXPECT_NEAR(median_of_first(store, 20)(0, 0).r, 0.45f, 1e-5);
}

TEST(ReferenceRegion, RefusesAMaskOfAnotherSize) {
    const DriftingScene scene;
    const auto store = still(scene, [](int, int, int) { return SrgbF{}; });
    EXPECT_THROW(find_reference_region(store, Mask(3, 3)), Error);
    ReferenceOptions options;
    options.distance = 2;
    EXPECT_THROW(find_reference_region(store, scene.specimen(), options), Error);
}

}  // namespace
}  // namespace verdigris
