// SPDX-License-Identifier: MIT
#include "verdigris/deliver/textures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "verdigris/deliver/testing.h"
#include "verdigris/forecast/forecast_io.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

const fs::path kPack = "CopperPatinating_u020";
const std::string kPrefix = "CopperPatinating_u020_";

template <class P>
Image<P> read(const fs::path& path) {
    ImageFile file = read_image(path);
    Image<P>* pixels = std::get_if<Image<P>>(&file.pixels);
    if (!pixels) throw std::runtime_error(path.string() + " has other pixels");
    return std::move(*pixels);
}

TEST(Textures, WritesExactlyTheStatedFiles) {
    const ScratchFolder folder;
    const MadeDelivery made;
    const std::vector<fs::path> files = write_textures(made.delivery, folder.path());
    std::set<std::string> expected;
    for (const char* label : {"u000", "u005", "u020"}) {
        const std::string stem = std::string("CopperPatinating_") + label;
        const std::string pack = stem + "/";
        for (const char* map :
             {"Color", "NormalGL", "Roughness", "Metalness", "Displacement", "ORM"}) {
            expected.insert(pack + stem + "_" + map + ".png");
            expected.insert(pack + "masters16/" + stem + "_" + map + ".png");
        }
        expected.insert(pack + "dx/" + stem + "_NormalDX.png");
        expected.insert(pack + "dx/masters16/" + stem + "_NormalDX.png");
        expected.insert(pack + "README.txt");
    }
    std::set<std::string> reported, found;
    for (const fs::path& file : files) reported.insert(file.generic_string());
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
        if (entry.is_regular_file()) {
            found.insert(entry.path().lexically_relative(folder.path()).generic_string());
        }
    }
    EXPECT_EQ(reported, expected);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(files.size(), expected.size());
}

TEST(Textures, HoldTheMaterial) {
    const ScratchFolder folder;
    const MadeDelivery made;
    write_textures(made.delivery, folder.path());
    Material material;
    materialize(made.recipe, made.forecast, 20, material);
    const fs::path pack = folder.path() / kPack;
    const auto color = read<SrgbU8>(pack / (kPrefix + "Color.png"));
    const auto color16 = read<SrgbU16>(pack / "masters16" / (kPrefix + "Color.png"));
    const auto orm = read<SrgbU8>(pack / (kPrefix + "ORM.png"));
    const auto rough = read<SrgbU8>(pack / (kPrefix + "Roughness.png"));
    const auto metal = read<SrgbU8>(pack / (kPrefix + "Metalness.png"));
    const auto height = read<SrgbU16>(pack / (kPrefix + "Displacement.png"));
    const auto gl = read<SrgbU8>(pack / (kPrefix + "NormalGL.png"));
    const auto dx = read<SrgbU8>(pack / "dx" / (kPrefix + "NormalDX.png"));
    ASSERT_TRUE(color.same_size(material.albedo));
    bool moves = false;
    for (std::size_t i = 0; i < color.pixel_count(); ++i) {
        const SrgbF albedo = material.albedo.pixels()[i];
        EXPECT_NEAR(color.pixels()[i].r, 255 * albedo.r, 0.51);
        EXPECT_NEAR(color.pixels()[i].g, 255 * albedo.g, 0.51);
        EXPECT_NEAR(color16.pixels()[i].b, 65535 * albedo.b, 0.51);
        EXPECT_LE(std::abs(color16.pixels()[i].r / 257.0 - color.pixels()[i].r), 0.5);
        EXPECT_EQ(orm.pixels()[i], (SrgbU8{255, rough.pixels()[i].r, metal.pixels()[i].r}));
        EXPECT_NEAR(rough.pixels()[i].g, 255 * material.roughness.pixels()[i], 0.51);
        EXPECT_NEAR(metal.pixels()[i].g, 255 * material.metallic.pixels()[i], 0.51);
        EXPECT_NEAR(height.pixels()[i].g, 65535 * material.height.pixels()[i], 0.51);
        EXPECT_EQ(dx.pixels()[i], (SrgbU8{gl.pixels()[i].r, std::uint8_t(255 - gl.pixels()[i].g),
                                          gl.pixels()[i].b}));
        EXPECT_GT(gl.pixels()[i].b, 127);
        moves = moves || metal.pixels()[i].r < 200;
    }
    EXPECT_TRUE(moves) << "the made forecast should cover some metal";
}

