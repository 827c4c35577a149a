// SPDX-License-Identifier: MIT
#include "verdigris/appearance/material_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/metrics/flip.h"
#include "verdigris/pixels/parallel_rows.h"
#include "verdigris/render/testing.h"

namespace verdigris {
namespace {

ViewOptions small(SceneKind scene) {
    return {scene, 48, 8};
}

TEST(MaterialView, OneMaterialIsOnePictureAtAnyThreadCount) {
    const Material copper = even_material({0.6f, 0.3f, 0.2f}, 0.4f, 0.9f, 4);
    for (const SceneKind scene : {SceneKind::sphere, SceneKind::plate, SceneKind::drape}) {
        const MaterialView view(small(scene), {0, 0, 4, 4});
        const Image<SrgbF> first = view.picture(copper);
        set_thread_count(1);
        const Image<SrgbF> second = view.picture(copper);
        set_thread_count(0);
        EXPECT_TRUE(std::ranges::equal(first.pixels(), second.pixels()));
        EXPECT_EQ(flip(first, second).mean, 0);
    }
}

TEST(MaterialView, ShowsThePartItIsGiven) {
    // Left half red, right half blue: the part decides which is seen.
    Material two = even_material({0.7f, 0.1f, 0.1f}, 0.8f, 0.0f, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 4; x < 8; ++x) two.albedo(x, y) = {0.1f, 0.1f, 0.8f};
    const Image<SrgbF> left = MaterialView(small(SceneKind::sphere), {0, 0, 4, 8}).picture(two),
                       right = MaterialView(small(SceneKind::sphere), {4, 0, 4, 8}).picture(two);
    EXPECT_GT(left(24, 24).r, left(24, 24).b + 0.2f);
    EXPECT_GT(right(24, 24).b, right(24, 24).r + 0.2f);
}

TEST(MaterialView, SharedRaysCancelTheNoise) {
    // Two materials that hardly differ, 8 rays a pixel: with the rays of another seed the noise
    // hides what is between them.
    const Material a = even_material({0.6f, 0.3f, 0.2f}, 0.4f, 0.9f, 4),
                   b = even_material({0.602f, 0.3f, 0.2f}, 0.4f, 0.9f, 4);
    const MaterialView view(small(SceneKind::sphere), {0, 0, 4, 4});
    const Image<SrgbF> picture = view.picture(a);
    const double shared = flip(picture, view.picture(b)).mean;
    EXPECT_GT(shared, 0);
    EXPECT_LT(3 * shared, flip(picture, view.picture(b, 1)).mean);
}

TEST(MaterialView, RefusesWhatItCannotShow) {
    EXPECT_THROW(MaterialView({SceneKind::sphere, 16, 8}, {0, 0, 4, 4}), Error);
    EXPECT_THROW(MaterialView({SceneKind::sphere, 64, 12}, {0, 0, 4, 4}), Error);
    EXPECT_THROW(MaterialView({SceneKind::sphere, 64, 8}, {0, 0, 0, 4}), Error);
}

}  // namespace
}  // namespace verdigris
