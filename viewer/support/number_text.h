// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Numbers as text: alone, and in the columns of tables.
#pragma once

#include <QString>
#include <cstdint>

#include "transillum/vec3.h"

namespace transillum::viewer {

/// Sets a decimal point, without separators of thousands, for all widgets and for C functions, so
/// that numbers look as they do in files, whatever the user's locale. To be called once there is a
/// QCoreApplication, which sets the user's locale, and before the first widget.
void use_decimal_point();

/// Up to four significant digits: 0.01234, 1.234 × 10⁻⁶, 2 013, 19 976; "–" if not finite.
QString number_text(double value);
/// With thin spaces between thousands: 19 976.
QString count_text(std::int64_t value);
/// A power of ten for an axis: 10⁻⁴.
QString power_of_ten_text(int exponent);
/// Rounded up: 3 s, 2 min 05 s, 1 h 20 min.
QString duration_text(double seconds);
/// With a capital first letter.
QString capitalized(const QString& text);
/// Three number_text() separated by spaces.
QString rgb_text(const Rgb& value);
/// (x, y, z) with three decimals.
QString vector_text(const Vec3& value);

/// How the numbers of one column are written: with one power of ten, which stands in the header,
/// and the same number of decimals, so that they can be compared at a glance.
class ColumnFormat {
 public:
  ColumnFormat() = default;
  /// @param largest the largest size of a number in the column; it gets five significant digits
  explicit ColumnFormat(double largest);

  /// A number below half of the last decimal, but not 0, is "≈ 0"; "–" if not finite.
  QString text(double value) const;
  /// A title with the power of ten before its unit: "Area, m²" becomes "Area, 10⁻⁶ m²".
  QString header(const QString& title) const;

  friend bool operator==(const ColumnFormat&, const ColumnFormat&) = default;

 private:
  int exponent_ = 0;  ///< exponent of the power of ten, a multiple of 3
  int decimals_ = 4;
};

}  // namespace transillum::viewer
