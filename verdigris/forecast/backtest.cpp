// SPDX-License-Identifier: MIT
#include "verdigris/forecast/backtest.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "verdigris/forecast/affine_fit.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/guards.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: the family has at most 24 parameters; 65,536 pixels fix them to far better than the
// frames' own jitter, and a back-test of a 4K context takes seconds less. 256 x 256 is exact.
constexpr std::int64_t kBacktestPixels = 65536;
constexpr int kFlatWidth = 256;
constexpr int kMinTrained = 3;    // chosen: two points always lie on a line
constexpr int kMinForOrder2 = 8;  // chosen: the first origin then fits 3 coefficients to 4 frames
// chosen: a gain below 2 % of the error cannot be seen and is within what the choice of pixels
// does to it. Of the error above the noise, that is: both forecasts carry the noise of the last
// frame and of the frame they are judged on, 2 sigma^2, and no forecast can gain on that. Where
// nothing is above the noise, 5 % of the whole error stands in, so that the bar is never zero.
// tuned: twice its standard error over the origins, on the real copper and clay frames, where one
// standard error let noise through (docs/models/forecast.md).
constexpr double kMinGain = 0.02, kMinStandardErrors = 2, kMinExcess = 0.05;
constexpr double kCreditMargin = 1.25;  // chosen: the noise itself is known to about 10 %

/// The context with its pixels gathered into a plain rectangle: the affine family knows no place,
/// so their order does not matter.
struct FlatContext {
    std::vector<Image<SrgbF>> frames;
    Mask fit, moving;
    double sigma = 0;
};

FlatContext flatten(const Context& context, FitPixels pixels) {
    const Mask usable = fit_mask(context, FitPixels::all);
    const Mask fit = fit_mask(context, pixels), moving = moving_mask(context);
    const auto indices = sample_inside(usable, kBacktestPixels);
    const int height = int((std::int64_t(indices.size()) + kFlatWidth - 1) / kFlatWidth);
    FlatContext flat;
    flat.sigma = context.sigma;
    flat.fit = Mask(kFlatWidth, height);
    flat.moving = Mask(kFlatWidth, height);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        flat.fit.pixels()[i] = fit.pixels()[indices[i]];
        flat.moving.pixels()[i] = moving.pixels()[indices[i]];
    }
    for (const Image<SrgbF>& frame : context.frames) {
        Image<SrgbF> gathered(kFlatWidth, height);
        for (std::size_t i = 0; i < indices.size(); ++i) {
            gathered.pixels()[i] = frame.pixels()[indices[i]];
        }
        flat.frames.push_back(std::move(gathered));
    }
    return flat;
}

double mean_squared_error(const Image<SrgbF>& a, const Image<SrgbF>& b, const Mask& where) {
    double sum = 0;
    std::int64_t count = 0;
    const auto p = a.pixels(), q = b.pixels();
    const auto inside = where.pixels();
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (inside[i] == 0) continue;
        const double r = double(p[i].r) - double(q[i].r), g = double(p[i].g) - double(q[i].g),
                     b2 = double(p[i].b) - double(q[i].b);
        sum += r * r + g * g + b2 * b2;
        ++count;
    }
    return count == 0 ? 0 : sum / double(3 * count);
}

/// How much lower the error gets because the drift happens to shrink the noise of the last frame:
/// sigma^2 (1 - |I + phi S|_F^2 / 3), never negative. That is not foresight and earns nothing.
double noise_credit(const AffineFit& fit, const TimeLaw& law, double lead, double sigma) {
    double norm = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double entry = (r == c ? 1.0 : 0.0) + law.phi(lead) * fit.linear.S[r][c] +
                                 law.phi2(lead) * fit.quadratic.S[r][c];
            norm += entry * entry;
        }
    }
    return std::max(0.0, kCreditMargin * sigma * sigma * (1 - norm / 3));
}

/// Of one origin: weighted errors over the leads behind it.
struct OriginScore {
    double weight = 0, error = 0, held = 0, credit = 0;  // sums of weight * value
};

