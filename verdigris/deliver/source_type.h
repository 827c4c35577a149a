// SPDX-License-Identifier: MIT
// A forecast cannot be passed off as a photograph: every picture says in its XMP how it came to be.
#pragma once

#include <string>

#include "verdigris/files/png.h"
#include "verdigris/forecast/forecast.h"

namespace verdigris {

/// The IPTC code of a picture's origin [IPTC].
enum class SourceType {
    capture,              ///< digitalCapture: an observed frame
    algorithm,            ///< algorithmicMedia: a fitted law, or a map computed from pixels
    trained_algorithm,    ///< trainedAlgorithmicMedia: a network
    composite_synthetic,  ///< compositeSynthetic: photographs and forecasts on one sheet
};

/// What a frame of this forecast is, at horizon > 0: a law or a network's picture.
SourceType forecast_source(const Forecast& forecast);

/// The XMP packet with Iptc4xmpExt:DigitalSourceType and xmp:CreatorTool.
std::string xmp_text(SourceType type);

/// PNG options that carry it.
PngOptions png_options(SourceType type, int level = 1);

}  // namespace verdigris
