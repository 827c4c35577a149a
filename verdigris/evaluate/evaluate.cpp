// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/evaluate/foreground.h"
#include "verdigris/evaluate/held_recording.h"
#include "verdigris/evaluate/repeat_check.h"
#include "verdigris/evaluate/watched_store.h"
#include "verdigris/evaluate/window_scorer.h"
#include "verdigris/observe/with_samples.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

constexpr int kWindowsAtOnce = 32;    // chosen: half a second between two reports
constexpr double kMostBytes = 800e6;  // chosen: an evaluation stays below 1 GB
constexpr const char* kPersistence = "persistence";

/// Recordings under distinct names, with what the protocol makes of them.
struct Entry {
    const Observation* observation = nullptr;
    RecordingRecord record;
    WindowPlan plan;
};

void check_observation(const Observation& observation) {
    const std::string& where = observation.source_name;
    if (!observation.store || observation.store->count() < 1) {
        throw Error(ErrorCode::bad_input, "the observation holds no sample", where);
    }
    if (observation.axis.samples > 0 && observation.store->count() != observation.axis.samples) {
        throw Error(ErrorCode::bad_input,
                    fmt::format("only {} of {} samples were kept; an evaluation needs every one",
                                observation.store->count(), observation.axis.samples),
                    where);
    }
    if (!observation.specimen.empty()) {
        if (!observation.specimen.same_size(observation.width(), observation.height())) {
            throw Error(ErrorCode::bad_input, "the specimen's mask and the samples differ in size",
                        where);
        }
        if (std::ranges::count(observation.specimen.pixels(), std::uint8_t(0)) ==
            std::int64_t(observation.specimen.pixel_count())) {
            throw Error(ErrorCode::bad_input, "the specimen's mask is empty", where);
        }
    }
}

std::string unique_name(const std::string& wanted, const std::vector<Entry>& others) {
    const std::string base = wanted.empty() ? "recording" : wanted;
    std::string name = base;
    for (int n = 2;; ++n) {
        const bool taken =
            std::ranges::any_of(others, [&](const Entry& e) { return e.record.name == name; });
        if (!taken) return name;
        name = fmt::format("{} ({})", base, n);
    }
}

void refuse_copies(const std::vector<Entry>& entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const RecordingRecord &a = entries[j].record, &b = entries[i].record;
            const std::set<std::string> frames(a.frame_hashes.begin(), a.frame_hashes.end());
            const auto shared = std::ranges::count_if(
                b.frame_hashes, [&](const std::string& h) { return frames.contains(h); });
            // chosen: half. A shared title or black lead-in is left to the audit.
            if ((!a.sha256.empty() && a.sha256 == b.sha256) ||
                2 * std::size_t(shared) > b.frame_hashes.size()) {
                throw Error(ErrorCode::refused,
                            fmt::format("{} and {} are two copies of one recording: nothing would "
                                        "be held out",
                                        a.name, b.name));
            }
            const double likeness = surface_likeness(a.surface, b.surface);
            if (likeness >= kNearCopy) {
                throw Error(ErrorCode::refused, near_copy_sentence(a.name, b.name, likeness) +
                                                    ", so that nothing would be held out");
            }
        }
    }
}

std::vector<Entry> entries_of(const EvaluationProtocol& protocol,
                              std::span<const Observation> observations, const Progress& progress) {
    std::vector<Entry> entries;
    for (const Observation& observation : observations) {
        check_observation(observation);
        Entry entry;
        entry.observation = &observation;
        entry.plan = plan_windows(protocol, observation.store->count(), observation.source_name);
        const double bytes = double(entry.plan.usable.count()) * sizeof(SrgbF) *
                             observation.width() * observation.height();
        if (bytes > kMostBytes) {
            throw Error(ErrorCode::bad_input,
                        fmt::format("{} samples of {} x {} pixels take {:.1f} GB; observe it at a "
                                    "smaller size (the paper: 128 x 128)",
                                    entry.plan.usable.count(), observation.width(),
                                    observation.height(), bytes / 1e9),
                        observation.source_name);
        }
        entry.record.name = unique_name(observation.source_name, entries);
        entry.record.sha256 = observation.source_sha256;
        entry.record.samples = observation.store->count();
        entry.record.usable = entry.plan.usable;
        entry.record.surface = surface_print(observation, entry.plan.usable);
        if (protocol.hash_frames) {
            entry.record.frame_hashes =
                frame_hashes(*observation.store, entry.plan.usable, progress);
        }
        entries.push_back(std::move(entry));
    }
    refuse_copies(entries);
    return entries;
}

