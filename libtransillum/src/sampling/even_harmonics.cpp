// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A density 1 + δ on the sphere becomes uniform if its points move along -grad Φ, where the
// Laplacian of Φ is -δ, up to O(δ²). Of the density of the points, the part of even degrees l up to
// L is
//
//   Φ(x) = Σ_l (2l+1) / (l(l+1)) mean_j P_l(x·x_j),
//
// which the addition theorem splits into harmonics, so that the cost is linear in the points.
//
// Notation: R_lm = r^l P_lm(cos θ) e^{imφ} / (l+m)!, without the sign (-1)^m: the regular solid
// harmonics whose derivatives are harmonics again, ∂z R_lm = R_{l-1,m},
// (∂x - i∂y) R_lm = R_{l-1,m-1}, (∂x + i∂y) R_lm = -R_{l-1,m+1}.
#include "sampling/even_harmonics.h"

#include <array>
#include <tuple>

#include "transillum/at.h"

namespace transillum {
namespace {

/// A complex number whose products have no checks for infinities.
struct Complex {
  double re = 0, im = 0;
};

/// Index of degree l and order m, 0 <= m <= l.
constexpr int index(int l, int m) { return l * (l + 1) / 2 + m; }

/// R_lm, or coefficients of them, for all degrees.
using Harmonics = std::array<Complex, index(max_harmonic_degree + 1, 0)>;

/// 1 / ((l+m)(l-m)) for m < l.
constexpr auto recursion_factors = [] {
  std::array<double, std::tuple_size_v<Harmonics>> factors{};
  for (int l = 1; l <= max_harmonic_degree; ++l) {
    for (int m = 0; m < l; ++m) {
      at(factors, index(l, m)) = 1.0 / ((l + m) * (l - m));
    }
  }
  return factors;
}();

/// R_lm of a unit vector, up to `degree`.
void evaluate(const Vec3& a, int degree, Harmonics& r) {
  r[0] = {1, 0};
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) {
      const Complex before = at(r, index(m - 1, m - 1));
      at(r, index(m, m)) = {(before.re * a.x - before.im * a.y) / (2 * m),
                            (before.re * a.y + before.im * a.x) / (2 * m)};
    }
    Complex last{}, current = at(r, index(m, m));
    for (int l = m + 1; l <= degree; ++l) {
      const double slope = (2 * l - 1) * a.z, fraction = at(recursion_factors, index(l, m));
      const Complex next{(slope * current.re - last.re) * fraction,
                         (slope * current.im - last.im) * fraction};
      last = current;
      current = at(r, index(l, m)) = next;
    }
  }
}

/// The coefficients c_lm with Φ = Re Σ_lm conj(c_lm) R_lm, m >= 0.
Harmonics potential_of(const std::vector<Vec3>& points, int degree) {
  Harmonics sums{}, r;
  for (const Vec3& p : points) {
    evaluate(p, degree, r);
    for (int k = 0; k < index(degree + 1, 0); ++k) {
      at(sums, k).re += at(r, k).re;
      at(sums, k).im += at(r, k).im;
    }
  }
  for (int l = 2; l <= degree; l += 2) {
    // (l-m)! (l+m)!, from m = l down.
    double factorials = 1;
    for (int k = 2; k <= 2 * l; ++k) {
      factorials *= k;
    }
    for (int m = l; m >= 0; --m) {
      const double scale = (m > 0 ? 2 : 1) * factorials * (2 * l + 1) /
                           (l * (l + 1) * static_cast<double>(points.size()));
      at(sums, index(l, m)).re *= scale;
      at(sums, index(l, m)).im *= scale;
      factorials *= static_cast<double>(l - m + 1) / (l + m);
    }
  }
  return sums;
}

/// The gradient of Φ where the harmonics up to degree - 1 are `r`.
Vec3 gradient(const Harmonics& potential, const Harmonics& r, int degree) {
  Vec3 sum;
  for (int l = 2; l <= degree; l += 2) {
    const double zonal = at(potential, index(l, 0)).re;
    sum = sum + zonal * Vec3{-at(r, index(l - 1, 1)).re, -at(r, index(l - 1, 1)).im,
                             at(r, index(l - 1, 0)).re};
    for (int m = 1; m <= l; ++m) {
      const Complex c = at(potential, index(l, m));
      const Complex down = at(r, index(l - 1, m - 1));
      const Complex same = m < l ? at(r, index(l - 1, m)) : Complex{};
      const Complex up = m < l - 1 ? at(r, index(l - 1, m + 1)) : Complex{};
      sum.x += (c.re * (down.re - up.re) + c.im * (down.im - up.im)) / 2;
      sum.y += (c.im * (down.re + up.re) - c.re * (down.im + up.im)) / 2;
      sum.z += c.re * same.re + c.im * same.im;
    }
  }
  return sum;
}

}  // namespace

void move_to_exact_harmonics(std::vector<Vec3>& points, int degree) {
  const Harmonics potential = potential_of(points, degree);
  Harmonics r;
  for (Vec3& p : points) {
    evaluate(p, degree - 1, r);
    const Vec3 slope = gradient(potential, r, degree);
    p = normalized(p - (slope - dot(slope, p) * p));
  }
}

}  // namespace transillum
