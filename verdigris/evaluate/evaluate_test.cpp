// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "verdigris/color/convert.h"
#include "verdigris/color/delta_e.h"
#include "verdigris/error.h"
#include "verdigris/evaluate/testing.h"
#include "verdigris/forecast/affine.h"
#include "verdigris/forecast/choose.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

using testing::affine_recording;
using testing::observed;

/// As the paper has it: no ridge, no clamp.
AffineOptions plain(AffineFamily family = AffineFamily::full, int order = 1) {
    return {family, order, 0, FitPixels::all, false};
}

EvaluationProtocol small() {
    EvaluationProtocol p = short_recording_protocol(10);
    p.train_fraction = p.validation_fraction = 0;
    return p;
}

std::vector<Observation> pair(double sigma = 0) {
    std::vector<Observation> list;
    list.push_back(affine_recording("chamber", 200, sigma, 1, 1));
    list.push_back(affine_recording("air", 190, sigma, -1, 2));
    return list;
}

TEST(Evaluate, AGlobalAffineDriftIsForecastAlmostExactly) {
    const Evaluation e = evaluate(small(), pair(), {training_free(affinergb(plain()))});
    ASSERT_EQ(e.directions.size(), 2u);
    EXPECT_EQ(e.directions[0].label(), "air -> chamber");
    EXPECT_EQ(e.directions[1].label(), "chamber -> air");
    EXPECT_EQ(e.directions[0].starts.size(), 60u);
    EXPECT_EQ(e.directions[1].starts.size(), 50u);
    for (const Direction& d : e.directions) {
        ASSERT_EQ(d.entrants.size(), 2u);
        const EntrantScores& affine = d.entrant("affinergb full order 1");
        EXPECT_GT(overall_mean(d.persistence().foreground), 1e-6);
        // Not exact: the drift is fitted to the first frame and applied to the last, whose color
        // has moved by 4 S meanwhile.
        EXPECT_GT(gain(d, affine), 0.9995);
        EXPECT_LT(overall_mean(affine.foreground), 2e-8);
        EXPECT_LT(overall_mean(affine.delta_e), 0.02);
        EXPECT_EQ(gain(d, d.persistence()), 0);
    }
    EXPECT_TRUE(e.notes.empty()) << e.notes.front().sentence;
}

TEST(Evaluate, PassesOnWhatIsWrongWithARecording) {
    std::vector<Observation> list = pair();
    list[1].notes = {{"broken_tail", Severity::caution, "cut off after 44 of 100 frames"},
                     {"something", Severity::info, "not worth a word"}};
    const Evaluation e = evaluate(small(), list, {});
    ASSERT_EQ(e.recording_notes.size(), 1u);
    EXPECT_EQ(e.recording_notes[0].sentence, "air: cut off after 44 of 100 frames");
}

TEST(Evaluate, HoldsOutOneRecordingOnlyWhereAsked) {
    EvaluationProtocol protocol = small();
    const Evaluation both = evaluate(protocol, pair(), {training_free(affinergb(plain()))});
    protocol.hold_out = "air";
    const Evaluation one = evaluate(protocol, pair(), {training_free(affinergb(plain()))});
    ASSERT_EQ(one.directions.size(), 1u);
    EXPECT_EQ(one.directions[0].label(), "chamber -> air");
    EXPECT_EQ(one.directions[0].entrants[1].foreground.values,
              both.directions[1].entrants[1].foreground.values);
    EXPECT_EQ(one.record.recordings.size(), 2u);
    EXPECT_TRUE(one.notes.empty());
    protocol.hold_out = "sea";
    EXPECT_THROW(evaluate(protocol, pair(), {}), Error);
    protocol.hold_out = "air";
    protocol.single = true;
    EXPECT_THROW(evaluate(protocol, pair(), {}), Error);
}

