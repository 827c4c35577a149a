// SPDX-License-Identifier: MIT
// Reading a trajectory at a horizon: one fused multiply-add per pixel, and the clamp.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "verdigris/forecast/trajectory_row.h"
#include "verdigris/pixels/parallel_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "verdigris/forecast/trajectory.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
// After foreach_target, which includes this file again for each target.
#include "verdigris/forecast/trajectory_row-inl.h"

HWY_BEFORE_NAMESPACE();
namespace verdigris {
namespace HWY_NAMESPACE {

void evaluate_row(const TrajectoryRow& row, const TrajectoryTime& time, std::size_t width,
                  float* HWY_RESTRICT out) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, 1> one;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t x = 0;
    for (; x + lanes <= width; x += lanes) store_rgb(d, frame_at(d, row, time, x), out + 3 * x);
    for (; x < width; ++x) store_rgb(one, frame_at(one, row, time, x), out + 3 * x);
}

}  // namespace HWY_NAMESPACE
}  // namespace verdigris
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace verdigris {
namespace {

HWY_EXPORT(evaluate_row);

// chosen: ~50 us of work on a wide image; small images stay on one thread.
int rows_per_run(int width) {
    return std::max(1, 32768 / std::max(width, 1));
}

const float* floats(const SrgbF* pixels) {
    return reinterpret_cast<const float*>(pixels);
}

double between_nodes(const std::vector<LawNode>& nodes, double horizon, double LawNode::*value) {
    LawNode before;
    for (const LawNode& node : nodes) {
        if (horizon <= node.horizon) {
            const double share = (horizon - before.horizon) / (node.horizon - before.horizon);
            return before.*value + share * (node.*value - before.*value);
        }
        before = node;
    }
    return before.*value;
}

bool outside(float v, float tolerance) {
    return !(v >= -tolerance && v <= 1 + tolerance);
}

}  // namespace

double TimeLaw::phi(double horizon) const {
    if (tabulated()) return between_nodes(nodes, horizon, &LawNode::phi);
    return order >= 1 ? horizon : 0;
}

double TimeLaw::phi2(double horizon) const {
    if (tabulated()) return between_nodes(nodes, horizon, &LawNode::phi2);
    const double m = context - 1;
    return order >= 2 ? horizon * (horizon + 2 * m) : 0;  // (m + h)^2 - m^2
}

void check_trajectory(const Trajectory& trajectory, double horizon) {
    if (!(horizon >= 0) || !std::isfinite(horizon)) {
        throw Error(ErrorCode::usage, "a horizon must be a number of units, 0 or more");
    }
    const bool rate_fits = trajectory.law.order < 1 || trajectory.rate.same_size(trajectory.base);
    const bool curvature_fits =
        trajectory.law.order < 2 || trajectory.curvature.same_size(trajectory.base);
    if (!rate_fits || !curvature_fits) {
        throw Error(ErrorCode::usage, "the images of a trajectory differ in size");
    }
}

TrajectoryTime trajectory_time(const Trajectory& trajectory, double horizon) {
    const int order = horizon > 0 ? trajectory.law.order : 0;
    TrajectoryTime time{float(horizon), float(2 * (trajectory.law.context - 1)), order,
                        trajectory.clamp};
    time.tabulated = trajectory.law.tabulated();
    time.phi = float(trajectory.law.phi(horizon));
    time.phi2 = float(trajectory.law.phi2(horizon));
    return time;
}

TrajectoryRow trajectory_row(const Trajectory& trajectory, int y) {
    TrajectoryRow row{floats(trajectory.base.row(y)), nullptr, nullptr};
    if (trajectory.law.order >= 1) row.rate = floats(trajectory.rate.row(y));
    if (trajectory.law.order >= 2) row.curvature = floats(trajectory.curvature.row(y));
    return row;
}

void evaluate_trajectory(const Trajectory& trajectory, double horizon, Image<SrgbF>& out) {
    check_trajectory(trajectory, horizon);
    const int width = trajectory.base.width(), height = trajectory.base.height();
    if (!out.same_size(trajectory.base)) out = Image<SrgbF>::for_overwrite(width, height);
    const TrajectoryTime time = trajectory_time(trajectory, horizon);
    parallel_rows(height, rows_per_run(width), [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            HWY_DYNAMIC_DISPATCH(evaluate_row)
            (trajectory_row(trajectory, y), time, std::size_t(width),
             reinterpret_cast<float*>(out.row(y)));
        }
    });
}

double out_of_gamut_share(const Trajectory& trajectory, double horizon, const Mask& where,
                          double tolerance) {
    check_trajectory(trajectory, horizon);
    const int width = trajectory.base.width(), height = trajectory.base.height();
    if (!where.empty() && !where.same_size(trajectory.base)) {
        throw Error(ErrorCode::usage, "the mask and the trajectory differ in size");
    }
    const float phi = float(trajectory.law.phi(horizon)),
                phi2 = float(trajectory.law.phi2(horizon));
    const float slack = float(tolerance);
    struct Count {
        std::int64_t outside = 0, all = 0;
    };
    const auto counts = map_rows<Count>(height, rows_per_run(width), [&](RowRun run) {
        Count count;
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < width; ++x) {
                if (!where.empty() && where(x, y) == 0) continue;
                SrgbF c = trajectory.base(x, y);
                if (trajectory.law.order >= 1) {
                    const SrgbF r = trajectory.rate(x, y);
                    c = {c.r + phi * r.r, c.g + phi * r.g, c.b + phi * r.b};
                }
                if (trajectory.law.order >= 2) {
                    const SrgbF q = trajectory.curvature(x, y);
                    c = {c.r + phi2 * q.r, c.g + phi2 * q.g, c.b + phi2 * q.b};
                }
                count.outside += outside(c.r, slack) || outside(c.g, slack) || outside(c.b, slack);
                ++count.all;
            }
        }
        return count;
    });
    Count total;
    for (const Count& c : counts) total.outside += c.outside, total.all += c.all;
    return total.all == 0 ? 0 : double(total.outside) / double(total.all);
}

}  // namespace verdigris
#endif  // HWY_ONCE
