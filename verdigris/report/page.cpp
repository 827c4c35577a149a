// SPDX-License-Identifier: MIT
#include "verdigris/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/files/base64.h"
#include "verdigris/report/escape.h"
#include "verdigris/report/figure_layout.h"
#include "verdigris/report/report_page.h"
#include "verdigris/report/table_formats.h"
#include "verdigris/report/vega_lite.h"

namespace verdigris {
namespace {

std::string data_uri(const char* kind, const std::string& bytes) {
    return fmt::format("data:image/{};base64,{}", kind,
                       base64(std::as_bytes(std::span(bytes.data(), bytes.size()))));
}

std::string files_line(const std::string& folder, const std::string& id,
                       std::initializer_list<std::pair<const char*, const char*>> kinds) {
    std::string links;
    for (const auto& [name, suffix] : kinds) {
        links += fmt::format("{}<a href=\"{}/{}.{}\">{}</a>", links.empty() ? "" : " · ", folder,
                             id, suffix, name);
    }
    return "<p class=\"files\">" + links + "</p>\n";
}

class BodyWriter {
  public:
    BodyWriter(const PageOptions& options, bool interactive)
        : options_(options), interactive_(interactive) {}

    std::string operator()(const Paragraph& block) const {
        return "<p>" + html_text(block.text) + "</p>\n";
    }
    std::string operator()(const BulletList& block) const {
        std::string out = "<ul>\n";
        for (const std::string& item : block.items) out += "<li>" + html_text(item) + "</li>\n";
        return out + "</ul>\n";
    }
    std::string operator()(const Status& block) const {
        const std::string severity = to_string(block.severity);
        const char* word = block.severity == Severity::info      ? "Note"
                           : block.severity == Severity::caution ? "Caution"
                                                                 : "Refused";
        return fmt::format("<p class=\"callout {}\" role=\"note\"><strong>{}.</strong> {}</p>\n",
                           severity, word, html_text(block.sentence));
    }
    std::string operator()(const Table& block) const {
        std::string out = fmt::format(
            "<section id=\"{}-block\">\n<h3>{}</h3>\n"
            "<div class=\"table\">{}</div>\n",
            block.id, html_text(block.title), table_html(block));
        if (options_.links) {
            out += files_line("tables", block.id,
                              {{"CSV", "csv"}, {"JSON", "json"}, {"LaTeX", "tex"}});
        }
        return out + "</section>\n";
    }
    std::string operator()(const Figure& block) const {
        const auto drawing = options_.drawings.find(block.id);
        const bool drawn = drawing != options_.drawings.end();
        const bool wide = layout_figure(block).columns > 1;
        std::string out = fmt::format(
            "<section id=\"{}-block\">\n<h3>{}</h3>\n"
            "<figure id=\"figure-{}\" class=\"{}\">\n",
            block.id, html_text(block.title), block.id, wide ? "wide" : "narrow");
        if (interactive_) out += "<div class=\"chart\"></div>\n";
        if (drawn) {
            out += fmt::format("<img class=\"drawing\" alt=\"{}\" src=\"{}\">\n",
                               html_text(one_line(block.title + ". " + block.caption)),
                               data_uri("svg+xml", drawing->second));
        } else if (!interactive_) {
            out +=
                "<p class=\"callout info\">This figure was not drawn: gnuplot was missing.</p>\n";
        }
        out += fmt::format("<figcaption>{}</figcaption>\n</figure>\n", html_text(block.caption));
        if (options_.links && drawn) {
            out += files_line("figures", block.id, {{"SVG", "svg"}, {"PNG", "png"}});
        }
        return out + "</section>\n";
    }

    std::string operator()(const Picture& block) const {
        std::string out = fmt::format(
            "<section id=\"{}-block\">\n<h3>{}</h3>\n<figure class=\"picture\">\n"
            "<img alt=\"{}\" src=\"{}\">\n<figcaption>{}</figcaption>\n</figure>\n",
            block.id, html_text(block.title),
            html_text(one_line(block.title + ". " + block.caption)), data_uri("png", block.png),
            html_text(block.caption));
        if (options_.links) out += files_line("figures", block.id, {{"PNG", "png"}});
        return out + "</section>\n";
    }

