// SPDX-License-Identifier: MIT
#include "verdigris/report/report_page.h"

#include <cstddef>

// Defined by report_page.s: the bytes of each page and the byte after the last.
extern "C" {
extern const char verdigris_report_page_begin[];
extern const char verdigris_report_page_end[];
extern const char verdigris_report_plain_begin[];
extern const char verdigris_report_plain_end[];
}

namespace verdigris {

std::string_view interactive_page() {
    return {verdigris_report_page_begin,
            std::size_t(verdigris_report_page_end - verdigris_report_page_begin)};
}

std::string_view plain_page() {
    return {verdigris_report_plain_begin,
            std::size_t(verdigris_report_plain_end - verdigris_report_plain_begin)};
}

}  // namespace verdigris
