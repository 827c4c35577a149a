// SPDX-License-Identifier: MIT
#include "verdigris/simulate/spec_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <type_traits>

#include "verdigris/error.h"

namespace verdigris {
namespace {

template <class Enum>
SpecChoice choice(Enum& value, std::vector<std::string_view> words) {
    return {std::move(words), [&value] { return int(value); },
            [&value](int i) { value = Enum(i); }};
}

// Adds fields to one section.
struct Section {
    std::vector<SpecField>& fields;
    std::string_view name;
    void operator()(std::string_view key, SpecValue value, double least, double most,
                    std::string_view meaning) const {
        fields.push_back({name, key, std::move(value), least, most, meaning});
    }
};

void add_top(SimulationSpec& s, std::vector<SpecField>& f) {
    f.push_back({"", "seed", &s.seed, 0, 0x1p53, "another seed, another specimen and another day"});
    f.push_back({"", "specimen_seed", &s.specimen_seed, 0, 0x1p53,
                 "of the specimen alone, so that it can meet another day; 0: as seed"});
    f.push_back({"", "grid", &s.grid, 8, 1024, "cells across the longer side that corrode"});
}

void add_frames(FrameSpec& s, std::vector<SpecField>& f) {
    const Section add{f, "frames"};
    add("width", &s.width, 16, 4096, "pixels");
    add("height", &s.height, 16, 4096, "pixels");
    add("fps", &s.fps, 0.001, 1000, "frames per second of the file");
    add("count", &s.count, 2, 1000000, "frames; 984 are one per sample of the unit grid");
    add("units", &s.units, 0.1, 1000, "accelerated units that they span");
}

void add_scene(SceneSpec& s, std::vector<SpecField>& f) {
    const Section add{f, "scene"};
    add("center_x", &s.center_x, 0, 1, "of the specimen, share of the frame's width");
    add("center_y", &s.center_y, 0, 1, "share of the frame's height");
    add("width", &s.width, 0.05, 8, "of the specimen, share of the frame's shorter side");
    add("height", &s.height, 0.05, 8, "share of the frame's shorter side");
    add("tilt", &s.tilt, -180, 180, "degrees, clockwise");
    add("corner", &s.corner, 0, 0.5, "radius of the corners, in sides (1: its shorter side)");
    add("backdrop", &s.backdrop, 0, 1, "reflectance of the neutral backdrop");
    add("backdrop_gradient", &s.backdrop_gradient, -1, 1, "relative, top to bottom");
    add("mount", &s.mount, 0, 1, "a rod holds the specimen from above");
    add("mount_width", &s.mount_width, 0.001, 1, "sides");
    add("light_gradient", &s.light_gradient, -1, 1, "relative, over one short side of the frame");
    add("light_direction", &s.light_direction, -360, 360, "degrees, where it is brighter");
    add("vignette", &s.vignette, 0, 0.5, "relative loss half a short side from the middle");
    add("texture", &s.texture, 0, 1, "log amplitude of the brushing");
    add("texture_angle", &s.texture_angle, -360, 360, "degrees, along the brush lines");
    add("texture_scale", &s.texture_scale, 0.0005, 1, "width of a brush line, sides");
    add("glint", &s.glint, 0, 100, "peak of the lamp's reflection, linear light");
    add("glint_x", &s.glint_x, -1, 20, "sides from the specimen's left");
    add("glint_y", &s.glint_y, -1, 20, "sides from its top");
    add("glint_size", &s.glint_size, 0.001, 10, "sides");
    add("shadow", &s.shadow, 0, 1, "depth of the specimen's soft shadow");
}

void add_susceptibility(SusceptibilitySpec& s, std::vector<SpecField>& f) {
    const Section add{f, "susceptibility"};
    add("pattern", choice(s.pattern, {"gaussian", "reaction_diffusion"}), 0, 0,
        "smooth noise, or the spots and labyrinths of Gray and Scott");
    add("spread", &s.spread, 0, 2, "standard deviation of log rho");
    add("coarse", &s.coarse, 0.01, 100, "correlation length of the broad pattern, sides");
    add("fine", &s.fine, 0.001, 100, "and of the fine one");
    add("fine_share", &s.fine_share, 0, 1, "share of the fine pattern in the variance");
    add("stretch", &s.stretch, 1, 100, "longer along x by this: the rolling direction");
    add("edge", &s.edge, -3, 3, "log boost at the rim");
    add("edge_width", &s.edge_width, 0.001, 10, "over which it falls to 1/e, sides");
    add("drip", &s.drip, -3, 3, "log amplitude of streaks that run down");
    add("feed", &s.feed, 0, 0.2, "of Gray and Scott; other pairs, other patterns");
    add("kill", &s.kill, 0, 0.2, "spots at feed 0.03 and kill 0.063, labyrinths at 0.035, 0.06");
    add("steps", &s.steps, 0, 100000, "of the reaction");
    add("reaction_scale", &s.reaction_scale, 0.016, 0.25, "four cells of the reaction, sides");
}

void add_nucleation(NucleationSpec& s, std::vector<SpecField>& f) {
    const Section add{f, "nucleation"};
    add("initial", &s.initial, 0, 1, "share that grows at the start; 1 is all of it");
    add("seeds", &s.seeds, 0, 1000, "nuclei per side^2 and unit");
    add("seed_radius", &s.seed_radius, 0, 0.2, "sides");
    add("growth", &s.growth, 0, 10, "a of a rho theta (1 - theta), per unit");
    add("diffusion", &s.diffusion, 0, 0.01, "of the coverage, sides^2 per unit");
}

void add_oxide(OxideSpec& s, std::vector<SpecField>& f) {
    const Section add{f, "oxide"};
    add("initial_nm", &s.initial_nm, 0, 5000, "thickness at the start, nm");
    add("initial_follows", &s.initial_follows, 0, 2,
        "the start is initial_nm rho^this: 0 even, 1/3 as if grown before");
    add("rate", &s.growth.parabolic_rate, 1e-9, 1e6, "k_p of the parabolic law, nm^2 per unit");
    add("thin_film", choice(s.growth.thin_film, {"direct_logarithmic", "inverse_logarithmic"}), 0,
        0, "the law below 5 nm");
    add("logarithmic_nm", &s.growth.logarithmic_nm, 0.1, 10, "its length, nm");
    add("inverse_nm", &s.growth.inverse_nm, 0.1, 50, "its length, nm");
    add("cu2o_fresh", &s.chemistry.fresh, 0, 1, "share of Cu2O in thin films, the rest is CuO");
    add("cu2o_aged", &s.chemistry.aged, 0, 1, "and in thick ones");
    add("fresh_nm", &s.chemistry.fresh_nm, 0, 5000, "up to here a film is thin, nm");
    add("aged_nm", &s.chemistry.aged_nm, 0, 5000, "from here on it is thick, nm");
    add("thickness_spread", &s.thickness_spread, 0, 0.3, "relative, within a pixel");
    add("roughness_factor", &s.roughness_factor, 1, 5, "true area over projected area");
    add("brown_limit", &s.brown_limit, 0, 1, "thick films turn into a brown crust");
    add("metal_table", &s.metal_table, 0, 0, "CSV with wavelength_nm, n, k; empty: copper");
    add("cuprous_table", &s.cuprous_table, 0, 0, "empty: Cu2O");
    add("cupric_table", &s.cupric_table, 0, 0, "empty: CuO");
}

void add_environment(EnvironmentOptions& s, std::vector<SpecField>& f) {
    const Section add{f, "environment"};
    add("noise", &s.noise, 0, 2, "standard deviation of the pace; 0 in a chamber");
    add("correlation", &s.correlation, 0.01, 1e4, "of that noise, units");
    add("diurnal", &s.diurnal, 0, 2, "amplitude of the day");
    add("day", &s.day, 0.01, 1e6, "its length, units");
    add("phase", &s.phase, -1e6, 1e6, "where in it the recording starts, days");
}

void add_patina(PatinaSpec& s, std::vector<SpecField>& f) {
    const Section add{f, "patina"};
    add("rate", &s.growth.rate, 0, 1000, "of the green layer where it is wet, um per unit");
    add("onset_nm", &s.growth.onset_nm, 0, 1e5, "of oxide before any green forms");
    add("wet_spread", &s.wet_spread, 0, 3, "standard deviation of log wetness");
    add("wet_scale", &s.wet_scale, 0.01, 100, "its correlation length, sides");
    add("wet_runs", &s.wet_runs, 0.1, 100, "longer downwards by this");
    add("wet_share", &s.wet_share, 0, 1, "share of the time that is wet");
}

void add_camera(CameraSpec& s, std::vector<SpecField>& f) {
    const Section add{f, "camera"};
    add("exposure", &s.exposure, 0.01, 100, "linear gain at the start");
    add("auto_exposure", &s.auto_exposure, 0, 1, "share of a change of the mean it takes back");
    add("auto_exposure_lag", &s.auto_exposure_lag, 0.001, 1000, "its time constant, units");
    add("light_drift", &s.light_drift, 0, 1, "standard deviation of log light, slow");
    add("light_correlation", &s.light_correlation, 0.01, 1e4, "units");
    add("white_balance", &s.white_balance, 0, 0.5, "standard deviation of log balance per channel");
    add("white_balance_correlation", &s.white_balance_correlation, 0.01, 1e4, "units");
    add("jitter", &s.jitter, 0, 0.5, "of log light, from sample to sample (0.1 unit)");
    add("flicker", &s.flicker, 0, 0.9, "amplitude of bands that roll through the frame");
    add("flicker_bands", &s.flicker_bands, 0, 1000, "of them in a frame");
    add("shot_noise", &s.shot_noise, 0, 1, "a of variance a v + b^2, linear light, per sample");
    add("read_noise", &s.read_noise, 0, 1, "b");
    add("bits", &s.bits, 8, 16, "of a code; 16 not in .mp4");
    add("drift_gain", &s.drift_gain, 0.01, 100, "encoded R, G, B at the end: an affine drift");
    add("drift_offset", &s.drift_offset, -1, 1, "encoded R, G, B at the end");
}

}  // namespace

std::vector<SpecField> spec_fields(SimulationSpec& spec) {
    std::vector<SpecField> fields;
    add_top(spec, fields);
    add_frames(spec.frames, fields);
    add_scene(spec.scene, fields);
    add_susceptibility(spec.susceptibility, fields);
    add_nucleation(spec.nucleation, fields);
    add_oxide(spec.oxide, fields);
    add_environment(spec.environment, fields);
    add_patina(spec.patina, fields);
    add_camera(spec.camera, fields);
    return fields;
}

std::string allowed(const SpecField& field) {
    return std::visit(
        [&](const auto& value) -> std::string {
            using T = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<T, bool*>) {
                return "true and false";
            } else if constexpr (std::is_same_v<T, std::filesystem::path*>) {
                return "names of CSV files with the columns wavelength_nm, n and k";
            } else if constexpr (std::is_same_v<T, SpecChoice>) {
                return fmt::format("\"{}\"", fmt::join(value.words, "\" and \""));
            } else if constexpr (std::is_same_v<T, std::array<double, 3>*>) {
                return fmt::format("three numbers, each {} to {}", field.least, field.most);
            } else if (field.name() == "camera.bits") {
                return "8 and 16";
            } else if constexpr (std::is_same_v<T, double*>) {
                return fmt::format("{} to {}", field.least, field.most);
            } else {
                return fmt::format("whole numbers from {} to {}", field.least, field.most);
            }
        },
        field.value);
}

