// SPDX-License-Identifier: MIT
#include "verdigris/deliver/sheet_layout.h"

#include <gtest/gtest.h>

#include <utility>

namespace verdigris {
namespace {

bool overlap(const Rect& a, const Rect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

// A tile with the two label lines below it.
Rect with_labels(Rect tile, const SheetLayout& s) {
    return {tile.x, tile.y, s.column_width, tile.height + 56};
}

// How many forecast frames, and whether a row says how far off they may be.
constexpr std::pair<int, bool> kForecasts[] = {{0, false}, {0, true}, {1, false}, {1, true},
                                               {3, false}, {3, true}, {6, false}, {6, true}};

TEST(SheetLayout, NothingOverlapsAndAllIsOnTheSheet) {
    for (PictureSize picture : {PictureSize{256, 256}, {640, 20}, {1, 100}, {4000, 3000}, {3, 2}}) {
        for (int observed : {1, 2, 5}) {
            for (const auto& [forecast, uncertainty] : kForecasts) {
                const SheetLayout s = lay_out({picture, observed, forecast, 6, uncertainty});
                std::vector<Rect> blocks{s.legend};
                if (s.chart.width > 0) blocks.push_back(s.chart);
                if (uncertainty && forecast > 0) blocks.push_back(s.uncertainty_legend);
                for (const auto* row :
                     {&s.observed, &s.forecast, &s.change, &s.uncertainty, &s.maps}) {
                    for (const Rect& tile : *row) blocks.push_back(with_labels(tile, s));
                }
                // Headings are text above a row, as wide as the sheet.
                blocks.push_back({0, s.change_heading_y - 14, s.width, 18});
                if (!s.uncertainty.empty()) {
                    blocks.push_back({0, s.uncertainty_heading_y - 14, s.width, 18});
                }
                const std::size_t headings = s.uncertainty.empty() ? 1 : 2;
                for (std::size_t i = 0; i < blocks.size(); ++i) {
                    EXPECT_GE(blocks[i].x, 0);
                    EXPECT_LE(blocks[i].x + blocks[i].width,
                              s.width - (i + headings < blocks.size() ? s.margin : 0));
                    for (std::size_t k = i + 1; k < blocks.size(); ++k) {
                        EXPECT_FALSE(overlap(blocks[i], blocks[k]))
                            << i << " and " << k << ", " << picture.width << "x" << picture.height;
                    }
                }
                EXPECT_GE(s.notes.width, 500);
                EXPECT_LE(s.notes.x + s.notes.width, s.width - s.margin);
                EXPECT_EQ(s.change.size(), s.forecast.size());
                for (std::size_t i = 0; i < s.change.size(); ++i) {
                    EXPECT_EQ(s.change[i].x, s.forecast[i].x);
                }
                ASSERT_EQ(s.uncertainty.size(), uncertainty ? s.forecast.size() : 0u);
                for (std::size_t i = 0; i < s.uncertainty.size(); ++i) {
                    EXPECT_EQ(s.uncertainty[i].x, s.forecast[i].x);
                    EXPECT_GT(s.uncertainty[i].y, s.change[i].y);
                    EXPECT_LT(s.uncertainty[i].y + s.tile.height, s.divider_bottom);
                }
                EXPECT_LT(s.divider_bottom, s.maps_heading_y - 14);
            }
        }
    }
}

TEST(SheetLayout, TilesKeepTheAspect) {
    EXPECT_EQ(tile_extent({512, 512}), (PictureSize{256, 256}));
    EXPECT_EQ(tile_extent({400, 200}), (PictureSize{256, 128}));
    EXPECT_EQ(tile_extent({20, 40}), (PictureSize{128, 256}));
    EXPECT_EQ(tile_extent({1, 1000}), (PictureSize{1, 256}));
}

TEST(Evenly, KeepsTheEnds) {
    EXPECT_EQ(evenly_chosen(0, 5), (std::vector<int>{}));
    EXPECT_EQ(evenly_chosen(3, 5), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(evenly_chosen(10, 5), (std::vector<int>{0, 2, 5, 7, 9}));
    EXPECT_EQ(evenly_chosen(9, 1), (std::vector<int>{8}));
}

}  // namespace
}  // namespace verdigris
