// SPDX-License-Identifier: MIT
#include "verdigris/deliver/viewer_page.h"

namespace verdigris {

std::string_view viewer_page() {
    return {};
}

}  // namespace verdigris
