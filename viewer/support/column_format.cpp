// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/column_format.h"

#include <algorithm>
#include <cmath>

#include "support/number_text.h"

namespace transillum::viewer {

ColumnFormat::ColumnFormat(double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) {
    return;
  }
  const int magnitude = static_cast<int>(std::floor(std::log10(largest)));
  constexpr int smallest = -2, greatest = 5;  // written without a power of ten
  if (magnitude < smallest || magnitude > greatest) {
    exponent_ = 3 * static_cast<int>(std::floor(magnitude / 3.0));
  }
  constexpr int digits = 5;
  decimals_ = std::max(digits - 1 - (magnitude - exponent_), 0);
}

QString ColumnFormat::text(double value) const {
  if (!std::isfinite(value)) {
    return QStringLiteral("–");
  }
  if (value == 0) {
    return QStringLiteral("0");
  }
  const double scaled = value * std::pow(10.0, -exponent_);
  if (std::abs(scaled) < 0.5 * std::pow(10.0, -decimals_)) {
    return QStringLiteral("≈ 0");
  }
  return QString::number(scaled, 'f', decimals_).replace(QLatin1Char('-'), QChar(0x2212));
}

QString ColumnFormat::header(const QString& title) const {
  if (exponent_ == 0) {
    return title;
  }
  const QString power = power_of_ten_text(exponent_);
  const auto unit = title.lastIndexOf(QLatin1String(", "));
  return unit < 0 ? title + QStringLiteral(", ") + power
                  : title.left(unit + 2) + power + QChar(' ') + title.mid(unit + 2);
}

}  // namespace transillum::viewer
