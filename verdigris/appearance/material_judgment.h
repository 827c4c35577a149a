// SPDX-License-Identifier: MIT
// The paper's Table 3: forecasts judged by how their materials look beside the true ones, rendered
// on the same shape under the same light.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verdigris/appearance/material_view.h"
#include "verdigris/appearance/window_materials.h"
#include "verdigris/evaluate/bootstrap.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/metrics/flip.h"

namespace verdigris {

struct MaterialJudgeOptions {
    std::vector<int> horizons{5, 10, 20, 50};  ///< units, increasing from 1 on; the paper's
    ViewOptions view;
    CoverageScale scale = CoverageScale::truth;
    double pixels_per_degree = kFlipPixelsPerDegree;
    /// The whole frame, its backdrop too (no metal); else the largest rectangle of specimen.
    bool whole = false;
    /// LPIPS of truth and forecast, called from one thread; empty: there is none, and `no_lpips`
    /// says why.
    std::function<double(const Image<SrgbF>& truth, const Image<SrgbF>& test)> lpips;
    std::string no_lpips;
};

/// Means over the picture, or over the shown part of the frame; one row per window, one column per
/// horizon of the options.
struct MaterialScores {
    std::string name;
    bool trained = false;
    ErrorTable flip;           ///< mean LDR-FLIP of the two pictures
    ErrorTable ssim, delta_e;  ///< of the two pictures: SSIM, mean CIEDE2000
    ErrorTable lpips;          ///< empty where there is none
    ErrorTable error;          ///< MSE of the frames, encoded sRGB
    ErrorTable moved;          ///< mean |frame - last observed|
    ErrorTable agreement;      ///< cosine of forecast and true movement; may be NaN
    /// Of the forecast before any clamp: pixels with a channel outside [0, 1], and channels.
    ErrorTable outside_pixels, outside_channels;
};

/// What to look at: one window.
struct ExampleFrame {
    Image<SrgbU8> picture;
    Image<float> change;  ///< per pixel, mean |frame - last observed| of the channels
};
struct ExampleRow {
    std::string name;
    ExampleFrame frame;     ///< of the forecast, clamped as it is written
    Image<SrgbU8> picture;  ///< of the material
    Image<float> flip;
    double mean = 0;  ///< of `flip`
};
struct MaterialExample {
    int start = 0, horizon = 0;
    Image<SrgbU8> last;  ///< the last observed frame
    ExampleFrame true_frame;
    Image<SrgbU8> truth;           ///< the picture of its material
    std::vector<ExampleRow> rows;  ///< in the order of MaterialDirection::rows
};

struct MaterialDirection {
    std::string held_out, label;
    std::vector<int> starts;  ///< of the scored windows
    Rect shown;               ///< of the frame
    /// kControls of them: "persistence", which is the static control; "canvas", the median of the
    /// context, which is the static control as the paper words it; "true-finish", no forecast but
    /// the color of the last frame on the true frame's other maps: how much of the control's FLIP
    /// is its color. Then the entrants.
    static constexpr std::size_t kControls = 3;
    std::vector<MaterialScores> rows;
    ErrorTable truth_moved;  ///< mean |truth - last observed|
    /// FLIP of two pictures of one material whose rays differ: more than what noise adds here.
    double noise_flip = 0;
    /// One per horizon: of the last scored window that starts in the first half, or the first.
    std::vector<MaterialExample> examples;

    const MaterialScores& control() const { return rows.front(); }
};

struct MaterialJudgment {
    MaterialJudgeOptions options;
    Evaluation evaluation;  ///< of the same windows: record, notes
    std::vector<MaterialDirection> directions;
};

/// `base` with windows that reach to the furthest horizon; what trained forecasters learn from is
/// left as it is in `base`.
EvaluationProtocol material_protocol(const EvaluationProtocol& base,
                                     const std::vector<int>& horizons);

/// Every window serves all horizons, so that they can be compared. `base` as for evaluate(), which
/// does the rest: holding out, refusing copies, recording. Same bytes at any thread count. Memory:
/// as evaluate(), and the pictures of one window. Cost: a picture per window, horizon and
/// forecaster that moves. Progress stages: those of evaluate(), and "render". Throws as evaluate();
/// Error{usage}: options; Error{bad_input} naming a recording in which the furthest horizon leaves
/// no window.
MaterialJudgment judge_materials(const EvaluationProtocol& base,
                                 std::span<const Observation> observations,
                                 const std::vector<Entrant>& entrants,
                                 const MaterialJudgeOptions& options = {},
                                 const Progress& progress = {});

/// FLIP of the static control less FLIP of `row`, over the control's, at one horizon (an index):
/// what bootstrap() takes. Blocks of one window's span at this horizon, not at the furthest.
WindowRatios flip_ratios(const MaterialDirection& direction, const MaterialScores& row,
                         std::size_t horizon);
BootstrapOptions flip_bootstrap(const MaterialJudgment& judgment, std::size_t horizon);

}  // namespace verdigris
