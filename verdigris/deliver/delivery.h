// SPDX-License-Identifier: MIT
// What flows into every writer of this room, and the states a delivery consists of.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "verdigris/forecast/forecast.h"
#include "verdigris/material/material.h"
#include "verdigris/status.h"

namespace verdigris {

/// One earlier observed frame, for the contact sheet and the viewer. unit <= 0, 0 is the last.
struct ObservedFrame {
    double unit = 0;
    Image<SrgbF> image;
};

/// Everything a writer may need; owned by the caller.
struct Delivery {
    std::string stem;              ///< from asset_stem(): "CopperPatinating"
    std::string title;             ///< for people: "copper_patinating"
    std::vector<double> horizons;  ///< increasing, > 0
    const Forecast* forecast = nullptr;
    const MaterialRecipe* recipe = nullptr;
    const Mask* specimen = nullptr;
    std::vector<ObservedFrame> observed;  ///< oldest first; the last has unit 0
    Statuses guards;                      ///< all that fired, for viewer and sheet
    double units_observed = 0;            ///< that the recording spans
    /// Origin and options for the manifest, in order; values are JSON texts.
    std::vector<std::pair<std::string, std::string>> facts;
};

/// One state of the material: the last observed frame, or the forecast at a horizon.
struct DeliveredState {
    double horizon = 0;  ///< 0: observed
    std::string label;   ///< for file names: "u000", "u010", "u007_5"
    std::string name;    ///< for people: "observed (last frame)", "+10 units (forecast)"
    bool observed() const { return horizon == 0; }
};

/// Observed first, then one per horizon.
/// Throws Error{usage} if the delivery has no forecast or recipe, or if its horizons are not
/// finite, positive and increasing.
std::vector<DeliveredState> delivered_states(const Delivery& delivery);

/// The largest horizon within twice the context (beyond, the guards warn), else the smallest;
/// 0 if nothing is forecast. The state whose maps are shown where only one can be.
double trusted_horizon(const Delivery& delivery);

/// "+10 units", "+1 unit", "+7.5 units", "-40 units".
std::string units_text(double units);

/// What one unit means, in one sentence; the same wherever a horizon is written.
extern const char* const kUnitSentence;

/// "0.1.0": the library that wrote a file.
std::string writer_version();

/// Map names as people read them, in the order of Material: see map_origins(). "coverage" is not
/// among them there and follows the other modeled maps.
Origin origin_of(const std::vector<MapOrigin>& origins, const std::string& map);

}  // namespace verdigris