  private:
    const PageOptions& options_;
    bool interactive_;
};

std::string contents(const Report& report) {
    std::string out = "<nav aria-label=\"Contents\">\n<h2>Contents</h2>\n<ol>\n";
    const auto entry = [](const std::string& anchor, const std::string& title) {
        return fmt::format("<a href=\"#{}\">{}</a>", anchor, html_text(title));
    };
    for (const ReportSection& section : report.sections) {
        out += "<li>" + entry(section.id, section.title);
        std::string inner;
        for (const ReportBlock& block : section.blocks) {
            if (const auto* table = std::get_if<Table>(&block)) {
                inner += "<li>" + entry(table->id + "-block", table->title) + "</li>\n";
            } else if (const auto* figure = std::get_if<Figure>(&block)) {
                inner += "<li>" + entry(figure->id + "-block", figure->title) + "</li>\n";
            } else if (const auto* picture = std::get_if<Picture>(&block)) {
                inner += "<li>" + entry(picture->id + "-block", picture->title) + "</li>\n";
            }
        }
        if (!inner.empty()) out += "\n<ol>\n" + inner + "</ol>\n";
        out += "</li>\n";
    }
    return out + "</ol>\n</nav>\n";
}

std::string body(const Report& report, const PageOptions& options, bool interactive) {
    const BodyWriter writer(options, interactive);
    std::string out = contents(report) + "<main>\n<h1>" + html_text(report.title) + "</h1>\n";
    if (!report.subtitle.empty()) {
        out += "<p class=\"subtitle\">" + html_text(report.subtitle) + "</p>\n";
    }
    for (const ReportSection& section : report.sections) {
        out += fmt::format("<h2 id=\"{}\">{}</h2>\n", section.id, html_text(section.title));
        for (const ReportBlock& block : section.blocks) out += std::visit(writer, block);
    }
    if (!report.footer.empty()) out += "<footer>" + html_text(report.footer) + "</footer>\n";
    return out + "</main>";
}

// The specifications of all figures. "<" is escaped because the document stands in a script
// element, which "</script" would end.
std::string data(const Report& report) {
    std::string out = "{\"figures\":{";
    bool first = true;
    for (const ReportSection& section : report.sections) {
        for (const ReportBlock& block : section.blocks) {
            const auto* figure = std::get_if<Figure>(&block);
            if (!figure) continue;
            out += fmt::format("{}\"{}\":", first ? "" : ",", figure->id) + vega_lite_spec(*figure);
            first = false;
        }
    }
    out += "}}";
    std::string escaped;
    for (const char c : out) {
        if (c == '<') {
            escaped += "\\u003c";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

}  // namespace

void check_report(const Report& report) {
    std::set<std::string> ids;
    const auto claim = [&](const std::string& id) {
        // What derives from an id may be longer than an id.
        if (!is_plain_id(id.substr(0, 80))) {
            throw Error(ErrorCode::failed, "the report is not written: the id '" + id +
                                               "' must be letters, digits, '-' and '_' only");
        }
        if (!ids.insert(id).second) {
            throw Error(ErrorCode::failed,
                        "the report is not written: two of its parts are called '" + id + "'");
        }
    };
    for (const ReportSection& section : report.sections) {
        claim(section.id);
        for (const ReportBlock& block : section.blocks) {
            if (const auto* table = std::get_if<Table>(&block)) {
                check_table(*table);
                claim(table->id);
                claim(table->id + "-block");
                claim("table-" + table->id);
            } else if (const auto* figure = std::get_if<Figure>(&block)) {
                check_figure(*figure);
                claim(figure->id);
                claim(figure->id + "-block");
                claim("figure-" + figure->id);
            } else if (const auto* picture = std::get_if<Picture>(&block)) {
                claim(picture->id);
                claim(picture->id + "-block");
            }
        }
    }
}

bool report_is_interactive() {
    return !interactive_page().empty();
}

std::string filled_page(std::string_view page,
                        const std::vector<std::pair<std::string, std::string>>& parts) {
    struct Place {
        std::size_t at, length;
        const std::string* text;
    };
    std::vector<Place> places;
    for (const auto& [name, text] : parts) {
        const std::string token = "@@VERDIGRIS_" + name + "@@";
        const std::size_t at = page.find(token);
        if (at == page.npos || page.find(token, at + 1) != page.npos) {
            throw Error(ErrorCode::failed, "the built-in report page does not hold its token '" +
                                               name + "' exactly once; rebuild apps/report");
        }
        places.push_back({at, token.size(), &text});
    }
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.at < b.at; });
    std::string out;
    std::size_t done = 0;
    for (const Place& place : places) {
        out += page.substr(done, place.at - done);
        out += *place.text;
        done = place.at + place.length;
    }
    out += page.substr(done);
    return out;
}

std::string page_html(const Report& report, const PageOptions& options) {
    check_report(report);
    const bool interactive = options.interactive && report_is_interactive();
    std::vector<std::pair<std::string, std::string>> parts{
        {"TITLE", html_text(one_line(report.title))}, {"BODY", body(report, options, interactive)}};
    if (interactive) parts.emplace_back("DATA", data(report));
    return filled_page(interactive ? interactive_page() : plain_page(), parts);
}

}  // namespace verdigris
