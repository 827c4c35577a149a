// SPDX-License-Identifier: MIT
#include "arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "verdigris/error.h"
#include "verdigris/observe/unit_axis.h"

namespace verdigris::cli {
namespace {

bool parse_int(std::string_view text, int& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

void ObserveArguments::add(CLI::App& command) {
    command.add_option("--crop", crop, "auto, none, or x,y,w,h in pixels of the shown frame")
        ->capture_default_str();
    command
        .add_option("--size", size,
                    "native, or the side in pixels to resample the crop to. Memory grows with the "
                    "area: a run takes about 1.4 GB at 2048, 5 GB at 4096")
        ->capture_default_str();
    command
        .add_option("--units", units,
                    fmt::format("Accelerated units the recording spans (default: {}, or one per "
                                "frame when there are fewer than {:.0f} frames)",
                                kUnitsPerRecording, std::ceil(kFramesForUnitGrid)))
        ->check(CLI::PositiveNumber);
    command.add_option("--tau", tau, "Dead-zone on the change (default: 2.40 times the noise)")
        ->check(CLI::Range(1e-6, 1.0));
    command.add_option("--assume-matrix", assume_matrix,
                       "YUV matrix where the file does not say: bt709, bt601, bt2020");
    command.add_option("--assume-range", assume_range,
                       "Range where the file does not say: limited, full");
}

ObserveOptions ObserveArguments::options() const {
    ObserveOptions o;
    if (crop == "auto") {
        o.crop.mode = CropMode::automatic;
    } else if (crop == "none") {
        o.crop.mode = CropMode::none;
    } else {
        o.crop.mode = CropMode::manual;
        std::vector<int> v;
        std::size_t start = 0;
        while (start <= crop.size()) {
            const std::size_t end = std::min(crop.find(',', start), crop.size());
            int value = 0;
            if (!parse_int(std::string_view(crop).substr(start, end - start), value)) break;
            v.push_back(value);
            start = end + 1;
        }
        if (v.size() != 4 || start <= crop.size() || v[0] < 0 || v[1] < 0 || v[2] < 1 || v[3] < 1) {
            throw Error(ErrorCode::usage,
                        fmt::format("--crop takes auto, none or x,y,w,h (four whole numbers, "
                                    "width and height at least 1), not '{}'",
                                    crop));
        }
        o.crop.rect = {v[0], v[1], v[2], v[3]};
    }
    if (size != "native" && (!parse_int(size, o.size) || o.size < 8 || o.size > 16384)) {
        throw Error(ErrorCode::usage,
                    fmt::format("--size takes native or a side from 8 to 16384, not '{}'", size));
    }
    if (!std::isfinite(units) || units > 1e6 || !std::isfinite(tau)) {
        throw Error(ErrorCode::usage, "--units and --tau are plain numbers, --units at most 1e6");
    }
    if (units > 0) o.units = units;
    if (tau > 0) o.tau = tau;
    o.keep = every_sample ? Keep::every_sample : Keep::unit_steps;
    return o;
}

RecordingOptions ObserveArguments::recording_options() const {
    RecordingOptions o;
    o.assume_matrix = assume_matrix;
    o.assume_range = assume_range;
    return o;
}

void ForecastArguments::add(CLI::App& command) {
    command.add_option("--context", context, "Observed units to fit on; 10 is the paper's advice")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command.add_option("--horizons", horizons, "Accelerated units ahead, comma-separated")
        ->delimiter(',')
        ->capture_default_str();
    command
        .add_option("--forecaster", forecaster,
                    fmt::format("One of: {}; or a network that `train` made, "
                                "RUN/best.safetensors",
                                fmt::join(forecaster_names(), ", ")))
        ->capture_default_str();
    command.add_option("--ridge-k", ridge_k, "Ridge of the fit in noise variances; 0: the paper")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1e9));
    command.add_option("--fit-pixels", fit_pixels, "all (the paper) or specimen")
        ->capture_default_str()
        ->check(CLI::IsMember({"all", "specimen"}));
    command.add_flag("--no-clamp", no_clamp, "Let colors leave the displayable range");
}

ChooseOptions ForecastArguments::options() const {
    ChooseOptions o;
    o.ridge_k = ridge_k;
    o.pixels = fit_pixels == "all" ? FitPixels::all : FitPixels::specimen;
    o.clamp = !no_clamp;
    return o;
}

std::vector<double> ForecastArguments::sorted_horizons() const {
    std::vector<double> h = horizons;
    if (h.empty()) throw Error(ErrorCode::usage, "--horizons is empty");
    if (h.size() > 64) throw Error(ErrorCode::usage, "--horizons takes at most 64 values");
    for (double v : h) {
        if (!(v >= 0.1 - 1e-6) || v > 1000) {
            throw Error(ErrorCode::usage,
                        fmt::format("--horizons are accelerated units from 0.1 to 1000, "
                                    "not {}",
                                    v));
        }
        // File names carry one decimal: finer horizons would overwrite each other.
        if (std::fabs(v * 10 - std::round(v * 10)) > 1e-6) {
            throw Error(ErrorCode::usage,
                        fmt::format("--horizons have at most one decimal, not {}", v));
        }
    }
    for (double& v : h) v = std::round(v * 10) / 10;
    std::sort(h.begin(), h.end());
    h.erase(std::unique(h.begin(), h.end()), h.end());
    return h;
}

void MaterialArguments::add(CLI::App& command) {
    MaterialOptions& o = options;
    command
        .add_option(
            "--clean-state", clean_state,
            "What counts as clean metal: context (the paper: the observed state), start "
            "(the start of the recording), auto (start if the specimen has visibly left it)")
        ->capture_default_str()
        ->check(CLI::IsMember({"auto", "context", "start"}));
    const std::string group = "Material (defaults are the paper's)";
    const auto number = [&](const char* name, double& value, const char* help) {
        command.add_option(name, value, help)->capture_default_str()->group(group);
    };
    number("--coverage-exponent", o.coverage_exponent, "Shapes the coverage");
    number("--normalizer-percentile", o.normalizer_percentile, "Change that counts as full cover");
    number("--roughness-clean", o.roughness_clean, "Roughness of the clean state");
    number("--roughness-patina", o.roughness_patina, "Roughness at full coverage");
    number("--roughness-gamma", o.roughness_gamma, "How quickly roughness responds");
    number("--micro-roughness", o.micro_roughness, "Amplitude of the micro-roughness");
    number("--micro-range", o.micro_range, "High-pass amplitude that counts as full");
    number("--micro-sigma", o.micro_sigma, "Low-pass of the micro-roughness, pixels");
    number("--metallic-clean", o.metallic_clean, "Metallic of the clean state");
    number("--metallic-patina", o.metallic_patina, "Metallic at full coverage");
    number("--metallic-gamma", o.metallic_gamma, "How quickly metallic responds");
    number("--height-patina-weight", o.height_patina_weight, "Share of the patina in the height");
    number("--height-sigma", o.height_sigma, "Smoothing of the luma, pixels");
    number("--normal-scale", o.normal_scale, "Gradient scale of the normals");
    number("--normal-gain", o.normal_gain, "8: plain Sobel; 1: gradient per pixel");
    number("--reference-horizon", o.reference_horizon,
           "Units at which the coverage is normalized (0: twice the context)");
}

void MaterialArguments::check() const {
    const MaterialOptions& o = options;
    const auto require = [](bool fine, const char* name, double value, const char* range) {
        if (!fine) {
            throw Error(ErrorCode::usage,
                        fmt::format("--{} must be {}, not {}", name, range, value));
        }
    };
    const auto unit = [&](const char* name, double v) {
        require(v >= 0 && v <= 1, name, v, "between 0 and 1");
    };
    const auto positive = [&](const char* name, double v, double most) {
        require(v > 0 && v <= most, name, v, fmt::format("above 0 and at most {}", most).c_str());
    };
    unit("roughness-clean", o.roughness_clean);
    unit("roughness-patina", o.roughness_patina);
    unit("micro-roughness", o.micro_roughness);
    unit("metallic-clean", o.metallic_clean);
    unit("metallic-patina", o.metallic_patina);
    unit("height-patina-weight", o.height_patina_weight);
    positive("normalizer-percentile", o.normalizer_percentile, 1);
    positive("coverage-exponent", o.coverage_exponent, 10);
    positive("roughness-gamma", o.roughness_gamma, 10);
    positive("metallic-gamma", o.metallic_gamma, 10);
    positive("micro-range", o.micro_range, 1);
    positive("micro-sigma", o.micro_sigma, 16);
    positive("height-sigma", o.height_sigma, 16);
    require(o.normal_scale >= 0 && o.normal_scale <= 100, "normal-scale", o.normal_scale,
            "between 0 and 100");
    require(o.normal_gain >= 0 && o.normal_gain <= 100, "normal-gain", o.normal_gain,
            "between 0 and 100");
    require(o.reference_horizon >= 0 && o.reference_horizon <= 1000, "reference-horizon",
            o.reference_horizon, "between 0 and 1000");
}

}  // namespace verdigris::cli
