// SPDX-License-Identifier: MIT
// Stage 1. A recording becomes a sequence of denoised samples of one specimen on an axis of
// accelerated units, with masks and a measured noise.
// Path: recording -> [observe] -> forecast.   Model: docs/models/observe.md
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"
#include "verdigris/recording/recording.h"
#include "verdigris/status.h"

namespace verdigris {

/// Accelerated units in a whole recording: 984 grid samples, 10 per unit. derived: docs/models.
inline constexpr double kUnitsPerRecording = 98.4;
/// At most this many samples per unit (the paper's stride).
inline constexpr int kMaxSamplesPerUnit = 10;

enum class CropMode { automatic, none, manual };
struct CropChoice {
    CropMode mode{CropMode::automatic};
    Rect rect;  ///< with manual: shown coordinates; must lie inside the frame
};

/// Which samples are kept at full size. Noise and masks always see all of them.
enum class Keep {
    every_sample,  ///< 10 per unit where the recording is long enough: for evaluation
    unit_steps,    ///< one per unit, counted back from the last sample: for authoring
};

struct ObserveOptions {
    CropChoice crop;
    int size = 0;  ///< side of the (square) result in pixels; 0: native, no resampling
    std::optional<double> units;  ///< units the recording spans; default see docs/models/observe.md
    std::optional<double>
        tau;  ///< dead-zone; default 2.40 * sigma, at least 5e-4 (docs/models/observe.md)
    Keep keep{Keep::unit_steps};
    double trim = 0.1;  ///< share trimmed at each end of a bin, per pixel and channel
    /// Where kept samples are written as they are made (samples.npy). Empty: an unnamed temporary.
    std::filesystem::path store;
};

/// The time axis. sample i is centered at (i + 0.5) / samples * units.
struct UnitAxis {
    double units = 0;             ///< units the whole recording spans
    int samples = 0;              ///< bins on the axis
    int samples_per_unit = 1;     ///< the stride between unit steps
    double seconds_per_unit = 0;  ///< of the recording, not of the world
};

/// One kept sample.
struct Sample {
    double unit = 0;            ///< position on the axis, units from the start of the recording
    double seconds = 0;         ///< center of its bin in the recording
    int frames = 0;             ///< source frames averaged
    bool interpolated = false;  ///< the bin was empty: filled linearly from its neighbors
};

/// Kept samples, oldest first, stored as 16-bit codes on disk and read on demand.
class SampleStore {
  public:
    virtual ~SampleStore() = default;
    virtual int count() const = 0;
    virtual int width() const = 0;
    virtual int height() const = 0;
    virtual Image<SrgbF> image(int index) const = 0;
};

struct Noise {
    double sigma = 0;        ///< per pixel and channel, of one sample, encoded units [0, 1]
    double tau = 0;          ///< dead-zone on the channel mean of |difference|
    bool tau_given = false;  ///< set by the user
};

/// How the specimen was found.
struct CropReport {
    Rect rect;            ///< in shown coordinates of the frame
    int frame_width = 0;  ///< of the frame as shown; 0: not known, as of a stored observation
    int frame_height = 0;
    bool fills_frame = false;  ///< nearly everything changes: the specimen is the frame
    double area_share = 0;     ///< specimen mask over the frame
    double score_ratio = 0;    ///< best candidate over the runner-up; 0 if only one
    std::string sentence;      ///< what was decided and why
};

/// What flows on to forecast/.
struct Observation {
    std::string source_name;    ///< file or folder name, no path
    std::string source_sha256;  ///< of the input bytes
    UnitAxis axis;
    std::vector<Sample> samples;
    std::shared_ptr<const SampleStore> store;
    Mask specimen;  ///< 255: metal; 0: mount, backdrop
    Mask clipped;   ///< 255: saturated for long or at the end, or beside it (a glint, black)
    Noise noise;
    CropReport crop;
    DecodeReport decode;
    Statuses notes;  ///< broken tail, exposure steps, few frames, interpolated samples ...

    int width() const { return store ? store->width() : 0; }
    int height() const { return store ? store->height() : 0; }
};

/// Streams the recording once (after a look at <= 64 frames for crop and masks). Memory: the bins
/// being filled, never the recording. Deterministic at any thread count.
/// Throws Error{bad_input}: nothing decodes, one frame only ("needs at least 2"), automatic crop
/// finds no specimen or cannot choose (asks for --crop), crop outside the frame.
Observation observe(const Recording& recording, const ObserveOptions& options = {},
                    const Progress& progress = {});

}  // namespace verdigris
