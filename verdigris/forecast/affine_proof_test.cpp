// SPDX-License-Identifier: MIT
// The one-solve fit against the paper's words: fit a transform to every frame, fit a polynomial to
// every entry of the sequence, extrapolate it. Both must agree to rounding.
#include <gtest/gtest.h>

#include <numeric>

#include "verdigris/forecast/slope_moments.h"
#include "verdigris/forecast/testing.h"

namespace verdigris {
namespace {

using Column = std::vector<double>;
using Transform = std::array<std::array<double, 4>, 3>;  // [A | b]

double dot(const Column& a, const Column& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// min |sum_j p_j columns_j - target|: orthogonalization of the explicit design matrix (twice, so
/// that it is orthogonal to rounding), no normal equations.
std::vector<double> least_squares(std::vector<Column> columns, Column target) {
    const std::size_t m = columns.size();
    std::vector<std::vector<double>> r(m, std::vector<double>(m));
    std::vector<double> q_target(m);
    for (std::size_t j = 0; j < m; ++j) {
        for (int pass = 0; pass < 2; ++pass) {
            for (std::size_t i = 0; i < j; ++i) {
                const double along = dot(columns[i], columns[j]);
                r[i][j] += along;
                for (std::size_t k = 0; k < target.size(); ++k) {
                    columns[j][k] -= along * columns[i][k];
                }
            }
        }
        r[j][j] = std::sqrt(dot(columns[j], columns[j]));
        for (double& v : columns[j]) v /= r[j][j];
        q_target[j] = dot(columns[j], target);
        for (std::size_t k = 0; k < target.size(); ++k) target[k] -= q_target[j] * columns[j][k];
    }
    std::vector<double> p(m);
    for (std::size_t j = m; j-- > 0;) {
        p[j] = q_target[j];
        for (std::size_t i = j + 1; i < m; ++i) p[j] -= r[j][i] * p[i];
        p[j] /= r[j][j];
    }
    return p;
}

std::array<Column, 3> pixels_of(const Image<SrgbF>& image, const Mask& where) {
    std::array<Column, 3> channels;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        if (where.pixels()[i] == 0) continue;
        const SrgbF c = image.pixels()[i];
        channels[0].push_back(double(c.r));
        channels[1].push_back(double(c.g));
        channels[2].push_back(double(c.b));
    }
    return channels;
}

Column joined(const std::array<Column, 3>& channels) {
    Column all;
    for (const Column& c : channels) all.insert(all.end(), c.begin(), c.end());
    return all;
}

/// x -> y by least squares.
Transform fit_transform(const std::array<Column, 3>& x, const std::array<Column, 3>& y,
                        AffineFamily family) {
    Transform t{};
    const Column one(x[0].size(), 1.0), ones(3 * x[0].size(), 1.0);
    if (family == AffineFamily::single_gain) {
        const auto p = least_squares({ones, joined(x)}, joined(y));
        for (std::size_t c = 0; c < 3; ++c) t[c][c] = p[1], t[c][3] = p[0];
        return t;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        if (family == AffineFamily::full) {
            const auto p = least_squares({one, x[0], x[1], x[2]}, y[c]);
            t[c] = {p[1], p[2], p[3], p[0]};
        } else {
            const auto p = least_squares({one, x[c]}, y[c]);
            t[c][c] = p[1], t[c][3] = p[0];
        }
    }
    return t;
}

std::vector<Column> powers(int n, int order) {
    std::vector<Column> columns;
    for (int k = 0; k <= order; ++k) {
        Column c;
        for (int i = 0; i < n; ++i) c.push_back(std::pow(i, k));
        columns.push_back(c);
    }
    return columns;
}

/// Coefficients of t^1 and t^2 of the polynomial fitted to every entry of T_0 .. T_{n-1}.
std::array<Transform, 2> slopes_of_sequence(const Context& context, AffineFamily family, int order,
                                            const Mask& where) {
    const auto x0 = pixels_of(context.frames[0], where);
    std::vector<Transform> sequence;
    for (const auto& frame : context.frames) {
        sequence.push_back(fit_transform(x0, pixels_of(frame, where), family));
    }
    std::array<Transform, 2> out{};
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
            Column entry;
            for (const Transform& t : sequence) entry.push_back(t[r][c]);
            const auto p = least_squares(powers(context.length(), order), entry);
            for (int k = 1; k <= order; ++k) out[std::size_t(k - 1)][r][c] = p[std::size_t(k)];
        }
    }
    return out;
}

double distance(const AffineDrift& drift, const Transform& t) {
    double largest = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            largest = std::max(largest, std::abs(drift.S[r][c] - t[r][c]));
        }
        largest = std::max(largest, std::abs(drift.s[r] - t[r][3]));
    }
    return largest;
}

class AffineProof : public testing::TestWithParam<std::tuple<AffineFamily, int, int>> {};

TEST_P(AffineProof, OneSolveEqualsTheSequenceOfTransforms) {
    const auto [family, order, n] = GetParam();
    Context context = drifting(n, planted_drift(), 0.01, 11, 45, 33);
    context.clipped = Mask(45, 33);
    for (int i = 0; i < 40; ++i) context.clipped(i, (i * 7) % 33) = kInside;
    Mask usable(45, 33);
    for (std::size_t i = 0; i < usable.pixel_count(); ++i) {
        usable.pixels()[i] = context.clipped.pixels()[i] ? 0 : kInside;
    }
    AffineOptions options;
    options.family = family;
    options.order = order;
    options.ridge_k = 0;
    const AffineFit fit = fit_affine(context, options);
    const auto slopes = slopes_of_sequence(context, family, order, usable);
    EXPECT_LT(distance(fit.linear, slopes[0]), 1e-10);
    EXPECT_LT(distance(fit.quadratic, slopes[1]), 1e-10);
    EXPECT_GT(distance({}, slopes[0]), 1e-3);  // there is something to agree on
    if (order == 2) {
        EXPECT_GT(distance({}, slopes[1]), 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(All, AffineProof,
                         testing::Combine(testing::Values(AffineFamily::full,
                                                          AffineFamily::per_channel,
                                                          AffineFamily::single_gain),
                                          testing::Values(1, 2), testing::Values(3, 5, 10)));

TEST(PolynomialWeights, AreTheRowsOfThePseudoInverse) {
    for (int n : {3, 5, 10, 31}) {
        for (int order : {1, 2}) {
            for (int i = 0; i < n;
                 ++i) {  // column i of the pseudo-inverse: the fit to a unit vector
                Column unit(std::size_t(n), 0.0);
                unit[std::size_t(i)] = 1;
                const auto p = least_squares(powers(n, order), unit);
                for (int power = 1; power <= order; ++power) {
                    EXPECT_NEAR(polynomial_weights(n, order, power)[std::size_t(i)],
                                p[std::size_t(power)], 1e-12);
                }
            }
        }
    }
    EXPECT_NEAR(polynomial_weights(5, 1, 1)[0], -0.2, 1e-15);  // w_0 of the dilution argument
}

}  // namespace
}  // namespace verdigris
