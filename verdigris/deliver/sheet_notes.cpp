// SPDX-License-Identifier: MIT
#include "verdigris/deliver/sheet_notes.h"

#include <fmt/format.h>

#include <algorithm>

#include "verdigris/deliver/uncertainty.h"

namespace verdigris {
namespace {

constexpr Ink kText{0xECEAE6}, kMuted{0x9DA3A8}, kAmber{0xE6B450}, kRed{0xF0737C}, kBlue{0x8AB6E8};
constexpr TextStyle kHeading{14, kMuted, true}, kBody{16, kText}, kSmall{15, kMuted};
constexpr int kLeading = 24;
// chosen: a sheet is a picture; whoever needs every word finds it in manifest.json.
constexpr int kMaxGuards = 8, kGuardLines = 4, kExplanationLines = 8, kUncertaintyLines = 4;

struct SeverityWord {
    const char* word;
    Ink ink;
};
SeverityWord word_of(Severity severity) {
    switch (severity) {
        case Severity::info:
            return {"NOTE", kBlue};
        case Severity::caution:
            return {"CAUTION", kAmber};
        case Severity::refusal:
            return {"REFUSED WITHOUT --force", kRed};
    }
    return {"NOTE", kBlue};
}

// "31 %" stays on one line.
std::string with_tied_percent(std::string text) {
    const std::string tied = "\xC2\xA0%";  // a no-break space
    for (std::size_t at = 0; (at = text.find(" %", at)) != std::string::npos; at += tied.size()) {
        text.replace(at, 2, tied);
    }
    return text;
}

}  // namespace

void SheetNotes::add(const std::string& text, const TextStyle& style, int indent, int advance) {
    lines_.push_back({text, style, indent, advance});
}

void SheetNotes::add_paragraph(const std::string& text, const TextStyle& style, int indent,
                               int before, int max_lines) {
    int advance = before;
    for (const std::string& line :
         wrapped(with_tied_percent(printable(text)), width_ - indent, max_lines, measure(style))) {
        add(line, style, indent, advance);
        advance = kLeading;
    }
}

SheetNotes::SheetNotes(const Delivery& delivery, int width) : width_(width) {
    add("WHY THIS FORECAST", kHeading, 0, 0);
    const std::string& explanation = delivery.forecast->explanation;
    add_paragraph(explanation.empty() ? "No explanation was recorded." : explanation, kBody, 0, 32,
                  kExplanationLines);
    const std::string sure = uncertainty_sentence(uncertainty_of(delivery));
    if (!sure.empty()) add_paragraph(sure, kBody, 0, 36, kUncertaintyLines);
    add("WHAT TO MIND", kHeading, 0, 48);
    if (delivery.guards.empty()) {
        add_paragraph("No guard fired: the context is long enough and behaves.", kBody, 0, 32, 2);
    }
    // The worst first; within one severity in the given order.
    std::vector<const Status*> guards;
    for (const Status& guard : delivery.guards) guards.push_back(&guard);
    std::stable_sort(guards.begin(), guards.end(),
                     [](const Status* a, const Status* b) { return a->severity > b->severity; });
    for (std::size_t i = 0; i < guards.size() && i < kMaxGuards; ++i) {
        const SeverityWord severity = word_of(guards[i]->severity);
        TextStyle style = kHeading;
        style.ink = severity.ink;
        add(severity.word, style, 16, i == 0 ? 34 : 36);
        add_paragraph(guards[i]->sentence, kBody, 16, kLeading, kGuardLines);
    }
    if (guards.size() > kMaxGuards) {
        add(fmt::format("and {} more, in manifest.json", guards.size() - kMaxGuards), kSmall, 16,
            36);
    }
}

int SheetNotes::height() const {
    int height = 8;  // below the last baseline
    for (const Line& line : lines_) height += line.advance;
    return height;
}

void SheetNotes::draw(SheetCanvas& canvas, int x, int y) const {
    for (const Line& line : lines_) {
        y += line.advance;
        canvas.text(x + line.indent, y, line.text, line.style);
    }
}

}  // namespace verdigris
