// SPDX-License-Identifier: MIT
// Used inside this room only.
#pragma once

namespace verdigris {

/// OpenEXR compresses on its own threads and has none unless asked. An application that has set
/// its own number keeps it. The bytes do not depend on it.
void exr_use_all_cores();

}  // namespace verdigris
