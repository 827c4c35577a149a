// SPDX-License-Identifier: MIT
// The Gaussian models of a trend: how the increments of a component hang together with each other
// and with the change to come (internal).
// Model: docs/models/bandtrend.md
#pragma once

#include <Eigen/Core>
#include <array>

namespace verdigris {

/// Units ahead for which a trend is worked out: linear in between, held beyond. chosen: dense where
/// forecasts are judged.
inline constexpr std::array kTrendUnits{1.,  2.,  3.,  4.,  5.,  6.,  7.,  8.,  9.,  10.,
                                        12., 15., 20., 25., 30., 40., 50., 65., 85., 100.};

enum class TrendShape {
    drift,  ///< a change that goes on
    walk,   ///< a level that walks at random
    level,  ///< one level, and noise
};

/// One model.
struct TrendKind {
    TrendShape shape{};
    bool bending = false;  ///< Matern 3/2; else an autoregression
    double rho = 0;        ///< how neighboring increments hang together
    double kappa = 0;      ///< slows down by e^-kappa per unit
    double eta = 0;        ///< variance of the white noise of frames, of V
    double period = 0;     ///< swings to and fro, in units; 0: does not
    /// Units for which a drift has walked at random by the last frame, from nothing; 0: it does
    /// not, and rho tells how it hangs together.
    double walked = 0;
    /// Units for which a layer has grown through itself by the last frame: it slows down as the
    /// square root of its age; 0: it does not.
    double age = 0;
    // Of a change of two parts, each of which keeps to a law of its own:
    double second_share = 0;  ///< of V
    double second_kappa = 0;
};

/// At V = 1, for q increments.
struct TrendMoments {
    Eigen::MatrixXd covariance;   ///< [q x q] of the increments
    Eigen::MatrixXd with_future;  ///< [kTrendUnits x q] of the change to come with them
    Eigen::VectorXd future;       ///< [kTrendUnits] its own; the noise of both ends is in it
};

/// How large a drift of this kappa and age is, `ahead` units after the last frame (less than 0:
/// before), of what it is at the last. What speeds up, with a kappa below 0, does so for a few
/// units only.
double drift_size(const TrendKind& kind, double ahead);

/// A drift without noise: the same for every eta.
struct DriftMoments {
    Eigen::MatrixXd drift, future;  ///< as in TrendMoments, without noise
    Eigen::VectorXd ahead;
};
/// Of the first part alone, at V = 1. `doubt`: see TrendPrior.
DriftMoments part_moments(const TrendKind& kind, int q, double doubt);
/// Of both parts together.
DriftMoments together(const DriftMoments& first, const DriftMoments& second, double second_share);
/// The second part of a kind, as a kind of one part.
TrendKind second_part(const TrendKind& kind);
DriftMoments drift_moments(const TrendKind& kind, int q, double doubt);
TrendMoments with_noise(const DriftMoments& drift, double eta);
TrendMoments walk_moments(int q);
/// `eta` 1 is the model; with less, of frames with less noise.
TrendMoments level_moments(int q, double eta = 1);

}  // namespace verdigris
