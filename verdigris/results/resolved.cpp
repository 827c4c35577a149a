// SPDX-License-Identifier: MIT
#include "verdigris/results/resolved.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "verdigris/error.h"
#include "verdigris/results/cells.h"

namespace verdigris {
namespace {
using Json = nlohmann::ordered_json;

}  // namespace

Resolved resolved(const WindowRatios& ratios, const BootstrapOptions& options) {
    Resolved r;
    r.windows = int(ratios.starts.size());
    r.value = std::numeric_limits<double>::quiet_NaN();
    if (ratios.starts.empty()) return r;
    r.value = ratio(ratios);
    r.block = bootstrap(ratios, BootstrapKind::block, options);
    r.blocks = block_gains(ratios, options.block);
    return r;
}

WindowRatios paired_difference(const WindowRatios& first, const WindowRatios& second) {
    if (first.starts != second.starts || first.under != second.under)
        throw Error(ErrorCode::usage, "a paired difference needs the same windows");
    WindowRatios difference = first;
    for (std::size_t i = 0; i < difference.over.size(); ++i) difference.over[i] -= second.over[i];
    return difference;
}

int printed_sign(double fraction) {
    const double tenths = std::nearbyint(1000 * fraction);
    return tenths > 0 ? 1 : tenths < 0 ? -1 : 0;
}

bool sign_is_settled(const Resolved& r) {
    return r.blocks.size() >= kFewBlocks && r.block &&
           (printed_sign(r.block->low) > 0 || printed_sign(r.block->high) < 0);
}

std::string blocks_better(const std::vector<BlockGain>& blocks) {
    const auto of_sign = [&](int sign) {
        return std::ranges::count_if(blocks, [&](const BlockGain& b) {
            return std::isfinite(b.value) && printed_sign(b.value) == sign;
        });
    };
    std::string text = fmt::format("{} of {} blocks", of_sign(1), blocks.size());
    if (of_sign(0) > 0) text += fmt::format(" and equal in {}", of_sign(0));
    return text;
}

std::string how_sure(const Resolved& r) {
    if (r.blocks.size() < 2) return "there is one block only, which says nothing of how sure";
    if (r.blocks.size() < kFewBlocks || !r.block)
        return fmt::format("{} blocks are too few to say how sure that is", r.blocks.size());
    return fmt::format(
        "the block interval {} to {} {}", signed_percent(r.block->low),
        signed_percent(r.block->high),
        sign_is_settled(r) ? "excludes zero" : "includes zero, so the sign is not settled");
}

std::string signed_percent(double fraction) {
    return printed_sign(fraction) == 0 ? "0.0 %" : fmt::format("{:+.1f} %", 100 * fraction);
}

TableCell cell_of(const Resolved& r) {
    // Of two blocks an interval is the lower and the higher one: no interval at all.
    return r.blocks.size() < kFewBlocks ? TableCell(r.value) : interval_cell(r.value, r.block);
}

Json json_of(const Resolved& r) {
    return {{"gain", number_json(r.value)},
            {"interval", interval_json(r.block)},
            {"windows", r.windows},
            {"blocks", blocks_json(r.blocks)}};
}

}  // namespace verdigris
