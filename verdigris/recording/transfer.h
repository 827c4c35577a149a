// SPDX-License-Identifier: MIT
// Code values that are not meant for a display of the sRGB kind -> encoded sRGB: linear light,
// pure powers, PQ and HLG, and primaries wider than BT.709.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/recording/frame_format.h"

namespace verdigris {

/// True if the code values are shown as they are: display transfer on BT.709 or BT.601 primaries.
/// Both BT.601 sets lie within 0.015 in xy of BT.709, and no player converts them.
bool shown_as_coded(Transfer transfer, Primaries primaries);

/// R'G'B' in [0, 1] as coded -> encoded sRGB in [0, 1]. PQ and HLG put their reference white of
/// 203 cd/m2 [BT2408] at 1; what is brighter is clipped.
SrgbF srgb_from_coded(SrgbF coded, Transfer transfer, Primaries primaries);

}  // namespace verdigris
