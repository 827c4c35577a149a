// SPDX-License-Identifier: MIT
#include "verdigris/files/image_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "verdigris/color/convert.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/chromaticities.h"
#include "verdigris/files/orientation.h"
#include "verdigris/files/png.h"
#include "verdigris/files/test_pictures.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

TEST(ReadImage, SaysWhatAFileIsInstead) {
    const ScratchFolder folder;
    const auto sentence = [&](const std::string& content) {
        write_file(folder / "a.png", content);
        EXPECT_FALSE(looks_like_image(folder / "a.png"));
        const Error error = error_of([&] { read_image(folder / "a.png"); });
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        EXPECT_EQ(error.where(), (folder / "a.png").string());
        EXPECT_EQ(error_of([&] { read_image_info(folder / "a.png"); }).sentence(),
                  error.sentence());
        return error.sentence();
    };
    EXPECT_EQ(sentence(""), "is empty");
    EXPECT_EQ(sentence("hello\r\n\tw\xc3\xb6rld"), "is text, not a picture");
    EXPECT_EQ(sentence("BM is how this text begins"), "is text, not a picture");
    EXPECT_EQ(sentence("x"), "is text, not a picture");
    EXPECT_EQ(sentence(std::string("\0\1\2\3", 4)),
              "is not a picture that can be read (PNG, JPEG, TIFF, OpenEXR)");
    EXPECT_EQ(sentence("RIFF\1\2\3\4WEBPVP8 "),
              "is a WebP picture, which is not read; convert it to PNG");
    EXPECT_EQ(sentence(std::string("\0\0\0\x18"
                                   "ftypheic",
                                   12)),
              "is a HEIC picture, which is not read; convert it to PNG or JPEG");
    EXPECT_EQ(sentence(std::string("\0\0\0\x18"
                                   "ftypmp42",
                                   12)),
              "is a video, not a picture");
    EXPECT_EQ(sentence(std::string("II*\0\x10\0\0\0CR\2\0", 12)),
              "is a camera raw file (CR2); develop it to 16-bit TIFF");
}

TEST(ReadImage, SaysWhyAFileCannotBeOpened) {
    const ScratchFolder folder;
    write_png(folder / "a.png", test_picture());
    EXPECT_TRUE(looks_like_image(folder / "a.png"));
    const auto sentence = [](const fs::path& path) {
        return error_of([&] { read_image(path); }).sentence();
    };
    EXPECT_EQ(sentence(folder / "b.png"), "does not exist");
    EXPECT_EQ(sentence(folder.path()), "is a folder, not a file");
    EXPECT_EQ(sentence(folder / "a.png/b"),
              "cannot be opened: a part of the path is a file, not a folder");
    EXPECT_FALSE(looks_like_image(folder / "b.png"));
    EXPECT_FALSE(looks_like_image(folder.path()));
    fs::permissions(folder / "a.png", fs::perms(0));
    fs::permissions(folder.path(), fs::perms(0755));
    const AsNobody nobody;
    EXPECT_EQ(sentence(folder / "a.png"), "cannot be opened: no permission");
    EXPECT_FALSE(looks_like_image(folder / "a.png"));
}

TEST(ReadImage, OwnWritersRoundTrip) {
    const ScratchFolder folder;
    const Image<SrgbU16> image = test_picture16(61, 47);
    write_png(folder / "a.png", image);
    const ImageFile file = read_image(folder / "a.png");
    EXPECT_EQ(file.info.bits, 16);
    const auto& read = std::get<Image<SrgbU16>>(file.pixels);
    ASSERT_TRUE(read.same_size(image));
    EXPECT_TRUE(std::equal(read.pixels().begin(), read.pixels().end(), image.pixels().begin()));
}

// What "as shown" means, from the definition: where the first coded row and column appear
// [EXIF, 4.6.4: "the 0th row is at the visual ... , the 0th column at the visual ..."].
TEST(Orientation, MatchesTheDefinition) {
    struct Case {
        int orientation;
        const char *row, *column;
    };
    for (const Case& c :
         {Case{1, "top", "left"}, Case{2, "top", "right"}, Case{3, "bottom", "right"},
          Case{4, "bottom", "left"}, Case{5, "left", "top"}, Case{6, "right", "top"},
          Case{7, "right", "bottom"}, Case{8, "left", "bottom"}}) {
        Image<int> coded(3, 2);
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 3; ++x) coded(x, y) = 10 * y + x;  // row and column as digits
        }
        const Image<int> shown = oriented(std::move(coded), c.orientation);
        const int w = shown.width(), h = shown.height();
        EXPECT_EQ(w, c.orientation >= 5 ? 2 : 3);
        const auto on_side = [&](const std::string& side, int x, int y) {
            return (side == "top" && y == 0) || (side == "bottom" && y == h - 1) ||
                   (side == "left" && x == 0) || (side == "right" && x == w - 1);
        };
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                EXPECT_EQ(shown(x, y) / 10 == 0, on_side(c.row, x, y)) << c.orientation;
                EXPECT_EQ(shown(x, y) % 10 == 0, on_side(c.column, x, y)) << c.orientation;
            }
        }
    }
}

const Chromaticities kP3{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}};

// Display P3 to sRGB by the matrix of the primaries, clipped: lcms2 must agree.
SrgbF expected_from_p3(SrgbF c) {
    const LinearF l = multiply(linear_from_chromaticities(kP3), linear_from_srgb(c));
    const SrgbF e = srgb_from_linear(l);
    const auto unit = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
    return {unit(e.r), unit(e.g), unit(e.b)};
}

