// SPDX-License-Identifier: MIT
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <half.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <limits>
#include <string>
#include <vector>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

Image<LinearF> picture(int width, int height) {
    Image<LinearF> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // All exact in half: multiples of 1/64 below 16.
            image(x, y) = {float(x) / 64, float(y) / 32, float(x + y) / 64 - 0.25f};
        }
    }
    return image;
}

// Float channels named by `names`, sample = 100 * channel + x + 10 * y in data-window coordinates.
void make_exr(const std::filesystem::path& path, Imf::Header header,
              const std::vector<std::string>& names, Imf::PixelType type = Imf::FLOAT) {
    const Imath::Box2i window = header.dataWindow();
    const int w = window.max.x - window.min.x + 1, h = window.max.y - window.min.y + 1;
    std::vector<std::vector<float>> planes;
    std::vector<std::vector<std::uint32_t>> words;
    planes.reserve(names.size());
    words.reserve(names.size());
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < names.size(); ++c) {
        planes.emplace_back();
        words.emplace_back();
        for (int i = 0; i < w * h; ++i) {
            planes.back().push_back(float(100 * int(c) + i % w + 10 * (i / w)));
            words.back().push_back(std::uint32_t(planes.back().back()));
        }
        header.channels().insert(names[c], Imf::Channel(type));
        const void* data = type == Imf::UINT ? static_cast<const void*>(words.back().data())
                                             : static_cast<const void*>(planes.back().data());
        buffer.insert(names[c], Imf::Slice::Make(type, data, window));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(h);
}

const Image<LinearF>& linear(const ImageFile& file) {
    return std::get<Image<LinearF>>(file.pixels);
}

TEST(Exr, RgbRoundTripsInHalf) {
    const ScratchFolder folder;
    const Image<LinearF> image = picture(70, 150);  // more than one block of PIZ
    write_exr(folder / "a.exr", image);
    const ImageFile file = read_image(folder / "a.exr");
    EXPECT_EQ(file.info.format, "exr");
    EXPECT_EQ(file.info.bits, 16);
    EXPECT_TRUE(file.info.is_float);
    EXPECT_EQ(file.info.color, "linear (EXR)");
    EXPECT_TRUE(file.notes.empty());
    ASSERT_TRUE(linear(file).same_size(image));
    EXPECT_TRUE(
        std::equal(image.pixels().begin(), image.pixels().end(), linear(file).pixels().begin()));
    const Imf::InputFile reference((folder / "a.exr").c_str());
    EXPECT_EQ(reference.header().compression(), Imf::PIZ_COMPRESSION);
    EXPECT_TRUE(Imf::hasChromaticities(reference.header()));
    EXPECT_EQ(entry_count(folder.path()), 1);
}

TEST(Exr, SameBytesEveryTime) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", picture(300, 300));
    write_exr(folder / "b.exr", picture(300, 300));
    EXPECT_EQ(read_file(folder / "a.exr"), read_file(folder / "b.exr"));
}

TEST(Exr, HeightRoundTripsInFloat) {
    const ScratchFolder folder;
    Image<float> image(33, 20);
    for (std::size_t i = 0; i < image.pixel_count(); ++i) image.pixels()[i] = 1 / float(i + 3);
    write_exr(folder / "a.exr", image.view().window({3, 2, 20, 10}));
    const ImageFile file = read_image(folder / "a.exr");
    EXPECT_EQ(file.info.bits, 32);
    ASSERT_TRUE(linear(file).same_size(20, 10));
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 20; ++x) {
            const float v = image(x + 3, y + 2);
            EXPECT_EQ(linear(file)(x, y), (LinearF{v, v, v}));
        }
    }
}

TEST(Exr, LargeValuesAreClampedAndNonNumbersRefused) {
    const ScratchFolder folder;
    Image<LinearF> image(2, 2);
    image(1, 0) = {1e9f, -1e9f, 65504};
    write_exr(folder / "a.exr", image);
    EXPECT_EQ(linear(read_image(folder / "a.exr"))(1, 0), (LinearF{65504, -65504, 65504}));
    image(0, 1).g = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error_of([&] { write_exr(folder / "b.exr", image); }).sentence(),
              "is not written: the picture holds NaN or infinity in row 1");
    Image<float> height(2, 3);
    height(1, 2) = std::numeric_limits<float>::infinity();
    EXPECT_EQ(error_of([&] { write_exr(folder / "b.exr", height); }).sentence(),
              "is not written: the picture holds NaN or infinity in row 2");
    EXPECT_EQ(entry_count(folder.path()), 1);
}

TEST(Exr, TheDisplayWindowIsThePicture) {
    const ScratchFolder folder;
    // Data partly outside of, and partly short of, what is shown.
    const Imath::Box2i display({10, 20}, {14, 23}), data({12, 18}, {20, 21});
    make_exr(folder / "a.exr", Imf::Header(display, data), {"R", "G", "B"});
    const ImageFile file = read_image(folder / "a.exr");
    ASSERT_TRUE(linear(file).same_size(5, 4));
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) {
            const bool covered = x >= 2 && y <= 1;
            const float v = float(x - 2 + 10 * (y + 2));
            EXPECT_EQ(linear(file)(x, y), covered ? (LinearF{v, v + 100, v + 200}) : LinearF{});
        }
    }
}

