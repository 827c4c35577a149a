// SPDX-License-Identifier: MIT
#include "verdigris/study/transfer_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "verdigris/error.h"
#include "verdigris/evaluate/characterize.h"
#include "verdigris/evaluate/evaluate.h"
#include "verdigris/learn/train.h"
#include "verdigris/simulate/simulate.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {

// Numbers of patterns and days that no two uses share.
constexpr int kOtherPattern = 1000, kTestPattern = 2000, kSecondDay = 500;
constexpr int kStates = 1 << kTransferFactors;

EvaluationProtocol study_protocol(const TransferStudyOptions& o) {
    EvaluationProtocol protocol;  // the paper's grid, windows and splits
    protocol.max_windows = o.test_windows;
    protocol.single = true;  // what is held out is decided here, specimen by specimen
    protocol.delta_e = false;
    protocol.hash_frames = false;
    return protocol;
}

class Study {
  public:
    Study(const TransferStudyOptions& options, const fs::path& runs, const Progress& progress)
        : options_(options), runs_(runs), progress_(progress), protocol_(study_protocol(options)) {
        const int networks = int(options.networks.size());
        const int counted =
            int(std::ranges::count_if(options.specimens, [](int n) { return n > 1; }));
        total_ = std::int64_t(options.presets.size()) * options.seeds *
                 (networks * (1 + counted) + kStates + int(options.specimens.size()));
    }

    TransferStudy run() {
        TransferStudy study;
        study.options = options_;
        for (const std::string& preset : options_.presets) {
            for (int seed = 1; seed <= options_.seeds; ++seed) {
                const std::vector<Entrant> one = trained(study, preset, seed, 1);
                for (int state = 0; state < kStates; ++state) {
                    const TransferChange change = transfer_change(state);
                    const int pattern = change.pattern ? kOtherPattern + seed : seed;
                    const Observation test = observed(preset, pattern, kSecondDay + seed, change);
                    study.cells.push_back({preset, seed, change, scores(test, one)});
                    done();
                }
                for (const int n : options_.specimens) {
                    const std::vector<Entrant> entrants =
                        n == 1 ? one : trained(study, preset, seed, n);
                    const Observation test =
                        observed(preset, kTestPattern + seed, kSecondDay + seed, {.pose = true});
                    study.counts.push_back({preset, seed, n, scores(test, entrants)});
                    done();
                }
            }
        }
        return study;
    }

  private:
    void done() { report(progress_, "study", ++done_, total_); }

    Observation observed(const std::string& preset, int specimen, int day,
                         const TransferChange& change) {
        ObserveOptions options;
        options.crop.mode = CropMode::none;  // the frame is what stays where it is
        options.size = options_.size;
        options.keep = Keep::every_sample;
        const SimulationSpec spec = transfer_spec(preset, specimen, day, change, options_.size);
        Observation o = observe(simulated_recording(spec, progress_), options, progress_);
        // Part of what a training is recognized by when it is resumed.
        o.source_name = fmt::format(
            "{} specimen {}, day {}{}{}{}", preset, specimen, day, change.pose ? ", moved" : "",
            change.camera ? ", other camera" : "", change.kinetics ? ", other kinetics" : "");
        return o;
    }

    /// Networks that learned from `n` specimens, the first of them that of `seed` in its usual
    /// pose.
    std::vector<Entrant> trained(TransferStudy& study, const std::string& preset, int seed, int n) {
        std::vector<Observation> observations;
        for (int i = 0; i < n; ++i) {
            const int specimen = learned_specimen(seed, i);
            observations.push_back(observed(preset, specimen, specimen, {.pose = i % 2 != 0}));
        }
        EvaluationProtocol protocol = protocol_;
        std::vector<TrainingSource> sources;
        for (const Observation& o : observations) {
            const WindowPlan plan = plan_windows(protocol, o.store->count(), o.source_name);
            sources.push_back({o.source_name, &o, plan.splits->train, plan.splits->validation});
        }
        const int windows = options_.train_windows > 0
                                ? options_.train_windows
                                : windows_inside(sources.front().train, protocol.span());
        std::vector<Entrant> entrants;
        for (const NetworkKind kind : options_.networks) {
            TrainOptions train;
            train.kind = kind;
            train.epochs = options_.epochs;
            train.seed = std::uint64_t(seed);
            train.max_windows = std::max(1, windows / n);  // as many steps, whatever n
            train.threads = options_.threads;
            train.resume = true;
            const fs::path folder =
                runs_ / fmt::format("{}-{}-seed{}-of{}", to_string(kind), preset, seed, n);
            const TrainedNetwork network =
                train_network(protocol, sources, train, folder, progress_);
            if (n == 1) {
                study.own.push_back({preset, to_string(kind), seed, network.facts.validation_error,
                                     network.facts.validation_persistence});
            }
            entrants.push_back(training_free(
                as_forecaster(network.network, to_string(kind), units_to(protocol.horizons))));
            done();
        }
        Entrant affine = training_free(affinergb(paper_affine()));
        affine.name = "affinergb";
        entrants.push_back(std::move(affine));
        return entrants;
    }

