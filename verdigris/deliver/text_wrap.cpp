// SPDX-License-Identifier: MIT
#include "verdigris/deliver/text_wrap.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace verdigris {
namespace {

const std::string kEllipsis = "\xE2\x80\xA6";
const std::string kReplacement = "\xEF\xBF\xBD";

// Length of the UTF-8 sequence at text[i] if it is valid ([RFC3629], no overlong forms, no
// surrogates), else 0.
std::size_t sequence_length(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) -> unsigned {
        return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
    };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(k) & 0xC0) != 0x80) return 0;
    }
    if (lead == 0xE0 && byte(1) < 0xA0) return 0;
    if (lead == 0xED && byte(1) > 0x9F) return 0;
    if (lead == 0xF0 && byte(1) < 0x90) return 0;
    if (lead == 0xF4 && byte(1) > 0x8F) return 0;
    return length;
}

// The largest beginning of `text` (whole characters) for which fits(beginning) holds; at least
// `least` characters. Binary search: measuring is what costs.
std::size_t fitting_bytes(const std::string& text, std::size_t least,
                          const std::function<bool(const std::string&)>& fits) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequence_length(text, i);
        i += length > 0 ? length : 1;
        ends.push_back(i);
    }
    std::size_t low = 0, high = ends.size();
    while (low < high) {
        const std::size_t middle = (low + high + 1) / 2;
        if (fits(text.substr(0, ends[middle - 1]))) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    if (low < least) low = std::min(least, ends.size());
    return low == 0 ? 0 : ends[low - 1];
}

}  // namespace

std::string printable(std::string_view text) {
    std::string clean;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequence_length(text, i);
        const auto lead = static_cast<unsigned char>(text[i]);
        if (length == 0) {
            clean += kReplacement;
            ++i;
            continue;
        }
        if (length == 1 && (lead < 0x20 || lead == 0x7F)) {
            clean += ' ';
        } else {
            clean += text.substr(i, length);
        }
        i += length;
    }
    return clean;
}

std::string ellipsized(const std::string& text, double width, const TextWidth& measure) {
    if (measure(text) <= width) return text;
    const std::size_t bytes = fitting_bytes(text, 0, [&](const std::string& beginning) {
        return measure(beginning + kEllipsis) <= width;
    });
    return text.substr(0, bytes) + kEllipsis;
}

std::vector<std::string> wrapped(const std::string& text, double width, int max_lines,
                                 const TextWidth& measure) {
    std::vector<std::string> lines;
    std::string line;
    std::size_t at = 0;
    while (at < text.size()) {
        if (text[at] == ' ') {
            ++at;
            continue;
        }
        const std::size_t end = std::min(text.find(' ', at), text.size());
        std::string word = text.substr(at, end - at);
        const std::string longer = line.empty() ? word : line + " " + word;
        if (measure(longer) <= width) {
            line = longer;
            at = end;
            continue;
        }
        if (int(lines.size()) + 1 == max_lines) {  // the rest must end on this line
            line = ellipsized(line.empty() ? text.substr(at) : line + " " + text.substr(at), width,
                              measure);
            at = text.size();
            break;
        }
        if (!line.empty()) {
            lines.push_back(std::exchange(line, {}));
            continue;
        }
        const std::size_t bytes = fitting_bytes(
            word, 1, [&](const std::string& beginning) { return measure(beginning) <= width; });
        lines.push_back(word.substr(0, bytes));
        at += bytes;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

}  // namespace verdigris
