// SPDX-License-Identifier: MIT
#include "verdigris/observe/drift_correction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "verdigris/color/convert.h"
#include "verdigris/error.h"
#include "verdigris/observe/noise.h"
#include "verdigris/observe/with_samples.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr std::size_t kMostPixels = 1u << 18;  // chosen: their mean is known to sigma / 500
constexpr int kSamplesAtOnce = 16;             // chosen: keeps the cores busy, holds 16 images
constexpr double kDark = 0.01;                 // chosen: below, a gain is a division by nothing

/// The region's values of one sample: channel by channel.
using Gathered = std::array<std::vector<float>, 3>;

std::vector<std::size_t> indices_inside(const Mask& mask, std::size_t most) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask.pixels()[i] == kInside) all.push_back(i);
    }
    if (all.size() <= most) return all;
    std::vector<std::size_t> some(most);
    for (std::size_t k = 0; k < most; ++k) some[k] = all[k * all.size() / most];
    return some;
}

Gathered gather(const Image<SrgbF>& image, const std::vector<std::size_t>& where) {
    Gathered out;
    for (auto& channel : out) channel.reserve(where.size());
    for (const std::size_t i : where) {
        const SrgbF c = image.pixels()[i];
        out[0].push_back(c.r);
        out[1].push_back(c.g);
        out[2].push_back(c.b);
    }
    return out;
}

double trimmed_mean(std::vector<float> values, double trim) {
    const auto drop = std::ptrdiff_t(trim * double(values.size()));
    const auto first = values.begin() + drop, last = values.end() - drop;
    if (drop > 0) {
        std::nth_element(values.begin(), first, values.end());
        std::nth_element(first, last - 1, values.end());
    }
    double sum = 0;
    for (auto v = first; v != last; ++v) sum += double(*v);
    return sum / double(last - first);
}

ChannelValues mean_inside(const Image<SrgbF>& image, const Mask& mask) {
    ChannelValues sum{};
    double count = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        if (mask.pixels()[i] != kInside) continue;
        const SrgbF c = image.pixels()[i];
        sum = {sum[0] + double(c.r), sum[1] + double(c.g), sum[2] + double(c.b)};
        ++count;
    }
    for (double& s : sum) s /= std::max(count, 1.0);
    return sum;
}

/// Spatial standard deviation of the mean of `frames`.
ChannelValues spread_of(const std::vector<const Gathered*>& frames) {
    ChannelValues out{};
    const double n = double(frames.size());
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t pixels = (*frames[0])[c].size();
        const double shift = double((*frames[0])[c][0]);  // near the mean: nothing cancels
        double sum = 0, square = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
            double v = 0;
            for (const Gathered* f : frames) v += double((*f)[c][i]);
            v = v / n - shift;
            sum += v;
            square += v * v;
        }
        const double mean = sum / double(pixels);
        out[c] = std::sqrt(std::max(square / double(pixels) - mean * mean, 0.0));
    }
    return out;
}

std::vector<ChannelValues> smoothed(const std::vector<ChannelValues>& values, int window) {
    const int n = int(values.size());
    std::vector<ChannelValues> out(values.size());
    for (int t = 0; t < n; ++t) {
        const int half = std::min({window / 2, t, n - 1 - t});
        ChannelValues sum{};
        for (int i = t - half; i <= t + half; ++i) {
            for (std::size_t c = 0; c < 3; ++c) sum[c] += values[std::size_t(i)][c];
        }
        for (std::size_t c = 0; c < 3; ++c) out[std::size_t(t)][c] = sum[c] / (2 * half + 1);
    }
    return out;
}

double movement(const std::vector<ChannelValues>& smooth) {
    double most = 0;
    for (const ChannelValues& v : smooth) {
        double sum = 0;
        for (std::size_t c = 0; c < 3; ++c) sum += std::fabs(v[c] - smooth[0][c]) / 3;
        most = std::max(most, sum);
    }
    return most;
}

double luma_of(const ChannelValues& v) {
    return double(kLumaR) * v[0] + double(kLumaG) * v[1] + double(kLumaB) * v[2];
}

std::optional<double> correlation(const std::vector<ChannelValues>& a,
                                  const std::vector<ChannelValues>& b) {
    double ma = 0, mb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ma += luma_of(a[i]) / double(a.size());
        mb += luma_of(b[i]) / double(a.size());
    }
    double aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = luma_of(a[i]) - ma, y = luma_of(b[i]) - mb;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    // chosen: variations of 1e-6 of the range are rounding, and rounding correlates with nothing.
    const double least = 1e-12 * double(a.size());
    if (aa < least || bb < least) return std::nullopt;
    return ab / std::sqrt(aa * bb);
}

void check(const SampleStore& samples, const Mask& specimen, const ReferenceRegion& region,
           const DriftSeriesOptions& options) {
    if (!region.found()) throw Error(ErrorCode::usage, "drift needs a reference region");
    for (const Mask* mask : {&specimen, &region.mask}) {
        if (!mask->same_size(samples.width(), samples.height())) {
            throw Error(ErrorCode::usage, "the masks and the samples differ in size");
        }
    }
    if (!(options.trim >= 0 && options.trim < 0.5)) {
        throw Error(ErrorCode::usage, "the trimmed share must be 0 or more and below 0.5");
    }
    if (options.spread_over < 1 || options.spread_over % 2 == 0 || options.smoothing < 1 ||
        options.smoothing % 2 == 0) {
        throw Error(ErrorCode::usage, "smoothing takes an odd number of samples, 1 or more");
    }
}

