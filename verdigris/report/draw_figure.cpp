// SPDX-License-Identifier: MIT
#include "verdigris/report/draw_figure.h"

#include <string_view>

#include "verdigris/error.h"
#include "verdigris/report/child_process.h"
#include "verdigris/report/escape.h"

namespace verdigris {
namespace {

constexpr const char* kGnuplot = "gnuplot";

bool is_whole(std::string_view picture, FigureFormat format) {
    if (format == FigureFormat::svg) {
        constexpr std::string_view kEnd = "</svg>";
        const auto end = picture.rfind(kEnd);
        return end != picture.npos &&
               picture.find_first_not_of('\n', end + kEnd.size()) == picture.npos;
    }
    constexpr std::string_view kEnd("IEND\xae\x42\x60\x82", 8);  // the last chunk of every PNG
    return picture.ends_with(kEnd);
}

// gnuplot calls every drawing "Gnuplot", which readers of the picture would be told.
std::string titled(std::string svg, const std::string& title) {
    constexpr std::string_view kTitle = "<title>Gnuplot</title>";
    const auto at = svg.find(kTitle);
    if (at != svg.npos) svg.replace(at, kTitle.size(), "<title>" + html_text(title) + "</title>");
    return svg;
}

// The last line of what gnuplot says is the complaint; before it stands the offending script.
std::string last_line(std::string text) {
    text.erase(text.find_last_not_of("\n ") + 1);
    return one_line(text.substr(text.rfind('\n') + 1));
}

}  // namespace

bool gnuplot_is_installed() {
    return !find_program(kGnuplot).empty();
}

std::string draw_figure(const Figure& figure, FigureFormat format) {
    const std::string script = gnuplot_script(figure, format);
    const std::filesystem::path gnuplot = find_program(kGnuplot);
    const std::string where = "figure '" + figure.id + "'";
    if (gnuplot.empty()) {
        throw Error(ErrorCode::failed,
                    "cannot be drawn without gnuplot: install the package gnuplot-nox", where);
    }
    // Without the user's ~/.gnuplot, which could change anything.
    const ProcessResult run = run_process({gnuplot, {"--default-settings"}, script});
    if (run.exit_status != 0 || !is_whole(run.output, format)) {
        throw Error(ErrorCode::failed,
                    "is not drawn: gnuplot says '" + last_line(run.errors) +
                        "'; gnuplot 5.4 or later with the terminals svg and pngcairo is needed "
                        "(package gnuplot-nox)",
                    where);
    }
    return format == FigureFormat::svg ? titled(run.output, figure.title) : run.output;
}

}  // namespace verdigris
