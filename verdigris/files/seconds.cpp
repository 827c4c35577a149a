// SPDX-License-Identifier: MIT
// Points in time from text: ISO 8601 as people write it, EXIF, or a plain number.
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "verdigris/error.h"
#include "verdigris/files/csv.h"

namespace verdigris {
namespace {

class Cursor {
  public:
    explicit Cursor(std::string_view text) : rest_(text) {}

    bool done() const { return rest_.empty(); }
    char peek() const { return rest_.empty() ? '\0' : rest_[0]; }
    bool accept(char c) {
        if (peek() != c) return false;
        rest_.remove_prefix(1);
        return true;
    }
    /// Exactly `digits` digits.
    std::optional<int> number(int digits) {
        int value = 0;
        for (int i = 0; i < digits; ++i) {
            const char c = peek();
            if (c < '0' || c > '9') return std::nullopt;
            value = value * 10 + (c - '0');
            rest_.remove_prefix(1);
        }
        return value;
    }
    /// ".5" or ",5", zero if there is none.
    std::optional<double> fraction() {
        if (peek() != '.' && peek() != ',') return 0;
        rest_.remove_prefix(1);
        double value = 0, place = 1;
        int digits = 0;
        for (; peek() >= '0' && peek() <= '9'; ++digits) {
            value = value * 10 + (peek() - '0');
            place *= 10;
            rest_.remove_prefix(1);
            // More digits than a double holds change nothing, and must not overflow.
            if (digits > 15) value = value / 10, place /= 10;
        }
        if (digits == 0) return std::nullopt;
        return value / place;
    }

  private:
    std::string_view rest_;
};

std::optional<double> plain_number(std::string_view text) {
    if (!text.empty() && text[0] == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

// Days since 1970-01-01 in the proleptic Gregorian calendar; nothing for the 30th of February.
std::optional<double> days(Cursor& at) {
    const auto year = at.number(4);
    const char separator = at.peek();
    if (!year || (separator != '-' && separator != ':')) return std::nullopt;
    at.accept(separator);
    const auto month = at.number(2);
    if (!month || !at.accept(separator)) return std::nullopt;
    const auto day = at.number(2);
    if (!day) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(*year),
                                           std::chrono::month(unsigned(*month)),
                                           std::chrono::day(unsigned(*day))};
    if (!date.ok()) return std::nullopt;
    return double(std::chrono::sys_days(date).time_since_epoch().count());
}

// "12:00", "12:00:00.5". 60 is a leap second, which counts as the next second.
std::optional<double> time_of_day(Cursor& at) {
    const auto hour = at.number(2);
    if (!hour || *hour > 23 || !at.accept(':')) return std::nullopt;
    const auto minute = at.number(2);
    if (!minute || *minute > 59) return std::nullopt;
    double seconds = *hour * 3600.0 + *minute * 60.0;
    if (at.accept(':')) {
        const auto whole = at.number(2);
        if (!whole || *whole > 60) return std::nullopt;
        const auto part = at.fraction();
        if (!part) return std::nullopt;
        seconds += *whole + *part;
    }
    return seconds;
}

// Seconds that local time is ahead of UTC: "Z", "+02:00", "+0200", "+02", or nothing.
std::optional<double> zone(Cursor& at) {
    if (at.done() || at.accept('Z') || at.accept('z')) return 0;
    const bool behind = at.peek() == '-';
    if (!at.accept('+') && !at.accept('-')) return std::nullopt;
    const auto hours = at.number(2);
    int minutes = 0;
    const bool colon = at.accept(':');
    if (colon || !at.done()) {
        const auto m = at.number(2);
        if (!m) return std::nullopt;
        minutes = *m;
    }
    // 14 hours is the largest zone in use.
    if (!hours || *hours > 14 || minutes > 59) return std::nullopt;
    return (behind ? -1.0 : 1.0) * (*hours * 3600.0 + minutes * 60.0);
}

std::optional<double> point_in_time(std::string_view text) {
    Cursor at(text);
    const auto date = days(at);
    if (!date) return std::nullopt;
    double seconds = *date * 86400;
    if (at.done()) return seconds;
    if (!at.accept('T') && !at.accept('t') && !at.accept(' ')) return std::nullopt;
    const auto time = time_of_day(at);
    if (!time) return std::nullopt;
    at.accept(' ');  // "12:00:00 +02:00"
    const auto ahead = zone(at);
    if (!ahead || !at.done()) return std::nullopt;
    return seconds + *time - *ahead;
}

}  // namespace

double seconds_from_text(std::string_view text) {
    std::string_view trimmed = text;
    while (!trimmed.empty() && (trimmed.front() == ' ' || trimmed.front() == '\t')) {
        trimmed.remove_prefix(1);
    }
    while (!trimmed.empty() && (trimmed.back() == ' ' || trimmed.back() == '\t')) {
        trimmed.remove_suffix(1);
    }
    if (const auto number = plain_number(trimmed)) return *number;
    if (const auto seconds = point_in_time(trimmed)) return *seconds;
    // chosen: 60 characters show what was meant.
    throw Error(ErrorCode::bad_input, "'" + std::string(text.substr(0, 60)) +
                                          "' is neither a number of seconds nor a time such as "
                                          "2026-03-01T12:00:00+02:00");
}

}  // namespace verdigris
