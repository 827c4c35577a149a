// SPDX-License-Identifier: MIT
// What bandtrend is made of, so that each part and constant can be taken out or changed.
// Model: docs/models/bandtrend.md
#pragma once

#include <string>

namespace verdigris {

/// What is thought possible before anything is seen. What is off is an ablation.
struct TrendPrior {
    bool drift = true;      ///< change that goes on; else only levels that wander, and noise
    bool slowing = true;    ///< drifts that slow down
    bool two_parts = true;  ///< drifts of two parts, each slowing down or speeding up by itself
    bool bending = true;    ///< drifts that bend smoothly, beside those that wander
    bool walking = true;    ///< drifts that themselves walk at random: each keeps what it has got
    bool swing = true;      ///< drifts that swing to and fro, as day and night have it
    bool noise = true;      ///< frames with white noise
    double event = 0.02;    ///< of a step or an outlier, at each place it can have; 0: none
    double level = 0.1;     ///< of frames that are one level and noise
    double doubt = 0.01;    ///< per unit ahead: no drift is trusted to stay as it is for ever
};

/// The parts of the method and its constants; docs/models/bandtrend.md. What is off is an ablation.
struct BandTrendDesign {
    bool light = true;    ///< frames are brought under the light of the last one
    bool relight = true;  ///< and where that light goes back to is forecast
    bool gray = true;     ///< unless a backdrop shows it, light is told apart as one gain of all
    bool global = true;   ///< a drift that is affine in color, before all else
    bool split = true;  ///< its mean by itself, and what depends on color; else it is one component
    bool local = true;  ///< what that leaves
    bool bands = true;  ///< split by how far it reaches; else it is one component
    // chosen; docs/models/bandtrend.md has the sensitivity to all of them.
    double global_count = 2;     ///< a global drift has few independent parts: light, and color
    double largest_count = 100;  ///< neighbors are never as independent as they look
    double confidence = 1;       ///< standard deviations; where a trend is held
    /// What risk costs where all of the specimen shares a change, so that nothing averages out
    /// (be_cautious).
    double caution = 0.2;
    TrendPrior prior;
};

/// For ablations: "" is the method as it is; ":bands=0:confidence=0.5" differs in what is named.
/// Keys: light, relight, gray, global, split, local, bands, slowing, two-parts, bending, walking,
/// swing, noise (0 or 1);
/// events, doubt, confidence, caution, level, global-count, band-count (numbers of 0 and more;
/// counts of 1 and more). Throws Error{usage} naming the key.
BandTrendDesign band_trend_design(const std::string& text);

}  // namespace verdigris
