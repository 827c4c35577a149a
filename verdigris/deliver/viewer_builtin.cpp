// SPDX-License-Identifier: MIT
#include <cstddef>

#include "verdigris/deliver/viewer_page.h"

// Defined by viewer_page.s: the bytes of viewer.html and the byte after the last.
extern "C" {
extern const char verdigris_viewer_page_begin[];
extern const char verdigris_viewer_page_end[];
}

namespace verdigris {

std::string_view viewer_page() {
    return {verdigris_viewer_page_begin,
            std::size_t(verdigris_viewer_page_end - verdigris_viewer_page_begin)};
}

}  // namespace verdigris
