// SPDX-License-Identifier: MIT
// One window: the materials of the forecasts and of the truth, from one recipe.
#pragma once

#include <string_view>

#include "verdigris/color/pixel_types.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/material/material.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Where the normalizer s of Eq. (2) comes from.
enum class CoverageScale {
    /// The true frame 2 n units ahead, or at the furthest horizon judged if that is nearer: one for
    /// a window, all its horizons and all forecasters, in which no forecast has a say.
    truth,
    /// Each frame its own, as Eq. (2) reads by itself: any change above the dead-zone is stretched
    /// to full patina. chosen by nobody; for comparing with numbers that were made so.
    frame,
};
std::string_view to_string(CoverageScale scale);  ///< "truth", "frame"

class WindowMaterials {
  public:
    /// Clean state: the median of the context, as the paper. The specimen alone is metal, where the
    /// observation knows it. `window` must outlive this; `furthest` is the last unit judged.
    WindowMaterials(const ScoredWindow& window, int furthest, CoverageScale scale);

    /// The maps of a frame `horizon` units ahead. For any number of threads at once.
    Material material(const Image<SrgbF>& frame, double horizon) const;
    const Image<SrgbF>& canvas() const { return recipe_.canvas; }
    const MaterialRecipe& recipe() const { return recipe_; }

  private:
    MaterialRecipe recipe_of(const Image<SrgbF>& frame, double horizon) const;

    Context context_;
    CoverageScale scale_;
    MaterialRecipe recipe_;
};

/// How a frame has moved, over `where`: against the last observed frame and against the truth.
struct FrameMotion {
    double error = 0;      ///< mean over pixels and channels of (frame - truth)^2
    double moved = 0;      ///< mean of |frame - last|
    double agreement = 0;  ///< cosine between frame - last and truth - last; NaN if one is still
    double outside_pixels = 0;    ///< share with a channel outside [0, 1]
    double outside_channels = 0;  ///< share of channels outside [0, 1]
};
FrameMotion frame_motion(const Image<SrgbF>& frame, const Image<SrgbF>& truth,
                         const Image<SrgbF>& last, Rect where);

/// The forecast without any clamp: of a trajectory what its law says, of a stack its frames.
Image<SrgbF> unclamped(const Forecast& forecast, double horizon);

}  // namespace verdigris
