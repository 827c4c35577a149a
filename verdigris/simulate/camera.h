// SPDX-License-Identifier: MIT
// What the camera makes of the light: exposure, color balance, noise, the sRGB curve, 8 bits.
// This is where forecasts are really won and lost.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/simulate/spec.h"

namespace verdigris {

/// What multiplied and shifted one frame: the truth about its color.
struct FrameGains {
    double unit = 0;                         ///< when it was taken
    std::array<double, 3> linear{};          ///< all that multiplies linear light: R, G, B
    double exposure = 1;                     ///< of it, what the automatic exposure decided
    double light = 1;                        ///< of it, what the light did slowly
    double jitter = 1;                       ///< of it, what the light did from sample to sample
    std::array<double, 3> balance{1, 1, 1};  ///< of it, the color balance
    /// Of the bands, turns: row y of H is also multiplied by 1 + flicker sin(2 pi (bands y / H +
    /// phase)).
    double flicker_phase = 0;
    std::array<double, 3> encoded_gain{1, 1, 1}, encoded_offset{0, 0, 0};  ///< affine drift
};

/// The causal part: drift processes and the exposure loop, one step per 0.1 unit.
class CameraTrack {
  public:
    explicit CameraTrack(const SimulationSpec& spec);
    /// To be called once per node of 0.1 units, in order, with the mean luminance of the scene
    /// there (linear, before the camera): the automatic exposure reacts to it with its lag.
    void see(double mean_luminance);
    /// Nodes seen so far.
    int nodes() const { return int(exposure_log_.size()); }
    /// Of a frame at `unit`, which must not lie beyond the last node seen.
    FrameGains gains(double unit, int frame = 0) const;

    static constexpr double kNodeUnits = 0.1;

  private:
    SimulationSpec spec_;
    std::vector<double> light_, jitter_, exposure_log_;
    std::array<std::vector<double>, 3> balance_;
    double first_log_ = 0, state_ = 0;
};

/// The frame-by-frame part.
class Camera {
  public:
    /// Makes the noise, ~20 ms.
    explicit Camera(const SimulationSpec& spec);

    /// A frame of the light lerp(before, after, t) under these gains; `index` decides its noise.
    /// ~4 ns a sample and core. Same arguments, same bytes, at any thread count. Samples over 1 are
    /// saturated, as a sensor's are; rounding is to the nearest code.
    void expose(const Image<LinearF>& before, const Image<LinearF>& after, double t,
                const FrameGains& gains, int index, Image<SrgbU8>& frame) const;
    void expose(const Image<LinearF>& before, const Image<LinearF>& after, double t,
                const FrameGains& gains, int index, Image<SrgbU16>& frame) const;

    /// Variance of one frame's noise at linear value v is shot * v + read^2: what the spec states
    /// per sample of 0.1 units, times the frames in a sample.
    double shot() const { return shot_; }
    double read_variance() const { return read_variance_; }

  private:
    template <class Encode>
    void rows(const Image<LinearF>& before, const Image<LinearF>& after, double t,
              const FrameGains& gains, int index, const Encode& encode) const;

    SimulationSpec spec_;
    double shot_ = 0, read_variance_ = 0;
    std::vector<float> tile_;  ///< standard normal numbers
};

}  // namespace verdigris
