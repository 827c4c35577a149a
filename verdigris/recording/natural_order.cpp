// SPDX-License-Identifier: MIT
#include "verdigris/recording/natural_order.h"

#include <cstddef>

namespace verdigris {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
unsigned char lower(char c) {
    return static_cast<unsigned char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

// Takes a run of digits off the front of `text`; leading zeros do not count.
std::string_view take_number(std::string_view& text) {
    std::size_t zeros = 0, end = 0;
    while (end < text.size() && is_digit(text[end])) ++end;
    while (zeros < end && text[zeros] == '0') ++zeros;
    const std::string_view number = text.substr(zeros, end - zeros);
    text.remove_prefix(end);
    return number;
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
    std::string_view x = a, y = b;
    while (!x.empty() && !y.empty()) {
        if (is_digit(x[0]) && is_digit(y[0])) {
            const std::string_view p = take_number(x), q = take_number(y);
            if (p.size() != q.size()) return p.size() < q.size();
            if (p != q) return p < q;
        } else {
            const unsigned char p = lower(x[0]), q = lower(y[0]);
            if (p != q) return p < q;
            x.remove_prefix(1);
            y.remove_prefix(1);
        }
    }
    if (x.empty() != y.empty()) return x.empty();
    return a < b;
}

}  // namespace verdigris
