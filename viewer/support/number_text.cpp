// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/number_text.h"

#include <QLocale>
#include <QStringList>
#include <algorithm>
#include <clocale>
#include <cmath>

namespace transillum::viewer {

void use_decimal_point() {
  QLocale::setDefault(QLocale::c());
  std::setlocale(LC_NUMERIC, "C");
}

QString count_text(std::int64_t value) {
  QString digits = QString::number(value < 0 ? -value : value);
  for (qsizetype place = digits.size() - 3; place > 0; place -= 3) {
    digits.insert(static_cast<int>(place), QChar(0x2009));
  }
  return value < 0 ? QChar(0x2212) + digits : digits;
}

QString number_text(double value) {
  if (!std::isfinite(value)) {
    return QStringLiteral("–");
  }
  const double size = std::abs(value);
  if (size >= 999.95 && size < 1e7) {  // four digits are whole numbers
    return count_text(std::llround(value));
  }
  QString text = QString::number(value, 'g', 4);
  const auto exponent_at = text.indexOf(QLatin1Char('e'));
  if (exponent_at >= 0) {
    const QString power = power_of_ten_text(text.mid(exponent_at + 1).toInt());
    const QString lead = text.left(exponent_at);
    text = lead == QLatin1String("1") ? power : lead + QStringLiteral("\u00a0×\u00a0") + power;
  }
  return text.replace(QLatin1Char('-'), QChar(0x2212));
}

QString power_of_ten_text(int exponent) {
  static const QString superscripts = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString text = QStringLiteral("10");
  if (exponent < 0) {
    text += QChar(0x207B);
  }
  for (const QChar digit : QString::number(std::abs(exponent))) {
    text += superscripts[digit.digitValue()];
  }
  return text;
}

QString duration_text(double seconds) {
  if (!(seconds < 360000)) {
    return QStringLiteral("over 100 h");
  }
  const auto whole = static_cast<int>(std::ceil(seconds));
  if (whole < 60) {
    return QStringLiteral("%1 s").arg(whole);
  }
  if (whole < 3600) {
    return QStringLiteral("%1 min %2 s").arg(whole / 60).arg(whole % 60, 2, 10, QLatin1Char('0'));
  }
  return QStringLiteral("%1 h %2 min")
      .arg(whole / 3600)
      .arg(whole % 3600 / 60, 2, 10, QLatin1Char('0'));
}

QString capitalized(const QString& text) { return text.left(1).toUpper() + text.mid(1); }

QString rgb_text(const Rgb& value) {
  return QStringList{number_text(value.r), number_text(value.g), number_text(value.b)}.join(
      QStringLiteral("   "));
}

QString vector_text(const Vec3& value) {
  const auto coordinate = [](double x) {
    // Avoids "-0.000".
    const double rounded = std::round(x * 1000) / 1000;
    return QString::number(rounded == 0 ? 0.0 : rounded, 'f', 3)
        .replace(QLatin1Char('-'), QChar(0x2212));
  };
  return QStringLiteral("(%1, %2, %3)")
      .arg(coordinate(value.x), coordinate(value.y), coordinate(value.z));
}

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
