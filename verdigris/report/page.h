// SPDX-License-Identifier: MIT
// A report to read: sections of words, tables and figures, on one self-contained page.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "verdigris/report/figure.h"
#include "verdigris/report/table.h"
#include "verdigris/status.h"

namespace verdigris {

/// A paragraph. Plain text: nothing in it is markup. Numbers are the caller's, already in words.
struct Paragraph {
    std::string text;
};
/// A list with bullets.
struct BulletList {
    std::vector<std::string> items;
};

/// A picture that is no drawing: frames, renders, maps.
struct Picture {
    std::string id;  ///< as a figure's
    std::string title, caption;
    std::string png;  ///< the bytes of a PNG file
};

/// A Status is shown as a callout with its severity in words.
using ReportBlock = std::variant<Paragraph, BulletList, Status, Table, Figure, Picture>;

struct ReportSection {
    std::string id;  ///< of the heading: letters, digits, "-", "_"; unique
    std::string title;
    std::vector<ReportBlock> blocks;
};

struct Report {
    std::string title, subtitle;
    std::vector<ReportSection> sections;
    std::string footer;  ///< how it was made: version, command, input; may be empty
};

struct PageOptions {
    /// Charts and sorting; without them, or where this build has no scripts, the page holds none at
    /// all.
    bool interactive = true;
    /// SVG of each figure by its id; a figure without one is shown as a chart only, or where there
    /// is no script as a sentence that says why it is missing.
    std::map<std::string, std::string> drawings;
    /// Links to tables/<id>.csv and so on, and to figures/<id>.svg: the page lies beside them.
    bool links = false;
};

/// The page as HTML: table of contents, light and dark, printable; no network, no time of day.
/// Throws Error{failed}: an id used twice or no plain id, a table or a figure that cannot be
/// written.
std::string page_html(const Report& report, const PageOptions& options);

/// Are charts interactive in this build?
bool report_is_interactive();

/// Throws Error{failed} as page_html does; cheap, and before anything is drawn.
void check_report(const Report& report);

/// `page` with each "@@VERDIGRIS_<name>@@" replaced by its part; parts are not searched for tokens.
/// Throws Error{failed} if a token is not there exactly once.
std::string filled_page(std::string_view page,
                        const std::vector<std::pair<std::string, std::string>>& parts);

}  // namespace verdigris