/// Persistence first.
std::vector<Entrant> with_persistence(const std::vector<Entrant>& entrants) {
    std::vector<Entrant> all{training_free(persistence())};
    std::set<std::string> names{kPersistence};
    for (const Entrant& e : entrants) {
        if (!e.trained() && e.name == kPersistence) continue;
        if (!e.trained() && !e.forecaster.forecast) {
            throw Error(ErrorCode::usage, fmt::format("'{}' has nothing to forecast with", e.name));
        }
        if (!names.insert(e.name).second) {
            throw Error(ErrorCode::usage, fmt::format("two forecasters are named '{}'", e.name));
        }
        all.push_back(e);
    }
    return all;
}

void check_enough(const EvaluationProtocol& protocol, std::span<const Observation> observations,
                  const std::vector<Entrant>& entrants) {
    if (observations.empty()) {
        throw Error(ErrorCode::usage, "an evaluation needs at least one recording");
    }
    if (!protocol.single && observations.size() < 2) {
        throw Error(ErrorCode::refused,
                    "one recording holds nothing out; add another, or ask for a within-recording "
                    "result of training-free forecasters (--single)");
    }
    if (!protocol.single) return;
    for (const Entrant& e : entrants) {
        if (!e.trained()) continue;
        throw Error(ErrorCode::refused,
                    fmt::format("'{}' is trained, and a single recording leaves nothing to judge "
                                "it on; add another recording",
                                e.name));
    }
}

/// Trains on all but `held_out`, and notes which samples were read.
std::vector<Forecaster> forecasters_for(const std::vector<Entrant>& entrants,
                                        const std::vector<Entry>& entries, std::size_t held_out,
                                        DirectionRecord& record, const Progress& progress) {
    struct Watched {
        std::shared_ptr<WatchedStore> store;
        Observation observation;
    };
    std::vector<Watched> watched;
    std::vector<TrainingSource> sources;
    const bool train = std::ranges::any_of(entrants, &Entrant::trained);
    watched.reserve(entries.size());  // the sources point into it
    for (std::size_t i = 0; train && i < entries.size(); ++i) {
        if (i == held_out) continue;
        const Entry& e = entries[i];
        if (!e.plan.splits) {
            throw Error(ErrorCode::refused, "cannot be trained on: " + e.plan.splits_problem,
                        e.record.name);
        }
        auto store = std::make_shared<WatchedStore>(e.observation->store);
        watched.push_back({store, with_samples(*e.observation, store)});
        sources.push_back({e.record.name, &watched.back().observation, e.plan.splits->train,
                           e.plan.splits->validation});
    }
    std::vector<Forecaster> forecasters;
    for (const Entrant& e : entrants) {
        if (!e.trained()) {
            forecasters.push_back(e.forecaster);
            continue;
        }
        report(progress, "train", std::int64_t(record.trained.size()), 0);
        record.trained.push_back(e.name);
        forecasters.push_back(e.train(sources));
    }
    for (std::size_t i = 0; i < sources.size(); ++i) {
        SampleUse learned{SampleRole::train, sources[i].name, sources[i].train, {}, {}, 0, 0};
        SampleUse selected{
            SampleRole::validation, sources[i].name, sources[i].validation, {}, {}, 0, 0};
        for (const int s : watched[i].store->read()) {
            // What lies in neither is held against training.
            (sources[i].validation.contains(s) ? selected : learned).samples.push_back(s);
        }
        record.uses.push_back(std::move(learned));
        record.uses.push_back(std::move(selected));
    }
    return forecasters;
}

