// SPDX-License-Identifier: MIT
// Pictures whose FLIP is known: computed with version 1.6 of its authors' code.
#include "verdigris/metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "hwy/targets.h"
#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/metrics/testing.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using testing::flat;
using testing::noise;
using testing::picture;
constexpr double kClose = 2e-5;

struct Uniform {
    SrgbF reference, test;
    double error;      ///< by the definition, in double
    double published;  ///< of the authors' code, in float
};

// On a surface of one color the feature detectors give 0; the authors' single sums leave 1e-8
// there, which the square root of step 7 lifts: their numbers are up to 5e-5 from their definition.
TEST(Flip, OfOneColorAgainstAnother) {
    const Uniform known[] = {
        {{0, 0, 0}, {1, 1, 1}, 0.9673798, 0.967388},
        {{1, 0, 0}, {0, 1, 0}, 0.9866623, 0.986665},
        {{0, 1, 0}, {0, 0, 1}, 1.0000000, 1.000000},
        {{0.5f, 0.5f, 0.5f}, {0.6f, 0.6f, 0.6f}, 0.2850130, 0.285063},
        {{0.5f, 0.5f, 0.5f}, {0.51f, 0.51f, 0.51f}, 0.0574754, 0.057496},
        {{0.72f, 0.45f, 0.36f}, {0.60f, 0.34f, 0.22f}, 0.3660440, 0.366067},
        {{0.72f, 0.45f, 0.36f}, {0.30f, 0.24f, 0.36f}, 0.8502286, 0.850244},
    };
    for (const Uniform& u : known) {
        const FlipResult r = flip(flat(32, 32, u.reference), flat(32, 32, u.test));
        EXPECT_NEAR(r.mean, u.published, 5.1e-5);
        for (const double value : {r.mean, r.minimum, r.maximum, r.median})
            EXPECT_NEAR(value, u.error, 2e-6);
    }
}

Image<SrgbF> ramps() {
    return picture(64, 64, [](int x, int y) { return SrgbF{float(x) / 63, float(y) / 63, 0.5f}; });
}
Image<SrgbF> other_ramps() {
    return picture(64, 64, [](int x, int y) {
        const float r = float(x) / 63, g = float(y) / 63;
        return SrgbF{std::min(1.0f, 0.9f * r + 0.05f), g * g, 0.45f};
    });
}
Image<SrgbF> ramps_with_disc() {
    return picture(64, 64, [](int x, int y) {
        const bool inside = (x - 32) * (x - 32) + (y - 32) * (y - 32) <= 225;
        return inside ? SrgbF{0.2f, 0.3f, 0.8f} : SrgbF{float(x) / 63, float(y) / 63, 0.5f};
    });
}

TEST(Flip, OfRamps) {
    const FlipResult r = flip(ramps(), other_ramps());
    EXPECT_NEAR(r.mean, 0.495552, kClose);
    EXPECT_NEAR(r.minimum, 0.109401, kClose);
    EXPECT_NEAR(r.maximum, 0.800056, kClose);
    EXPECT_NEAR(r.map(20, 10), 0.259182, kClose);
    EXPECT_NEAR(r.map(63, 63), 0.294280, kClose);
    const FlipResult far = flip(ramps(), other_ramps(), {.pixels_per_degree = 20});
    EXPECT_NEAR(far.mean, 0.478230, kClose);
    EXPECT_NEAR(far.minimum, 0.100486, kClose);
    EXPECT_NEAR(far.maximum, 0.789276, kClose);
}

TEST(Flip, OfADisc) {
    const FlipResult r = flip(ramps(), ramps_with_disc());
    EXPECT_NEAR(r.mean, 0.188087, kClose);
    EXPECT_NEAR(r.maximum, 0.973461, kClose);
    EXPECT_NEAR(r.map(32, 32), 0.876291, kClose);
    EXPECT_NEAR(r.map(47, 32), 0.679102, kClose);
    EXPECT_EQ(r.map(0, 0), 0);
    EXPECT_EQ(r.minimum, 0);
    const FlipResult far = flip(ramps(), ramps_with_disc(), {.pixels_per_degree = 20});
    EXPECT_NEAR(far.mean, 0.155542, kClose);
    EXPECT_NEAR(far.maximum, 0.979042, kClose);
    EXPECT_NEAR(far.map(47, 32), 0.853894, kClose);
}

TEST(Flip, OfOneWhitePixel) {
    const SrgbF gray{0.5f, 0.5f, 0.5f};
    Image<SrgbF> test = flat(64, 64, gray);
    test(32, 32) = {1, 1, 1};
    const FlipResult r = flip(flat(64, 64, gray), test);
    EXPECT_NEAR(r.mean, 0.001055, kClose);
    EXPECT_NEAR(r.map(32, 32), 0.380198, kClose);
    EXPECT_NEAR(r.map(33, 32), 0.294573, kClose);
    EXPECT_NEAR(r.map(35, 32), 0.030570, kClose);
    EXPECT_NEAR(r.map(33, 32), r.map(32, 31), 2e-6);  // no direction is special
}

TEST(Flip, OfACheckerAgainstGray) {
    const auto checker = picture(64, 64, [](int x, int y) {
        const float v = (x / 8 + y / 8) % 2 == 1 ? 0.8f : 0.2f;
        return SrgbF{v, v, v};
    });
    const FlipResult r = flip(checker, flat(64, 64, {0.5f, 0.5f, 0.5f}));
    EXPECT_NEAR(r.mean, 0.628051, kClose);
    EXPECT_NEAR(r.map(4, 4), 0.794321, kClose);
    EXPECT_NEAR(r.map(8, 8), 0.319050, kClose);
    EXPECT_NEAR(r.map(4, 7), 0.250679, kClose);
}

