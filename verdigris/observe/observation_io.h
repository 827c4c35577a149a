// SPDX-License-Identifier: MIT
// An Observation on disk: observation.json, samples.npy, specimen.png, clipped.png.
// samples.npy holds uint16: of shape (T, H, W, 3) encoded sRGB, or, of video at its own size, of
// shape (T, N) the planes of each sample as coded ("stored_as" in observation.json says how;
// docs/models/observe.md has the arithmetic). That is half the size, and no color is made of
// samples that nobody looks at.
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
