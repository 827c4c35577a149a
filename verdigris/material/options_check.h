// SPDX-License-Identifier: MIT
// Which material options make sense (internal).
#pragma once

#include "verdigris/material/material.h"

namespace verdigris {

/// Throws Error{usage} naming the option.
void check_options(const MaterialOptions& options);

}  // namespace verdigris