    std::vector<TransferScore> scores(const Observation& test,
                                      const std::vector<Entrant>& entrants) {
        const Evaluation evaluation = evaluate(protocol_, std::span(&test, 1), entrants, progress_);
        const Direction& d = evaluation.directions.front();
        if (d.starts.empty()) {
            throw Error(ErrorCode::refused, "leaves no window to score: too little changes",
                        test.source_name);
        }
        const double persistence = overall_mean(d.persistence().foreground);
        std::vector<TransferScore> list;
        for (std::size_t i = 1; i < d.entrants.size(); ++i) {
            list.push_back(
                {d.entrants[i].name, overall_mean(d.entrants[i].foreground), persistence});
        }
        return list;
    }

    const TransferStudyOptions& options_;
    const fs::path& runs_;
    const Progress& progress_;
    EvaluationProtocol protocol_;
    std::int64_t done_ = 0, total_ = 0;
};

/// Log ratios of the states of one preset, forecaster and seed.
using States = std::array<double, kStates>;

int state_of(const TransferChange& c) {
    return int(c.pattern) | int(c.pose) << 1 | int(c.camera) << 2 | int(c.kinetics) << 3;
}

/// Mean over the states of the other factors of what changing `f` does.
double main_effect(const States& of, int f) {
    double sum = 0;
    for (int i = 0; i < kStates; ++i) sum += (i >> f & 1) != 0 ? of[i] : -of[i];
    return sum / (kStates / 2);
}

/// Mean over the states of the other factors of what changing both adds to the two alone.
double interaction(const States& of, int f, int g) {
    double sum = 0;
    for (int i = 0; i < kStates; ++i) sum += (i >> f & 1) == (i >> g & 1) ? of[i] : -of[i];
    return sum / (kStates / 4);
}

/// 97.5 % points of Student's t [Student1908], for 1 to 10 degrees of freedom and beyond.
double student(int degrees) {
    constexpr double kPoints[] = {12.706, 4.303, 3.182, 2.776, 2.571,
                                  2.447,  2.365, 2.306, 2.262, 2.228};
    if (degrees <= 10) return kPoints[degrees - 1];
    // Beyond, its expansion around the normal distribution: within 0.001 of the tables.
    constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    const double n = degrees;
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

}  // namespace

int learned_specimen(int seed, int i) {
    if (i == 0) return seed;
    // From the fifth on they would run into the second days and the other patterns.
    return 100 * seed + i + (seed < 5 ? 0 : 10000);
}

TransferStudyOptions quick_transfer_study() {
    TransferStudyOptions o;
    o.networks = {NetworkKind::patinanet};
    o.presets = {"chamber"};
    o.seeds = 2;
    o.specimens = {1, 2};
    o.size = 32;
    o.epochs = 2;
    o.train_windows = 64;
    o.test_windows = 20;
    return o;
}

double TransferScore::log_ratio() const {
    return std::log(error / persistence);
}

TransferChange transfer_change(int number) {
    const auto other = [number](int factor) { return (number >> factor & 1) != 0; };
    return {other(0), other(1), other(2), other(3)};
}

std::string other_place(const std::string& preset) {
    return preset == "air" ? "chamber" : "air";
}

