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
    /// What of each row takes the noise of the last frame back; the rest is change that goes on.
    Eigen::RowVectorXd level;
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
///      (Matern 3/2: a drift that bends smoothly), or rho^lag cos(2 pi lag / period) (one that
///      swings to and fro), or the time from the start of a walk to the earlier of two (a drift
///      that itself walks at random)
///   A  how they slow down: e^(-kappa ahead), or 1 / sqrt(age)
///   T  white noise of the frames, whose differences are 2 on the diagonal and -1 beside it
/// and, in variants of each, one step (an increment of any size, or two where it falls within the
/// time of a frame) or one outlying frame. V is fitted. Building costs O(models q^3), once; `trend`
/// O(models q^3): 0.4 ms at q = 9.
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
        Eigen::RowVectorXd level;     ///< see Trend
        Eigen::VectorXd unexplained;  ///< variance of the change to come that they leave, V = 1
        /// Per event and size of it: what it takes away of the precision, in a product
        /// precision * share * precision, on the two increments that it touches: of this symmetric
        /// matrix the first, twice the second and the last value.
        Eigen::Matrix3Xd shares;
        double least_log_determinant = 0, most_log_prior = 0;  ///< of it and its variants
    };
    /// Something that happens to increments a and b = a + 1 (of one increment alone: a) besides
    /// what the model says.
    struct Event {
        int a = 0, b = 0;
        Eigen::Matrix2d shape;  ///< its covariance there, of size 1
        double prior = 0;
        int frame = 0;  ///< see Trend
        bool outlier = false;
    };
    void add_events();
    /// A matrix's columns that an event touches.
    static Eigen::MatrixX2d touched(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                                    const Event& event);
    Eigen::Ref<const Eigen::MatrixXd> precision(std::size_t model) const;
    /// Of all models, the diagonal of precision * gram * precision and what is next to it:
    /// [increments x 2 models].
    Eigen::MatrixXd seen(const Eigen::MatrixXd& gram) const;
    /// Of a model: it alone, and with each event at each size.
    std::size_t variants() const;
    /// Of all variants of all models, the log of the evidence that `squares` (of the increments, by
    /// each one's precision) is; of those that are out of the question, no one's.
    struct Evidence {
        Eigen::ArrayXd share;           ///< of the total, in the place of `squares`
        std::vector<bool> conceivable;  ///< models
    };
    Evidence evidence(Eigen::ArrayXd squares, double count) const;
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
