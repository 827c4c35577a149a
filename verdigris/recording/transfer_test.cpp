// SPDX-License-Identifier: MIT
#include "verdigris/recording/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "verdigris/color/convert.h"

namespace verdigris {
namespace {

constexpr Transfer kCurves[] = {Transfer::display, Transfer::linear, Transfer::gamma22,
                                Transfer::gamma28, Transfer::pq,     Transfer::hlg};

float gray(float code, Transfer transfer, Primaries primaries = Primaries::bt709) {
    return srgb_from_coded({code, code, code}, transfer, primaries).g;
}

TEST(Transfer, DisplayCodesAreShownAsTheyAre) {
    const SrgbF c{0.3f, 0.6f, 0.9f};
    for (auto primaries : {Primaries::bt709, Primaries::bt601_525, Primaries::bt601_625}) {
        EXPECT_TRUE(shown_as_coded(Transfer::display, primaries));
        EXPECT_EQ(srgb_from_coded(c, Transfer::display, primaries), c);
    }
    EXPECT_FALSE(shown_as_coded(Transfer::display, Primaries::bt2020));
    EXPECT_FALSE(shown_as_coded(Transfer::pq, Primaries::bt709));
}

TEST(Transfer, PowersAndLinearLight) {
    EXPECT_NEAR(gray(0.18f, Transfer::linear), srgb_from_linear(0.18f), 1e-6);
    EXPECT_NEAR(gray(0.5f, Transfer::gamma22), srgb_from_linear(std::pow(0.5f, 2.2f)), 1e-6);
    EXPECT_NEAR(gray(0.5f, Transfer::gamma28), srgb_from_linear(std::pow(0.5f, 2.8f)), 1e-6);
}

// [BT2408] table 1: reference white, 203 cd/m2, is 58 % PQ and 75 % HLG; 18 % gray, 26 cd/m2, is
// 38 % in both. The table is rounded to whole percents: half of one is up to 5 % of the light.
TEST(Transfer, PqAndHlgPutReferenceWhiteAtOne) {
    EXPECT_NEAR(gray(0.58f, Transfer::pq), 1.0f, 0.02f);
    EXPECT_NEAR(gray(0.5806f, Transfer::pq), 1.0f, 0.001f);  // PQ of 203 cd/m2 is 0.58069
    EXPECT_NEAR(gray(0.75f, Transfer::hlg), 1.0f, 0.005f);
    const float gray_card = srgb_from_linear(26.0f / 203.0f);
    EXPECT_NEAR(gray(0.38f, Transfer::pq), gray_card, 0.02f);
    EXPECT_NEAR(gray(0.38f, Transfer::hlg), gray_card, 0.02f);
}

TEST(Transfer, HighlightsAreClippedAndBlackIsBlack) {
    for (Transfer transfer : kCurves) {
        EXPECT_EQ(gray(0, transfer), 0.0f);
        EXPECT_NEAR(gray(1, transfer), 1.0f, 1e-6f);
    }
    EXPECT_NEAR(gray(0.9f, Transfer::pq), 1.0f, 1e-6f);
    EXPECT_NEAR(gray(0.9f, Transfer::hlg), 1.0f, 1e-6f);
}

TEST(Transfer, EveryCurveRises) {
    for (Transfer transfer : kCurves) {
        float last = -1;
        for (int i = 0; i <= 1000; ++i) {
            const float v = gray(float(i) / 1000.0f, transfer, Primaries::bt2020);
            ASSERT_TRUE(std::isfinite(v));
            ASSERT_GE(v, last - 1e-6f);
            last = v;
        }
    }
}

// The matrices, derived again from the published chromaticities.
using Matrix = std::array<std::array<double, 3>, 3>;

Matrix inverse(const Matrix& m) {
    Matrix out{};
    double det = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            out[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
        det += m[0][i] * out[i][0];
        if (i == 2) {
            for (auto& row : out)
                for (double& v : row) v /= det;
        }
    }
    return out;
}

Matrix xyz_from(const std::array<std::array<double, 2>, 3>& xy) {
    Matrix m{};
    for (std::size_t c = 0; c < 3; ++c) {
        m[0][c] = xy[c][0] / xy[c][1];
        m[1][c] = 1;
        m[2][c] = (1 - xy[c][0] - xy[c][1]) / xy[c][1];
    }
    const double white[] = {0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};  // D65
    const Matrix inv = inverse(m);
    for (std::size_t c = 0; c < 3; ++c) {
        const double gain = inv[c][0] * white[0] + inv[c][1] * white[1] + inv[c][2] * white[2];
        for (std::size_t r = 0; r < 3; ++r) m[r][c] *= gain;
    }
    return m;
}

TEST(Transfer, WidePrimariesBecomeBt709) {
    const Matrix bt709 = xyz_from({{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}});
    struct Wide {
        Primaries primaries;
        Matrix xyz;
    };
    const Wide wides[] = {
        {Primaries::bt2020, xyz_from({{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}}})},
        {Primaries::display_p3, xyz_from({{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}}})}};
    const Matrix to_bt709 = inverse(bt709);
    for (const Wide& wide : wides) {
        for (const LinearF c : {LinearF{0.5f, 0.4f, 0.3f}, {0.3f, 0.4f, 0.35f}, {1, 1, 1}}) {
            const double in[] = {c.r, c.g, c.b};
            double xyz[3] = {}, out[3] = {};
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t k = 0; k < 3; ++k) xyz[r] += wide.xyz[r][k] * in[k];
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t k = 0; k < 3; ++k) out[r] += to_bt709[r][k] * xyz[k];
            const SrgbF got = srgb_from_coded({c.r, c.g, c.b}, Transfer::linear, wide.primaries);
            EXPECT_NEAR(got.r, srgb_from_linear(float(out[0])), 1e-4);
            EXPECT_NEAR(got.g, srgb_from_linear(float(out[1])), 1e-4);
            EXPECT_NEAR(got.b, srgb_from_linear(float(out[2])), 1e-4);
        }
    }
}

}  // namespace
}  // namespace verdigris
