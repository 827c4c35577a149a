// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include "verdigris/error.h"

namespace verdigris {
namespace {

// chosen: C(23, 12) = 1.35 million multisets, a tenth of a second; 13 blocks have 5.2 million.
constexpr int kMostEnumerated = 12;

struct Sums {
    double over = 0, under = 0;
    int windows = 0;
    Sums& operator+=(const Sums& s) {
        over += s.over;
        under += s.under;
        windows += s.windows;
        return *this;
    }
};

struct Weighted {
    double value = 0, weight = 0;
};

double quotient(const Sums& s) {
    return s.under != 0 ? s.over / s.under : std::numeric_limits<double>::quiet_NaN();
}

/// The smallest value that at least `share` of the weight does not exceed.
double quantile(const std::vector<Weighted>& sorted, double share) {
    double total = 0;
    for (const Weighted& w : sorted) total += w.weight;
    double below = 0;
    for (const Weighted& w : sorted) {
        below += w.weight;
        // A sum of weights misses its exact value by rounding; a whole quantile must not hang on
        // it.
        if (below >= share * total * (1 - 1e-12)) return w.value;
    }
    return sorted.back().value;
}

std::optional<Interval> percentile(std::vector<Weighted> values, double level) {
    for (const Weighted& w : values) {
        if (!std::isfinite(w.value)) return std::nullopt;
    }
    std::ranges::sort(values, {}, &Weighted::value);
    return Interval{quantile(values, (1 - level) / 2), quantile(values, (1 + level) / 2)};
}

/// Uniform in [0, n), the same on every machine (std::uniform_int_distribution is not). The bias of
/// a multiply-shift is below n / 2^32.
std::size_t draw(std::mt19937& random, std::size_t n) {
    return std::size_t((std::uint64_t(random()) * n) >> 32);
}

std::mt19937 generator(std::uint64_t seed) {
    return std::mt19937(std::uint32_t(seed ^ (seed >> 32)));
}

/// Draws `count` of `parts` with replacement, options.draws times.
std::vector<Weighted> resampled(const std::vector<Sums>& parts, std::size_t count,
                                const BootstrapOptions& options) {
    std::mt19937 random = generator(options.seed);
    std::vector<Weighted> out;
    for (int i = 0; i < options.draws; ++i) {
        Sums sum;
        for (std::size_t k = 0; k < count; ++k) sum += parts[draw(random, parts.size())];
        out.push_back({quotient(sum), 1});
    }
    return out;
}

std::vector<Sums> one_by_one(const WindowRatios& r) {
    std::vector<Sums> out;
    for (std::size_t i = 0; i < r.starts.size(); ++i) out.push_back({r.over[i], r.under[i], 1});
    return out;
}

/// At least one window. Blocks without any are left out: nothing was observed there.
std::vector<Sums> by_block(const WindowRatios& r, int block) {
    std::vector<Sums> blocks;
    int current = -1;
    for (std::size_t i = 0; i < r.starts.size(); ++i) {
        const int index = (r.starts[i] - r.starts[0]) / block;
        if (index != current) blocks.emplace_back();
        current = index;
        blocks.back() += {r.over[i], r.under[i], 1};
    }
    // Drawn like a whole block, the few windows of a short last one would weigh as one.
    const int fullest = std::ranges::max_element(blocks, {}, &Sums::windows)->windows;
    if (blocks.size() > 1 && 2 * blocks.back().windows < fullest) {
        const Sums rest = blocks.back();
        blocks.pop_back();
        blocks.back() += rest;
    }
    return blocks;
}

/// All multisets of n blocks out of n, with the multinomial probability of each.
void enumerate(const std::vector<Sums>& blocks, std::size_t at, int left, Sums sum, double log_p,
               std::vector<Weighted>& out) {
    if (at + 1 == blocks.size() || left == 0) {
        if (left > 0) {
            sum += {left * blocks[at].over, left * blocks[at].under, left * blocks[at].windows};
            log_p -= std::lgamma(left + 1.0);
        }
        out.push_back({quotient(sum), std::exp(log_p)});
        return;
    }
    for (int times = 0; times <= left; ++times) {
        Sums with = sum;
        with += {times * blocks[at].over, times * blocks[at].under, times * blocks[at].windows};
        enumerate(blocks, at + 1, left - times, with, log_p - std::lgamma(times + 1.0), out);
    }
}

std::vector<Weighted> all_multisets(const std::vector<Sums>& blocks) {
    const double n = double(blocks.size());
    std::vector<Weighted> out;
    enumerate(blocks, 0, int(blocks.size()), {}, std::lgamma(n + 1) - n * std::log(n), out);
    return out;
}

/// sums[i]: of the windows among the first i starts of the axis.
std::vector<Sums> running_sums(const WindowRatios& r) {
    const int first = r.starts.front();
    std::vector<Sums> sums(std::size_t(r.starts.back()) - std::size_t(first) + 2);
    for (std::size_t i = 0; i < r.starts.size(); ++i) {
        sums[std::size_t(r.starts[i] - first) + 1] = {r.over[i], r.under[i], 1};
    }
    for (std::size_t i = 1; i < sums.size(); ++i) sums[i] += sums[i - 1];
    return sums;
}

Sums between(const std::vector<Sums>& sums, std::size_t from, std::size_t to) {
    return {sums[to].over - sums[from].over, sums[to].under - sums[from].under,
            sums[to].windows - sums[from].windows};
}

std::vector<Weighted> circular_blocks(const WindowRatios& r, const BootstrapOptions& options) {
    const std::vector<Sums> sums = running_sums(r);
    const std::size_t length = sums.size() - 1,
                      block = std::min(length, std::size_t(options.block));
    std::mt19937 random = generator(options.seed);
    std::vector<Weighted> out;
    for (int i = 0; i < options.draws; ++i) {
        Sums sum;
        for (std::size_t filled = 0; filled < length; filled += block) {
            const std::size_t at = draw(random, length), n = std::min(block, length - filled);
            const std::size_t end = std::min(at + n, length);
            sum += between(sums, at, end);
            sum += between(sums, 0, at + n - end);  // past the end it goes on at the start
        }
        // Where windows were skipped, a draw may hold none at all: it says nothing.
        if (sum.windows > 0) out.push_back({quotient(sum), 1});
    }
    return out;
}

void check(const WindowRatios& r, const BootstrapOptions& options) {
    if (r.over.size() != r.starts.size() || r.under.size() != r.starts.size()) {
        throw Error(ErrorCode::usage, "a bootstrap needs two numbers for every window");
    }
    if (std::ranges::adjacent_find(r.starts, std::greater_equal{}) != r.starts.end()) {
        throw Error(ErrorCode::usage, "the windows of a bootstrap must be in order");
    }
    if (options.draws < 1 || options.block < 1 || !(options.level > 0 && options.level < 1)) {
        throw Error(ErrorCode::usage,
                    "a bootstrap needs 1 draw or more, blocks of 1 sample or more and a level "
                    "between 0 and 1");
    }
}

WindowRatios paired(const Direction& direction, const EntrantScores& better,
                    const EntrantScores& worse) {
    if (direction.starts.empty()) {
        throw Error(ErrorCode::usage, direction.label() + " has no scored window to resample");
    }
    WindowRatios r;
    r.starts = direction.starts;
    r.under = window_means(direction.persistence().foreground);
    r.over = window_means(worse.foreground);
    const std::vector<double> subtracted = window_means(better.foreground);
    for (std::size_t i = 0; i < r.over.size(); ++i) r.over[i] -= subtracted[i];
    return r;
}

}  // namespace

std::string to_string(BootstrapKind kind) {
    switch (kind) {
        case BootstrapKind::naive:
            return "naive";
        case BootstrapKind::block:
            return "block";
        case BootstrapKind::circular_block:
            return "circular-block";
    }
    return "unknown";
}

WindowRatios gain_ratios(const Direction& direction, const EntrantScores& entrant) {
    return paired(direction, entrant, direction.persistence());
}

WindowRatios difference_ratios(const Direction& direction, const EntrantScores& first,
                               const EntrantScores& second) {
    return paired(direction, first, second);
}

BootstrapOptions bootstrap_options(const EvaluationProtocol& protocol) {
    return {protocol.bootstrap_draws, protocol.seed, 0.95, protocol.span()};
}

double ratio(const WindowRatios& r) {
    Sums sum;
    for (const Sums& s : one_by_one(r)) sum += s;
    return quotient(sum);
}

std::optional<Interval> bootstrap(const WindowRatios& r, BootstrapKind kind,
                                  const BootstrapOptions& options) {
    check(r, options);
    if (r.starts.size() < 2) return std::nullopt;
    std::vector<Weighted> values;
    if (kind == BootstrapKind::naive) {
        values = resampled(one_by_one(r), r.starts.size(), options);
    } else {
        const std::vector<Sums> blocks = by_block(r, options.block);
        if (blocks.size() < 2) return std::nullopt;
        if (kind == BootstrapKind::circular_block) {
            values = circular_blocks(r, options);
        } else {
            values = int(blocks.size()) <= kMostEnumerated
                         ? all_multisets(blocks)
                         : resampled(blocks, blocks.size(), options);
        }
    }
    if (values.empty()) return std::nullopt;
    return percentile(std::move(values), options.level);
}

std::vector<BlockGain> block_gains(const WindowRatios& r, int block) {
    check(r, {1, 0, 0.5, block});
    std::vector<BlockGain> out;
    const std::vector<Sums> blocks = r.starts.empty() ? std::vector<Sums>{} : by_block(r, block);
    std::size_t window = 0;
    for (const Sums& b : blocks) {
        const std::size_t last = window + std::size_t(b.windows) - 1;
        out.push_back({r.starts[window], r.starts[last], b.windows, quotient(b)});
        window = last + 1;
    }
    return out;
}

}  // namespace verdigris
