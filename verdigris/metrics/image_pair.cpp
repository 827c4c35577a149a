// SPDX-License-Identifier: MIT
#include "verdigris/metrics/image_pair.h"

#include <fmt/format.h>

#include "verdigris/error.h"

namespace verdigris {

void check_pair(ImageView<const SrgbF> reference, ImageView<const SrgbF> test) {
    if (reference.width() != test.width() || reference.height() != test.height()) {
        throw Error(
            ErrorCode::bad_input,
            fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared",
                        reference.width(), reference.height(), test.width(), test.height()));
    }
    if (reference.empty()) throw Error(ErrorCode::bad_input, "pictures without pixels");
}

}  // namespace verdigris
