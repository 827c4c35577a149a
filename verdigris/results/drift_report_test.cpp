// SPDX-License-Identifier: MIT
#include "verdigris/results/drift_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "verdigris/evaluate/characterize.h"
#include "verdigris/observe/testing/drifting_store.h"

namespace verdigris {
namespace {

using testing::DriftingScene;

/// A plate under a camera that brightens by `brightening`; before a backdrop too dark to serve,
/// if asked for.
RecordingDrift measured(double darkening, double brightening, double backdrop = 0.45) {
    DriftingScene scene;
    scene.samples = 240;
    scene.noise = 3e-4;
    scene.darkening = darkening;
    scene.backdrop = backdrop;
    if (backdrop < 0.1) scene.gradient = 0;
    Observation o;
    o.source_name = "plate";
    o.axis = {24, scene.samples, 10, 1};
    o.samples.resize(std::size_t(scene.samples));
    o.store = testing::seen_through(scene, [scene, brightening](int t) {
        const double gain = 1 + brightening * t / scene.samples;
        return ChannelMap{{gain, gain, gain}, {}};
    });
    o.specimen = scene.specimen();
    o.noise = {3e-4, 2.4 * 3e-4, false};
    EvaluationProtocol protocol = short_recording_protocol(10);
    protocol.area = EvaluatedArea::specimen;
    protocol.max_windows = 20;
    Entrant affine = training_free(affinergb(paper_affine()));
    affine.name = "affinergb";
    return measure_recording_drift(protocol, o, {affine});
}

bool said(const RecordingDrift& d, const std::string& part) {
    return std::ranges::any_of(
        d.sentences, [&](const std::string& s) { return s.find(part) != std::string::npos; });
}
std::string all(const RecordingDrift& d) {
    std::string text;
    for (const std::string& s : d.sentences) text += s + "\n";
    return text;
}

TEST(DriftReport, AStillCameraIsSaidToBeStill) {
    const RecordingDrift d = measured(0.2, 0);
    ASSERT_TRUE(d.series.has_value());
    EXPECT_TRUE(said(d, "the camera is not drifting")) << all(d);
    EXPECT_FALSE(said(d, "correlation")) << all(d);
    // 240 samples are fewer blocks than settle a sign.
    EXPECT_TRUE(said(d, "the gain stays, but its sign was not settled")) << all(d);
}

TEST(DriftReport, AGainOnTheCameraDoesNotSurvive) {
    const RecordingDrift d = measured(0, 0.04);
    EXPECT_TRUE(said(d, "is drifting")) << all(d);
    EXPECT_GT(d.gain_of("affinergb", std::nullopt).gain.value, 0.8);
    EXPECT_TRUE(std::isnan(d.gain_of("affinergb", DriftCorrection::gain).gain.value));
    EXPECT_TRUE(said(d, "by gain no window is left that changes")) << all(d);
    EXPECT_FALSE(said(d, "the result survives")) << all(d);
}

TEST(DriftReport, AGainOnTheMetalSurvivesADriftingCamera) {
    const RecordingDrift d = measured(0.2, 0.04);
    EXPECT_TRUE(said(d, "is drifting")) << all(d);
    EXPECT_TRUE(said(d, "against each other")) << all(d);
    EXPECT_GT(d.gain_of("affinergb", DriftCorrection::gain).gain.value, 0.8);
    EXPECT_TRUE(said(d, "the gain stays")) << all(d);
    ASSERT_EQ(d.maps.size(), 3u);
    // The map undoes what was planted.
    EXPECT_NEAR(d.maps[0].second[200].gain[1], 1 / (1 + 0.04 * 200 / 240), 2e-3);
}

TEST(DriftReport, WithoutAReferenceItSaysSoAndReportsTheRest) {
    std::vector<RecordingDrift> list;
    list.push_back(measured(0.2, 0, 0.02));
    const RecordingDrift& d = list[0];
    EXPECT_FALSE(d.series.has_value());
    EXPECT_TRUE(said(d, "no reference region")) << all(d);
    EXPECT_TRUE(said(d, "whether the camera drifts cannot be said")) << all(d);
    EXPECT_TRUE(said(d, "it stays open")) << all(d);
    ASSERT_EQ(d.gains.size(), 1u);
    EXPECT_GT(d.gains[0].gain.value, 0.5);
    const Report report = drift_report(EvaluationProtocol(), list);
    check_report(report);
}

TEST(DriftReport, SentencesTurnWithTheNumbers) {
    RecordingDrift d = measured(0.2, 0);
    for (DriftGain& g : d.gains)
        if (g.correction == DriftCorrection::offset) g.gain.value = -0.1;
    d.sentences = drift_sentences(d);
    EXPECT_TRUE(said(d, "the result does not survive 1 of 3 corrections")) << all(d);
    for (DriftGain& g : d.gains) g.gain.value = g.correction ? 0.1 : 0.5;
    d.sentences = drift_sentences(d);
    EXPECT_TRUE(said(d, "of the result less than half survives")) << all(d);
    // Six blocks that agree settle it, as recorded and corrected: only then does it survive.
    for (DriftGain& g : d.gains) {
        g.gain.value = 0.5;
        g.gain.block = Interval{0.4, 0.6};
        g.gain.blocks.assign(6, BlockGain{0, 139, 140, 0.5});
    }
    d.sentences = drift_sentences(d);
    EXPECT_TRUE(said(d, "the result survives")) << all(d);
    EXPECT_TRUE(said(d, "better in 3 of 3")) << all(d);
    d.region.margin = 0.5;
    d.sentences = drift_sentences(d);
    EXPECT_TRUE(said(d, "--crop none")) << all(d);
}

TEST(DriftReport, TablesFiguresAndJsonHoldTheNumbers) {
    std::vector<RecordingDrift> list;
    list.push_back(measured(0.2, 0.04));
    const EvaluationProtocol protocol = short_recording_protocol(10);
    const Report report = drift_report(protocol, list);
    const std::string page = page_html(report, {false, {}, false});
    EXPECT_EQ(page.find("year"), std::string::npos) << "calendar time appears nowhere";
    const Table gains = drift_gain_table(list);
    ASSERT_EQ(gains.groups[0].rows.size(), 4u);
    EXPECT_EQ(gains.groups[0].rows[0][1].words(), "none");
    const Table maps = drift_map_table(list);
    check_table(maps);
    EXPECT_EQ(maps.groups[0].rows.size(), 3u * 240u);
    const Figure figure = drift_figure(list);
    ASSERT_EQ(figure.panels.size(), 2u);
    EXPECT_EQ(figure.panels[1].x.categories,
              (std::vector<std::string>{"none", "gain", "offset", "both"}));
    // Gains follow from the windows.
    double error = 0, still = 0;
    const Table windows = drift_windows(list);
    for (const TableRow& row : windows.groups[0].rows) {
        if (row[2].words() != "offset") continue;
        error += row[4].value(), still += row[5].value();
    }
    EXPECT_NEAR(1 - error / still, list[0].gain_of("affinergb", DriftCorrection::offset).gain.value,
                1e-12);
    const auto json = json_of(protocol, list);
    EXPECT_TRUE(json["recordings"]["plate"]["gains"]["affinergb"].contains("both"));
    EXPECT_TRUE(json["recordings"]["plate"]["reference"]["found"]);
}

}  // namespace
}  // namespace verdigris
