// SPDX-License-Identifier: MIT
// Does a learned prior transfer? patinanet's static susceptibility, compared between windows of one
// specimen, between specimens, and with what really changed: the paper's Figure 5.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "verdigris/evaluate/protocol.h"
#include "verdigris/learn/checkpoint.h"
#include "verdigris/observe/observe.h"
#include "verdigris/pixels/image.h"
#include "verdigris/progress.h"

namespace verdigris {

/// A mean over pairs or maps of Pearson's r. The error is the jackknife's over a recording's
/// windows (or maps): leave one out, of all pairs that it is in. Between two recordings each is
/// left out of its own, and the two variances add.
struct Correlation {
    double mean = 0;
    double error = 0;  ///< standard error; NaN where there are too few windows to leave one out
    int count = 0;     ///< pairs or maps
};

/// Over all pixels, and over the pixels that are specimen in the recordings concerned: the contrast
/// between specimen and backdrop makes a high r by itself.
struct AreaCorrelations {
    Correlation all, specimen;
};

struct SusceptibilityMaps {
    std::string recording;
    bool source = false;  ///< the network learned from it
    std::vector<int> starts;
    std::vector<Image<float>> rho;  ///< one per window, [0, 1]
    Image<float> mean;              ///< of them
    /// What really changed: mean over channels of |median of the last 20 samples - of the first|.
    Image<float> change;
    Mask specimen;
};

struct SusceptibilityAnalysis {
    std::vector<SusceptibilityMaps> recordings;
    struct Within {
        std::string recording;
        AreaCorrelations windows;  ///< rho of its windows with each other
        AreaCorrelations change;   ///< mean rho with what really changed; jackknife over windows
    };
    std::vector<Within> within;
    struct Cross {
        std::string first, second;
        AreaCorrelations windows;  ///< same pixel coordinates; specimen: where both are
    };
    std::vector<Cross> cross;
};

/// Of windows one span apart (6 in the paper's 950 samples; the last may be cut by the end).
/// All maps are of the network's size, to which recordings are stretched. Throws Error{usage} for a
/// network without a susceptibility or trained on another context or stride; Error{bad_input}
/// naming a recording too short for two windows.
/// Cost: one encoding per window.
SusceptibilityAnalysis analyze_susceptibility(const Checkpoint& checkpoint,
                                              const EvaluationProtocol& protocol,
                                              std::span<const Observation> observations,
                                              const Progress& progress = {});

/// Of r[i][j] with j < i: windows of one recording with each other. Error from three windows on.
Correlation within_mean(const std::vector<std::vector<double>>& r);
/// Of all r[i][j], i of one recording and j of the other. Error from two windows of each on.
Correlation cross_mean(const std::vector<std::vector<double>>& r);

/// Pearson's r of two maps of one size over `where` (empty: every pixel); 0 where one is constant.
double pearson(const Image<float>& a, const Image<float>& b, const Mask& where);

}  // namespace verdigris
