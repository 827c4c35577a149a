// SPDX-License-Identifier: MIT
#include "verdigris/learn/susceptibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "verdigris/error.h"
#include "verdigris/learn/susceptibility_report.h"
#include "verdigris/learn/testing.h"

namespace verdigris {
namespace {

using namespace verdigris::testing;

TEST(Pearson, KnownAnswers) {
    Image<float> a(4, 1), b(4, 1), flat(4, 1);
    const float x[] = {1, 2, 3, 4}, y[] = {2, 1, 4, 3};
    for (int i = 0; i < 4; ++i) a(i, 0) = x[i], b(i, 0) = y[i];
    EXPECT_NEAR(pearson(a, b, {}), 0.6, 1e-12);
    EXPECT_NEAR(pearson(a, a, {}), 1, 1e-12);
    EXPECT_EQ(pearson(a, flat, {}), 0);
    Mask two(4, 1);
    two(0, 0) = two(1, 0) = kInside;
    EXPECT_NEAR(pearson(a, b, two), -1, 1e-12);
}

// r[i][j] = a[i] + b[j]: the mean's variance is that of a mean of a plus that of a mean of b. The
// jackknife of a plain mean is its usual standard error.
TEST(Jackknife, BetweenRecordingsAddsTheVariancesOfTwoMeans) {
    const std::vector<double> a{0.1, 0.3, 0.2, 0.4}, b{0.5, 0.1, 0.3};
    std::vector<std::vector<double>> r;
    for (const double x : a) r.push_back({x + b[0], x + b[1], x + b[2]});
    const Correlation c = cross_mean(r);
    EXPECT_NEAR(c.mean, 0.25 + 0.3, 1e-12);
    EXPECT_EQ(c.count, 12);
    EXPECT_NEAR(c.error, std::sqrt(0.05 / 3 / 4 + 0.08 / 2 / 3), 1e-12);
    EXPECT_TRUE(std::isnan(cross_mean({{0.1, 0.2}}).error));
}

// By hand: without 0, 1 and 2 the pairs left are 0.8, 0.6 and 0.4; squares 0.08, times 2 / 3.
TEST(Jackknife, WithinARecordingLeavesOutAWindowWithItsPairs) {
    const Correlation c = within_mean({{0, 0, 0}, {0.4, 0, 0}, {0.6, 0.8, 0}});
    EXPECT_NEAR(c.mean, 0.6, 1e-12);
    EXPECT_EQ(c.count, 3);
    EXPECT_NEAR(c.error, std::sqrt(0.08 * 2 / 3), 1e-12);
    const Correlation two = within_mean({{0, 0}, {0.4, 0}});
    EXPECT_NEAR(two.mean, 0.4, 1e-12);
    EXPECT_TRUE(std::isnan(two.error));
}

Checkpoint fresh(NetworkKind kind, const Observation& source) {
    Checkpoint c;
    c.network = std::make_shared<Network>(NetworkConfig{kind, 3, 32}, 2);
    c.facts.stride = small_protocol().stride;
    c.facts.sources = {{source.source_name, source.source_sha256, "", {}, {}}};
    return c;
}

TEST(Susceptibility, CountsPairsAndTellsTheSource) {
    const EvaluationProtocol protocol = small_protocol();
    std::vector<Observation> recordings;
    recordings.push_back(changing_recording(32, 60, "a"));
    recordings.push_back(changing_recording(32, 80, "b"));
    const Checkpoint c = fresh(NetworkKind::patinanet, recordings[0]);
    const SusceptibilityAnalysis s = analyze_susceptibility(c, protocol, recordings);
    ASSERT_EQ(s.within.size(), 2u);
    ASSERT_EQ(s.cross.size(), 1u);
    const int n = int(s.recordings[0].rho.size()), m = int(s.recordings[1].rho.size());
    EXPECT_EQ(n, 60 / protocol.span());
    EXPECT_EQ(m, 80 / protocol.span());
    EXPECT_EQ(s.within[0].windows.all.count, n * (n - 1) / 2);
    EXPECT_EQ(s.cross[0].windows.all.count, n * m);
    EXPECT_TRUE(s.recordings[0].source);
    EXPECT_FALSE(s.recordings[1].source);
    // The left half stands still; the right half is the specimen and changes.
    const Image<float>& change = s.recordings[0].change;
    EXPECT_EQ(change(3, 20), 0);
    EXPECT_GT(change(28, 20), 0.02f);
    for (const auto& w : s.within) {
        EXPECT_LE(std::abs(w.windows.all.mean), 1);
        EXPECT_TRUE(std::isfinite(w.windows.specimen.error));
    }
    // The same picture all the time gives the same map all the time.
    EXPECT_GT(s.within[0].windows.all.mean, 0.5);
}

// Sentences say "less" only where the errors let them.
TEST(SusceptibilityReport, SaysWhatTheNumbersSay) {
    SusceptibilityAnalysis a;
    a.recordings.resize(2);
    a.recordings[0].source = true;
    for (auto& r : a.recordings) r.mean = Image<float>(4, 4), r.change = Image<float>(4, 4);
    const auto r = [](double mean, double error) {
        return AreaCorrelations{{mean, error, 15}, {mean, error, 15}};
    };
    a.within = {{"a", r(0.9, 0.02), r(0.7, 0.05)}, {"b", r(0.8, 0.03), r(0.1, 0.05)}};
    a.cross = {{"a", "b", r(0.2, 0.05)}};
    std::vector<std::string> said = susceptibility_sentences(a);
    ASSERT_EQ(said.size(), 5u);
    EXPECT_NE(said[2].find("less than within either"), std::string::npos) << said[2];
    EXPECT_NE(said[3].find("learned from"), std::string::npos);
    EXPECT_NE(said[4].find("never seen"), std::string::npos);
    a.cross = {{"a", "b", r(0.78, 0.05)}};
    said = susceptibility_sentences(a);
    EXPECT_NE(said[2].find("less than within one of them"), std::string::npos) << said[2];
    a.cross = {{"a", "b", r(0.2, std::nan(""))}};
    EXPECT_NE(susceptibility_sentences(a)[2].find("do not tell"), std::string::npos);
    Checkpoint c;
    c.facts.sources.resize(1);
    check_report(susceptibility_report(c, a));
    EXPECT_EQ(susceptibility_sheet(a).height(), 2 * (12 + 6) + 6);
}

TEST(Susceptibility, RefusesOtherNetworksAndShortRecordings) {
    const EvaluationProtocol protocol = small_protocol();
    std::vector<Observation> recordings;
    recordings.push_back(changing_recording(32, 60, "a"));
    EXPECT_THROW(
        analyze_susceptibility(fresh(NetworkKind::convlstm, recordings[0]), protocol, recordings),
        Error);
    std::vector<Observation> brief;
    brief.push_back(changing_recording(32, 20, "a"));
    EXPECT_THROW(analyze_susceptibility(fresh(NetworkKind::patinanet, brief[0]), protocol, brief),
                 Error);
    Checkpoint finer = fresh(NetworkKind::patinanet, recordings[0]);
    finer.facts.stride = protocol.stride + 1;
    try {
        analyze_susceptibility(finer, protocol, recordings);
        FAIL() << "maps of frames other units apart than it learned from";
    } catch (const Error& e) {
        EXPECT_NE(e.sentence().find("samples per unit"), std::string::npos) << e.sentence();
    }
}

}  // namespace
}  // namespace verdigris
