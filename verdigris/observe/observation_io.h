// SPDX-License-Identifier: MIT
// An Observation on disk: observation.json, samples.npy (T, H, W, 3; uint16 encoded sRGB),
// specimen.png, clipped.png.
#pragma once

#include <filesystem>

#include "verdigris/observe/observe.h"

namespace verdigris {

/// Writes everything but samples.npy, which observe() wrote when ObserveOptions::store named
/// `folder`/samples.npy; otherwise it is copied. observation.json goes last. Throws Error{failed}.
void write_observation(const Observation& observation, const std::filesystem::path& folder);

/// Throws Error{bad_input} naming the file: missing, truncated, inconsistent sizes, a format of a
/// newer version.
Observation read_observation(const std::filesystem::path& folder);

}  // namespace verdigris
