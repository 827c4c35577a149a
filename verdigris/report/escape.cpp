// SPDX-License-Identifier: MIT
#include "verdigris/report/escape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

namespace verdigris {
namespace {

constexpr char32_t kReplacement = 0xfffd;

// One character off the front. Overlong forms, surrogates and stray bytes are U+FFFD.
char32_t take_character(std::string_view& rest) {
    const auto lead = static_cast<unsigned char>(rest[0]);
    const int length = lead < 0x80 ? 1 : lead >> 5 == 6 ? 2 : lead >> 4 == 14 ? 3 : 4;
    char32_t c = lead;
    if (length > 1) c = lead & (0xff >> (length + 1));
    bool valid = lead < 0x80 || (lead >= 0xc2 && lead <= 0xf4);
    for (int i = 1; i < length && valid; ++i) {
        valid = std::size_t(i) < rest.size() &&
                (static_cast<unsigned char>(rest[std::size_t(i)]) >> 6) == 2;
        if (valid) c = c << 6 | (static_cast<unsigned char>(rest[std::size_t(i)]) & 0x3f);
    }
    constexpr std::array<char32_t, 5> kSmallest{0, 0, 0x80, 0x800, 0x10000};
    valid =
        valid && c >= kSmallest[std::size_t(length)] && c <= 0x10ffff && (c < 0xd800 || c > 0xdfff);
    rest.remove_prefix(valid ? std::size_t(length) : 1);
    return valid ? c : kReplacement;
}

void append_utf8(std::string& out, char32_t c) {
    if (c < 0x80) {
        out += char(c);
        return;
    }
    const int more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    constexpr std::array<char32_t, 4> kLead{0, 0xc0, 0xe0, 0xf0};
    out += char(kLead[std::size_t(more)] | (c >> (6 * more)));
    for (int i = more - 1; i >= 0; --i) out += char(0x80 | (c >> (6 * i) & 0x3f));
}

bool is_control(char32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x2028 || c == 0x2029;
}

char32_t visible(char32_t c) {
    return is_control(c) ? U' ' : c;
}

const char* latex_of_ascii(char32_t c) {
    switch (c) {
        case '\\':
            return "\\textbackslash{}";
        case '{':
            return "\\{";
        case '}':
            return "\\}";
        case '$':
            return "\\$";
        case '&':
            return "\\&";
        case '#':
            return "\\#";
        case '%':
            return "\\%";
        case '_':
            return "\\_";
        case '~':
            return "\\textasciitilde{}";
        case '^':
            return "\\textasciicircum{}";
        case '<':
            return "\\textless{}";
        case '>':
            return "\\textgreater{}";
        case '|':
            return "\\textbar{}";
        case '"':
            return "''";
        case '\'':
            return "'";
        // "\\ [" would be an optional argument to the end of the row before.
        case '[':
            return "{[}";
        case ']':
            return "{]}";
        default:
            return nullptr;
    }
}

// Letters and signs a report is likely to use and that pdflatex does not set by itself.
const char* latex_of_sign(char32_t c) {
    static constexpr std::pair<char32_t, const char*> kSigns[] = {
        {0x00a0, "~"},
        {0x00b0, "$^{\\circ}$"},
        {0x00b1, "$\\pm$"},
        {0x00b2, "$^{2}$"},
        {0x00b3, "$^{3}$"},
        {0x00b5, "$\\mu$"},
        {0x00b7, "$\\cdot$"},
        {0x00b9, "$^{1}$"},
        {0x00d7, "$\\times$"},
        {0x00f7, "$\\div$"},
        {0x2009, "\\,"},
        {0x2013, "--"},
        {0x2014, "---"},
        {0x2018, "`"},
        {0x2019, "'"},
        {0x201c, "``"},
        {0x201d, "''"},
        {0x2026, "\\ldots{}"},
        {0x202f, "\\,"},
        {0x207a, "$^{+}$"},
        {0x207b, "$^{-}$"},
        {0x2192, "$\\to$"},
        {0x2190, "$\\leftarrow$"},
        {0x2211, "$\\sum$"},
        {0x2212, "$-$"},
        {0x221a, "$\\surd$"},
        {0x221e, "$\\infty$"},
        {0x2248, "$\\approx$"},
        {0x2260, "$\\neq$"},
        {0x2264, "$\\leq$"},
        {0x2265, "$\\geq$"},
        {0x2208, "$\\in$"},
        {0x2020, "\\dag{}"},
        {0x2021, "\\ddag{}"},
        {0x2022, "\\textbullet{}"},
        {0x2032, "$'$"},
    };
    const auto* found = std::find_if(std::begin(kSigns), std::end(kSigns),
                                     [c](const auto& sign) { return sign.first == c; });
    return found == std::end(kSigns) ? nullptr : found->second;
}

std::string latex_of_greek(char32_t c) {
    static constexpr std::array kSmall{
        "alpha", "beta",   "gamma",   "delta", "epsilon", "zeta", "eta",  "theta", "iota",
        "kappa", "lambda", "mu",      "nu",    "xi",      "",     "pi",   "rho",   "varsigma",
        "sigma", "tau",    "upsilon", "phi",   "chi",     "psi",  "omega"};
    static constexpr std::pair<char32_t, const char*> kLarge[] = {
        {0x393, "Gamma"}, {0x394, "Delta"}, {0x398, "Theta"}, {0x39b, "Lambda"}, {0x39e, "Xi"},
        {0x3a0, "Pi"},    {0x3a3, "Sigma"}, {0x3a6, "Phi"},   {0x3a8, "Psi"},    {0x3a9, "Omega"}};
    std::string name;
    if (c >= 0x3b1 && c < 0x3b1 + kSmall.size()) name = kSmall[c - 0x3b1];
    for (const auto& [letter, large] : kLarge) {
        if (letter == c) name = large;
    }
    return name.empty() ? name : "$\\" + name + "$";
}

std::string latex_of(char32_t c) {
    if (is_control(c)) return " ";
    if (const char* escaped = latex_of_ascii(c)) return escaped;
    if (c < 0x80) return std::string(1, char(c));
    if (const char* sign = latex_of_sign(c)) return sign;
    if (std::string greek = latex_of_greek(c); !greek.empty()) return greek;
    if (c >= 0x2070 && c <= 0x2079) return fmt::format("$^{{{}}}$", c - 0x2070);
    if (c >= 0x2080 && c <= 0x2089) return fmt::format("$_{{{}}}$", c - 0x2080);
    // Accented Latin letters: LaTeX reads UTF-8 and composes these also in its oldest encoding.
    // The Icelandic ones and a few more are not in it.
    constexpr std::u32string_view kNotInOt1 = U"ÐÞðþĐđĦħĨĩĲĳĸĿŀŉŊŋŤťŦŧſ";
    const bool letter = c >= 0xc0 && c <= 0x17f && kNotInOt1.find(c) == std::u32string_view::npos;
    if (!letter) return fmt::format("{{[}}U+{:04X}{{]}}", std::uint32_t(c));
    std::string out;
    append_utf8(out, c);
    return out;
}

}  // namespace

std::string html_text(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const char32_t c = take_character(text);
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                append_utf8(out, is_control(c) && c != '\n' && c != '\t' ? U' ' : c);
        }
    }
    return out;
}

std::string latex_text(std::string_view text) {
    std::string out;
    while (!text.empty()) out += latex_of(take_character(text));
    return out;
}

bool is_plain_id(std::string_view id) {
    return !id.empty() && id.size() <= 80 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    });
}

int character_count(std::string_view text) {
    int count = 0;
    for (; !text.empty(); ++count) take_character(text);
    return count;
}

std::string one_line(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const char32_t c = take_character(text);
        append_utf8(out, visible(c));
    }
    return out;
}

std::string first_characters(std::string_view text, int count) {
    std::string out;
    for (; count > 0 && !text.empty(); --count) append_utf8(out, visible(take_character(text)));
    return out;
}

std::string last_characters(std::string_view text, int count) {
    for (int skip = character_count(text) - count; skip > 0; --skip) take_character(text);
    return one_line(text);
}

}  // namespace verdigris
