// SPDX-License-Identifier: MIT
// Stage 2. What the specimen will look like, at any horizon, and which guards fired.
// Path: observe -> [forecast] -> material.   Model: docs/models/forecast.md
//
// Works on encoded sRGB: the paper never linearizes. Horizons are accelerated units from the last
// observed frame; they are never calendar time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/forecast/spread.h"
#include "verdigris/observe/observe.h"
#include "verdigris/pixels/image.h"
#include "verdigris/status.h"

namespace verdigris {

/// What a forecaster sees: n frames one unit apart, oldest first, and where to look.
struct Context {
    std::vector<Image<SrgbF>> frames;  ///< all of one size
    Mask specimen;                     ///< empty: every pixel
    Mask clipped;                      ///< empty: none. Never steers a fit, never moves
    Mask backdrop;                     ///< empty: unknown. What changes here is the light
    double sigma = 0;                  ///< noise of one frame, per channel
    double tau = 0;                    ///< dead-zone on the channel mean of |difference|

    int length() const { return int(frames.size()); }
};

/// The last `length` unit steps of an observation (all there are, if fewer).
Context context_from(const Observation& observation, int length);
/// What an observation shows that is not its specimen. Empty without a specimen.
Mask backdrop_of(const Observation& observation);

/// Values of a law that is no polynomial.
struct LawNode {
    double horizon = 0, phi = 0, phi2 = 0;
    bool operator==(const LawNode&) const = default;
};

/// The scalar part of a trajectory: phi(h) and phi2(h), with phi(0) = phi2(0) = 0.
/// order 0: both 0. order 1: phi = h. order 2: also phi2 = (n-1+h)^2 - (n-1)^2; but with nodes,
/// whose horizons increase from above 0, both are linear from 0 to and between them and held
/// beyond.
struct TimeLaw {
    int order = 1;
    int context = 0;               ///< n
    std::vector<LawNode> nodes{};  ///< only at order 2
    bool tabulated() const { return !nodes.empty(); }
    double phi(double horizon) const;
    double phi2(double horizon) const;
};

/// A closed-form forecast: frame(h) = base + phi(h) rate (+ phi2(h) curvature). Any horizon is one
/// fused multiply-add per pixel; a GPU scrubs it from the same three images.
struct Trajectory {
    Image<SrgbF> base;       ///< the last observed frame, in [0, 1]
    Image<SrgbF> rate;       ///< per unit; 0 where nothing is forecast (backdrop, glint)
    Image<SrgbF> curvature;  ///< empty unless law.order == 2
    TimeLaw law;
    /// Freeze each pixel's drift at the first horizon where any channel would leave [0, 1]: the
    /// paper's suggested fix, hue-preserving. A law with nodes is instead shortened towards the
    /// base until it is inside. Off: values may leave the range.
    bool clamp = true;
};

/// frame(h) into `out` (resized if needed). Cost: reads 2 (3) images, writes 1; SIMD, rows in
/// parallel.
void evaluate_trajectory(const Trajectory& trajectory, double horizon, Image<SrgbF>& out);

/// Share of `where` pixels (empty: all) with any channel outside [0 - tolerance, 1 + tolerance]
/// in the unclamped frame(h).
double out_of_gamut_share(const Trajectory& trajectory, double horizon, const Mask& where,
                          double tolerance = 0);

/// A network's answer: frames at increasing whole or fractional horizons, linearly interpolated.
struct FrameStack {
    std::vector<double> horizons;
    std::vector<Image<SrgbF>> frames;
    Image<SrgbF> base;  ///< at horizon 0
};

/// The result of stage 2.
struct Forecast {
    std::string forecaster;   ///< "persistence", "affinergb full order 1", ...
    std::string explanation;  ///< which evidence decided, in a sentence
    Trajectory trajectory;    ///< used unless `stack` has frames
    FrameStack stack;
    Spread spread;  ///< how far off it may be; of few forecasters
    int context_length = 0;
    Statuses guards;  ///< those that hold at every horizon

    bool is_trajectory() const { return stack.frames.empty(); }
    /// The forecast frame; horizon >= 0. at(0) is the last observed frame, exactly.
    Image<SrgbF> at(double horizon) const;
};

/// The seam: a name and a function. Persistence, the affine family and the networks are all one.
struct Forecaster {
    std::string name;
    std::function<Forecast(const Context&)> forecast;
};

/// It stays as it is.
Forecaster persistence();

}  // namespace verdigris
