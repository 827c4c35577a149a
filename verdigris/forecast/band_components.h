// SPDX-License-Identifier: MIT
// The change of a context split into components, each with its trend (internal).
// Model: docs/models/bandtrend.md
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "verdigris/forecast/band_trend_design.h"
#include "verdigris/forecast/increments.h"
#include "verdigris/forecast/trend_models.h"

namespace verdigris {

inline constexpr int kTerms = 2;  ///< of a trajectory

/// A product of few laws over kTrendUnits with as many combinations of what `weights` combines.
struct FewTerms {
    Eigen::MatrixXd laws;   ///< [units x terms]
    Eigen::MatrixXd parts;  ///< [terms x columns of weights]
};
/// The closest in squared change, each horizon relative to its own size. `gram`: of what `weights`
/// combines.
FewTerms few_terms(const Eigen::MatrixXd& weights, const Eigen::MatrixXd& gram);

/// What is known of one component once its increments are forgotten. Squares are means over what
/// moves and channels.
struct Component {
    Eigen::MatrixXd laws;           ///< [units x terms]
    Eigen::MatrixXd gram;           ///< of its terms' images
    std::vector<ColorField> terms;  ///< three planes each
    Trend trend;
    Eigen::MatrixXd increments;  ///< mean products of its increments
    double count = 0;            ///< independent parts of it
    bool common = false;         ///< all of the specimen shares it
    bool light = false;          ///< it is light, or may be
    int held = 0;                ///< it stays as it is at this one of kTrendUnits
};

/// Grids of models, made once for each number of increments. For several threads at once.
class TrendModelsCache {
  public:
    explicit TrendModelsCache(const TrendPrior& prior = {}) : prior_(prior) {}
    const TrendModels& of(int increments);

  private:
    const TrendPrior prior_;
    std::mutex mutex_;
    std::map<int, std::unique_ptr<TrendModels>> made_;
};

/// What is thought possible of the parts of a change.
struct BandModels {
    explicit BandModels(const TrendPrior& prior);
    TrendModelsCache own;     ///< of what places have for themselves
    TrendModelsCache common;  ///< of what all of the specimen shares
    TrendModelsCache light;   ///< of light that the backdrop shows
};

struct Components {
    std::vector<Component> all;  ///< from what all share to what each pixel has
    /// Mean square of the channels of the global increments, and per value of all others.
    SrgbF global_energy{};
    Image<SrgbF> local_energy;
};

Components components_of(const Context& context, const Mask& moving, const BandTrendDesign& design,
                         BandModels& models);

}  // namespace verdigris
