// SPDX-License-Identifier: MIT
// One row of a trajectory and one moment, as SIMD kernels take them (internal).
#pragma once

#include "verdigris/forecast/forecast.h"

namespace verdigris {

struct TrajectoryRow {
    const float* base = nullptr;       ///< interleaved r, g, b
    const float* rate = nullptr;       ///< unused at order 0
    const float* curvature = nullptr;  ///< only at order 2
};

struct TrajectoryTime {
    float horizon = 0;
    float two_m = 0;  ///< 2 (n - 1): phi2(h) = h^2 + 2 (n - 1) h
    int order = 0;    ///< 0 also stands for "nothing moves yet": horizon 0
    bool clamp = true;
    bool tabulated = false;  ///< frame = base + phi rate + phi2 curvature, as they are here
    float phi = 0, phi2 = 0;
};

TrajectoryTime trajectory_time(const Trajectory& trajectory, double horizon);
TrajectoryRow trajectory_row(const Trajectory& trajectory, int y);
/// Throws Error{usage} unless all images have the size of the base and the horizon is >= 0.
void check_trajectory(const Trajectory& trajectory, double horizon);

}  // namespace verdigris
