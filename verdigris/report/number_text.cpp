// SPDX-License-Identifier: MIT
#include "verdigris/report/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace verdigris {
namespace {

std::string digits_of(double value, NumberFormat format) {
    const int digits = std::clamp(format.digits, 0, 17);
    switch (format.style) {
        case NumberStyle::significant: {
            // As %g chooses, but with the zeros kept: they say how much is known. The exponent is
            // that of the rounded value, so that 99.96 with three digits is "100".
            const int after_first = std::max(digits, 1) - 1;
            const std::string text = fmt::format("{:.{}e}", value, after_first);
            const int exponent = std::stoi(text.substr(text.find('e') + 1));
            if (exponent < -5 || exponent > after_first) return text;
            return fmt::format("{:.{}f}", value, after_first - exponent);
        }
        case NumberStyle::fixed:
            return fmt::format("{:.{}f}", value, digits);
        case NumberStyle::scientific:
            return fmt::format("{:.{}e}", value, digits);
        case NumberStyle::percent:
            return fmt::format("{:.{}f}", value * 100, digits);
        case NumberStyle::integer:
            return fmt::format("{:.0f}", value);
    }
    return {};
}

// Before an exponent, where there is one: the digits of the mantissa decide.
bool shows_zero(std::string_view text) {
    return text.substr(0, text.find('e')).find_first_of("123456789") == std::string_view::npos;
}

void append_superscript(std::string& out, std::string_view exponent) {
    constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    if (exponent.starts_with('-')) out += "⁻";
    if (exponent.starts_with('-') || exponent.starts_with('+')) exponent.remove_prefix(1);
    while (exponent.size() > 1 && exponent.starts_with('0')) exponent.remove_prefix(1);
    for (const char c : exponent) out += kDigits[c - '0'];
}

}  // namespace

std::string number_text(double value, NumberFormat format) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < 0 ? "-inf" : format.sign ? "+inf" : "inf";
    std::string text = digits_of(value, format);
    if (shows_zero(text)) {
        if (text.starts_with('-')) text.erase(0, 1);
    } else if (format.sign && value > 0) {
        text.insert(0, "+");
    }
    if (format.style == NumberStyle::percent) text += " %";
    return text;
}

std::string typeset_number(double value, NumberFormat format) {
    std::string text = number_text(value, format), out;
    if (std::isnan(value)) return text;
    std::string_view rest = text;
    if (rest.starts_with('-')) {
        out += "−";
        rest.remove_prefix(1);
    }
    if (rest.ends_with("inf")) {
        return out + (rest.starts_with('+') ? "+∞" : "∞");
    }
    const auto exponent = rest.find('e');
    out += rest.substr(0, exponent);
    if (exponent != rest.npos) {
        out += "×10";
        append_superscript(out, rest.substr(exponent + 1));
    }
    return out;
}

std::string exact_number(double value) {
    if (std::isnan(value)) return "nan";  // never "-nan": a sign there means nothing
    return fmt::format("{}", value);
}

}  // namespace verdigris
