// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/precision.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace transillum {
namespace {

/// A number in its shortest decimal form that reads back: digits 10^exponent, no trailing zeros.
struct Decimal {
  int digits;    ///< how many
  int exponent;  ///< of the last digit
};

Decimal shortest(double v) {
  // d.ddde-xx
  std::array<char, 32> text;
  char* const end = std::to_chars(text.data(), text.data() + text.size(), std::abs(v),
                                  std::chars_format::scientific)
                        .ptr;
  char* const mark = std::find(text.data(), end, 'e');
  int power = 0;
  std::from_chars(mark[1] == '+' ? mark + 2 : mark + 1, end, power);
  const int digits = static_cast<int>(mark - text.data()) - (mark - text.data() > 1 ? 1 : 0);
  return {digits, power - digits + 1};
}

}  // namespace

double coordinate_rounding(std::span<const Vec3> points) {
  constexpr int fewest_digits = 6, most_digits = 15;
  double largest = 0;
  int digits = fewest_digits, last = 0;
  bool floats = true, any = false;
  for (const Vec3& p : points) {
    for (const double v : {p.x, p.y, p.z}) {
      if (v == 0) {
        continue;
      }
      largest = std::max(largest, std::abs(v));
      const Decimal d = shortest(v);
      digits = std::max(digits, d.digits);
      last = any ? std::min(last, d.exponent) : d.exponent;
      any = true;
      floats = floats && std::abs(v - static_cast<double>(static_cast<float>(v))) <=
                             0.5 * std::pow(10.0, d.exponent);
    }
  }
  if (!any) {
    return 0;
  }
  double unit = 0x1p-52 * largest;
  const int leading = static_cast<int>(std::floor(std::log10(largest)));
  if (digits <= most_digits) {
    unit = std::max(unit, std::pow(10.0, leading - digits + 1));
  }
  // Digits after the point are counted only as far as 6 digits of the largest number.
  unit = std::max(unit, std::pow(10.0, std::min(last, leading - fewest_digits + 1)));
  if (floats) {
    unit = std::max(unit, 0x1p-23 * largest);
  }
  return 0.5 * unit;
}

}  // namespace transillum
