// SPDX-License-Identifier: MIT
// The study that the paper asks for and could not do: does a network fail on another specimen
// because the pattern of corrosion moved, or because the specimen did? Simulated specimens of which
// one thing is changed at a time.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/learn/learn.h"
#include "verdigris/progress.h"
#include "verdigris/simulate/spec.h"

namespace verdigris {

struct TransferStudyOptions {
    std::vector<NetworkKind> networks{NetworkKind::patinanet, NetworkKind::horizonnet};
    std::vector<std::string> presets{"chamber", "air"};
    int seeds = 3;                           ///< source specimens per preset
    std::vector<int> specimens{1, 2, 4, 8};  ///< how many are learned from, in the second part
    int size = 64;                           ///< side of the samples
    int epochs = 6;
    int train_windows = 0;  ///< per training, over all of its specimens; 0: all of one recording's
    int test_windows = 60;  ///< per recording, evenly spaced
    int threads = 0;
};
/// Small enough to try out in a few minutes: one preset, patinanet, two seeds, 32 pixels.
TransferStudyOptions quick_transfer_study();
/// Throws Error{usage} in a sentence. run_transfer_study does so first.
void check_transfer_options(const TransferStudyOptions& options);

/// One forecaster on one simulated recording.
struct TransferScore {
    std::string forecaster;             ///< "patinanet", "affinergb", ...
    double error = 0, persistence = 0;  ///< mean foreground MSE over windows and horizons
    double gain() const { return 1 - error / persistence; }
    /// log(error / persistence): below 0 is better than holding still. Effects are differences of
    /// it, because a gain has no lower bound.
    double log_ratio() const;
};

/// What is other in a recording than in the one learned from, beside the day (noise, the light's
/// wandering, the environment's), which is another in every recording judged on.
struct TransferChange {
    bool pattern = false;  ///< of the corrosion and of the brushing: all that tells specimens apart
    bool pose = false;     ///< turned by 8 degrees, moved by 5 % of the frame, a tenth smaller
    bool camera = false;   ///< camera and lamp are those of the other place
    bool kinetics = false;  ///< how the film starts and grows, and the pace of the environment, too
    bool operator==(const TransferChange&) const = default;
};
constexpr int kTransferFactors = 4;  ///< in the order of the fields of TransferChange
/// All sixteen states of the factorial; of number i, bit f says whether factor f is changed.
TransferChange transfer_change(int number);

/// The place whose camera and kinetics a specimen of `preset` gets: air, or chamber for air.
std::string other_place(const std::string& preset);

/// Part 1: trained on one specimen, tested on a recording in which some things are others.
struct TransferCell {
    std::string preset;
    int seed = 0;
    TransferChange change;
    std::vector<TransferScore> scores;
};
/// Part 2: trained on several specimens (poses and patterns differ) for as many steps, tested on
/// one of other pose and pattern.
struct SpecimenCountCell {
    std::string preset;
    int seed = 0, specimens = 0;
    std::vector<TransferScore> scores;
};

struct TransferStudy {
    TransferStudyOptions options;
    std::vector<TransferCell> cells;
    std::vector<SpecimenCountCell> counts;
    /// Of every network trained in part 1, how it did on its own recording's validation stretch.
    struct Own {
        std::string preset, network;
        int seed = 0;
        double error = 0, persistence = 0;
    };
    std::vector<Own> own;
};

/// The recording of a cell. `specimen` numbers patterns, `day` everything that wanders; of `change`
/// the pattern is ignored, which is what `specimen` says.
SimulationSpec transfer_spec(const std::string& preset, int specimen, int day,
                             const TransferChange& change, int size);

/// Number (pattern and day) of the i-th specimen that a network of `seed` learns from, i from 0 to
/// 15; of no pattern and no day that any network is judged on, and of no other seed.
int learned_specimen(int seed, int i);

/// Trains in `runs`, a folder per training, which resumes what was interrupted; recordings are
/// simulated in memory. Deterministic. Progress stages: "study" (trainings and tests done, of all)
/// and those of train_network. Throws as train_network, evaluate; Error{usage}: options.
TransferStudy run_transfer_study(const TransferStudyOptions& options,
                                 const std::filesystem::path& runs, const Progress& progress = {});

/// A mean over seeds with a 95 % interval of Student's t; no interval for fewer than two.
struct SeedMean {
    double mean = 0, low = 0, high = 0;
    int count = 0;
    bool has_interval() const { return count > 1; }
};
SeedMean seed_mean(const std::vector<double>& values);

/// The factorial's effects per preset and forecaster, on log(error / persistence), paired by seed:
/// how much worse it gets by changing one thing, mean over the eight states of the others.
struct TransferEffects {
    std::string preset, forecaster;
    std::array<SeedMean, kTransferFactors> of;  ///< in the order of TransferChange
    /// What changing both adds to the sum of the two, mean over the states of the others.
    SeedMean pattern_and_pose, camera_and_kinetics;
    /// log ratio where nothing but the day changed: what is left of what was learned.
    SeedMean day_only;
};
std::vector<TransferEffects> transfer_effects(const TransferStudy& study);

}  // namespace verdigris
