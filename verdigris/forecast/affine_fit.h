// SPDX-License-Identifier: MIT
// The fit behind affinergb on any run of frames: back-tests fit prefixes of a context (internal).
#pragma once

#include <span>

#include "verdigris/forecast/affine.h"

namespace verdigris {

/// As fit_affine, on `frames` and the pixels inside `where`. `noise` is used for fewer than 4.
AffineFit fit_frames(std::span<const Image<SrgbF>> frames, const Mask& where, double noise,
                     const AffineOptions& options);

/// The fit applied to `last` inside `moving`, and at rest elsewhere.
Trajectory affine_trajectory(const AffineFit& fit, const Image<SrgbF>& last, const Mask& moving,
                             int context_length, const AffineOptions& options);

/// "affinergb full order 1".
std::string affine_name(const AffineOptions& options);

}  // namespace verdigris