class CorrectedStore final : public SampleStore {
  public:
    CorrectedStore(std::shared_ptr<const SampleStore> samples, std::vector<ChannelMap> maps)
        : samples_(std::move(samples)), maps_(std::move(maps)) {}
    int count() const override { return samples_->count(); }
    int width() const override { return samples_->width(); }
    int height() const override { return samples_->height(); }
    Image<SrgbF> image(int index) const override {
        Image<SrgbF> image = samples_->image(index);
        const ChannelMap& m = maps_[std::size_t(index)];
        for (SrgbF& p : image.pixels()) {
            p = {float(m.gain[0] * double(p.r) + m.offset[0]),
                 float(m.gain[1] * double(p.g) + m.offset[1]),
                 float(m.gain[2] * double(p.b) + m.offset[2])};
        }
        return image;
    }

  private:
    std::shared_ptr<const SampleStore> samples_;
    std::vector<ChannelMap> maps_;
};

}  // namespace

DriftSeries measure_drift_series(const SampleStore& samples, const Mask& specimen,
                                 const ReferenceRegion& region, const DriftSeriesOptions& options,
                                 const Progress& progress) {
    check(samples, specimen, region, options);
    const int n = samples.count(), half = options.spread_over / 2;
    const std::vector<std::size_t> where = indices_inside(region.mask, kMostPixels);
    DriftSeries series;
    for (auto* values : {&series.reference, &series.spread, &series.specimen}) {
        values->resize(std::size_t(n));
    }
    std::vector<Gathered> held(static_cast<std::size_t>(n));  // emptied behind the spread's window
    int next_spread = 0;
    for (int begin = 0; begin < n; begin += kSamplesAtOnce) {
        report(progress, "drift", begin, n);
        const int end = std::min(begin + kSamplesAtOnce, n);
        parallel_for(end - begin, [&](int k) {
            const auto t = std::size_t(begin) + std::size_t(k);
            const Image<SrgbF> image = samples.image(begin + k);
            held[t] = gather(image, where);
            for (std::size_t c = 0; c < 3; ++c) {
                series.reference[t][c] = trimmed_mean(held[t][c], options.trim);
            }
            series.specimen[t] = mean_inside(image, specimen);
        });
        // At the ends the window is shifted inside, not shrunk: a single sample would show its
        // noise as contrast.
        for (; next_spread < n; ++next_spread) {
            const int last = std::min(std::max(next_spread + half, 2 * half), n - 1);
            if (last >= end) break;
            std::vector<const Gathered*> frames;
            for (int i = std::max(last - 2 * half, 0); i <= last; ++i) {
                frames.push_back(&held[std::size_t(i)]);
            }
            series.spread[std::size_t(next_spread)] = spread_of(frames);
            const int done = next_spread - 2 * half - 1;
            if (done >= 0) held[std::size_t(done)] = {};
        }
    }
    report(progress, "drift", n, n);
    series.smooth_reference = smoothed(series.reference, options.smoothing);
    series.smooth_spread = smoothed(series.spread, options.smoothing);
    series.smooth_specimen = smoothed(series.specimen, options.smoothing);
    series.reference_movement = movement(series.smooth_reference);
    series.specimen_movement = movement(series.smooth_specimen);
    if (series.reference_movement > 0) {
        series.ratio = series.specimen_movement / series.reference_movement;
    }
    series.luma_correlation = correlation(series.reference, series.specimen);
    series.smooth_luma_correlation = correlation(series.smooth_reference, series.smooth_specimen);
    return series;
}

std::string to_string(DriftCorrection correction) {
    switch (correction) {
        case DriftCorrection::gain:
            return "gain";
        case DriftCorrection::offset:
            return "offset";
        case DriftCorrection::both:
            return "both";
    }
    return "unknown";
}

std::vector<ChannelMap> correction_maps(const DriftSeries& series, DriftCorrection correction,
                                        double sigma) {
    std::vector<ChannelMap> maps(series.smooth_reference.size());
    for (std::size_t t = 0; t < maps.size(); ++t) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double start = series.smooth_reference[0][c], now = series.smooth_reference[t][c];
            double& gain = maps[t].gain[c];
            double& offset = maps[t].offset[c];
            if (correction == DriftCorrection::gain) {
                gain = std::max(start, kDark) / std::max(now, kDark);
            } else if (correction == DriftCorrection::offset) {
                offset = start - now;
            } else {
                const double s0 = series.smooth_spread[0][c], s = series.smooth_spread[t][c];
                const double contrast = s0 * s0, noise = 9 * sigma * sigma;
                const double trust = contrast > 0 ? contrast / (contrast + noise) : 0;
                gain = s > 0 ? 1 + (s0 / s - 1) * trust : 1;
                offset = start - gain * now;
            }
        }
    }
    return maps;
}

std::shared_ptr<const SampleStore> corrected_samples(std::shared_ptr<const SampleStore> samples,
                                                     std::vector<ChannelMap> maps) {
    if (!samples || int(maps.size()) != samples->count()) {
        throw Error(ErrorCode::usage, "a correction needs one map per sample");
    }
    return std::make_shared<CorrectedStore>(std::move(samples), std::move(maps));
}

Observation corrected_observation(const Observation& observation, const DriftSeries& series,
                                  DriftCorrection correction) {
    Observation out = with_samples(
        observation,
        corrected_samples(observation.store,
                          correction_maps(series, correction, observation.noise.sigma)));
    NoiseMeter meter(out.width(), out.height());
    if (!out.specimen.empty()) meter.only_inside(out.specimen.clone());
    for (int i = 0; i < out.store->count(); ++i) meter.add(i, out.store->image(i));
    const auto sigma = meter.sigma(out.specimen);
    const auto tau = out.noise.tau_given ? std::optional(out.noise.tau) : std::nullopt;
    if (sigma) out.noise = noise_from(*sigma, tau);
    return out;
}

}  // namespace verdigris
