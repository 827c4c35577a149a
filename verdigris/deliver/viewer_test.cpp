// SPDX-License-Identifier: MIT
#include "verdigris/deliver/viewer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "verdigris/deliver/testing.h"
#include "verdigris/deliver/viewer_recipe.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using Json = nlohmann::json;

std::vector<double> values_of(const Json& document, const Json& blob) {
    return decoded_blob(document["width"], document["height"], blob["channels"], blob["scale"],
                        blob["offset"], blob["data"].get<std::string>());
}

void expect_color(const Json& document, const Json& blob, const Image<SrgbF>& image) {
    ASSERT_EQ(blob["channels"], 3);
    const std::vector<double> values = values_of(document, blob);
    ASSERT_EQ(values.size(), image.pixel_count() * 3);
    const double half = blob["scale"].get<double>() / 2 * (1 + 1e-9) + 1e-12;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        EXPECT_NEAR(values[3 * i], image.pixels()[i].r, half);
        EXPECT_NEAR(values[3 * i + 1], image.pixels()[i].g, half);
        EXPECT_NEAR(values[3 * i + 2], image.pixels()[i].b, half);
    }
}

TEST(ViewerJson, HasEveryFieldOfTheFormat) {
    const MadeDelivery made;
    const Json document = Json::parse(viewer_json(made.delivery));
    EXPECT_EQ(document["format"], "verdigris-viewer/1");
    EXPECT_EQ(document["title"], "copper_patinating");
    EXPECT_EQ(document["version"], writer_version());
    EXPECT_EQ(document["width"], 40);
    EXPECT_EQ(document["height"], 24);
    EXPECT_EQ(document["context"], 10);
    EXPECT_EQ(document["units_observed"], 98.4);
    EXPECT_EQ(document["horizons"], Json::array({5.0, 20.0}));
    EXPECT_EQ(document["forecaster"]["name"], made.forecast.forecaster);
    EXPECT_EQ(document["forecaster"]["explanation"], made.forecast.explanation);
    EXPECT_EQ(document["guards"][0]["id"], "long_horizon");
    EXPECT_EQ(document["guards"][0]["severity"], "caution");
    EXPECT_EQ(document["guards"][0]["sentence"], "Beyond 20 units it is untested.");
    const auto origins = map_origins(made.forecast);
    ASSERT_EQ(document["origins"].size(), origins.size());
    EXPECT_EQ(document["origins"][0]["origin"], to_string(origins[0].origin));
    const Json& law = document["trajectory"];
    EXPECT_EQ(law["kind"], "law");
    EXPECT_EQ(law["order"], 1);
    EXPECT_EQ(law["context"], 10);
    EXPECT_EQ(law["clamp"], true);
    EXPECT_TRUE(law["curvature"].is_null());
    const std::vector<std::string> scalars = {
        "coverage_exponent", "roughness_clean",  "roughness_patina",
        "roughness_gamma",   "micro_roughness",  "metallic_patina",
        "metallic_clean",    "metallic_gamma",   "height_patina_weight",
        "height_sigma",      "micro_sigma",      "normal_scale",
        "normal_gain",       "micro_range",      "tau",
        "normalizer",        "reference_horizon"};
    EXPECT_EQ(document["material"].size(), scalars.size() + 1);
    EXPECT_EQ(document["material"]["observed_is_clean"], made.recipe.observed_is_clean);
    for (const std::string& name : scalars) {
        EXPECT_TRUE(document["material"].at(name).is_number()) << name;
    }
    EXPECT_EQ(document["material"]["normal_scale"], made.recipe.options.normal_scale);
    EXPECT_EQ(document["material"]["tau"], made.recipe.tau);
    EXPECT_TRUE(document["uncertainty"].is_null());
    EXPECT_TRUE(document["spread"].is_null());
    EXPECT_EQ(document.size(), 20u);
}

TEST(ViewerJson, TellsHowFarOffTheHorizonsMayBe) {
    MadeDelivery made;
    made.forecast.spread.own = made.forecast.trajectory.base.clone();
    made.forecast.spread.nodes = {{20, 4e-4, 0}};
    const Json list = Json::parse(viewer_json(made.delivery))["uncertainty"];
    ASSERT_EQ(list.size(), made.delivery.horizons.size());
    EXPECT_EQ(list[1]["horizon"], 20);
    EXPECT_NEAR(list[1]["mean_95"].get<double>(), 0.02 * kMeanHalfWidth95, 1e-12);
    EXPECT_NEAR(list[0]["pixel_80"].get<double>(), 0.01 * kHalfWidth80, 1e-12);
}

