// SPDX-License-Identifier: MIT
#include "verdigris/material/material_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/material/testing.h"

namespace verdigris {
namespace {

namespace fs = std::filesystem;

class RecipeIo : public testing::Test {
  protected:
    static MaterialRecipe example() {
        MaterialOptions options;
        options.coverage_exponent = 0.7;
        options.normal_gain = 3;
        options.reference_horizon = 12;
        const Context context = copper_context(23, 17, 6);
        return prepare_material(context, straight_forecast(context, {-0.01f, 0, 0.01f}), options);
    }
    ScratchFolder scratch_;
    fs::path folder_ = scratch_ / "material";
};

TEST_F(RecipeIo, RoundTripsEveryBit) {
    const MaterialRecipe saved = example();
    write_recipe(saved, folder_);
    const MaterialRecipe read = read_recipe(folder_);
    EXPECT_EQ(read.options.coverage_exponent, 0.7);
    EXPECT_EQ(read.options.normal_gain, 3);
    EXPECT_EQ(read.options.reference_horizon, 12);
    EXPECT_EQ(read.options.micro_range, saved.options.micro_range);
    EXPECT_EQ(read.tau, saved.tau);
    EXPECT_EQ(read.normalizer, saved.normalizer);
    EXPECT_EQ(read.reference_horizon, 12);
    EXPECT_TRUE(std::ranges::equal(read.canvas.pixels(), saved.canvas.pixels()));
    EXPECT_TRUE(std::ranges::equal(read.dead_zone.pixels(), saved.dead_zone.pixels()));
    EXPECT_TRUE(std::ranges::equal(read.luma_fill.pixels(), saved.luma_fill.pixels()));
    EXPECT_TRUE(std::ranges::equal(read.active.pixels(), saved.active.pixels()));
}

TEST_F(RecipeIo, NamesTheFileThatIsWrong) {
    const auto expect_bad = [&](const std::string& file) {
        try {
            read_recipe(folder_);
            FAIL() << "accepted a damaged " << file;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::bad_input);
            EXPECT_NE(e.where().find(file), std::string::npos) << e.what();
        }
    };
    expect_bad("recipe.json");
    const MaterialRecipe recipe = example();
    write_recipe(recipe, folder_);
    std::string text = read_text(folder_ / "recipe.json");
    write_file(folder_ / "recipe.json", "[1, 2");
    expect_bad("recipe.json");
    const auto at = text.find("\"micro_range\": ");
    ASSERT_NE(at, std::string::npos);
    write_file(folder_ / "recipe.json", text.insert(at + 15, "-"));
    expect_bad("recipe.json");
    write_recipe(recipe, folder_);
    fs::copy_file(folder_ / "canvas.npy", folder_ / "dead_zone.npy",
                  fs::copy_options::overwrite_existing);
    expect_bad("dead_zone.npy");
    write_recipe(recipe, folder_);
    fs::remove(folder_ / "luma_fill.npy");
    expect_bad("luma_fill.npy");
}

}  // namespace
}  // namespace verdigris
