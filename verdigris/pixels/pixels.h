// SPDX-License-Identifier: MIT
// Ground: what an image is in memory. Knows nothing of color, files or time.
// Path: [pixels] -> color -> files -> recording -> observe -> forecast -> material -> deliver.
#pragma once

#include "verdigris/pixels/image.h"
#include "verdigris/pixels/parallel_rows.h"
