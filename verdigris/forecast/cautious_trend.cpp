// SPDX-License-Identifier: MIT
#include "verdigris/forecast/cautious_trend.h"

#include <algorithm>

#include "verdigris/forecast/trend_outlook.h"

namespace verdigris {

void be_cautious(Trend& trend, const Eigen::MatrixXd& gram, double caution) {
    if (!(caution > 0)) return;
    const double noise = frame_noise(trend);
    for (Eigen::Index u = 0; u < trend.weights.rows(); ++u) {
        const Eigen::RowVectorXd goes_on = trend.weights.row(u) - trend.level;
        const double size = goes_on * gram * goes_on.transpose();
        if (!(size > 0)) continue;
        const double error = std::max(trend.error[u] - noise, 0.0);
        const double kept = size / (size + caution * error);
        trend.weights.row(u) = trend.level + kept * goes_on;
        trend.change[u] = trend.weights.row(u) * gram * trend.weights.row(u).transpose();
        trend.error[u] += (1 - kept) * (1 - kept) * size;
    }
}

}  // namespace verdigris