TEST(Textures, ABumpLitFromAboveLooksRaised) {
    // A bright bump: above its top (smaller y) the surface rises downwards in the image, so the
    // normal leans up: green above one half in GL, below in DX.
    const ScratchFolder folder;
    MadeDelivery made(33, 33, 0);
    for (int y = 0; y < 33; ++y) {
        for (int x = 0; x < 33; ++x) {
            const double r2 = (x - 16) * (x - 16) + (y - 16) * (y - 16);
            const float v = 0.3f + 0.4f * float(std::exp(-r2 / 40));
            made.forecast.trajectory.base(x, y) = made.recipe.canvas(x, y) = {v, v, v};
        }
    }
    made.recipe.luma_fill(16, 16) = -1;
    write_textures(made.delivery, folder.path());
    const fs::path pack = folder.path() / "CopperPatinating_u000";
    const auto gl = read<SrgbU8>(pack / "CopperPatinating_u000_NormalGL.png");
    const auto dx = read<SrgbU8>(pack / "dx" / "CopperPatinating_u000_NormalDX.png");
    EXPECT_GT(gl(16, 10).g, 135);
    EXPECT_LT(gl(16, 22).g, 120);
    EXPECT_LT(gl(10, 16).r, 120);  // left flank leans left: -X
    EXPECT_GT(gl(22, 16).r, 135);
    EXPECT_LT(dx(16, 10).g, 120);
}

TEST(Textures, OnlyColorIsTaggedAndAllSayHowTheyCameToBe) {
    const ScratchFolder folder;
    const MadeDelivery made;
    for (const fs::path& file : write_textures(made.delivery, folder.path())) {
        if (file.extension() != ".png") continue;
        const std::string name = file.generic_string();
        const auto chunks = png_chunks(read_text(folder.path() / file));
        const bool is_color = name.ends_with("_Color.png");
        EXPECT_EQ(has_chunk(chunks, "sRGB"), is_color) << name;
        EXPECT_EQ(has_chunk(chunks, "gAMA"), is_color) << name;
        EXPECT_FALSE(has_chunk(chunks, "iCCP")) << name;
        const bool photographed = is_color && name.find("u000") != std::string::npos;
        const std::string expected =
            std::string(
                "Iptc4xmpExt:DigitalSourceType=\"http://cv.iptc.org/newscodes/"
                "digitalsourcetype/") +
            (photographed ? "digitalCapture\"" : "algorithmicMedia\"");
        int found = 0;
        for (const PngChunk& chunk : chunks) {
            if (chunk.type == "iTXt" && chunk.data.starts_with("XML:com.adobe.xmp")) {
                found += chunk.data.find(expected) != std::string::npos;
            }
        }
        EXPECT_EQ(found, 1) << name;
        const int bits = chunks.at(0).data.at(8);
        const bool deep =
            name.find("masters16") != std::string::npos || name.ends_with("_Displacement.png");
        EXPECT_EQ(bits, deep ? 16 : 8) << name;
    }
}

TEST(Textures, ANetworksFramesSayThatTheyWereTrained) {
    const ScratchFolder folder;
    MadeDelivery made;
    made.forecast.stack.base = made.recipe.canvas.clone();
    made.forecast.stack.horizons = {20};
    made.forecast.stack.frames.push_back(made.recipe.canvas.clone());
    write_textures(made.delivery, folder.path());
    const std::string png = read_text(folder.path() / kPack / (kPrefix + "Color.png"));
    EXPECT_NE(png.find("digitalsourcetype/trainedAlgorithmicMedia"), std::string::npos);
}

TEST(Textures, SayTheirResolutionOnlyWhereItIsOne) {
    const MadeDelivery made;
    const DeliveredState state{7.5, "u007_5", ""};
    EXPECT_EQ(texture_prefix(made.delivery, state, 2048, 2048), "CopperPatinating_u007_5_2K");
    EXPECT_EQ(texture_prefix(made.delivery, state, 700, 1024), "CopperPatinating_u007_5_1K");
    EXPECT_EQ(texture_prefix(made.delivery, state, 2000, 2000), "CopperPatinating_u007_5");
}