TEST(Exr, IntegerChannelsAlphaAndDates) {
    const ScratchFolder folder;
    Imf::Header header(4, 3);
    Imf::addCapDate(header, "2026:03:01 12:00:00");
    Imf::addUtcOffset(header, -7200);  // UTC is local time minus two hours
    Imf::addExpTime(header, 0.01f);
    make_exr(folder / "a.exr", header, {"A", "R", "G", "B"}, Imf::UINT);
    const ImageFile file = read_image(folder / "a.exr");
    EXPECT_EQ(linear(file)(3, 2), (LinearF{123, 223, 323}));
    EXPECT_EQ(file.info.bits, 32);
    EXPECT_DOUBLE_EQ(file.info.taken.value(), 20513 * 86400.0 + 10 * 3600);
    EXPECT_EQ(file.info.camera, "1/100 s");
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].id, "alpha_dropped");
}

// AP1 with the ACES white to sRGB, Bradford-adapted: the matrix that [ACES] implementations carry.
TEST(Exr, AcesCgIsConverted) {
    const ScratchFolder folder;
    Imf::Header header(2, 1);
    Imf::addChromaticities(header, Imf::Chromaticities({0.713f, 0.293f}, {0.165f, 0.830f},
                                                       {0.128f, 0.044f}, {0.32168f, 0.33767f}));
    make_exr(folder / "a.exr", header, {"R", "G", "B"});
    const ImageFile file = read_image(folder / "a.exr");
    EXPECT_EQ(file.info.color, "EXR chromaticities: ACEScg");
    EXPECT_EQ(read_image_info(folder / "a.exr").color, file.info.color);
    const double r = 1, g = 101, b = 201;
    const LinearF c = linear(file)(1, 0);
    EXPECT_NEAR(c.r, 1.70505 * r - 0.62179 * g - 0.08326 * b, 0.01);
    EXPECT_NEAR(c.g, -0.13026 * r + 1.14080 * g - 0.01055 * b, 0.01);
    EXPECT_NEAR(c.b, -0.02400 * r - 0.12897 * g + 1.15297 * b, 0.01);
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].id, "primaries_converted");
}

TEST(Exr, ImpossibleChromaticitiesAreACaution) {
    const ScratchFolder folder;
    Imf::Header header(2, 1);
    Imf::addChromaticities(
        header, Imf::Chromaticities({0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}));
    make_exr(folder / "a.exr", header, {"R", "G", "B"});
    const ImageFile file = read_image(folder / "a.exr");
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_EQ(file.notes[0].id, "chromaticities_ignored");
    EXPECT_EQ(linear(file)(1, 0), (LinearF{1, 101, 201}));
}

TEST(Exr, NamesThePixelThatIsNoNumber) {
    const ScratchFolder folder;
    const std::array<float, 12> y = {0, 0, 0, 0, 0, 0, std::nanf(""), 0, 0, INFINITY, 0, 0};
    Imf::Header header(4, 3);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, y.data(), header.dataWindow()));
    {
        Imf::OutputFile file((folder / "a.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(3);
    }
    EXPECT_NO_THROW(read_image_info(folder / "a.exr"));
    const Error error = error_of([&] { read_image(folder / "a.exr"); });
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(error.sentence(), "holds NaN or infinity at pixel x = 2, y = 1");
}

TEST(Exr, RefusesWhatItCannotReadRight) {
    const ScratchFolder folder;
    const auto sentence = [&] {
        return error_of([&] { read_image(folder / "a.exr"); }).sentence();
    };
    make_exr(folder / "a.exr", Imf::Header(4, 3), {"Z"});
    EXPECT_EQ(sentence(), "is an OpenEXR without channels R, G, B or Y");
    make_exr(folder / "a.exr", Imf::Header(4, 3), {"R", "B"});
    EXPECT_EQ(sentence(), "is an OpenEXR without all of the channels R, G and B");
    make_exr(folder / "a.exr", Imf::Header(4, 3), {"Y", "RY", "BY"});
    EXPECT_EQ(sentence(), "is an OpenEXR in luminance and chroma (Y, RY, BY); save it as RGB");

    write_exr(folder / "a.exr", picture(64, 64));
    const auto bytes = read_file(folder / "a.exr");
    for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, std::size_t(100)}) {
        write_file(folder / "a.exr", std::span(bytes).first(size));
        EXPECT_EQ(sentence(), "is truncated: the OpenEXR data end early");
    }
}

TEST(Exr, RefusesSizesFromTheHeader) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", picture(8, 8));
    std::string text = read_text(folder / "a.exr");
    for (const std::string name : {"dataWindow", "displayWindow"}) {
        const std::size_t at = text.find(name) + name.size() + 1 + 6 + 4;  // "box2i", length
        for (const std::size_t corner : {8u, 12u}) {
            text.replace(at + corner, 4, std::string("\xe7\xfd\0\0", 4));  // 64999
        }
    }
    write_file(folder / "a.exr", text);
    EXPECT_EQ(error_of([&] { read_image(folder / "a.exr"); }).sentence(),
              "declares 65000 x 65000 pixels, more than the 268435456 that are read");
}

TEST(Exr, AFullDiskIsReportedNotSwallowed) {
    const ScratchFolder folder;
    const Image<LinearF> image = picture(256, 256);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    rlimit small = old_limit;
    small.rlim_cur = 2000;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Error error = error_of([&] { write_exr(folder / "a.exr", image); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_EQ(error.sentence(), "cannot be written: the file is larger than the system allows");
    EXPECT_EQ(error.where(), (folder / "a.exr").string());
    EXPECT_EQ(entry_count(folder.path()), 0);
}

}  // namespace
}  // namespace verdigris