EntrantScores tables_for(const Entrant& entrant, const EvaluationProtocol& protocol, int windows) {
    const ErrorTable table(windows, protocol.horizons);
    EntrantScores s;
    s.name = entrant.name;
    s.trained = entrant.trained();
    s.foreground = s.specimen = s.absolute = table;
    s.pixels80 = s.pixels95 = s.mean80 = s.mean95 = table;
    for (ErrorTable* t : {&s.pixels80, &s.pixels95, &s.mean80, &s.mean95})
        std::ranges::fill(t->values, std::numeric_limits<double>::quiet_NaN());
    s.bias = {table, table, table};
    if (protocol.delta_e) s.delta_e = table;
    if (protocol.out_of_gamut) s.outside = s.outside_by_a_step = table;
    return s;
}

/// Moves the rows `keep` to the front and drops the rest.
void keep_rows(ErrorTable& table, const std::vector<int>& keep) {
    if (table.empty()) return;
    ErrorTable kept(int(keep.size()), table.horizons);
    for (std::size_t i = 0; i < keep.size(); ++i) {
        for (int k = 0; k < table.horizons; ++k) kept.at(int(i), k) = table.at(keep[i], k);
    }
    table = std::move(kept);
}

void score_windows(const EvaluationProtocol& protocol, const Entry& entry,
                   const std::vector<Entrant>& entrants, const std::vector<Forecaster>& forecasters,
                   Direction& direction, Statuses& notes, const Progress& progress,
                   const WindowVisitor& visit) {
    const HeldRecording held(*entry.observation, entry.plan.usable, progress);
    const WindowScorer scorer(protocol, *entry.observation, held, direction.tau);
    direction.specimen_pixels = scorer.specimen_pixels();
    const std::vector<int>& starts = entry.plan.starts;
    const int windows = int(starts.size());
    for (const Entrant& e : entrants) {
        direction.entrants.push_back(tables_for(e, protocol, windows));
    }
    RepeatCheck repeat(protocol, scorer, starts.front(), forecasters);
    std::vector<std::int64_t> pixels(starts.size());
    ScratchPool pool;
    const int at_once = visit ? 1 : kWindowsAtOnce;
    for (int begin = 0; begin < windows; begin += at_once) {
        report(progress, "evaluate", begin, windows);
        parallel_for(std::min(at_once, windows - begin), [&](int i) {
            WindowScratch scratch = pool.take();
            scratch.keep_forecasts = bool(visit);
            const int row = begin + i;
            pixels[std::size_t(row)] = scorer.score(starts[std::size_t(row)], row, forecasters,
                                                    direction.entrants, scratch);
            pool.give(std::move(scratch));
        });
        if (!visit || pixels[std::size_t(begin)] < protocol.min_foreground) continue;
        WindowScratch scratch = pool.take();  // the only one there is
        const int start = starts[std::size_t(begin)];
        visit({direction, *entry.observation, start, scratch.context, scratch.forecasts,
               [&](int unit) -> const Image<SrgbF>& { return scorer.truth(start, unit - 1); }});
        pool.give(std::move(scratch));
    }
    report(progress, "evaluate", windows, windows);
    repeat.finish(direction, notes);

    std::vector<int> keep;
    for (int row = 0; row < windows; ++row) {
        const auto i = std::size_t(row);
        if (pixels[i] >= protocol.min_foreground) {
            keep.push_back(row);
            direction.starts.push_back(starts[i]);
            direction.foreground_pixels.push_back(pixels[i]);
            continue;
        }
        direction.skipped.push_back({starts[i], fmt::format("{} foreground pixels, fewer than {}",
                                                            pixels[i], protocol.min_foreground)});
    }
    for (EntrantScores& s : direction.entrants) {
        for (ErrorTable* t : {&s.foreground, &s.specimen, &s.absolute, &s.delta_e, &s.bias[0],
                              &s.bias[1], &s.bias[2], &s.outside, &s.outside_by_a_step, &s.pixels80,
                              &s.pixels95, &s.mean80, &s.mean95}) {
            keep_rows(*t, keep);
        }
    }
}

