// SPDX-License-Identifier: MIT
// What our commands wrote, read back for the comparison (internal). Directions and recordings are
// in the paper's places: kChamberToAir is judged on the second recording.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "verdigris/results/resolved.h"

namespace verdigris {

/// One forecaster on one held-out recording. NaN where there is no number.
struct OursForecaster {
    std::string name;
    double mean = 0, delta_e = 0;
    std::vector<double> errors, gains;  ///< per horizon 1 ..; gains of persistence: empty
    std::optional<Resolved> gain;
    std::optional<Interval> naive;
};
struct OursDirection {
    std::string label;
    int windows = 0;
    std::vector<OursForecaster> forecasters;

    const OursForecaster* find(const std::string& name) const;
};
using OursEvaluation = std::array<OursDirection, 2>;

struct OursSetting {
    std::string axis, setting;
    int context = 0;
    struct Cell {
        double error = 0, persistence = 0;
        Resolved gain;
    };
    std::vector<Cell> cells;  ///< by direction
};
struct OursFar {
    std::vector<double> moved, outside, persistence, unclamped;  ///< per horizon 1 ..
};
struct OursCharacterization {
    std::vector<OursSetting> settings;
    std::vector<OursFar> far;  ///< by direction
};

struct OursDrift {
    std::string recording;
    std::optional<double> specimen, reference, ratio, correlation;
    /// "none", "gain", "offset", "both"
    std::map<std::string, Resolved> gains;
};

struct OursCorrelation {
    double r = 0, error = 0;  ///< error NaN: too few windows
};
/// Of one network: recording 0 is the one it learned from.
struct OursSusceptibility {
    std::array<std::string, 2> recordings;
    std::array<OursCorrelation, 2> within, change;
    OursCorrelation cross;
};

/// FLIP and LPIPS by horizon in units.
struct OursMaterial {
    std::string name;
    std::map<int, double> flip, lpips;
    std::map<int, Resolved> gain;  ///< over the static control
};
struct OursMaterials {
    std::string control, no_lpips;
    std::array<std::string, 2> labels;
    std::array<std::vector<OursMaterial>, 2> forecasters;
};

struct OursTraining {
    double validation = 0, persistence = 0;
    int epoch = 0, epochs = 0;
};

/// Mean colors by sample: "specimen_red" ... "reference_blue".
struct OursSeries {
    std::string recording;
    std::map<std::string, std::vector<double>> values;
};

/// All throw Error{bad_input} naming the file: missing, or not what the command writes.
OursEvaluation read_ours_evaluation(const std::filesystem::path& folder);
/// Of one recording by itself.
OursDirection read_ours_single(const std::filesystem::path& folder);
/// Of two recordings, or (`directions` 1) of one by itself.
OursCharacterization read_ours_characterization(const std::filesystem::path& folder,
                                                std::size_t directions);
/// By recording, in the order given.
std::vector<OursDrift> read_ours_drift(const std::filesystem::path& folder);
/// The series that `drift` writes beside its tables, in the same order.
std::vector<OursSeries> read_ours_series(const std::filesystem::path& folder);
OursSusceptibility read_ours_susceptibility(const std::filesystem::path& folder);
/// The one place that knows what `judge-materials` writes.
OursMaterials read_ours_materials(const std::filesystem::path& folder);
OursTraining read_ours_training(const std::filesystem::path& run);

}  // namespace verdigris