TEST(Evaluate, PersistenceOnALinearRampHasItsClosedForm) {
    // Every pixel moves by (a, b, c) per unit: the error at horizon k is k^2 (a^2 + b^2 + c^2) / 3.
    const double a = 0.004, b = -0.002, c = 0.001;
    std::vector<Observation> ramp;
    ramp.push_back(observed("ramp", 24, 16, 200, [=](int x, int y, int t) {
        const SrgbF p = testing::texture(x, y);
        return SrgbF{p.r + float(a * t / 10), p.g + float(b * t / 10), p.b + float(c * t / 10)};
    }));
    EvaluationProtocol protocol = small();
    protocol.single = true;
    const Evaluation e = evaluate(protocol, ramp, {training_free(affinergb(plain()))});
    const Direction& d = e.directions.at(0);
    EXPECT_EQ(d.label(), "within ramp");
    EXPECT_LT(overall_mean(d.entrants[1].foreground), 1e-12);  // and this one is exact
    const double square = (a * a + b * b + c * c) / 3;
    const std::vector<double> fg = horizon_means(d.persistence().foreground),
                              whole = horizon_means(d.persistence().specimen),
                              change = horizon_means(d.persistence().absolute),
                              bias = horizon_means(d.persistence().bias[0]);
    double mean = 0;
    for (int k = 1; k <= 10; ++k) {
        const auto i = std::size_t(k - 1);
        EXPECT_NEAR(fg[i], k * k * square, 1e-4 * k * k * square);
        EXPECT_NEAR(whole[i], k * k * square, 1e-4 * k * k * square);
        EXPECT_NEAR(change[i], k * (a - b + c) / 3, 1e-6);
        EXPECT_NEAR(bias[i], -k * a, 1e-6);  // it stays behind
        mean += k * k * square / 10;
    }
    EXPECT_NEAR(overall_mean(d.persistence().foreground), mean, 1e-4 * mean);
    EXPECT_EQ(d.foreground_pixels.front(), 24 * 16);
}

TEST(Evaluate, DeltaEIsTheMeanOfTheScalarOnes) {
    EvaluationProtocol protocol = small();
    protocol.max_windows = 2;
    const std::vector<Observation> recordings = pair();
    const Evaluation e = evaluate(protocol, recordings, {});
    const Direction& d = e.directions[0];
    const Observation& o = recordings[0];
    const Image<SrgbF> last = o.store->image(d.starts[1] + 40),
                       truth = o.store->image(d.starts[1] + 70);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < last.pixel_count(); ++i) {
        if (!o.specimen.pixels()[i]) continue;
        sum += delta_e2000(lab_from_srgb(last.pixels()[i]), lab_from_srgb(truth.pixels()[i]));
        ++count;
    }
    EXPECT_NEAR(d.persistence().delta_e.at(1, 2), sum / count, 1e-3);
}

TEST(Evaluate, OrderZeroIsPersistenceToTheBit) {
    const Evaluation e =
        evaluate(small(), pair(1e-3), {training_free(affinergb(plain(AffineFamily::full, 0)))});
    for (const Direction& d : e.directions) {
        EXPECT_EQ(d.entrants[1].foreground.values, d.persistence().foreground.values);
        EXPECT_EQ(d.entrants[1].delta_e.values, d.persistence().delta_e.values);
    }
}

TEST(Evaluate, TheForegroundIsTheChangingPartAndStillWindowsAreSkipped) {
    // A bar of 80 pixels changes until sample 120; then all is still.
    std::vector<Observation> list;
    list.push_back(observed("bar", 24, 16, 400, [](int x, int y, int t) {
        SrgbF c = testing::texture(x, y);
        if (y < 5 && x >= 8) c.r += 0.0005f * float(std::min(t, 120));
        return c;
    }));
    EvaluationProtocol protocol = small();
    protocol.single = true;
    const Direction d = evaluate(protocol, list, {}).directions.at(0);
    EXPECT_EQ(d.foreground_pixels.front(), 80);
    ASSERT_FALSE(d.skipped.empty());
    EXPECT_EQ(d.starts.size() + d.skipped.size(), 260u);
    EXPECT_NE(d.skipped.front().why.find("fewer than 64"), std::string::npos);
    EXPECT_EQ(d.persistence().foreground.windows, int(d.starts.size()));
    // Over the foreground the error is that of the bar, over the frame it is diluted.
    const double bar = horizon_means(d.persistence().foreground)[0];
    EXPECT_GT(bar, 2 * horizon_means(d.persistence().specimen)[0]);
    protocol.mask = MaskRule::per_horizon;
    EXPECT_LE(evaluate(protocol, list, {}).directions[0].starts.size(), d.starts.size());
    protocol.min_foreground = 81;
    const Evaluation none = evaluate(protocol, list, {});
    EXPECT_TRUE(none.directions[0].starts.empty());
    EXPECT_EQ(none.notes.back().id, "windows_skipped");
    EXPECT_EQ(none.notes.back().severity, Severity::refusal);
}

TEST(Evaluate, InTheSpecimensAreaNothingElseMovesOrCounts) {
    EvaluationProtocol protocol = small();
    protocol.area = EvaluatedArea::specimen;
    std::atomic<int> masked = 0;
    const Forecaster watch{"watch", [&](const Context& context) {
                               masked += !context.specimen.empty();
                               return persistence().forecast(context);
                           }};
    const Evaluation e = evaluate(protocol, pair(), {training_free(watch)});
    EXPECT_GT(masked, 0);
    EXPECT_EQ(e.directions[0].foreground_pixels.front(), 12 * 16);
}