TEST(ViewerJson, BlobsReturnWithinHalfAStep) {
    const MadeDelivery made;
    const Json document = Json::parse(viewer_json(made.delivery));
    expect_color(document, document["trajectory"]["base"], made.forecast.trajectory.base);
    expect_color(document, document["trajectory"]["rate"], made.forecast.trajectory.rate);
    expect_color(document, document["canvas"], made.recipe.canvas);
    const std::vector<double> active = values_of(document, document["active"]);
    const std::vector<double> fill = values_of(document, document["luma_fill"]);
    for (std::size_t i = 0; i < active.size(); ++i) {
        EXPECT_NEAR(active[i], made.recipe.active.pixels()[i] / 255.0, 0.01);
        const double expected = double(made.recipe.luma_fill.pixels()[i]);
        EXPECT_NEAR(fill[i], expected, 2e-5);
        if (expected < 0) {
            EXPECT_EQ(fill[i], -1);
        }
    }
}

TEST(ViewerJson, AClippedBlackPixelStaysClipped) {
    MadeDelivery made;
    made.recipe.luma_fill(3, 3) = 0;
    made.recipe.luma_fill(4, 3) = 1;
    const Json document = Json::parse(viewer_json(made.delivery));
    const std::vector<double> fill = values_of(document, document["luma_fill"]);
    EXPECT_EQ(fill[3 * 40 + 3], 0);
    EXPECT_NEAR(fill[3 * 40 + 4], 1, 1.0 / 32768);
}

TEST(ViewerJson, ObservedFramesArePngDataUris) {
    const ScratchFolder folder;
    const MadeDelivery made;
    const Json document = Json::parse(viewer_json(made.delivery));
    ASSERT_EQ(document["observed"].size(), 2u);
    EXPECT_EQ(document["observed"][0]["unit"], -4.0);
    EXPECT_EQ(document["observed"][1]["unit"], 0.0);
    const std::string uri = document["observed"][1]["image"];
    const std::string start = "data:image/png;base64,";
    ASSERT_TRUE(uri.starts_with(start));
    write_file(folder / "frame.png", decoded_base64(std::string_view(uri).substr(start.size())));
    const ImageFile file = read_image(folder / "frame.png");
    const auto& pixels = std::get<Image<SrgbU8>>(file.pixels);
    const Image<SrgbF>& frame = made.delivery.observed[1].image;
    ASSERT_TRUE(pixels.same_size(frame));
    for (std::size_t i = 0; i < frame.pixel_count(); ++i) {
        EXPECT_NEAR(pixels.pixels()[i].g, 255 * frame.pixels()[i].g, 0.501);
    }
}

TEST(ViewerJson, OrderTwoAndNetworkFrames) {
    MadeDelivery made;
    made.forecast.trajectory.law.order = 2;
    made.forecast.trajectory.curvature = made.forecast.trajectory.rate.clone();
    Json document = Json::parse(viewer_json(made.delivery));
    expect_color(document, document["trajectory"]["curvature"], made.forecast.trajectory.rate);

    made.forecast.stack.base = made.recipe.canvas.clone();
    made.forecast.stack.horizons = {1, 2.5};
    made.forecast.stack.frames.push_back(made.recipe.canvas.clone());
    made.forecast.stack.frames.push_back(made.forecast.trajectory.rate.clone());
    document = Json::parse(viewer_json(made.delivery));
    const Json& frames = document["trajectory"];
    EXPECT_EQ(frames["kind"], "frames");
    EXPECT_EQ(frames["horizons"], Json::array({1.0, 2.5}));
    ASSERT_EQ(frames["frames"].size(), 2u);
    expect_color(document, frames["base"], made.recipe.canvas);
    expect_color(document, frames["frames"][1], made.forecast.trajectory.rate);
}

TEST(ViewerJson, PersistenceMayHaveNoRateImage) {
    MadeDelivery made;
    made.forecast.trajectory.law.order = 0;
    made.forecast.trajectory.rate = {};
    const Json document = Json::parse(viewer_json(made.delivery));
    for (double v : values_of(document, document["trajectory"]["rate"])) EXPECT_EQ(v, 0);
}

TEST(ViewerJson, HostileTextCannotEndTheScript) {
    MadeDelivery made;
    const std::string hostile = "</script><!-- \"quoted\" 'x' \\ \n end";
    made.delivery.title = hostile;
    made.forecast.explanation = hostile;
    made.delivery.guards[0].sentence = hostile;
    const std::string text = viewer_json(made.delivery);
    EXPECT_EQ(text.find('<'), std::string::npos);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    const Json document = Json::parse(text);
    EXPECT_EQ(document["title"], hostile);
    EXPECT_EQ(document["guards"][0]["sentence"], hostile);
    made.delivery.title = "\xFF\xFE";
    EXPECT_NO_THROW(Json::parse(viewer_json(made.delivery)));
}

