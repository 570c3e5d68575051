// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/reports/report_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace transillum::cli {

std::string report_row(const std::string& name, const std::string& value) {
  return fmt::format("{:<18} {}\n", name, value);
}

std::string rgb_text(const Rgb& color, int digits) {
  return fmt::format("{:.{}g} {:.{}g} {:.{}g}", color.r, digits, color.g, digits, color.b, digits);
}

std::string fraction_text(double fraction) {
  if (fraction < 1e-9) {
    return "0 %";  // rounding
  }
  const double percent = 100 * fraction;
  if (percent < 0.001) {
    return "less than 0.001 %";
  }
  // Two digits, three above 99 %, where the rest counts; no exponent, no zeros at the end.
  if (percent >= 99.95 || (percent >= 9.95 && percent < 99)) {
    return fmt::format("{:.0f} %", percent);
  }
  return percent > 9 ? fmt::format("{:.1f} %", percent) : fmt::format("{:.2g} %", percent);
}

std::string dark_text(bool is_dark) {
  return is_dark ? " of a thousandth of the brightest surface, as it is in the dark" : "";
}

std::string time_text(double seconds) {
  if (!std::isfinite(seconds)) {
    return "?";
  }
  if (seconds < 1) {
    return fmt::format("{:.0f} ms", 1000 * seconds);
  }
  if (seconds < 59.95) {
    return fmt::format("{:.1f} s", seconds);
  }
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 3600) {
    return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  }
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace transillum::cli
