// SPDX-License-Identifier: MIT
#include "verdigris/report/page.h"

#include <gtest/gtest.h>

#include <string>

#include "verdigris/files/testing.h"
#include "verdigris/report/report_page.h"
#include "verdigris/report/testing.h"

namespace verdigris {
namespace {

Report small_report() {
    Table table;
    table.id = "scores";
    table.title = "Scores";
    table.columns = {{"name", "Name", Align::left}, {"mse", "MSE"}};
    table.add_row({"a < b", 0.5});
    return {"A title & more",
            "",
            {{"verdict",
              "Verdict",
              {Paragraph{"<script>alert(1)</script> @@VERDIGRIS_DATA@@"}, BulletList{{"one"}},
               Status{"few", Severity::caution, "Only 3 windows."}, table, simple_figure(),
               Picture{"seen", "A <picture>", "What it shows", "\x89PNG"}}}},
            "made by hand"};
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Page, HoldsItsPartsAndNoMarkupOfTheirs) {
    for (const bool interactive : {true, false}) {
        PageOptions options;
        options.interactive = interactive;
        options.drawings["simple"] = "<svg/>";
        const std::string html = page_html(small_report(), options);
        EXPECT_TRUE(holds(html, "<title>A title &amp; more</title>"));
        EXPECT_TRUE(holds(html, "&lt;script&gt;alert(1)&lt;/script&gt; @@VERDIGRIS_DATA@@</p>"));
        EXPECT_TRUE(holds(html, "<strong>Caution.</strong> Only 3 windows."));
        EXPECT_TRUE(holds(html, "a &lt; b"));
        EXPECT_TRUE(holds(html, "<a href=\"#verdict\">Verdict</a>"));
        EXPECT_TRUE(holds(html, "<a href=\"#simple-block\">A simple figure</a>"));
        EXPECT_TRUE(holds(html, "data:image/svg+xml;base64,PHN2Zy8+"));
        EXPECT_TRUE(holds(html, "<a href=\"#seen-block\">A &lt;picture&gt;</a>"));
        EXPECT_TRUE(holds(html, "data:image/png;base64,iVBORw=="));
        EXPECT_FALSE(holds(html, "href=\"tables/"));
        EXPECT_FALSE(holds(html, "@@STYLE@@"));
    }
}

TEST(Page, WithoutInteractionThereIsNoScriptAtAll) {
    PageOptions options;
    options.interactive = false;
    const std::string html = page_html(small_report(), options);
    EXPECT_FALSE(holds(html, "<script"));
    EXPECT_FALSE(holds(html, "class=\"chart\""));
    EXPECT_TRUE(holds(html, "gnuplot was missing"));
    EXPECT_TRUE(holds(html, "default-src 'none'"));
}

TEST(Page, TheDocumentCannotEndItsScript) {
    if (!report_is_interactive()) GTEST_SKIP() << "built without node";
    Report report = small_report();
    std::get<Figure>(report.sections[0].blocks[4]).panels[0].series[0].name = "</script><b>";
    const std::string html = page_html(report, {});
    EXPECT_TRUE(holds(html, "\\u003c/script>"));
    EXPECT_FALSE(holds(html, "</script><b>"));
}

TEST(Page, LinksStandBesideWhatTheyName) {
    PageOptions options;
    options.links = true;
    std::string html = page_html(small_report(), options);
    EXPECT_TRUE(holds(html, "href=\"tables/scores.csv\""));
    EXPECT_FALSE(holds(html, "href=\"figures/simple.svg\""));  // not drawn, no file
    options.drawings["simple"] = "<svg/>";
    html = page_html(small_report(), options);
    EXPECT_TRUE(holds(html, "href=\"figures/simple.svg\""));
}

TEST(Page, IdsAreUsedOnce) {
    Report report = small_report();
    report.sections.push_back({"scores", "Again", {}});
    const Error error = error_of([&] { page_html(report, {}); });
    EXPECT_TRUE(holds(error.what(), "two of its parts are called 'scores'")) << error.what();
    report.sections.back().id = "two words";
    EXPECT_THROW(page_html(report, {}), Error);
}

TEST(Page, TokensAreFilledOnceAndFromTheTemplateOnly) {
    EXPECT_EQ(
        filled_page("a@@VERDIGRIS_X@@b@@VERDIGRIS_Y@@c", {{"Y", "@@VERDIGRIS_X@@"}, {"X", "1"}}),
        "a1b@@VERDIGRIS_X@@c");
    EXPECT_THROW(filled_page("nothing", {{"X", "1"}}), Error);
    EXPECT_THROW(filled_page("@@VERDIGRIS_X@@@@VERDIGRIS_X@@", {{"X", "1"}}), Error);
}

}  // namespace
}  // namespace verdigris
