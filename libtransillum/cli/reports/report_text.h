// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/vec3.h"

namespace transillum::cli {

/// A line of a report: a name, padded to a column, and its value.
std::string report_row(const std::string& name, const std::string& value);

/// The three channels, with the given number of significant digits.
std::string rgb_text(const Rgb& color, int digits);

/// A fraction as people read it: 0.5 -> "50 %", 0.012 -> "1.2 %", 1e-7 -> "less than 0.001 %";
/// below 1e-9, which is rounding, "0 %".
std::string fraction_text(double fraction);

/// A phrase for after the error of a surface: what it is relative to; empty for its own level.
std::string dark_text(bool is_dark);

/// 75 s -> "1:15 min".
std::string time_text(double seconds);

}  // namespace transillum::cli
