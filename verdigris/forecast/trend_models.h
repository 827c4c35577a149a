// SPDX-License-Identifier: MIT
// How a component of the change went on from frame to frame, and how it will: a grid of Gaussian
// models of its increments, averaged by what the context says of each (internal).
// Model: docs/models/bandtrend.md
#pragma once

#include <Eigen/Core>
#include <vector>

#include "verdigris/forecast/band_trend_design.h"
#include "verdigris/forecast/trend_moments.h"

namespace verdigris {

/// One model of many: how likely it is, and the V that goes with it.
struct LikelyKind {
    TrendKind kind;
    double probability = 0;
    double variance = 0;  ///< in the unit of `gram`, widened by what is not known of it
};

/// What a component does next, as a combination of its increments.
struct Trend {
    /// [kTrendUnits x increments]: the change from the last frame on.
    Eigen::MatrixXd weights;
    /// Per kTrendUnits, in the unit of `gram`: mean square of that change, and of what the frame
    /// then will differ from it, its own noise included.
    Eigen::VectorXd change, error;
    double event = 0;      ///< probability of a step or an outlier among the frames
    int event_frame = 0;   ///< of the likeliest: the first frame after a step, or the outlier
    bool outlier = false;  ///< which of the two it is
    std::vector<LikelyKind> likely;  ///< those of at least a thousandth, events counted in
};

/// For a number of increments (frames - 1), which is all that the grid depends on. Increments
/// d_1 .. d_q of one component are Gaussian with covariance V (A K A + eta T):
///   K  how they hang together: rho^lag (a drift that wanders), or (1 + a lag) e^(-a lag)
///      (Matern 3/2: a drift that bends smoothly)
///   A  how they slow down: e^(-kappa age)
///   T  white noise of the frames, whose differences are 2 on the diagonal and -1 beside it
/// and, in variants of each, one step (an increment of any size) or one outlying frame. V is
/// fitted. Building costs O(models q^3), once; `trend` O(models q^3): 0.3 ms at q = 9.
class TrendModels {
  public:
    /// `increments`: at least 1.
    explicit TrendModels(int increments, const TrendPrior& prior = {});
    int increments() const { return increments_; }

    /// `gram`: mean over pixels and channels of d_i d_j. `count`: how many independent pixels
    /// stand behind it; the evidence of each model counts that many times.
    Trend trend(const Eigen::MatrixXd& gram, double count) const;

  private:
    struct Model {
        TrendKind kind;
        Eigen::MatrixXd weights;      ///< [kTrendUnits x increments]
        Eigen::VectorXd unexplained;  ///< variance of the change to come that they leave, V = 1
        Eigen::VectorXd of_events;    ///< event' * precision * event
    };
    /// What happens to an increment: to it alone (a step before `frame`), or to it what is taken
    /// back from the one before (`frame` is an outlier).
    struct Event {
        int increment = 0, frame = 0;
        bool outlier = false;
    };
    /// A matrix, of as many columns as there are increments, times an event.
    static Eigen::VectorXd along(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                                 const Event& event);
    Eigen::Ref<const Eigen::MatrixXd> precision(std::size_t model) const;
    /// Of all models, event' * precision * gram * precision * event: [events x models].
    Eigen::MatrixXd seen_by_events(const Eigen::MatrixXd& gram) const;
    /// Of a model: it alone, and with each event at each size.
    std::size_t variants() const;
    void add(const TrendKind& kind, const TrendMoments& moments, double prior);

    int increments_ = 0;
    TrendPrior prior_;
    std::vector<Event> events_;
    std::vector<Model> models_;
    Eigen::MatrixXd precisions_;  ///< of the increments at V = 1, model beside model
    // Of all models in turn: of it alone, then of it with each event at each size.
    Eigen::ArrayXd log_determinants_, log_priors_;
};

}  // namespace verdigris