SimulationSpec transfer_spec(const std::string& preset, int specimen, int day,
                             const TransferChange& change, int size) {
    SimulationSpec spec = preset_spec(preset);
    const SimulationSpec other = preset_spec(other_place(preset));
    if (change.camera) {
        spec.camera = other.camera;
        spec.scene.light_gradient = other.scene.light_gradient;
        spec.scene.light_direction = other.scene.light_direction;
        spec.scene.vignette = other.scene.vignette;
        spec.scene.glint = other.scene.glint;
        spec.scene.glint_x = other.scene.glint_x;
        spec.scene.glint_y = other.scene.glint_y;
        spec.scene.glint_size = other.scene.glint_size;
    }
    if (change.kinetics) {
        spec.nucleation = other.nucleation;
        spec.oxide = other.oxide;
        spec.environment = other.environment;
        spec.patina = other.patina;
    }
    spec.seed = std::uint64_t(100000 + day);
    spec.specimen_seed = std::uint64_t(specimen);
    // chosen: twice the samples' size, so that they are averages of pixels as any recording's are.
    spec.frames.width = spec.frames.height = 2 * size;
    if (change.pose) {
        spec.scene.tilt += 8;
        spec.scene.center_x += 0.05;
        spec.scene.center_y -= 0.05;
        spec.scene.width *= 0.9;
        spec.scene.height *= 0.9;
    }
    return spec;
}

void check_transfer_options(const TransferStudyOptions& o) {
    const auto must = [](bool holds, const char* what) {
        if (!holds) throw Error(ErrorCode::usage, what);
    };
    must(!o.networks.empty() && !o.presets.empty(), "a study needs a network and a preset");
    for (auto i = o.networks.begin(); i != o.networks.end(); ++i)
        must(std::find(o.networks.begin(), i, *i) == i, "a network is named twice");
    for (auto i = o.presets.begin(); i != o.presets.end(); ++i) {
        must(std::find(o.presets.begin(), i, *i) == i, "a preset is named twice");
        preset_spec(*i);  // there is one
    }
    must(o.seeds >= 1 && o.seeds <= 50, "seeds must be 1 to 50");
    must(o.size >= 16 && o.size <= 256 && o.size % 8 == 0,
         "the study's size must be 16 to 256, a multiple of 8");
    must(o.epochs >= 1 && o.epochs <= 1000, "epochs must be 1 to 1000");
    must(o.test_windows >= 1 && o.train_windows >= 0, "the number of windows cannot be negative");
    for (const int n : o.specimens)
        must(n >= 1 && n <= 16, "a study can learn from 1 to 16 specimens at once");
}

TransferStudy run_transfer_study(const TransferStudyOptions& options, const fs::path& runs,
                                 const Progress& progress) {
    check_transfer_options(options);
    return Study(options, runs, progress).run();
}

SeedMean seed_mean(const std::vector<double>& values) {
    SeedMean m;
    m.count = int(values.size());
    if (values.empty()) return m;
    for (const double v : values) m.mean += v / m.count;
    m.low = m.high = m.mean;
    if (m.count < 2) return m;
    double sum = 0;
    for (const double v : values) sum += (v - m.mean) * (v - m.mean);
    const double half = student(m.count - 1) * std::sqrt(sum / (m.count - 1) / m.count);
    m.low -= half;
    m.high += half;
    return m;
}

std::vector<TransferEffects> transfer_effects(const TransferStudy& study) {
    // By preset and forecaster, then by seed.
    std::map<std::pair<std::string, std::string>, std::map<int, States>> table;
    for (const TransferCell& c : study.cells) {
        for (const TransferScore& s : c.scores)
            table[{c.preset, s.forecaster}][c.seed][state_of(c.change)] = s.log_ratio();
    }
    std::vector<TransferEffects> effects;
    for (const auto& [key, seeds] : table) {
        const auto over_seeds = [&seeds](const auto& value) {
            std::vector<double> values;
            for (const auto& [seed, states] : seeds) values.push_back(value(states));
            return seed_mean(values);
        };
        TransferEffects e;
        e.preset = key.first;
        e.forecaster = key.second;
        for (int f = 0; f < kTransferFactors; ++f)
            e.of[f] = over_seeds([f](const States& s) { return main_effect(s, f); });
        e.pattern_and_pose = over_seeds([](const States& s) { return interaction(s, 0, 1); });
        e.camera_and_kinetics = over_seeds([](const States& s) { return interaction(s, 2, 3); });
        e.day_only = over_seeds([](const States& s) { return s[0]; });
        effects.push_back(std::move(e));
    }
    return effects;
}

}  // namespace verdigris
