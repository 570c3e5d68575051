// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// The directions of a set that are above a surface: of each pass omega or -omega.
struct Hemisphere {
  std::vector<double> x, y, z;  ///< unit vectors
  std::vector<double> cosine;   ///< with the normal, >= 0

  Hemisphere(const std::vector<Vec3>& directions, const Vec3& normal);
  std::size_t size() const { return x.size(); }
  Vec3 direction(std::size_t q) const { return {x[q], y[q], z[q]}; }
};

/// p(a, b) of LobeFunction: 1 at its peak, symmetric to the last bit.
class LobeKernel {
 public:
  explicit LobeKernel(const Lobe& lobe);

  /// p of two directions by their cosines with the normal and with each other.
  double value(double cosine_a, double cosine_b, double between) const;
  /// values[q] = p(a, q) for all directions q, the bits of value().
  /// @param values of as many as there are directions
  void row(const Vec3& a, double cosine, const Hemisphere& directions, double* values) const;
  /// equivalent_exponent()
  double exponent() const { return width_; }

 private:
  double power(double base) const;

  LobeShape shape_;
  double exponent_ = 0;
  unsigned whole_exponent_ = 0;
  bool is_whole_ = false;
  double least_ = 0;   ///< smaller bases are taken as 0: their powers are below 1e-30
  double alpha2_ = 1;  ///< alpha² of ggx
  double width_ = 0;
};

}  // namespace transillum
