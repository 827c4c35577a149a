// SPDX-License-Identifier: MIT
#include "verdigris/report/draw_figure.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/report/testing.h"

namespace verdigris {
namespace {

// PATH is empty while it lives: no program is found.
class EmptyPath {
  public:
    EmptyPath() : old_(std::getenv("PATH")) { ::setenv("PATH", "/nowhere", 1); }
    ~EmptyPath() { ::setenv("PATH", old_.c_str(), 1); }

  private:
    std::string old_;
};

#define NEEDS_GNUPLOT() \
    if (!gnuplot_is_installed()) GTEST_SKIP() << "no gnuplot on this machine"

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST(DrawFigure, SameFigureSameBytesAndNoDate) {
    NEEDS_GNUPLOT();
    for (const FigureFormat format : {FigureFormat::svg, FigureFormat::png}) {
        const std::string once = draw_figure(simple_figure(), format);
        ::setenv("TZ", "Asia/Tokyo", 1);
        ::setenv("LC_ALL", "de_DE.UTF-8", 1);
        EXPECT_EQ(once, draw_figure(simple_figure(), format));
        ::unsetenv("LC_ALL");
        ::unsetenv("TZ");
    }
}

TEST(DrawFigure, SvgHoldsTheWordsAndTheTitle) {
    NEEDS_GNUPLOT();
    Figure figure = simple_figure();
    figure.title = "Errors <by> horizon";
    figure.panels[0].references = {{"persistence", 50}};
    const std::string svg = draw_figure(figure, FigureFormat::svg);
    EXPECT_NE(svg.find("<title>Errors &lt;by&gt; horizon</title>"), std::string::npos);
    for (const char* word : {">Horizon<", ">Error<", ">affinergb<", ">persistence<"}) {
        EXPECT_NE(svg.find(word), std::string::npos) << word;
    }
    EXPECT_NE(svg.find("DejaVu Sans"), std::string::npos);
    EXPECT_EQ(count(svg, "<script"), 0);
}

TEST(DrawFigure, PngIsThreeAndAHalfInchesAt300) {
    NEEDS_GNUPLOT();
    const ScratchFolder folder;
    write_file(folder / "f.png", draw_figure(simple_figure(), FigureFormat::png));
    const ImageFile image = read_image(folder / "f.png");
    EXPECT_EQ(image.info.width, 1050);
}

TEST(DrawFigure, TextIsNeverACommand) {
    NEEDS_GNUPLOT();
    Figure figure = simple_figure();
    const std::string nasty = "it's `id` \"$(id)\" %s 100 % {/Symbol a}_b^c @x\n; system('x') \\";
    figure.panels[0].title = nasty;
    figure.panels[0].x.label = nasty;
    figure.panels[0].x.categories = {nasty, "50 %", "'"};
    figure.panels[0].series[0].name = nasty;
    figure.panels[0].references = {{nasty + "2", 3}};
    const std::string svg = draw_figure(figure, FigureFormat::svg);
    EXPECT_NE(svg.find("`id`"), std::string::npos);
    EXPECT_NE(svg.find("50 %"), std::string::npos);
    EXPECT_EQ(svg.find("uid="), std::string::npos);
}

// gnuplot drops what does not fit its key without a word.
TEST(DrawFigure, TheLegendHoldsEveryName) {
    NEEDS_GNUPLOT();
    for (const int columns : {1, 2}) {
        for (const std::size_t length : {3u, 12u, 19u, 27u, 45u}) {
            Figure figure = simple_figure();
            figure.columns = columns;
            for (int i = 0; i < 9; ++i) {
                FigureSeries series = figure.panels[0].series[0];
                series.name = std::string(length - 1, 'm') + char('a' + i);
                figure.panels[0].series.push_back(series);
            }
            const std::string svg = draw_figure(figure, FigureFormat::svg);
            for (const FigureSeries& series : figure.panels[0].series) {
                const auto at = svg.find(">" + series.name + "<");
                ASSERT_NE(at, std::string::npos) << series.name;
                // Inside the sheet: the last translate before the words.
                const auto move = svg.rfind("translate(", at);
                const double x = std::strtod(svg.c_str() + move + 10, nullptr);
                const double y = std::strtod(svg.c_str() + svg.find(',', move) + 1, nullptr);
                EXPECT_GT(y, 5) << series.name << ", " << columns << " columns";
                EXPECT_GT(x, 0) << series.name << ", " << columns << " columns";
            }
        }
    }
}

TEST(DrawFigure, WithoutGnuplotSaysWhatToInstall) {
    const EmptyPath nothing;
    EXPECT_FALSE(gnuplot_is_installed());
    const Error error = error_of([] { draw_figure(simple_figure(), FigureFormat::svg); });
    EXPECT_EQ(std::string(error.what()),
              "figure 'simple': cannot be drawn without gnuplot: install the package gnuplot-nox");
}

TEST(DrawFigure, AFailingGnuplotIsQuoted) {
    const ScratchFolder folder;
    write_file(folder / "gnuplot", "#!/bin/sh\necho 'line 3: no such terminal' >&2\nexit 1\n");
    std::filesystem::permissions(folder / "gnuplot", std::filesystem::perms::owner_all);
    const std::string old = std::getenv("PATH");
    ::setenv("PATH", folder.path().c_str(), 1);
    const Error error = error_of([] { draw_figure(simple_figure(), FigureFormat::png); });
    ::setenv("PATH", old.c_str(), 1);
    EXPECT_NE(error.sentence().find("'line 3: no such terminal'"), std::string::npos);
    EXPECT_NE(error.sentence().find("gnuplot-nox"), std::string::npos);
}

}  // namespace
}  // namespace verdigris
