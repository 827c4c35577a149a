// SPDX-License-Identifier: MIT
// Everything that decides a simulated recording: one struct per part of the scene. What a key of a
// spec file may be, and what it means, is listed once, in spec_fields.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "verdigris/copper/environment.h"
#include "verdigris/copper/growth.h"
#include "verdigris/copper/patina.h"

namespace verdigris {

/// Lengths on the specimen are in sides: 1 is the specimen's shorter side. So the same specimen
/// comes out at any size of the frame.
struct SusceptibilitySpec {
    enum class Pattern {
        gaussian,           ///< smooth random fields
        reaction_diffusion  ///< spots and labyrinths of Gray and Scott
    };
    Pattern pattern{Pattern::gaussian};
    double spread = 0.3;       ///< standard deviation of log rho
    double coarse = 0.22;      ///< correlation length of the broad pattern, sides
    double fine = 0.035;       ///< and of the fine one
    double fine_share = 0.35;  ///< share of the fine pattern in the variance
    double stretch = 1;        ///< rolling direction: patterns longer along x, by 1 or more
    double edge = 0;           ///< log boost at the rim
    double edge_width = 0.06;  ///< over which it falls to 1/e, sides
    double drip = 0;           ///< log amplitude of streaks that run down
    double feed = 0.035, kill = 0.060;  ///< of Gray and Scott; other pairs, other patterns
    int steps = 6000;                   ///< of the reaction
    double reaction_scale = 0.025;      ///< four cells of the reaction, sides
};

/// Where the film starts to grow and how that spreads: theta in [0, 1], the share of a cell whose
/// film grows. The film the specimen starts with (OxideSpec) lies everywhere.
struct NucleationSpec {
    double initial = 1;          ///< at the start; 1: all of it grows from the first moment
    double seeds = 0;            ///< nuclei per unit of area (a side squared) and unit of time
    double seed_radius = 0.015;  ///< of a nucleus, sides
    double growth = 0;           ///< rate a of a rho theta (1 - theta), per unit
    double diffusion = 0;        ///< D of the coverage, sides^2 per unit
};

struct OxideSpec {
    double initial_nm = 3;  ///< thickness at the start
    double initial_follows =
        0;  ///< the start is initial_nm rho^this: 0 even, 1/3 as if grown before
    GrowthOptions growth;
    OxideChemistry chemistry;
    double thickness_spread = 0.1;
    double roughness_factor = 1;
    bool brown_limit = true;
    /// Optical tables of one's own (CSV, see OpticalConstants); empty: the built-in ones.
    std::filesystem::path metal_table, cuprous_table, cupric_table;
};

struct PatinaSpec {
    PatinaOptions growth{.rate = 0};
    double wet_spread = 0.8;  ///< standard deviation of the logarithm of the wetness map
    double wet_scale = 0.15;  ///< its correlation length, sides
    double wet_runs = 2;      ///< how much longer it is downwards
    double wet_share = 1;     ///< share of each day that is wet
};

struct SceneSpec {
    double center_x = 0.5, center_y = 0.5;  ///< of the specimen, shares of the frame
    double width = 0.75, height = 0.75;     ///< of the specimen, shares of the frame's short side
    double tilt = 0;                        ///< degrees, clockwise
    double corner = 0.02;                   ///< radius of its corners, sides
    double backdrop = 0.42;                 ///< reflectance of the neutral backdrop
    double backdrop_gradient = 0.03;        ///< relative, top to bottom
    bool mount = false;                     ///< a rod that holds the specimen from above
    double mount_width = 0.06;              ///< sides
    double light_gradient = 0.08;           ///< relative, across the frame
    double light_direction = 30;            ///< degrees, from +x clockwise, where it is brighter
    double vignette = 0.03;                 ///< relative loss half a short side from the middle
    double texture = 0.04;                  ///< log amplitude of the brushing
    double texture_angle = 0;               ///< degrees, along the brush lines
    double texture_scale = 0.006;           ///< width of a brush line, sides
    double glint = 0;                       ///< peak of the lamp's reflection, linear
    double glint_x = 0.3, glint_y = 0.3;    ///< on the specimen, sides from its corner
    double glint_size = 0.12;               ///< sides
    double shadow = 0.25;                   ///< depth of the specimen's soft shadow
};

struct CameraSpec {
    double exposure = 0.6;          ///< linear gain at the start
    double auto_exposure = 0;       ///< share of a change of the mean that the loop takes back
    double auto_exposure_lag = 1;   ///< its time constant, units
    double light_drift = 0;         ///< stationary standard deviation of log light
    double light_correlation = 20;  ///< units
    double white_balance = 0;       ///< the same per channel of the color balance
    double white_balance_correlation = 20;
    double jitter = 0;           ///< common to all pixels, per sample (0.1 unit), log gain
    double flicker = 0;          ///< amplitude of bands that roll through the frame
    double flicker_bands = 1.5;  ///< of them in a frame
    double shot_noise = 0;       ///< a in variance = a v + b^2, linear, per sample
    double read_noise = 0;       ///< b
    int bits = 8;                ///< of a frame: 8 or 16
    /// Affine drift of the encoded values, straight in time from 1 and 0 to these at the end.
    std::array<double, 3> drift_gain{1, 1, 1}, drift_offset{0, 0, 0};
};

struct FrameSpec {
    int width = 512, height = 512;
    double fps = 24;
    int count = 984;      ///< one per sample of the unit grid
    double units = 98.4;  ///< that they span
};

struct SimulationSpec {
    std::string preset = "uniform";  ///< what the other values started from
    std::uint64_t seed = 0;
    /// Of the specimen alone: susceptibility, nuclei, wetness, brushing. 0: `seed`. With it the
    /// same specimen comes before the camera on another day.
    std::uint64_t specimen_seed = 0;
    std::uint64_t pattern_seed() const { return specimen_seed != 0 ? specimen_seed : seed; }
    int grid = 128;  ///< cells across the specimen's longer side in which it corrodes
    FrameSpec frames;
    SceneSpec scene;
    SusceptibilitySpec susceptibility;
    NucleationSpec nucleation;
    OxideSpec oxide;
    EnvironmentOptions environment;  ///< its own seed is ignored: all follow `seed`
    PatinaSpec patina;
    CameraSpec camera;
};

/// Throws Error{usage} naming the key and the allowed range: "oxide.initial_nm is -3; allowed are 0
/// to 5000", also for what only together makes no sense (a specimen beyond the frame).
void check_spec(const SimulationSpec& spec);

/// The chamber of [Paper], its open air, and four more; see docs/models/simulate.md.
/// Throws Error{usage} naming the presets there are.
SimulationSpec preset_spec(const std::string& name);
/// In the order in which the program lists them.
const std::array<std::string, 6>& preset_names();
/// The same specimen as the paper's cameras would have recorded it: size, rate and length of the
/// recording. 1920 x 1080 at 60 frames per second for 601 s; `air` 720 x 1280 at 30 for 482 s.
SimulationSpec full_size(SimulationSpec spec);

}  // namespace verdigris