TEST(Icc, DisplayP3IsConvertedToSrgb) {
    const ScratchFolder folder;
    double worst8 = 0, worst16 = 0;
    const auto check = [&](const ImageFile& file, const std::function<SrgbF(int, int)>& coded,
                           double& worst) {
        EXPECT_EQ(file.info.color, "ICC: Display P3");
        EXPECT_EQ(file.notes.size(), 1u);
        EXPECT_EQ(file.notes.at(0).id, "icc_converted");
        ASSERT_TRUE(std::holds_alternative<Image<SrgbU16>>(file.pixels));
        const auto& image = std::get<Image<SrgbU16>>(file.pixels);
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const SrgbF want = expected_from_p3(coded(x, y)), got = srgb_from_u16(image(x, y));
                worst =
                    std::max({worst, double(std::abs(want.r - got.r)),
                              double(std::abs(want.g - got.g)), double(std::abs(want.b - got.b))});
            }
        }
    };
    PngSpec spec;
    spec.width = spec.height = 16;
    spec.icc = make_icc_p3();
    for (const int bits : {8, 16}) {
        const double top = bits == 8 ? 255 : 65535;
        spec.bits = bits;
        spec.sample = [=](int x, int y, int c) {
            return unsigned(c == 0 ? x / 15.0 * top : c == 1 ? y / 15.0 * top : 0.3 * top);
        };
        write_file(folder / "a", make_png(spec));
        check(
            read_image(folder / "a"),
            [&](int x, int y) {
                return SrgbF{float(spec.sample(x, y, 0) / top), float(spec.sample(x, y, 1) / top),
                             float(spec.sample(x, y, 2) / top)};
            },
            bits == 8 ? worst8 : worst16);
        EXPECT_EQ(read_image_info(folder / "a").color, "ICC: Display P3");
    }
    // Profiles store primaries to 1/65536 and white as D50: well below one 8-bit code.
    EXPECT_LT(worst16, 0.5 / 255);
    EXPECT_LT(worst8, 0.5 / 255);
}

TEST(Icc, AProfileThatMeansSrgbChangesNothing) {
    const ScratchFolder folder;
    const Image<SrgbU8> image = test_picture(16, 8);
    const auto plain = make_jpeg(image), tagged = make_jpeg(image, {.icc = make_icc_srgb()});
    write_file(folder / "plain", plain);
    write_file(folder / "tagged", tagged);
    const ImageFile a = read_image(folder / "plain"), b = read_image(folder / "tagged");
    EXPECT_EQ(b.info.color, "ICC: sRGB test");
    EXPECT_TRUE(b.notes.empty());
    ASSERT_TRUE(std::holds_alternative<Image<SrgbU8>>(b.pixels));
    EXPECT_TRUE(std::equal(std::get<Image<SrgbU8>>(a.pixels).pixels().begin(),
                           std::get<Image<SrgbU8>>(a.pixels).pixels().end(),
                           std::get<Image<SrgbU8>>(b.pixels).pixels().begin()));
}

TEST(Icc, GrayProfilesApplyToGray) {
    const ScratchFolder folder;
    PngSpec spec;
    spec.color_type = 0;
    spec.icc = make_icc_linear_gray();
    spec.sample = [](int x, int y, int) { return unsigned(x * 36 + y); };
    write_file(folder / "a", make_png(spec));
    const ImageFile file = read_image(folder / "a");
    EXPECT_EQ(file.info.color, "ICC: linear gray");
    const auto& image = std::get<Image<SrgbU16>>(file.pixels);
    for (int x = 0; x < 7; ++x) {
        const float want = srgb_from_linear(float(x * 36) / 255);
        EXPECT_NEAR(srgb_from_u16(image(x, 0)).r, want, 0.002);
        EXPECT_NEAR(srgb_from_u16(image(x, 0)).b, want, 0.002);
    }
    // The same profile in a color picture makes no sense.
    write_file(folder / "b", make_jpeg(test_picture(), {.icc = make_icc_linear_gray()}));
    const ImageFile color = read_image(folder / "b");
    EXPECT_EQ(color.info.color, "sRGB (assumed)");
    ASSERT_EQ(color.notes.size(), 1u);
    EXPECT_EQ(color.notes[0].id, "icc_ignored");
}

TEST(Icc, ADamagedProfileIsACaution) {
    const ScratchFolder folder;
    auto icc = make_icc_p3();
    std::fill(icc.begin() + 128, icc.end(), std::byte(0xee));
    write_file(folder / "a", make_jpeg(test_picture(), {.icc = icc}));
    const ImageFile file = read_image(folder / "a");
    EXPECT_EQ(file.info.color, "sRGB (assumed)");
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].severity, Severity::caution);
}

TEST(ReadImage, RealFramesAsTheyAre) {
    const fs::path folder = fs::path(VERDIGRIS_SHARED_DATA) / "real/copper_patinating";
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
    const ImageFile file = read_image(folder / "0010.png");
    EXPECT_EQ(file.info.width, 256);
    EXPECT_EQ(file.info.height, 256);
    EXPECT_EQ(file.info.bits, 8);
    ASSERT_TRUE(std::holds_alternative<Image<SrgbU8>>(file.pixels));
}

}  // namespace
}  // namespace verdigris
