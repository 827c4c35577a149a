// SPDX-License-Identifier: MIT
// A number in print: the one place where digits are decided, so that a table, an axis and a
// tooltip say the same.
#pragma once

#include <string>

namespace verdigris {

enum class NumberStyle {
    significant,  ///< `digits` significant digits, zeros kept: 0.0120
    fixed,        ///< `digits` decimals: 12.50
    scientific,   ///< `digits` decimals of the mantissa: 1.20e-03
    percent,      ///< the value is a fraction; 0.123 with one decimal is "12.3 %"
    integer,      ///< rounded to the nearest: 810
};

struct NumberFormat {
    NumberStyle style = NumberStyle::significant;
    int digits = 4;     ///< 0..17; for `significant` at least 1; nothing to `integer`
    bool sign = false;  ///< "+" before what is above zero: for gains and differences
};

/// ASCII, with "." whatever the locale: "-12.3 %", "1.20e-03", "NaN", "inf", "-inf". A value that
/// rounds to zero carries no sign: "-0.00" would claim a direction that the digits do not show.
std::string number_text(double value, NumberFormat format);

/// The same in typographic UTF-8: a true minus, "∞", and 1.20×10⁻³ for exponents.
std::string typeset_number(double value, NumberFormat format);

/// The shortest text that reads back as the same double: "0.1", "1e-300", "nan", "inf", "-inf".
std::string exact_number(double value);

}  // namespace verdigris
