// SPDX-License-Identifier: MIT
#include "verdigris/deliver/viewer.h"

#include <cstddef>

#include "verdigris/deliver/viewer_page.h"
#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"

namespace verdigris {

std::string filled_viewer_page(std::string_view page, std::string_view json) {
    // Where docs/VIEWER_DATA.md puts the document.
    constexpr std::string_view kToken = "@@VERDIGRIS_DATA@@";
    const std::size_t at = page.find(kToken);
    if (at == std::string_view::npos || page.find(kToken, at + 1) != std::string_view::npos) {
        throw Error(ErrorCode::failed,
                    "the built-in viewer page does not hold its data token exactly once; rebuild "
                    "apps/viewer");
    }
    std::string filled;
    filled.reserve(page.size() + json.size());
    filled += page.substr(0, at);
    filled += json;
    filled += page.substr(at + kToken.size());
    return filled;
}

bool viewer_is_built_in() {
    return !viewer_page().empty();
}

void write_viewer(const Delivery& delivery, const std::filesystem::path& file,
                  const Progress& progress) {
    if (!viewer_is_built_in()) {
        throw Error(ErrorCode::failed,
                    "this build has no viewer: build with VERDIGRIS_BUILD_VIEWER=ON, which needs "
                    "node and npm",
                    file.string());
    }
    write_file(file, filled_viewer_page(viewer_page(), viewer_json(delivery, progress)));
}

}  // namespace verdigris