std::string complaint(const SpecField& field) {
    const auto outside = [&](double v) { return !(v >= field.least && v <= field.most); };
    return std::visit(
        [&](const auto& value) -> std::string {
            using T = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<T, double*> || std::is_same_v<T, int*>) {
                if (outside(double(*value)))
                    return fmt::format("{} is {}; allowed are {}", field.name(), *value,
                                       allowed(field));
            } else if constexpr (std::is_same_v<T, std::array<double, 3>*>) {
                for (const double v : *value) {
                    if (outside(v))
                        return fmt::format("{} is [{}]; allowed are {}", field.name(),
                                           fmt::join(*value, ", "), allowed(field));
                }
            }
            return {};
        },
        field.value);
}

void check_spec(const SimulationSpec& spec) {
    SimulationSpec copy = spec;
    for (const SpecField& field : spec_fields(copy)) {
        if (const std::string text = complaint(field); !text.empty())
            throw Error(ErrorCode::usage, text);
    }
    const auto refuse = [](const std::string& text) { throw Error(ErrorCode::usage, text); };
    if (spec.camera.bits != 8 && spec.camera.bits != 16)
        refuse(fmt::format("camera.bits is {}; allowed are 8 and 16", spec.camera.bits));
    if (spec.oxide.chemistry.fresh_nm > spec.oxide.chemistry.aged_nm)
        refuse(fmt::format("oxide.fresh_nm is {}; allowed are 0 to oxide.aged_nm, which is {}",
                           spec.oxide.chemistry.fresh_nm, spec.oxide.chemistry.aged_nm));
    const double longer = std::fmax(spec.scene.width, spec.scene.height);
    const double shorter = std::fmin(spec.scene.width, spec.scene.height);
    if (longer > 20 * shorter)
        refuse(
            fmt::format("scene.width is {} and scene.height is {}; allowed are sides up to 20 "
                        "times each other",
                        spec.scene.width, spec.scene.height));
    // The reaction's cells, four to a scale along the longer side.
    if (4 * longer / shorter / spec.susceptibility.reaction_scale > 1024)
        refuse(
            fmt::format("susceptibility.reaction_scale is {}; allowed are {:.3g} and more on a "
                        "specimen of this shape",
                        spec.susceptibility.reaction_scale, longer / shorter / 256));
    const double frame_short = std::fmin(spec.frames.width, spec.frames.height);
    const double angle = spec.scene.tilt * std::numbers::pi / 180;
    const double c = std::fabs(std::cos(angle)), s = std::fabs(std::sin(angle));
    const double half_w = (spec.scene.width * c + spec.scene.height * s) / 2 * frame_short;
    const double half_h = (spec.scene.width * s + spec.scene.height * c) / 2 * frame_short;
    const double x = spec.scene.center_x * spec.frames.width;
    const double y = spec.scene.center_y * spec.frames.height;
    // A specimen may be cut by the frame, or fill it; what is not seen at all is a mistake.
    if (x + half_w < 1 || y + half_h < 1 || x - half_w > spec.frames.width - 1 ||
        y - half_h > spec.frames.height - 1)
        refuse(
            fmt::format("scene.center_x is {} and scene.center_y is {}; allowed are centers "
                        "from which the specimen reaches into the frame",
                        spec.scene.center_x, spec.scene.center_y));
}

}  // namespace verdigris
