// SPDX-License-Identifier: MIT
// The frame in four colors: which of them is the specimen's?
#pragma once

#include "verdigris/observe/change_map.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// k-means (k = 4) on (0.5 L*, a*, b*) of the early look. The cluster that changes most and is
/// copper-colored at least in part; where hardly anything is copper-colored (gold, black or green
/// specimens), the cluster that changes most. Deterministic: its own fixed seed.
Mask specimen_cluster(const ChangeMap& map);

}  // namespace verdigris
