// SPDX-License-Identifier: MIT
#include "verdigris/learn/susceptibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "verdigris/error.h"
#include "verdigris/evaluate/foreground.h"
#include "verdigris/evaluate/windows.h"
#include "verdigris/learn/network_parts.h"
#include "verdigris/learn/patinanet.h"
#include "verdigris/learn/tensor_image.h"

namespace verdigris {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kEndSamples = 20;  // [C] of docs/models/learn.md: two units at each end

Image<float> mean_of(const std::vector<Image<float>>& maps) {
    Image<float> mean(maps.front().width(), maps.front().height());
    for (const Image<float>& m : maps) {
        for (std::size_t i = 0; i < mean.pixel_count(); ++i)
            mean.pixels()[i] += m.pixels()[i] / float(maps.size());
    }
    return mean;
}

Image<SrgbF> median_of_samples(const SampleStore& store, int begin, int end) {
    std::vector<Image<SrgbF>> frames;
    for (int i = begin; i < end; ++i) frames.push_back(store.image(i));
    Image<SrgbF> median;
    std::vector<float> scratch;
    canvas_of(frames, median, scratch);
    return median;
}

Image<float> change_of(const SampleStore& store, SampleRange usable, int size) {
    const int ends = std::min(kEndSamples, usable.count() / 2);
    const Image<SrgbF> first = median_of_samples(store, usable.begin, usable.begin + ends);
    const Image<SrgbF> last = median_of_samples(store, usable.end - ends, usable.end);
    const torch::Tensor change = (tensor_of(last) - tensor_of(first)).abs().mean(0);
    return field_of(resized(change.unsqueeze(0).unsqueeze(0), size, size)[0][0]);
}

/// Nearest pixel: a mask has nothing in between.
Mask stretched(const Mask& mask, int size) {
    if (mask.empty() || mask.same_size(size, size)) return mask.clone();
    Mask out(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            out(x, y) = mask(x * mask.width() / size, y * mask.height() / size);
    return out;
}

Mask both(const Mask& a, const Mask& b) {
    if (a.empty()) return b.clone();
    if (b.empty()) return a.clone();
    Mask out(a.width(), a.height());
    for (std::size_t i = 0; i < out.pixel_count(); ++i)
        out.pixels()[i] = a.pixels()[i] != 0 && b.pixels()[i] != 0 ? kInside : 0;
    return out;
}

/// The jackknife's variance of a mean of which one of `units` can be left out.
double jackknife_variance(int units, const std::function<double(int)>& mean_without) {
    std::vector<double> left;
    double mean = 0;
    for (int u = 0; u < units; ++u) {
        left.push_back(mean_without(u));
        mean += left.back() / units;
    }
    double sum = 0;
    for (const double v : left) sum += (v - mean) * (v - mean);
    return sum * (units - 1) / units;
}

Correlation within_correlation(const std::vector<Image<float>>& maps, const Mask& where) {
    std::vector<std::vector<double>> r(maps.size(), std::vector<double>(maps.size()));
    for (std::size_t i = 0; i < maps.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) r[i][j] = pearson(maps[i], maps[j], where);
    return within_mean(r);
}

Correlation cross_correlation(const std::vector<Image<float>>& a,
                              const std::vector<Image<float>>& b, const Mask& where) {
    std::vector<std::vector<double>> r(a.size(), std::vector<double>(b.size()));
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) r[i][j] = pearson(a[i], b[j], where);
    return cross_mean(r);
}

Correlation change_correlation(const SusceptibilityMaps& maps, const Mask& where) {
    const int n = int(maps.rho.size());
    Correlation c{pearson(maps.mean, maps.change, where), kUnknown, n};
    if (n < 3) return c;
    c.error = std::sqrt(jackknife_variance(n, [&](int without) {
        std::vector<Image<float>> kept;
        for (int i = 0; i < n; ++i)
            if (i != without) kept.push_back(maps.rho[std::size_t(i)].clone());
        return pearson(mean_of(kept), maps.change, where);
    }));
    return c;
}

SusceptibilityMaps maps_of(PatinaNet& network, torch::Device device, const TrainingFacts& facts,
                           const EvaluationProtocol& protocol, const Observation& o, int size) {
    const WindowPlan plan = plan_windows(protocol, o.store->count(), o.source_name);
    SusceptibilityMaps maps;
    maps.recording = o.source_name;
    maps.source = std::ranges::any_of(facts.sources, [&](const LearnedSource& s) {
        return !s.source_sha256.empty() && s.source_sha256 == o.source_sha256;
    });
    maps.specimen = stretched(o.specimen, size);
    const int contexts = (protocol.context - 1) * protocol.stride;  // all that a map looks at
    for (int start = plan.usable.begin; start + contexts < plan.usable.end; start += plan.span)
        maps.starts.push_back(start);
    if (maps.starts.size() > std::size_t(plan.independent))
        maps.starts.resize(std::size_t(plan.independent));
    if (maps.starts.size() < 2) {
        throw Error(ErrorCode::bad_input,
                    "is too short for two windows that share no sample, so nothing can be compared "
                    "within it",
                    o.source_name);
    }
    const torch::NoGradGuard frozen;
    for (const int start : maps.starts) {
        std::vector<torch::Tensor> frames;
        for (int i = 0; i < protocol.context; ++i)
            frames.push_back(tensor_of(o.store->image(start + i * protocol.stride)));
        const auto encoded =
            network.encode(resized(torch::stack(frames), size, size).unsqueeze(0).to(device));
        maps.rho.push_back(field_of(encoded.susceptibility[0][0]));
    }
    maps.mean = mean_of(maps.rho);
    maps.change = change_of(*o.store, plan.usable, size);
    return maps;
}

}  // namespace

