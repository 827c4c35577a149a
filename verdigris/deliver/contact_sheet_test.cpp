// SPDX-License-Identifier: MIT
#include "verdigris/deliver/contact_sheet.h"

#include <cairo.h>
#include <fontconfig/fontconfig.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verdigris/deliver/sheet_chart.h"
#include "verdigris/deliver/sheet_layout.h"
#include "verdigris/deliver/sheet_tiles.h"
#include "verdigris/deliver/testing.h"
#include "verdigris/deliver/uncertainty_map.h"
#include "verdigris/deliver/visible_change.h"

namespace verdigris {
namespace {

// cairo keeps fonts for the whole process, behind pointers that the leak checker cannot follow
// (fontconfig stores them as offsets). Given back when all tests are done.
class GiveBackFonts : public testing::Environment {
  public:
    void TearDown() override {
        cairo_debug_reset_static_data();
        FcFini();
    }
};
[[maybe_unused]] const auto* const kGiveBackFonts =
    testing::AddGlobalTestEnvironment(new GiveBackFonts);

constexpr SrgbU8 kGround{0x1D, 0x1F, 0x21};

// Rows and columns at the border of a sheet must be ground: text or tiles there would be cut off.
void expect_margins(const Image<SrgbU8>& sheet, int margin) {
    int dirty = 0;
    for (int y = 0; y < sheet.height(); ++y) {
        for (int x = 0; x < sheet.width(); ++x) {
            const bool border = x < margin || y < margin || x >= sheet.width() - margin ||
                                y >= sheet.height() - margin;
            if (border && sheet(x, y) != kGround) ++dirty;
        }
    }
    EXPECT_EQ(dirty, 0);
}

TEST(ContactSheet, WhatTheFontCannotWriteIsAQuestionMark) {
    const TextStyle style{38, {0xECEAE6}, true};
    const std::string chinese = "\xE9\x8A\x85\xE6\x9D\xBF", egyptian = "\xF0\x93\x80\x80";
    EXPECT_EQ(text_width("plate " + chinese + " 3", style), text_width("plate ?? 3", style));
    EXPECT_EQ(text_width(egyptian, style), text_width("?", style));
    // What it can write stays.
    const std::string greek =
        "\xCF\x87\xCE\xB1\xCE\xBB\xCE\xBA\xCF\x8C\xCF\x82 \xC2\xB7 \xE2\x80\xA6";
    EXPECT_NE(text_width(greek, style), text_width("?????? ? ?", style));
    MadeDelivery a, b;
    a.delivery.title = "plate " + chinese;
    b.delivery.title = "plate ??";
    const Image<SrgbU8> drawn = draw_contact_sheet(a.delivery),
                        asked = draw_contact_sheet(b.delivery);
    ASSERT_TRUE(drawn.same_size(asked));
    EXPECT_TRUE(std::equal(drawn.pixels().begin(), drawn.pixels().end(), asked.pixels().begin()));
}

TEST(ContactSheet, ShowsEveryTileWhereTheLayoutPutsIt) {
    const MadeDelivery made(64, 40);
    const Image<SrgbU8> sheet = draw_contact_sheet(made.delivery);
    const SheetTiles tiles = make_sheet_tiles(made.delivery);
    const SheetLayout s = lay_out({{64, 40}, 2, 2, 6});
    EXPECT_EQ(sheet.width(), s.width);
    EXPECT_GT(sheet.height(), s.maps_bottom);
    const auto expect_tile = [&](const Rect& at, const Image<SrgbU8>& picture) {
        ASSERT_TRUE(picture.same_size(at.width, at.height));
        for (int y = 0; y < at.height; ++y) {
            ASSERT_TRUE(
                std::equal(picture.row(y), picture.row(y) + at.width, sheet.row(at.y + y) + at.x));
        }
    };
    for (std::size_t i = 0; i < 2; ++i) {
        expect_tile(s.observed[i], tiles.observed[i].picture);
        expect_tile(s.forecast[i], tiles.forecast[i].picture);
        expect_tile(s.change[i], tiles.forecast[i].change);
    }
    for (std::size_t i = 0; i < 6; ++i) expect_tile(s.maps[i], tiles.maps[i].picture);
    expect_margins(sheet, 40);
}

void make_unsure(MadeDelivery& made) {
    made.forecast.spread.own = made.forecast.trajectory.base.clone();
    for (SrgbF& c : made.forecast.spread.own.pixels()) c = {2 * c.r, 2 * c.r, 2 * c.r};
    for (int y = 0; y < 8; ++y) made.forecast.spread.own(0, y) = {};
    made.forecast.spread.nodes = {{20, 1e-4, 4e-4}};
}

TEST(ContactSheet, HasARowOfUncertaintyOnlyWhereItIsStated) {
    MadeDelivery made(64, 40);
    const Image<SrgbU8> without = draw_contact_sheet(made.delivery);
    make_unsure(made);
    const Image<SrgbU8> sheet = draw_contact_sheet(made.delivery);
    const SheetTiles tiles = make_sheet_tiles(made.delivery);
    const SheetLayout s = lay_out({{64, 40}, 2, 2, 6, true});
    ASSERT_EQ(s.uncertainty.size(), 2u);
    EXPECT_GE(sheet.height() - without.height(), s.tile.height);
    EXPECT_EQ(tiles.uncertainty_full_codes, uncertainty_full_codes(made.delivery));
    for (std::size_t i = 0; i < 2; ++i) {
        const Rect& at = s.uncertainty[i];
        const Image<SrgbU8>& picture = tiles.forecast[i].uncertainty;
        ASSERT_TRUE(picture.same_size(at.width, at.height));
        for (int y = 0; y < at.height; ++y) {
            ASSERT_TRUE(
                std::equal(picture.row(y), picture.row(y) + at.width, sheet.row(at.y + y) + at.x));
        }
        EXPECT_EQ(picture(0, 0), kHeldGray);
        EXPECT_NE(picture(60, 40), kHeldGray);
    }
    // It grows, under one scale: the later one is lighter.
    EXPECT_GT(tiles.forecast[1].uncertainty(60, 40).r, tiles.forecast[0].uncertainty(60, 40).r);
    EXPECT_NEAR(tiles.forecast[1].pixel_80, kHalfWidth80 * std::sqrt(5e-4), 1e-9);
    expect_margins(sheet, 40);
}

TEST(ContactSheet, HasTextInEveryLabelPlace) {
    MadeDelivery made(64, 40);
    make_unsure(made);
    const Image<SrgbU8> sheet = draw_contact_sheet(made.delivery);
    const SheetLayout s = lay_out({{64, 40}, 2, 2, 6, true});
    const auto inked = [&](Rect r) {
        int count = 0;
        for (int y = r.y; y < r.y + r.height; ++y) {
            for (int x = r.x; x < r.x + r.width; ++x) count += sheet(x, y) != kGround;
        }
        return count;
    };
    EXPECT_GT(inked({s.margin, s.title_y - 28, 300, 30}), 500);
    EXPECT_GT(inked({s.margin, s.facts_y - 14, 600, 16}), 500);
    EXPECT_GT(inked({s.margin, s.axis_y - 12, 600, 14}), 500);
    for (const auto* row : {&s.observed, &s.forecast, &s.change, &s.uncertainty, &s.maps}) {
        for (const Rect& tile : *row) {
            EXPECT_GT(inked({tile.x, tile.y + tile.height + 10, s.column_width, 18}), 40);
        }
    }
    for (const Rect& legend : {s.legend, s.uncertainty_legend}) {
        EXPECT_GT(inked({legend.x, legend.y, 320, 16}), 4000);               // the bar
        EXPECT_GT(inked({legend.x, legend.y + 26, 320, 14}), 40);            // its ends
        EXPECT_GT(inked({legend.x, legend.y + 60, legend.width, 60}), 400);  // the note
    }
    EXPECT_GT(inked({s.margin, s.uncertainty_heading_y - 12, 240, 13}), 300);
    EXPECT_GT(inked({s.notes.x, s.notes.y - 12, 300, 14}), 200);
}

TEST(ContactSheet, SurvivesHostileText) {
    MadeDelivery made(16, 16);
    for (const std::string& text :
         {std::string("</script>\"'\n\t\xFF\xFE"), std::string(20000, 'W'), std::string(),
          std::string("\xE6\x97\xA5\xE6\x9C\xAC")}) {
        made.delivery.title = text;
        made.forecast.explanation = text;
        made.forecast.forecaster = text;
        made.delivery.guards.assign(20, {"x", Severity::refusal, text});
        const Image<SrgbU8> sheet = draw_contact_sheet(made.delivery);
        EXPECT_LT(sheet.height(), 4000);
        expect_margins(sheet, 40);
    }
}

TEST(ContactSheet, OddShapesAndCounts) {
    for (const PictureSize extent : {PictureSize{1, 50}, {50, 1}, {1, 1}, {900, 300}}) {
        MadeDelivery made(extent.width, extent.height, 0);
        made.delivery.horizons = {7.5};
        expect_margins(draw_contact_sheet(made.delivery), 40);
        made.delivery.horizons.clear();
        made.delivery.observed.clear();
        expect_margins(draw_contact_sheet(made.delivery), 40);
        for (int i = 1; i <= 12; ++i) made.delivery.horizons.push_back(i);
        for (int i = 0; i < 30; ++i) {
            made.delivery.observed.push_back({double(i - 29), made.recipe.canvas.clone()});
        }
        const SheetTiles tiles = make_sheet_tiles(made.delivery);
        EXPECT_EQ(tiles.observed.size(), 5u);
        EXPECT_EQ(tiles.observed.front().label, "-29 u");
        EXPECT_EQ(tiles.observed.back().label, "last observed");
        EXPECT_EQ(tiles.forecast.size(), 6u);
        EXPECT_EQ(tiles.forecast.back().label, "+12 u");
        expect_margins(draw_contact_sheet(made.delivery), 40);
    }
}

TEST(ContactSheet, IsASyntheticCompositeAndTheSameEveryTime) {
    const ScratchFolder folder;
    const MadeDelivery made;
    write_contact_sheet(made.delivery, folder / "sheet.png");
    const std::string png = read_text(folder / "sheet.png");
    EXPECT_NE(png.find("digitalsourcetype/compositeSynthetic"), std::string::npos);
    EXPECT_TRUE(has_chunk(png_chunks(png), "sRGB"));
    write_contact_sheet(made.delivery, folder / "again.png");
    EXPECT_EQ(read_text(folder / "again.png"), png);
}

TEST(SheetTiles, MarkHorizonsBeyondTwiceTheContext) {
    MadeDelivery made;
    made.delivery.horizons = {5, 20, 21};
    const SheetTiles tiles = make_sheet_tiles(made.delivery);
    EXPECT_FALSE(tiles.forecast[1].beyond_trust);
    EXPECT_TRUE(tiles.forecast[2].beyond_trust);
    EXPECT_EQ(tiles.maps_heading, "MATERIAL AT +20 u");
    EXPECT_EQ(trusted_horizon(made.delivery), 20);
}

TEST(ChangeCurve, KnownAnswers) {
    MadeDelivery made(20, 20);
    for (SrgbF& c : made.forecast.trajectory.rate.pixels()) c = {0.001f, -0.001f, 0.001f};
    for (SrgbF& c : made.delivery.observed[0].image.pixels()) c.r += 0.03f;
    const ChangeCurve curve = change_curve(made.delivery);
    ASSERT_EQ(curve.observed.size(), 2u);
    EXPECT_EQ(curve.observed[0].unit, -4);
    EXPECT_NEAR(curve.observed[0].change, 0.01, 1e-6);
    EXPECT_EQ(curve.observed[1].change, 0);
    ASSERT_EQ(curve.forecast.size(), 3u);
    EXPECT_EQ(curve.forecast[0].change, 0);
    EXPECT_NEAR(curve.forecast[2].change, 0.02, 1e-6);
    EXPECT_EQ(curve.trusted_until, 20);
}

TEST(ChangeMap, KnownAnswers) {
    Image<SrgbF> base(2, 1), frame(2, 1);
    frame(1, 0) = {0.3f, -0.3f, 0.0f};
    const Image<float> map = change_between(base, frame);
    EXPECT_EQ(map(0, 0), 0);
    EXPECT_FLOAT_EQ(map(1, 0), 0.2f);
    Mask where(2, 1);
    EXPECT_EQ(mean_inside(map, where), 0);
    where(1, 0) = kInside;
    EXPECT_FLOAT_EQ(float(mean_inside(map, where)), 0.2f);
    EXPECT_FLOAT_EQ(float(mean_inside(map, {})), 0.1f);
}

TEST(ChangeMap, ScaleIsRoundAndNeverTiny) {
    const auto scale_of = [](float value) {
        std::vector<Image<float>> maps;
        maps.emplace_back(10, 10);
        for (float& v : maps[0].pixels()) v = value;
        return change_scale(maps, {});
    };
    EXPECT_DOUBLE_EQ(scale_of(0), 0.01);
    EXPECT_DOUBLE_EQ(scale_of(0.013f), 0.02);
    EXPECT_DOUBLE_EQ(scale_of(0.04f), 0.05);
    EXPECT_DOUBLE_EQ(scale_of(0.3f), 0.5);
    EXPECT_DOUBLE_EQ(scale_of(0.9f), 1);
    EXPECT_DOUBLE_EQ(change_scale({}, {}), 0.01);
}

}  // namespace
}  // namespace verdigris
