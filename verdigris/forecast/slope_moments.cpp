// SPDX-License-Identifier: MIT
#include "verdigris/forecast/slope_moments.h"

#include <algorithm>

#include "verdigris/pixels/parallel_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/forecast/slope_moments.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "hwy/highway.h"

#ifndef VERDIGRIS_SLOPE_SUMS_ONCE
#define VERDIGRIS_SLOPE_SUMS_ONCE
namespace verdigris {
namespace {
/// Plain sums of shifted values. The shift (one pixel of the image) takes the place of the mean,
/// so that nothing large is subtracted at the end.
struct SlopeSums {
    double count = 0;
    double x[3]{}, v[3]{};
    double xx[6]{};  // rr rg rb gg gb bb
    double vx[9]{};
};
}  // namespace
}  // namespace verdigris
#endif

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Adds one row. `rows` are the n frames' rows, `inside` is 1 or 0 per pixel.
void add_row(const float* const* rows, const double* weights, std::size_t n, const double* inside,
             std::size_t width, const double* shift_x, const double* shift_v, SlopeSums& sums) {
    const hn::ScalableTag<double> d;
    const hn::Rebind<float, decltype(d)> df;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    V count = hn::Zero(d);
    V sx[3], sv[3], sxx[6], svx[9];
    for (V& s : sx) s = hn::Zero(d);
    for (V& s : sv) s = hn::Zero(d);
    for (V& s : sxx) s = hn::Zero(d);
    for (V& s : svx) s = hn::Zero(d);
    std::size_t i = 0;
    for (; i + lanes <= width; i += lanes) {
        const V w = hn::LoadU(d, inside + i);
        hn::Vec<decltype(df)> r, g, b;
        hn::LoadInterleaved3(df, rows[0] + 3 * i, r, g, b);
        const V x[3] = {hn::PromoteTo(d, r), hn::PromoteTo(d, g), hn::PromoteTo(d, b)};
        const V w0 = hn::Set(d, weights[0]);
        V v[3] = {hn::Mul(w0, x[0]), hn::Mul(w0, x[1]), hn::Mul(w0, x[2])};
        for (std::size_t k = 1; k < n; ++k) {
            hn::LoadInterleaved3(df, rows[k] + 3 * i, r, g, b);
            const V wk = hn::Set(d, weights[k]);
            v[0] = hn::MulAdd(wk, hn::PromoteTo(d, r), v[0]);
            v[1] = hn::MulAdd(wk, hn::PromoteTo(d, g), v[1]);
            v[2] = hn::MulAdd(wk, hn::PromoteTo(d, b), v[2]);
        }
        count = hn::Add(count, w);
        V dx[3], wx[3];
        for (int c = 0; c < 3; ++c) {
            dx[c] = hn::Sub(x[c], hn::Set(d, shift_x[c]));
            wx[c] = hn::Mul(w, dx[c]);
            sx[c] = hn::Add(sx[c], wx[c]);
        }
        for (int a = 0, k = 0; a < 3; ++a) {
            for (int c = a; c < 3; ++c, ++k) sxx[k] = hn::MulAdd(wx[a], dx[c], sxx[k]);
        }
        for (int a = 0; a < 3; ++a) {
            const V dv = hn::Sub(v[a], hn::Set(d, shift_v[a]));
            sv[a] = hn::MulAdd(w, dv, sv[a]);
            for (int c = 0; c < 3; ++c) svx[3 * a + c] = hn::MulAdd(dv, wx[c], svx[3 * a + c]);
        }
    }
    const auto total = [d](V s) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, s)); };
    sums.count += total(count);
    for (int c = 0; c < 3; ++c) sums.x[c] += total(sx[c]), sums.v[c] += total(sv[c]);
    for (int k = 0; k < 6; ++k) sums.xx[k] += total(sxx[k]);
    for (int k = 0; k < 9; ++k) sums.vx[k] += total(svx[k]);

    for (; i < width; ++i) {  // the end of the row, in plain double
        const double w = inside[i];
        double dx[3], dv[3];
        for (std::size_t c = 0; c < 3; ++c) {
            double v = 0;
            for (std::size_t k = 0; k < n; ++k) v += weights[k] * double(rows[k][3 * i + c]);
            dx[c] = double(rows[0][3 * i + c]) - shift_x[c];
            dv[c] = v - shift_v[c];
            sums.x[c] += w * dx[c];
            sums.v[c] += w * dv[c];
        }
        sums.count += w;
        for (int a = 0, k = 0; a < 3; ++a) {
            for (int c = a; c < 3; ++c, ++k) sums.xx[k] += w * dx[a] * dx[c];
            for (int c = 0; c < 3; ++c) sums.vx[3 * a + c] += w * dv[a] * dx[c];
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {

HWY_EXPORT(add_row);

constexpr int kRowsPerRun = 64;  // chosen: ~50 us at 128 pixels of width

std::vector<const float*> frame_rows(std::span<const Image<SrgbF>> frames, int y) {
    std::vector<const float*> rows;
    rows.reserve(frames.size());
    for (const Image<SrgbF>& f : frames) rows.push_back(reinterpret_cast<const float*>(f.row(y)));
    return rows;
}

void add(SlopeSums& to, const SlopeSums& from) {
    to.count += from.count;
    for (int c = 0; c < 3; ++c) to.x[c] += from.x[c], to.v[c] += from.v[c];
    for (int k = 0; k < 6; ++k) to.xx[k] += from.xx[k];
    for (int k = 0; k < 9; ++k) to.vx[k] += from.vx[k];
}

}  // namespace

SlopeMoments slope_moments(std::span<const Image<SrgbF>> frames, const Mask& where,
                           std::span<const double> weights) {
    const int width = frames[0].width(), height = frames[0].height();
    SlopeMoments moments;
    const auto mask = where.pixels();
    const auto first =
        std::find_if(mask.begin(), mask.end(), [](std::uint8_t v) { return v != 0; });
    if (first == mask.end()) return moments;
    const auto at = std::size_t(first - mask.begin());
    const SrgbF reference = frames[0].pixels()[at];
    const double shift_x[3] = {reference.r, reference.g, reference.b};
    double shift_v[3]{};
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const SrgbF c = frames[k].pixels()[at];
        shift_v[0] += weights[k] * double(c.r);
        shift_v[1] += weights[k] * double(c.g);
        shift_v[2] += weights[k] * double(c.b);
    }

    const auto partials = map_rows<SlopeSums>(height, kRowsPerRun, [&](RowRun run) {
        SlopeSums sums;
        std::vector<double> inside(static_cast<std::size_t>(width));
        for (int y = run.begin; y < run.end; ++y) {
            const std::uint8_t* m = where.row(y);
            for (std::size_t x = 0; x < inside.size(); ++x) inside[x] = m[x] ? 1.0 : 0.0;
            const auto rows = frame_rows(frames, y);
            HWY_DYNAMIC_DISPATCH(add_row)
            (rows.data(), weights.data(), frames.size(), inside.data(), inside.size(), shift_x,
             shift_v, sums);
        }
        return sums;
    });
    SlopeSums sums;
    for (const SlopeSums& p : partials) add(sums, p);

    const double count = sums.count;
    moments.pixels = count;
    for (std::size_t a = 0, k = 0; a < 3; ++a) {
        moments.mean_x[a] = shift_x[a] + sums.x[a] / count;
        moments.mean_v[a] = shift_v[a] + sums.v[a] / count;
        for (std::size_t c = a; c < 3; ++c, ++k) {
            const double value = sums.xx[k] / count - sums.x[a] / count * (sums.x[c] / count);
            moments.cov_x[a][c] = moments.cov_x[c][a] = value;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            moments.cov_vx[a][c] =
                sums.vx[3 * a + c] / count - sums.v[a] / count * (sums.x[c] / count);
        }
    }
    return moments;
}

std::vector<double> polynomial_weights(int n, int order, int power) {
    // With u = t - (n-1)/2 the powers are orthogonal in pairs; at order 2,
    // c2 = sum (u^2 - m2) x / sum (u^2 - m2)^2, slope at the center b = sum u x / sum u^2, and
    // expanding c2 u^2 + b u around t = 0 gives c1 = b - c2 (n - 1).
    const double center = (n - 1) / 2.0;
    double s2 = 0;
    for (int t = 0; t < n; ++t) s2 += (t - center) * (t - center);
    std::vector<double> linear, square(std::size_t(n), 0.0);
    for (int t = 0; t < n; ++t) linear.push_back(n > 1 ? (t - center) / s2 : 0.0);
    if (order < 2) return power == 1 ? linear : square;
    double s4 = 0;
    for (int t = 0; t < n; ++t) {
        square[std::size_t(t)] = (t - center) * (t - center) - s2 / n;
        s4 += square[std::size_t(t)] * square[std::size_t(t)];
    }
    for (double& w : square) w /= s4;
    if (power == 2) return square;
    for (std::size_t t = 0; t < linear.size(); ++t) linear[t] -= square[t] * (n - 1);
    return linear;
}

}  // namespace verdigris
#endif  // HWY_ONCE
