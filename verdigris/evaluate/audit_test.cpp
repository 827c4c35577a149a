// SPDX-License-Identifier: MIT
// Every leak we could think of, planted; each must be found, and only it.
#include "verdigris/evaluate/audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>

#include "verdigris/evaluate/evaluate.h"
#include "verdigris/evaluate/peeking.h"
#include "verdigris/evaluate/testing.h"
#include "verdigris/forecast/affine.h"

namespace verdigris {
namespace {

using testing::affine_recording;

std::vector<int> range(int begin, int end) {
    std::vector<int> out(std::size_t(end - begin));
    std::iota(out.begin(), out.end(), begin);
    return out;
}

/// The paper's protocol, kept: trained on the chamber, tested on air.
EvaluationRecord clean() {
    const EvaluationProtocol paper;
    const WindowPlan plan = plan_windows(paper, 984);
    EvaluationRecord record;
    record.span = paper.span();
    record.embargo = paper.embargo_samples();
    for (const char* name : {"chamber", "air"}) {
        RecordingRecord r{name, std::string("sha of ") + name, 984, plan.usable, {}};
        for (int i = 0; i < 950; ++i) r.frame_hashes.push_back(name + std::to_string(i));
        record.recordings.push_back(r);
    }
    const auto& splits = *plan.splits;
    const auto windows = [&](SampleRange r) { return range(r.begin, r.end - plan.span); };
    DirectionRecord d{"air", {"patinanet"}, {}};
    d.uses.push_back({SampleRole::train, "chamber", splits.train, windows(splits.train), {}, 0, 0});
    d.uses.push_back({SampleRole::validation,
                      "chamber",
                      splits.validation,
                      windows(splits.validation),
                      {},
                      0,
                      0});
    d.uses.push_back({SampleRole::test, "air", plan.usable, plan.starts, {}, 810, 0});
    record.directions.push_back(d);
    return record;
}

SampleUse& use(EvaluationRecord& record, SampleRole role) {
    return *std::ranges::find(record.directions[0].uses, role, &SampleUse::role);
}

/// Exactly these findings, in any order.
void expect(const EvaluationRecord& record, std::vector<std::string> ids) {
    std::vector<std::string> found;
    for (const Status& s : audit(record)) {
        found.push_back(s.id);
        EXPECT_FALSE(s.sentence.empty());
    }
    std::ranges::sort(found);
    std::ranges::sort(ids);
    EXPECT_EQ(found, ids);
}

TEST(Audit, FindsNothingWhereNothingLeaks) {
    const EvaluationRecord record = clean();
    EXPECT_EQ(record.directions[0].uses[0].starts.size(), 352u);
    EXPECT_EQ(record.directions[0].uses[1].starts.size(), 106u);
    expect(record, {});
}

TEST(Audit, AWindowThatReachesIntoTheEmbargo) {
    EvaluationRecord record = clean();
    auto& starts = use(record, SampleRole::train).starts;
    starts.push_back(starts.back() + 1);  // its last sample is the first of the embargo
    expect(record, {"window_crosses_split", "embargo_violated"});
}

TEST(Audit, ATestWindowBeyondTheEnd) {
    EvaluationRecord record = clean();
    use(record, SampleRole::test).starts.back() += 1;
    expect(record, {"window_crosses_split"});
}

TEST(Audit, AnEmbargoThatIsTooShort) {
    EvaluationRecord record = clean();
    SampleUse& validation = use(record, SampleRole::validation);
    validation.allowed.begin -= 1;
    validation.starts.insert(validation.starts.begin(), validation.starts.front() - 1);
    expect(record, {"embargo_violated"});
}

TEST(Audit, ASampleInTwoSplits) {
    EvaluationRecord record = clean();
    SampleUse& validation = use(record, SampleRole::validation);
    validation.allowed = {400, 700};
    validation.starts = range(400, 560);
    expect(record, {"sample_in_two_splits"});
}

TEST(Audit, TheTestRecordingInTraining) {
    EvaluationRecord record = clean();
    use(record, SampleRole::train).recording = "air";
    expect(record, {"test_recording_in_training", "sample_in_two_splits"});
}

TEST(Audit, TheTestRecordingInSelection) {
    EvaluationRecord record = clean();
    use(record, SampleRole::validation).recording = "air";
    expect(record, {"test_recording_in_selection", "sample_in_two_splits"});
}

TEST(Audit, TheTestRecordingUnderAnotherName) {
    EvaluationRecord record = clean();
    record.recordings[0].sha256 = record.recordings[1].sha256;
    expect(record,
           {"same_recording_twice", "test_recording_in_training", "test_recording_in_selection"});
}

TEST(Audit, TwoRecordingsWithIdenticalFrames) {
    EvaluationRecord record = clean();
    record.recordings[0].frame_hashes[3] = record.recordings[1].frame_hashes[700];
    expect(record, {"same_recording_twice", "frame_in_two_splits"});
    // In the unused tail it is still the same recording, but no split has it.
    record = clean();
    record.recordings[0].frame_hashes[949] = record.recordings[1].frame_hashes[700];
    expect(record, {"same_recording_twice"});
}

TEST(Audit, AFrameOfTrainingAgainInValidation) {
    EvaluationRecord record = clean();
    record.recordings[0].frame_hashes[800] = record.recordings[0].frame_hashes[10];
    expect(record, {"frame_in_two_splits"});
    record = clean();  // twice within training: dull, but no leak
    record.recordings[0].frame_hashes[11] = record.recordings[0].frame_hashes[10];
    expect(record, {});
}

TEST(Audit, ATrainingSampleOutsideItsSplit) {
    EvaluationRecord record = clean();
    use(record, SampleRole::train).samples = {20, 960};
    expect(record, {"sample_outside_split", "embargo_violated"});
}

TEST(Audit, TrainedWithNothingHeldOut) {
    EvaluationRecord record = clean();
    record.single = true;
    expect(record, {"trained_without_held_out"});
}

TEST(Audit, WindowsThatWereLeftOutOrCountedTwice) {
    EvaluationRecord record = clean();
    use(record, SampleRole::test).starts.resize(700);
    expect(record, {"windows_missing"});
    use(record, SampleRole::test).skipped = 110;
    expect(record, {});
    record = clean();
    use(record, SampleRole::test).starts[5] = use(record, SampleRole::test).starts[4];
    expect(record, {"window_twice"});
}

TEST(Audit, SamplesOfNobodyAndFramesWithoutHashes) {
    EvaluationRecord record = clean();
    use(record, SampleRole::train).recording = "lab";
    expect(record, {"unknown_recording"});
    record = clean();
    record.recordings[0].frame_hashes.clear();
    expect(record, {"frames_not_hashed"});
}

EvaluationProtocol learning() {
    EvaluationProtocol p = short_recording_protocol(10);
    p.train_fraction = 0.4;
    p.validation_fraction = 0.2;
    p.max_windows = 8;
    return p;
}

std::vector<Observation> pair() {
    std::vector<Observation> list;
    list.push_back(affine_recording("chamber", 400, 1e-3, 1, 1));
    list.push_back(affine_recording("air", 400, 1e-3, -1, 2));
    return list;
}

Entrant learner(std::function<std::vector<int>(const TrainingSource&)> reads) {
    Entrant e;
    e.name = "learner";
    e.train = [reads](const std::vector<TrainingSource>& sources) {
        for (const TrainingSource& s : sources) {
            for (const int i : reads(s)) s.observation->store->image(i);
        }
        return persistence();
    };
    return e;
}

TEST(Audit, WhatATrainerReadsIsSeenNotBelieved) {
    const Entrant honest = learner([](const TrainingSource& s) {
        std::vector<int> all = range(s.train.begin, s.train.end);
        const auto more = range(s.validation.begin, s.validation.end);
        all.insert(all.end(), more.begin(), more.end());
        return all;
    });
    const Evaluation fine = evaluate(learning(), pair(), {honest});
    EXPECT_TRUE(fine.notes.empty()) << fine.notes.front().sentence;
    ASSERT_EQ(fine.record.directions.size(), 2u);
    EXPECT_EQ(fine.record.directions[0].uses[0].samples.size(), 160u);
    EXPECT_EQ(fine.record.directions[0].uses[1].samples.size(), 80u);
    EXPECT_TRUE(fine.directions[0].entrants[1].trained);

    const Entrant greedy =
        learner([](const TrainingSource& s) { return range(0, s.train.end + 9); });
    const Evaluation caught = evaluate(learning(), pair(), {greedy});
    ASSERT_FALSE(caught.notes.empty());
    EXPECT_EQ(caught.notes[0].id, "sample_outside_split");
}

TEST(Audit, AForecasterThatRemembersIsCaught) {
    // Keeps every context it was shown: later windows contain the futures of earlier ones.
    struct Memory {
        std::mutex mutex;
        int seen = 0;
    };
    const auto memory = std::make_shared<Memory>();
    const Forecaster remembers{"remembers", [memory](const Context& context) {
                                   const std::lock_guard lock(memory->mutex);
                                   Forecast f = persistence().forecast(context);
                                   if (++memory->seen > 3) f.trajectory.base(0, 0).r += 0.01f;
                                   return f;
                               }};
    const Evaluation e = evaluate(learning(), pair(), {training_free(remembers)});
    ASSERT_FALSE(e.notes.empty());
    EXPECT_EQ(e.notes[0].id, "forecast_not_repeatable");
}

/// Finds its context's last frame in the observation and returns what comes next.
Forecaster oracle(const Observation& observation, int stride) {
    return {"oracle", [&observation, stride](const Context& context) {
                Forecast f = persistence().forecast(context);
                for (int i = 0; i + stride < observation.store->count(); ++i) {
                    const Image<SrgbF> frame = observation.store->image(i);
                    if (!std::ranges::equal(frame.pixels(), context.frames.back().pixels())) {
                        continue;
                    }
                    f.trajectory.base = observation.store->image(i + stride);
                    break;
                }
                return f;
            }};
}

TEST(Peeking, AForecasterThatReadsTheFutureIsCaught) {
    Observation observation = affine_recording("air", 300, 1e-3);
    const auto samples = std::make_shared<ScrambledSamples>(observation.store);
    observation.store = samples;
    const EvaluationProtocol protocol = learning();
    const std::vector<int> starts{0, 57, 120};
    const Statuses caught = check_peeking(protocol, observation, *samples,
                                          oracle(observation, protocol.stride), starts);
    ASSERT_EQ(caught.size(), 1u);
    EXPECT_EQ(caught[0].id, "looks_beyond_context");
    EXPECT_NE(caught[0].sentence.find("oracle"), std::string::npos);
    EXPECT_TRUE(check_peeking(protocol, observation, *samples, affinergb({}), starts).empty());
    EXPECT_TRUE(check_peeking(protocol, observation, *samples, persistence(), starts).empty());
    // Afterwards the samples are as they were.
    EXPECT_EQ(samples->image(5)(3, 3), affine_recording("air", 300, 1e-3).store->image(5)(3, 3));
}

TEST(Peeking, ARandomForecasterCannotBeJudged) {
    Observation observation = affine_recording("air", 300, 1e-3);
    const auto samples = std::make_shared<ScrambledSamples>(observation.store);
    observation.store = samples;
    int calls = 0;
    const Forecaster random{"random", [&](const Context& context) {
                                Forecast f = persistence().forecast(context);
                                f.trajectory.base(1, 1).g += 0.001f * float(++calls);
                                return f;
                            }};
    const Statuses found =
        check_peeking(learning(), observation, *samples, random, std::vector<int>{0});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, "forecast_not_repeatable");
}

}  // namespace
}  // namespace verdigris
