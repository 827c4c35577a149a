// SPDX-License-Identifier: MIT
// What the paper prints, to stand beside what comes out here.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace verdigris {

/// The paper's two transfer directions; in tables of ours the first recording takes the place of
/// the chamber, the second that of the open air.
inline constexpr int kChamberToAir = 0, kAirToChamber = 1, kNoDirection = -1;

struct PaperValue {
    const char* item;  ///< "table1" ... "table3", "figure12", "figure3" ... "figure5", "intervals"
                       ///< and "training" (both Section 6, in the text)
    int direction;
    const char* row;
    const char* column;
    const char* printed;  ///< its digits; percentages in percent
    /// Where it stands in the paper's source: the label of the table, the macro that holds it, or
    /// the words around it.
    const char* source;
};

std::span<const PaperValue> paper_values();

/// Nothing where the paper prints none.
std::optional<double> paper_value(std::string_view item, int direction, std::string_view row,
                                  std::string_view column);
/// What is printed in percent, as a fraction.
std::optional<double> paper_share(std::string_view item, int direction, std::string_view row,
                                  std::string_view column);

}  // namespace verdigris