TEST(ViewerRecipe, LargePicturesShrinkAndMeanTheSameSurface) {
    MadeDelivery made(2048, 512);
    made.recipe.luma_fill(101, 100) = 0.7f;  // a 2 x 2 block that is half filled
    made.recipe.luma_fill(100, 100) = 0.3f;
    made.recipe.luma_fill(200, 200) = 0.9f;  // one that is a quarter filled
    const Json document = Json::parse(viewer_json(made.delivery));
    EXPECT_EQ(document["width"], 1024);
    EXPECT_EQ(document["height"], 256);
    EXPECT_EQ(document["material"]["height_sigma"], 0.5);
    EXPECT_EQ(document["material"]["micro_sigma"], 1.0);
    EXPECT_EQ(document["material"]["normal_gain"], 1.5);
    const std::vector<double> base = values_of(document, document["trajectory"]["base"]);
    const Image<SrgbF>& full = made.forecast.trajectory.base;
    const double average = (full(20, 10).r + full(21, 10).r + full(20, 11).r + full(21, 11).r) / 4;
    EXPECT_NEAR(base[(5 * 1024 + 10) * 3], average, 1e-5);
    const std::vector<double> fill = values_of(document, document["luma_fill"]);
    EXPECT_NEAR(fill[50 * 1024 + 50], 0.5, 3e-5);
    EXPECT_EQ(fill[100 * 1024 + 100], -1);
    const std::vector<double> active = values_of(document, document["active"]);
    EXPECT_NEAR(active[0], 0, 1e-9);  // 3 of 4 pixels of the corner are backdrop
    EXPECT_NEAR(active[100], 1, 1e-9);
}

// The slopes of one bump, from the full picture and from the viewer's: the equations of
// docs/VIEWER_DATA.md without blur.
TEST(ViewerRecipe, KeepsTheSlopes) {
    MadeDelivery made(2048, 64);
    const ViewerRecipe small = viewer_recipe(made.recipe, {1024, 32});
    const double rise = 0.001;  // of height per fine pixel: a ramp, 8 * rise under Sobel
    const auto slope = [](const MaterialOptions& o, double step) {
        return o.normal_scale * o.normal_gain / 8 * 8 * step;
    };
    EXPECT_NEAR(slope(small.options, 2 * rise), slope(made.recipe.options, rise), 1e-12);
}

TEST(ViewerPage, PutsTheDocumentWhereTheTokenIs) {
    EXPECT_EQ(filled_viewer_page("<a>@@VERDIGRIS_DATA@@</a>", "{\"x\":1}"), "<a>{\"x\":1}</a>");
    EXPECT_THROW(filled_viewer_page("<a></a>", "{}"), Error);
    EXPECT_THROW(filled_viewer_page("@@VERDIGRIS_DATA@@@@VERDIGRIS_DATA@@", "{}"), Error);
}

TEST(ViewerPage, IsWrittenWhereItIsBuiltInAndRefusedElsewhere) {
    const ScratchFolder folder;
    const MadeDelivery made;
    if (!viewer_is_built_in()) {
        try {
            write_viewer(made.delivery, folder / "viewer.html");
            FAIL() << "wrote a viewer that this build does not have";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::failed);
            EXPECT_NE(error.sentence().find("VERDIGRIS_BUILD_VIEWER"), std::string::npos);
        }
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
        return;
    }
    write_viewer(made.delivery, folder / "viewer.html");
    const std::string page = read_text(folder / "viewer.html");
    EXPECT_EQ(page.find("@@VERDIGRIS_DATA@@"), std::string::npos);
    EXPECT_NE(page.find(viewer_json(made.delivery)), std::string::npos);
    // The title of the page is escaped text inside JSON; nothing else refers to the network.
    EXPECT_NE(page.find("id=\"verdigris-data\""), std::string::npos);
}

TEST(ViewerJson, SameTextAtAnyThreadCountAndStopsWhenAsked) {
    const MadeDelivery made(200, 100);
    set_thread_count(1);
    const std::string one = viewer_json(made.delivery);
    set_thread_count(0);
    EXPECT_EQ(viewer_json(made.delivery), one);
    EXPECT_THROW(viewer_json(made.delivery, [](std::string_view, std::int64_t done,
                                               std::int64_t) { return done < 2; }),
                 Error);
}

}  // namespace
}  // namespace verdigris
