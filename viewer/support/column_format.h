// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

namespace transillum::viewer {

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