Correlation within_mean(const std::vector<std::vector<double>>& r) {
    const int n = int(r.size());
    const auto mean_without = [&](int without) {
        double sum = 0;
        int count = 0;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < i; ++j) {
                if (i == without || j == without) continue;
                sum += r[std::size_t(i)][std::size_t(j)];
                ++count;
            }
        }
        return sum / count;
    };
    Correlation c{mean_without(-1), kUnknown, n * (n - 1) / 2};
    if (n >= 3) c.error = std::sqrt(jackknife_variance(n, mean_without));
    return c;
}

Correlation cross_mean(const std::vector<std::vector<double>>& r) {
    const int n = int(r.size()), m = int(r.front().size());
    const auto mean_without = [&](int row, int column) {
        double sum = 0;
        int count = 0;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < m; ++j) {
                if (i == row || j == column) continue;
                sum += r[std::size_t(i)][std::size_t(j)];
                ++count;
            }
        }
        return sum / count;
    };
    Correlation c{mean_without(-1, -1), kUnknown, n * m};
    if (n >= 2 && m >= 2) {
        c.error = std::sqrt(jackknife_variance(n, [&](int u) { return mean_without(u, -1); }) +
                            jackknife_variance(m, [&](int u) { return mean_without(-1, u); }));
    }
    return c;
}

double pearson(const Image<float>& a, const Image<float>& b, const Mask& where) {
    double n = 0, sa = 0, sb = 0;
    const auto counts = [&](std::size_t i) { return where.empty() || where.pixels()[i] != 0; };
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        if (!counts(i)) continue;
        ++n, sa += double(a.pixels()[i]), sb += double(b.pixels()[i]);
    }
    if (n < 2) return 0;
    double aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        if (!counts(i)) continue;
        const double x = double(a.pixels()[i]) - sa / n, y = double(b.pixels()[i]) - sb / n;
        aa += x * x, bb += y * y, ab += x * y;
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

SusceptibilityAnalysis analyze_susceptibility(const Checkpoint& checkpoint,
                                              const EvaluationProtocol& protocol,
                                              std::span<const Observation> observations,
                                              const Progress& progress) {
    const NetworkConfig& config = checkpoint.network->config();
    auto* network = dynamic_cast<PatinaNet*>(checkpoint.network->parts().module.get());
    if (network == nullptr) {
        throw Error(ErrorCode::usage, fmt::format("{} has no susceptibility; only patinanet does",
                                                  to_string(config.kind)));
    }
    if (config.context != protocol.context) {
        throw Error(ErrorCode::usage,
                    fmt::format("the network was trained on contexts of {} frames; the protocol "
                                "has {}",
                                config.context, protocol.context));
    }
    if (checkpoint.facts.stride != protocol.stride) {
        throw Error(ErrorCode::usage,
                    fmt::format("the network was trained with {} samples per unit; the protocol "
                                "has {}",
                                checkpoint.facts.stride, protocol.stride));
    }
    SusceptibilityAnalysis analysis;
    for (std::size_t i = 0; i < observations.size(); ++i) {
        report(progress, "susceptibility", std::int64_t(i), std::int64_t(observations.size()));
        analysis.recordings.push_back(maps_of(*network, checkpoint.network->parts().device,
                                              checkpoint.facts, protocol, observations[i],
                                              config.size));
    }
    const std::vector<SusceptibilityMaps>& all = analysis.recordings;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const SusceptibilityMaps& maps = all[i];
        analysis.within.push_back(
            {maps.recording,
             {within_correlation(maps.rho, {}), within_correlation(maps.rho, maps.specimen)},
             {change_correlation(maps, {}), change_correlation(maps, maps.specimen)}});
        for (std::size_t j = 0; j < i; ++j) {
            analysis.cross.push_back(
                {all[j].recording,
                 maps.recording,
                 {cross_correlation(all[j].rho, maps.rho, {}),
                  cross_correlation(all[j].rho, maps.rho, both(all[j].specimen, maps.specimen))}});
        }
    }
    return analysis;
}

}  // namespace verdigris
