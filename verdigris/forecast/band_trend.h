// SPDX-License-Identifier: MIT
// bandtrend: the change of the specimen, split by how far it reaches in space, each part carried on
// as the context says that it moves. Nothing is trained and nothing is to be set.
// Model: docs/models/bandtrend.md
#pragma once

#include "verdigris/forecast/band_trend_design.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

struct BandTrendOptions {
    bool clamp = true;    ///< see Trajectory::clamp
    bool explain = true;  ///< also tries itself on the end of the context; about as much work again
    BandTrendDesign design = {};
};

/// A forecaster for contexts of two frames and more; of one frame it holds still. Frames are
/// brought under the light of the last one, judged by the backdrop. Then their increments are
/// split: a global drift affine in color, what remains of it under Gaussians from a sixteenth of
/// the side down to one pixel, and the rest. Each part is forecast by an average of Gaussian models
/// of its increments (trend_models.h), weighted by how well they explain what was seen; noise
/// shrinks to nothing, steps and outlying frames are set aside. Of contexts over 40 frames the last
/// 40 count. O(pixels * frames * log side); memory linear in pixels * frames.
Forecaster band_trend(const BandTrendOptions& options = {});

}  // namespace verdigris
