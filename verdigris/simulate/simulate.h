// SPDX-License-Identifier: MIT
// A made recording of copper that corrodes in front of a camera, whose truth is known.
// Model: docs/models/simulate.md
#pragma once

#include <functional>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"
#include "verdigris/recording/recording.h"
#include "verdigris/simulate/camera.h"
#include "verdigris/simulate/scene.h"
#include "verdigris/simulate/spec.h"
#include "verdigris/simulate/specimen.h"

namespace verdigris {

/// Where a simulation goes. Empty functions are not called. The views end with the call.
struct SimulationSinks {
    /// Every frame in order; frame8 if the camera has 8 bits, else frame16.
    std::function<void(int index, ImageView<const SrgbU8>)> frame8;
    std::function<void(int index, ImageView<const SrgbU16>)> frame16;
    /// The specimen at units 0, 1, 2, ... and at the end.
    std::function<void(const Specimen&)> state;
};

struct SimulationResult {
    std::vector<FrameGains> gains;  ///< one per frame
    /// Where the time went, for benchmarks: wall seconds of corroding and composing, of exposing,
    /// and of the sinks (encoder, disk).
    double seconds_specimen = 0, seconds_camera = 0, seconds_sinks = 0;
};

/// Runs the whole recording. Streams: holds three frames and the specimen's cells. Same spec, same
/// frames, at any thread count. Throws as check_spec() and what the sinks throw.
SimulationResult simulate(const SimulationSpec& spec, const SimulationSinks& sinks,
                          const Progress& progress = {});

/// The frames of an 8-bit simulation held in memory, as a recording: for tests and for studies over
/// many specimens. 3 bytes a pixel and frame.
Recording simulated_recording(const SimulationSpec& spec, const Progress& progress = {});

/// Time of a frame on the axis: frame i is taken at (i + 0.5) / count of the units.
double frame_unit(const FrameSpec& frames, int index);

}  // namespace verdigris
