// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cmath>

#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

/// A point or a vector in space; points in meters.
struct Vec3 {
  double x = 0;  ///< first coordinate
  double y = 0;  ///< second coordinate
  double z = 0;  ///< third coordinate

  /// Exact comparison, component by component.
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// @name Vector arithmetic
/// @{

/// Component by component.
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator*(const Vec3& a, double s) { return s * a; }
inline Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
/// @}

/// Scalar product.
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Vector product, right-handed.
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Euclidean length.
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The unit vector along `a`; `a` must not be zero.
inline Vec3 normalized(const Vec3& a) { return a / norm(a); }
/// The largest magnitude of the three components.
inline double max_abs(const Vec3& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}
/// Whether no component is infinite or NaN.
inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// One value per color channel: reflectance (1), or exitance, radiosity or irradiance (W/m²).
struct Rgb {
  double r = 0;  ///< red
  double g = 0;  ///< green
  double b = 0;  ///< blue

  /// Exact comparison, channel by channel.
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// @name Color arithmetic
/// @{

/// Channel by channel.
inline Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator-(const Rgb& a, const Rgb& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline Rgb operator*(const Rgb& a, const Rgb& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Rgb operator*(double s, const Rgb& a) { return {s * a.r, s * a.g, s * a.b}; }
inline Rgb& operator+=(Rgb& a, const Rgb& b) { return a = a + b; }
/// @}

/// The largest magnitude of the three channels: the paper's maximum norm, for one patch.
inline double max_abs(const Rgb& a) {
  return std::max({std::abs(a.r), std::abs(a.g), std::abs(a.b)});
}

/// An axis-parallel box; empty until a point is added.
struct Bounds {
  Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};      ///< smallest coordinates, m
  Vec3 high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};  ///< largest coordinates, m

  /// Extends the box to contain `p`.
  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  /// Whether no point has been added.
  bool empty() const { return low.x > high.x; }
  /// The center; NaN for an empty box.
  Vec3 center() const { return 0.5 * low + 0.5 * high; }
  /// Length of the diagonal, m; 0 for an empty box.
  double diagonal() const { return empty() ? 0.0 : norm(high - low); }
};

}  // namespace TRANSILLUM_API transillum