TEST(Flip, OfEqualPicturesIsExactlyZero) {
    const Image<SrgbF> image = noise(300, 70, 1);
    const FlipResult r = flip(image, image);
    EXPECT_EQ(r.maximum, 0);
    EXPECT_EQ(r.mean, 0);
    EXPECT_EQ(r.third_quartile, 0);
}

TEST(Flip, IsSymmetric) {
    const Image<SrgbF> a = noise(120, 50, 1), b = noise(120, 50, 2);
    EXPECT_NEAR(flip(a, b).mean, flip(b, a).mean, 1e-9);
}

// What a user passes is limited to what a screen shows.
TEST(Flip, LimitsToTheUnitRange) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto a = flat(20, 20, {1.5f, -2, nan}), b = flat(20, 20, {1, 0, 0});
    EXPECT_EQ(flip(a, b).maximum, 0);
}

TEST(Flip, SameBytesAtAnyThreadCount) {
    const Image<SrgbF> a = noise(700, 530, 1), b = noise(700, 530, 2);
    const FlipResult many = flip(a, b);
    set_thread_count(1);
    const FlipResult one = flip(a, b);
    set_thread_count(0);
    EXPECT_TRUE(std::ranges::equal(many.map.pixels(), one.map.pixels()));
    EXPECT_EQ(many.mean, one.mean);
    EXPECT_EQ(many.median, one.median);
}

// A window of a larger picture is the picture of that window.
TEST(Flip, ReadsViews) {
    const Image<SrgbF> a = noise(90, 80, 1), b = noise(90, 80, 2);
    const Rect rect{13, 7, 61, 50};
    const auto cropped = [&](const Image<SrgbF>& image) {
        return picture(rect.width, rect.height,
                       [&](int x, int y) { return image(rect.x + x, rect.y + y); });
    };
    EXPECT_EQ(flip(a.view().window(rect), b.view().window(rect)).mean,
              flip(cropped(a), cropped(b)).mean);
}

TEST(Flip, AgreesOnEveryInstructionSet) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_NEAR(flip(ramps(), other_ramps()).mean, 0.495552, kClose) << hwy::TargetName(target);
        EXPECT_NEAR(flip(ramps(), ramps_with_disc()).map(47, 32), 0.679102, kClose)
            << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(Flip, RefusesWhatCannotBeCompared) {
    const Error sizes = error_of([] { flip(flat(4, 5, {}), flat(4, 6, {})); });
    EXPECT_EQ(sizes.code(), ErrorCode::bad_input);
    EXPECT_NE(sizes.sentence().find("4 x 5 and 4 x 6"), std::string::npos);
    EXPECT_EQ(error_of([] { flip(Image<SrgbF>(), Image<SrgbF>()); }).code(), ErrorCode::bad_input);
    for (const double ppd : {0.5, 401.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_EQ(error_of([&] { flip(flat(4, 4, {}), flat(4, 4, {}), {ppd}); }).code(),
                  ErrorCode::usage);
    }
}

// 0.7 m from a 0.7 m wide screen of 3840 columns.
TEST(PixelsPerDegree, OfTheAuthorsScreen) {
    EXPECT_DOUBLE_EQ(pixels_per_degree(0.7, 0.7, 3840), kFlipPixelsPerDegree);
}

TEST(FlipPicture, IsMagma) {
    Image<float> map(3, 1);
    map(1, 0) = 0.5f;
    map(2, 0) = 1;
    const Image<SrgbU8> picture = flip_picture(map);
    // Matplotlib's table, rounded: entries 0, 128 and 255.
    EXPECT_EQ(picture(0, 0), (SrgbU8{0, 0, 4}));
    EXPECT_EQ(picture(1, 0), (SrgbU8{183, 55, 121}));
    EXPECT_EQ(picture(2, 0), (SrgbU8{252, 253, 191}));
}

// ../shared/data: a pair of renderings; mean, quartiles and maximum of version 1.6.
TEST(Flip, OfRealPictures) {
    const std::filesystem::path folder = std::filesystem::path(VERDIGRIS_SHARED_DATA) / "flip";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no pictures at " << folder;
    const auto read = [&](const char* name) {
        const ImageFile file = read_image(folder / name);
        const auto& codes = std::get<Image<SrgbU8>>(file.pixels);
        return picture(codes.width(), codes.height(),
                       [&](int x, int y) { return srgb_from_u8(codes(x, y)); });
    };
    const Image<SrgbF> reference = read("tree-ref.png"), test = read("tree-test.png");
    const FlipResult r = flip(reference, test, {.pixels_per_degree = 67});
    EXPECT_NEAR(r.mean, 0.133286, 2e-6);
    EXPECT_NEAR(r.first_quartile, 0.184924, kClose);
    EXPECT_NEAR(r.median, 0.333243, kClose);
    EXPECT_NEAR(r.third_quartile, 0.503448, kClose);
    EXPECT_NEAR(r.maximum, 0.983044, kClose);
    EXPECT_NEAR(flip(reference, test).mean, 0.133277, 2e-6);
}

}  // namespace
}  // namespace verdigris
