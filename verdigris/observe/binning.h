// SPDX-License-Identifier: MIT
// The one pass over the recording: frames into bins, bins into samples, samples into the store and
// the noise meter.
#pragma once

#include <optional>
#include <string>

#include "verdigris/observe/noise.h"
#include "verdigris/observe/observe.h"
#include "verdigris/observe/sample_line.h"
#include "verdigris/observe/unit_axis.h"
#include "verdigris/progress.h"
#include "verdigris/recording/recording.h"

namespace verdigris {

/// What is made of each bin.
struct BinningPlan {
    const AxisPlan* axis = nullptr;
    std::vector<bool> kept;     ///< per bin
    Rect crop;                  ///< in the shown frame
    int width = 0, height = 0;  ///< of a sample
    double trim = 0.1;
    std::filesystem::path store;
    Mask specimen;  ///< of a sample's size; empty if it is found only afterwards
};

/// The rows of a sample that the noise is measured on. Samples that are not kept are made there
/// only: of 1080p this is 1 % of a frame, and binning costs next to nothing.
struct ProbeRows {
    std::vector<std::pair<int, int>> bands;  ///< [begin, end) rows of the sample
    int rows = 0;                            ///< all together
};
ProbeRows probe_rows(Rect crop, int height);
/// The probe's part of a mask of a sample's size.
Mask probe_of(const Mask& mask, const ProbeRows& rows);

struct Binned {
    std::shared_ptr<const SampleStore> store;
    std::vector<SampleLine::Kept> kept;
    int samples = 0;  ///< of the axis that could be filled: less if the tail is broken
    Mask clipped;
    Look look;  ///< at the samples, if the specimen was not known before
    std::optional<double> sigma_of(const Mask& specimen) const;
    NoiseMeter noise;
    ProbeRows probe;
    DecodeReport decode;
    std::optional<Status> jump;
};

/// Throws as observe().
Binned bin_recording(const Recording& recording, const BinningPlan& plan, const Progress& progress);

}  // namespace verdigris
