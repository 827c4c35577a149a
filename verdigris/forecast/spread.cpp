// SPDX-License-Identifier: MIT
#include "verdigris/forecast/spread.h"

#include <algorithm>
#include <cmath>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {

SpreadNode Spread::at(double horizon) const {
    SpreadNode before;
    for (const SpreadNode& after : nodes) {
        if (horizon <= after.horizon) {
            const double t = (horizon - before.horizon) / (after.horizon - before.horizon);
            return {horizon, std::lerp(before.common, after.common, t),
                    std::lerp(before.own, after.own, t)};
        }
        before = after;
    }
    before.horizon = horizon;
    return before;
}

void spread_image(const Spread& spread, double horizon, Image<SrgbF>& out) {
    const SpreadNode node = spread.at(horizon);
    const float common = float(node.common), own = float(node.own);
    const SrgbF all{common * spread.common.r, common * spread.common.g, common * spread.common.b};
    if (!out.same_size(spread.own))
        out = Image<SrgbF>::for_overwrite(spread.own.width(), spread.own.height());
    parallel_rows(out.height(), 64, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const SrgbF* from = spread.own.row(y);
            SrgbF* to = out.row(y);
            for (int x = 0; x < out.width(); ++x) {
                // Where a pixel has nothing of its own it is held, and so is what it shares.
                const bool moves = from[x].r + from[x].g + from[x].b > 0;
                to[x] = moves ? SrgbF{std::sqrt(all.r + own * from[x].r),
                                      std::sqrt(all.g + own * from[x].g),
                                      std::sqrt(all.b + own * from[x].b)}
                              : SrgbF{};
            }
        }
    });
}

SrgbF spread_of_mean(const Spread& spread, double horizon) {
    const double v = spread.at(horizon).common;
    return {float(std::sqrt(v * double(spread.common.r))),
            float(std::sqrt(v * double(spread.common.g))),
            float(std::sqrt(v * double(spread.common.b)))};
}

}  // namespace verdigris
