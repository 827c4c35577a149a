// SPDX-License-Identifier: MIT
// Photometric drift, measured on a reference region over a whole recording and taken out of it:
// the paper's control that a forecast follows the metal and not the camera ([Paper], Section 6).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/observe/observe.h"
#include "verdigris/observe/reference_region.h"
#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"

namespace verdigris {

/// One value per channel: r, g, b, encoded units.
using ChannelValues = std::array<double, 3>;

struct DriftSeriesOptions {
    double trim = 0.1;    ///< share of the reference's values dropped at each end of the mean
    int spread_over = 9;  ///< samples averaged before the spread is taken, so noise is not contrast
    /// Samples of the centered moving average, odd. [Paper]: 101 (at 10 samples per unit); an
    /// unsmoothed correction would carry the estimator's noise into every frame.
    int smoothing = 101;
};

/// One entry per sample. "smooth": after the moving average, whose window shrinks symmetrically at
/// the ends, so that a linear drift passes unchanged.
struct DriftSeries {
    std::vector<ChannelValues> reference;  ///< trimmed spatial mean of the reference region
    std::vector<ChannelValues> spread;     ///< its spatial standard deviation
    std::vector<ChannelValues> specimen;   ///< spatial mean of the specimen
    std::vector<ChannelValues> smooth_reference, smooth_spread, smooth_specimen;

    double reference_movement = 0;  ///< max over t of mean_c |smooth(t) - smooth(0)|, encoded units
    double specimen_movement = 0;
    /// specimen_movement / reference_movement; empty if the reference stands still.
    std::optional<double> ratio;
    /// Pearson's r of reference and specimen luma (BT.709 weights) over the samples, as measured
    /// and after smoothing; empty if one of them is constant. Near -1: the exposure makes up for
    /// a specimen that darkens.
    std::optional<double> luma_correlation, smooth_luma_correlation;
};

/// Streams the samples once; holds spread_over of the region's pixels (at most 262,144, evenly
/// picked) and a few images. Deterministic at any thread count.
/// Throws Error{usage}: no region, masks of another size, options out of range.
DriftSeries measure_drift_series(const SampleStore& samples, const Mask& specimen,
                                 const ReferenceRegion& region,
                                 const DriftSeriesOptions& options = {},
                                 const Progress& progress = {});

enum class DriftCorrection {
    gain,    ///< x mu(0) / mu(t)
    offset,  ///< x + mu(0) - mu(t)
    both,    ///< (x - mu(t)) s(0) / s(t) + mu(0), the gain shrunk to 1 where the contrast is noise
};
std::string to_string(DriftCorrection correction);  ///< "gain", "offset", "both"

/// corrected = gain * x + offset, per channel, encoded units.
struct ChannelMap {
    ChannelValues gain{1, 1, 1}, offset{};
};
/// One per sample, from the smoothed series; sample 0 is left as it is. `sigma` is the noise of
/// one sample: of `both`, gain - 1 is multiplied by s^2 / (s^2 + 9 sigma^2), since on a flat
/// backdrop the ratio of spreads says nothing.
std::vector<ChannelMap> correction_maps(const DriftSeries& series, DriftCorrection correction,
                                        double sigma);

/// The samples with maps[i] applied to sample i when it is read. Values are not limited to [0, 1].
/// Throws Error{usage} unless there is one map per sample.
std::shared_ptr<const SampleStore> corrected_samples(std::shared_ptr<const SampleStore> samples,
                                                     std::vector<ChannelMap> maps);

/// The observation with corrected samples, its noise measured again on them (sigma as in
/// noise.h over the specimen; a tau that was given stays).
/// Throws as measure_drift_series; Error{usage} if the series has another length.
Observation corrected_observation(const Observation& observation, const DriftSeries& series,
                                  DriftCorrection correction);

}  // namespace verdigris
