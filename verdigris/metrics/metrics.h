// SPDX-License-Identifier: MIT
// How different two pictures are: FLIP, SSIM, MS-SSIM, CIEDE2000, MSE and PSNR. LPIPS, which needs
// libtorch, is in learn/.
// Path: files -> [metrics]. Model: docs/models/metrics.md
#pragma once

#include "verdigris/metrics/flip.h"
#include "verdigris/metrics/pixel_errors.h"
#include "verdigris/metrics/ssim.h"