TEST(Evaluate, IsTheSameOnAnyNumberOfThreads) {
    const std::vector<Observation> list = pair(1e-3);
    const std::vector<Entrant> entrants{training_free(affinergb()), training_free(automatic())};
    set_thread_count(1);
    const Evaluation one = evaluate(small(), list, entrants);
    set_thread_count(0);
    const Evaluation all = evaluate(small(), list, entrants);
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(one.directions[i].entrants[k].foreground.values,
                      all.directions[i].entrants[k].foreground.values);
            EXPECT_EQ(one.directions[i].entrants[k].delta_e.values,
                      all.directions[i].entrants[k].delta_e.values);
        }
    }
}

TEST(Evaluate, OutOfGamutIsCountedWithoutTheClamp) {
    EvaluationProtocol protocol = small();
    protocol.single = true;
    protocol.out_of_gamut = true;
    std::vector<Observation> list;  // red reaches 1 at t = 500, long after the window
    list.push_back(observed("red", 24, 16, 150, [](int x, int, int t) {
        const float r = x < 12 ? 0.5f : 0.93f;
        return SrgbF{r + float(t) * 0.0008f, 0.4f + 0.01f * float(x), 0.3f};
    }));
    AffineOptions clamped = plain();
    clamped.clamp = true;
    const Evaluation e = evaluate(protocol, list, {training_free(affinergb(clamped))});
    const EntrantScores& s = e.directions[0].entrants[1];
    EXPECT_EQ(s.outside.at(0, 0), 0);
    EXPECT_NEAR(s.outside.at(0, 9), 0.5, 1e-12);
    EXPECT_LE(s.outside_by_a_step.at(0, 4), s.outside.at(0, 4));
    EXPECT_EQ(overall_mean(e.directions[0].persistence().outside), 0);
}

void expect_error(ErrorCode code, const std::string& words, const EvaluationProtocol& protocol,
                  const std::vector<Observation>& list, const std::vector<Entrant>& entrants) {
    try {
        evaluate(protocol, list, entrants);
        ADD_FAILURE() << "accepted: " << words;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

Entrant trained_persistence() {
    Entrant e;
    e.name = "learner";
    e.train = [](const std::vector<TrainingSource>&) { return persistence(); };
    return e;
}

TEST(Evaluate, RefusesWithTheReason) {
    std::vector<Observation> one;
    one.push_back(affine_recording("chamber", 200));
    EvaluationProtocol single = small();
    single.single = true;
    expect_error(ErrorCode::refused, "--single", small(), one, {});
    expect_error(ErrorCode::refused, "'learner' is trained", single, one, {trained_persistence()});
    expect_error(ErrorCode::usage, "at least one recording", small(), {}, {});
    EvaluationProtocol paper;
    paper.single = true;
    expect_error(ErrorCode::bad_input, "984", paper, one, {});
    EvaluationProtocol overlapping = small();
    overlapping.train_fraction = 0.7;
    overlapping.validation_fraction = 0.4;
    expect_error(ErrorCode::usage, "splits overlap", overlapping, pair(), {});
    EvaluationProtocol learning = small();
    learning.train_fraction = 0.9;
    learning.validation_fraction = 0.1;
    expect_error(ErrorCode::refused, "cannot be trained on", learning, pair(),
                 {trained_persistence()});

    std::vector<Observation> copies;
    copies.push_back(affine_recording("chamber", 200));
    copies.push_back(affine_recording("chamber", 200));
    expect_error(ErrorCode::refused, "two copies", small(), copies, {});
    copies[1].source_sha256 = "re-encoded";  // but the frames are the same
    expect_error(ErrorCode::refused, "two copies", small(), copies, {});

    one[0].axis.samples = 2000;
    expect_error(ErrorCode::bad_input, "every one", single, one, {});
    one.clear();
    one.push_back(affine_recording("short", 120));
    expect_error(ErrorCode::bad_input, "too short", single, one, {});
    expect_error(ErrorCode::usage, "two forecasters", small(), pair(),
                 {training_free(affinergb()), training_free(affinergb())});
    const Forecaster broken{"broken", [](const Context& context) {
                                Forecast f = persistence().forecast(context);
                                f.trajectory.base(0, 0).g = std::nanf("");
                                return f;
                            }};
    expect_error(ErrorCode::failed, "broken", small(), pair(), {training_free(broken)});
}

TEST(Evaluate, StopsWhenItIsAskedTo) {
    const auto stop = [](std::string_view stage, std::int64_t done, std::int64_t) {
        return !(stage == "evaluate" && done > 0);
    };
    EXPECT_THROW(evaluate(small(), pair(), {}, stop), Error);
}

}  // namespace
}  // namespace verdigris
