// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <cstdint>

#include "transillum/vec3.h"

namespace transillum::viewer {

/// Up to four significant digits, with thousands apart: 0.01234, 1.234 × 10⁻⁶, 19 976.
QString number_text(double value);
/// Thousands apart by a thin space: 19 976.
QString count_text(std::int64_t value);
/// Powers of ten for an axis: 10⁻⁴.
QString power_of_ten_text(int exponent);
/// 3 s, 2 min 05 s, 1 h 20 min.
QString duration_text(double seconds);
/// With a large first letter.
QString capitalized(const QString& text);
/// Three numbers apart by two spaces.
QString rgb_text(const Rgb& value);
QString vector_text(const Vec3& value);

}  // namespace transillum::viewer