void check_hold_out(const EvaluationProtocol& protocol, const std::vector<Entry>& entries) {
    if (protocol.hold_out.empty()) return;
    std::string names;
    for (const Entry& e : entries) {
        if (e.record.name == protocol.hold_out) return;
        names += (names.empty() ? "" : ", ") + e.record.name;
    }
    throw Error(ErrorCode::usage,
                fmt::format("there is no recording '{}' to hold out; there are {}",
                            protocol.hold_out, names));
}

void note_skipped(const Direction& direction, Statuses& notes) {
    const std::size_t all = direction.plan.starts.size(), skipped = direction.skipped.size();
    if (skipped == 0) return;
    notes.push_back({"windows_skipped", skipped == all ? Severity::refusal : Severity::caution,
                     fmt::format("{} of {} windows of {} are skipped: too few pixels change",
                                 skipped, all, direction.held_out)});
}

}  // namespace

Entrant training_free(Forecaster forecaster) {
    Entrant entrant;
    entrant.name = forecaster.name;
    entrant.forecaster = std::move(forecaster);
    return entrant;
}

Evaluation evaluate(const EvaluationProtocol& protocol, std::span<const Observation> observations,
                    const std::vector<Entrant>& entrants, const Progress& progress,
                    const WindowVisitor& visit) {
    check_protocol(protocol);
    check_enough(protocol, observations, entrants);
    const std::vector<Entrant> all = with_persistence(entrants);
    const std::vector<Entry> entries = entries_of(protocol, observations, progress);

    Evaluation evaluation;
    evaluation.protocol = protocol;
    EvaluationRecord& record = evaluation.record;
    record.span = protocol.span();
    record.embargo = protocol.embargo_samples();
    record.single = protocol.single;
    for (const Entry& e : entries) {
        record.recordings.push_back(e.record);
        for (const Status& s : e.observation->notes) {
            // What refuses a forecast for authoring is a caution here: all is judged.
            if (s.severity != Severity::info)
                evaluation.recording_notes.push_back(
                    {s.id, Severity::caution, e.record.name + ": " + s.sentence});
        }
    }

    check_hold_out(protocol, entries);
    Statuses notes;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        if (!protocol.hold_out.empty() && protocol.hold_out != entry.record.name) continue;
        Direction direction;
        direction.held_out = entry.record.name;
        for (std::size_t j = 0; !protocol.single && j < entries.size(); ++j) {
            if (j != i) direction.sources.push_back(entries[j].record.name);
        }
        direction.plan = entry.plan;
        direction.sigma = entry.observation->noise.sigma;
        direction.tau = foreground_threshold(protocol, direction.sigma);
        DirectionRecord used;
        used.held_out = direction.held_out;
        const std::vector<Forecaster> forecasters =
            forecasters_for(all, entries, i, used, progress);
        score_windows(protocol, entry, all, forecasters, direction, notes, progress, visit);
        note_skipped(direction, notes);
        used.uses.push_back({SampleRole::test,
                             direction.held_out,
                             entry.plan.usable,
                             direction.starts,
                             {},
                             int(entry.plan.starts.size()),
                             int(direction.skipped.size())});
        record.directions.push_back(std::move(used));
        evaluation.directions.push_back(std::move(direction));
    }
    evaluation.notes = audit(record);
    evaluation.notes.insert(evaluation.notes.end(), notes.begin(), notes.end());
    return evaluation;
}

}  // namespace verdigris
