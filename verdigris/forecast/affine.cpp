// SPDX-License-Identifier: MIT
#include "verdigris/forecast/affine.h"

#include <fmt/format.h>

#include <algorithm>

#include "verdigris/error.h"
#include "verdigris/forecast/affine_fit.h"
#include "verdigris/forecast/cholesky3.h"
#include "verdigris/forecast/context_noise.h"
#include "verdigris/forecast/context_pixels.h"
#include "verdigris/forecast/slope_moments.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

// chosen: a covariance this flat in some direction carries no color contrast a frame could show
// (a relative standard deviation of 1e-6); the lift below is of the order of float rounding.
constexpr double kMinRcond = 1e-12, kLift = 1e-9;

/// S = cov_vx (cov_x + lambda I)^-1.
Matrix3 solve_full(const SlopeMoments& m, double lambda) {
    Matrix3 a = m.cov_x;
    double trace = 0;
    for (std::size_t c = 0; c < 3; ++c) trace += a[c][c] += lambda;
    if (!(trace > 0)) return {};  // one flat color: only its mean drift is defined
    Cholesky3 factor(a);
    if (factor.rcond() < kMinRcond) {
        for (std::size_t c = 0; c < 3; ++c) a[c][c] += kLift * trace / 3;
        factor = Cholesky3(a);
    }
    Matrix3 out;
    for (std::size_t r = 0; r < 3; ++r) out[r] = factor.solve(m.cov_vx[r]);  // cov_x is symmetric
    return out;
}

Matrix3 solve_per_channel(const SlopeMoments& m, double lambda) {
    Matrix3 out{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double variance = m.cov_x[c][c] + lambda;
        out[c][c] = variance > 0 ? m.cov_vx[c][c] / variance : 0;
    }
    return out;
}

/// One gain and one bias over pixels and channels pooled together.
AffineDrift solve_single(const SlopeMoments& m, double lambda) {
    double x = 0, v = 0, xx = 0, vx = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        x += m.mean_x[c] / 3;
        v += m.mean_v[c] / 3;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        xx += (m.cov_x[c][c] + (m.mean_x[c] - x) * (m.mean_x[c] - x)) / 3;
        vx += (m.cov_vx[c][c] + (m.mean_v[c] - v) * (m.mean_x[c] - x)) / 3;
    }
    const double gain = xx + lambda > 0 ? vx / (xx + lambda) : 0;
    AffineDrift drift;
    for (std::size_t c = 0; c < 3; ++c) {
        drift.S[c][c] = gain;
        drift.s[c] = v - gain * x;
    }
    return drift;
}

AffineDrift solve(const SlopeMoments& m, double lambda, AffineFamily family) {
    if (family == AffineFamily::single_gain) return solve_single(m, lambda);
    AffineDrift drift;
    drift.S = family == AffineFamily::full ? solve_full(m, lambda) : solve_per_channel(m, lambda);
    for (std::size_t r = 0; r < 3; ++r) {
        drift.s[r] = m.mean_v[r];
        for (std::size_t c = 0; c < 3; ++c) drift.s[r] -= drift.S[r][c] * m.mean_x[c];
    }
    return drift;
}

SrgbF drift_of(const AffineDrift& d, SrgbF x) {
    const auto channel = [&](std::size_t c) {
        return float(d.S[c][0] * double(x.r) + d.S[c][1] * double(x.g) + d.S[c][2] * double(x.b) +
                     d.s[c]);
    };
    return {channel(0), channel(1), channel(2)};
}

Image<SrgbF> drift_image(const AffineDrift& drift, const Image<SrgbF>& last, const Mask& moving) {
    Image<SrgbF> out = Image<SrgbF>::for_overwrite(last.width(), last.height());
    parallel_rows(last.height(), std::max(1, 32768 / last.width()), [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < last.width(); ++x) {
                const SrgbF rate = drift_of(drift, last(x, y));
                out(x, y) = moving(x, y) ? rate : SrgbF{};
            }
        }
    });
    return out;
}

void check_options(const AffineOptions& options) {
    if (options.order < 0 || options.order > 2) {
        throw Error(ErrorCode::usage, "the order of affinergb is 0, 1 or 2");
    }
    if (!(options.ridge_k >= 0)) throw Error(ErrorCode::usage, "the ridge must be 0 or more");
}

}  // namespace

std::string to_string(AffineFamily family) {
    switch (family) {
        case AffineFamily::full:
            return "full";
        case AffineFamily::per_channel:
            return "per-channel";
        case AffineFamily::single_gain:
            return "single-gain";
    }
    return "unknown";
}

std::string affine_name(const AffineOptions& options) {
    return fmt::format("affinergb {} order {}", to_string(options.family), options.order);
}

AffineFit fit_frames(std::span<const Image<SrgbF>> frames, const Mask& where, double noise,
                     const AffineOptions& options) {
    AffineFit fit;
    const int n = int(frames.size());
    fit.pixels = count_inside(where);
    if (n < 2 || fit.pixels == 0 || options.order == 0) return fit;
    fit.sigma = context_noise(frames, where, noise);
    fit.lambda = options.ridge_k * fit.sigma * fit.sigma;
    const int order = std::min(options.order, n - 1);  // n points carry no higher polynomial
    fit.linear = solve(slope_moments(frames, where, polynomial_weights(n, order, 1)), fit.lambda,
                       options.family);
    if (order == 2) {
        fit.quadratic = solve(slope_moments(frames, where, polynomial_weights(n, order, 2)),
                              fit.lambda, options.family);
    }
    return fit;
}

AffineFit fit_affine(const Context& context, const AffineOptions& options) {
    check_context(context);
    check_options(options);
    return fit_frames(context.frames, fit_mask(context, options.pixels), context.sigma, options);
}

Trajectory affine_trajectory(const AffineFit& fit, const Image<SrgbF>& last, const Mask& moving,
                             int context_length, const AffineOptions& options) {
    Trajectory trajectory;
    trajectory.base = last.clone();
    trajectory.law = {options.order, context_length};
    trajectory.clamp = options.clamp;
    trajectory.rate = drift_image(fit.linear, last, moving);
    if (options.order == 2) trajectory.curvature = drift_image(fit.quadratic, last, moving);
    return trajectory;
}

Forecaster affinergb(const AffineOptions& options) {
    check_options(options);
    return {affine_name(options), [options](const Context& context) {
                const AffineFit fit = fit_affine(context, options);
                Forecast forecast;
                forecast.forecaster = affine_name(options);
                forecast.explanation = fmt::format(
                    "One color drift for the whole specimen ({}, order {}), fitted to the last "
                    "{} observed frames and continued.",
                    to_string(options.family), options.order, context.length());
                forecast.trajectory = affine_trajectory(
                    fit, context.frames.back(), moving_mask(context), context.length(), options);
                forecast.context_length = context.length();
                return forecast;
            }};
}

}  // namespace verdigris