TEST(Textures, ReadmeSaysTheConventions) {
    const MadeDelivery made;
    const auto states = delivered_states(made.delivery);
    const std::string forecast = texture_readme(made.delivery, states[2], "P", 40, 24);
    for (const char* words :
         {"+Y up", "+Y down", "R ambient occlusion", "G roughness", "B metallic", "sRGB",
          "not calendar time", "+20 units", "P_ORM.png", "40 x 24", "Computed"}) {
        EXPECT_NE(forecast.find(words), std::string::npos) << words;
    }
    for (const MapOrigin& origin : map_origins(made.forecast)) {
        // Long sentences are wrapped: their first words stand after the map's name.
        EXPECT_NE(forecast.find(origin.sentence.substr(0, 20)), std::string::npos) << origin.map;
    }
    const std::string observed = texture_readme(made.delivery, states[0], "P", 40, 24);
    EXPECT_NE(observed.find("last observed state"), std::string::npos);
    EXPECT_EQ(observed.find("A forecast,"), std::string::npos);
    EXPECT_NE(observed.find("  albedo     measured  The last observed frame itself;"),
              std::string::npos)
        << observed;
    EXPECT_NE(forecast.find("  albedo     modeled "), std::string::npos) << forecast;
}

TEST(Textures, SameBytesTwice) {
    const ScratchFolder a, b;
    const MadeDelivery made;
    set_thread_count(1);
    const auto files = write_textures(made.delivery, a.path());
    set_thread_count(0);
    write_textures(made.delivery, b.path());
    for (const fs::path& file : files) {
        EXPECT_EQ(sha256_of_file(a.path() / file), sha256_of_file(b.path() / file)) << file;
    }
}

TEST(Textures, OnePixelWideFractionalHorizonAndNoChange) {
    const ScratchFolder folder;
    MadeDelivery made(1, 9, 0);
    made.delivery.horizons = {7.5};
    const auto files = write_textures(made.delivery, folder.path());
    EXPECT_TRUE(std::any_of(files.begin(), files.end(), [](const fs::path& file) {
        return file.filename() == "CopperPatinating_" + horizon_label(7.5) + "_Color.png";
    }));
    const auto before = read<SrgbU16>(folder.path() / "CopperPatinating_u000/masters16" /
                                      "CopperPatinating_u000_Color.png");
    const std::string stem = "CopperPatinating_" + horizon_label(7.5);
    const auto after = read<SrgbU16>(folder.path() / stem / "masters16" / (stem + "_Color.png"));
    ASSERT_TRUE(before.same_size(1, 9));
    EXPECT_TRUE(std::equal(before.pixels().begin(), before.pixels().end(), after.pixels().begin()));
}

TEST(Textures, ReportEveryFileAndStopWhenAsked) {
    const ScratchFolder folder;
    const MadeDelivery made;
    std::int64_t last = 0, total = 0;
    const auto files =
        write_textures(made.delivery, folder.path(),
                       [&](std::string_view stage, std::int64_t done, std::int64_t of) {
                           EXPECT_EQ(stage, "deliver");
                           last = done;
                           total = of;
                           return true;
                       });
    EXPECT_EQ(last, std::int64_t(files.size()));
    EXPECT_EQ(total, std::int64_t(files.size()));
    try {
        write_textures(made.delivery, folder.path() / "stopped",
                       [](std::string_view, std::int64_t done, std::int64_t) { return done < 3; });
        FAIL() << "was not stopped";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::interrupted);
    }
}

TEST(Textures, RefuseAnIncompleteDelivery) {
    const ScratchFolder folder;
    MadeDelivery made;
    made.delivery.horizons = {5, 5};
    EXPECT_THROW(write_textures(made.delivery, folder.path()), Error);
    made.delivery.horizons = {-1};
    EXPECT_THROW(write_textures(made.delivery, folder.path()), Error);
    made.delivery.horizons = {5};
    made.delivery.recipe = nullptr;
    EXPECT_THROW(write_textures(made.delivery, folder.path()), Error);
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace verdigris
