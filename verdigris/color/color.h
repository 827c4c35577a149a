// SPDX-License-Identifier: MIT
// Ground: what a color is. Encoded sRGB, linear light, XYZ and Lab are different types.
#pragma once

#include "verdigris/color/convert.h"
#include "verdigris/color/delta_e.h"
#include "verdigris/color/magma.h"
#include "verdigris/color/pixel_types.h"