/// `affine` fitted on the first m frames and judged on the rest (empty: persistence).
OriginScore score_origin(const FlatContext& flat, int m, const AffineOptions* affine,
                         double sigma) {
    const std::span<const Image<SrgbF>> frames(flat.frames);
    const Image<SrgbF>& last = flat.frames[std::size_t(m - 1)];
    AffineFit fit;
    Trajectory trajectory;
    if (affine != nullptr) {
        fit = fit_frames(frames.first(std::size_t(m)), flat.fit, flat.sigma, *affine);
        trajectory = affine_trajectory(fit, last, flat.moving, m, *affine);
    }
    OriginScore score;
    Image<SrgbF> predicted;
    for (int target = m; target < int(flat.frames.size()); ++target) {
        // Weight = lead. The user asks for horizons far beyond the context, so long leads must
        // speak loudest, but few origins reach them: with this weight a lead k of at most L has
        // k (L + 1 - k) in all, so the rare long leads are not drowned by the many short ones.
        const double lead = target - m + 1;
        const Image<SrgbF>& truth = flat.frames[std::size_t(target)];
        const double held = mean_squared_error(last, truth, flat.moving);
        double error = held, credit = 0;
        if (affine != nullptr) {
            evaluate_trajectory(trajectory, lead, predicted);
            error = mean_squared_error(predicted, truth, flat.moving);
            credit = noise_credit(fit, trajectory.law, lead, sigma);
        }
        score.weight += lead;
        score.error += lead * error;
        score.held += lead * held;
        score.credit += lead * credit;
    }
    return score;
}

BacktestTrial judge(const std::vector<OriginScore>& scores, int frames_predicted, double sigma) {
    BacktestTrial trial;
    double weight = 0, error = 0, held = 0, net = 0;
    for (const OriginScore& s : scores) {
        weight += s.weight;
        error += s.error;
        held += s.held;
        net += s.held - s.error - s.credit;
    }
    trial.row.mean_squared_error = error / weight;
    trial.row.gain_over_persistence = held > 0 ? 1 - error / held : 0;
    trial.row.frames_predicted = frames_predicted;
    trial.improvement = net / weight;
    double spread = 0;
    for (const OriginScore& s : scores) {
        const double off = s.held - s.error - s.credit - s.weight * trial.improvement;
        spread += off * off;
    }
    const double count = double(scores.size());
    trial.standard_error = std::sqrt(spread * count / std::max(count - 1, 1.0)) / weight;
    const double reducible =
        std::max(held / weight - 2 * sigma * sigma, kMinExcess * held / weight);
    trial.beats_persistence = trial.improvement > kMinGain * reducible &&
                              trial.improvement > kMinStandardErrors * trial.standard_error;
    return trial;
}

std::vector<AffineOptions> candidates(int n, const ChooseOptions& options) {
    std::vector<AffineOptions> list;
    for (int order = 1; order <= (n >= kMinForOrder2 ? 2 : 1); ++order) {
        for (AffineFamily family :
             {AffineFamily::full, AffineFamily::per_channel, AffineFamily::single_gain}) {
            list.push_back({family, order, options.ridge_k, options.pixels, options.clamp});
        }
    }
    return list;
}

}  // namespace

std::vector<BacktestTrial> run_backtest(const Context& context, const ChooseOptions& options) {
    check_context(context);
    const int n = context.length();
    if (n < kMinContext) return {};
    const FlatContext flat = flatten(context, options.pixels);
    if (count_inside(flat.moving) == 0) return {};
    const double sigma = context_noise(flat.frames, flat.moving, context.sigma);
    const int first = std::max(kMinTrained, n / 2);

    const std::vector<AffineOptions> affine = candidates(n, options);
    std::vector<BacktestTrial> trials(affine.size() + 1);
    parallel_for(int(trials.size()), [&](int i) {
        const AffineOptions* options_of = i == 0 ? nullptr : &affine[std::size_t(i - 1)];
        std::vector<OriginScore> scores;
        for (int m = first; m < n; ++m) {
            scores.push_back(score_origin(flat, m, options_of, sigma));
        }
        BacktestTrial& trial = trials[std::size_t(i)];
        trial = judge(scores, n - first, sigma);
        trial.row.forecaster = options_of ? affine_name(*options_of) : "persistence";
        if (options_of) trial.affine = *options_of;
    });
    return trials;
}

std::vector<BacktestRow> backtest(const Context& context, const ChooseOptions& options) {
    std::vector<BacktestRow> rows;
    for (const BacktestTrial& trial : run_backtest(context, options)) rows.push_back(trial.row);
    return rows;
}

}  // namespace verdigris
