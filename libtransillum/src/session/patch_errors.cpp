// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The light that the functions of patches cannot represent. Input: solves of a scene and of the
// same scene with its patches divided; both of the same directions, so that these errors cancel.
#include "session/patch_errors.h"

#include <algorithm>
#include <array>

#include "radiosity/channel_sums.h"
#include "transillum/at.h"
#include "transillum/linear_basis.h"

namespace transillum {
namespace {

/// Integrals of B over a patch, times its functions, from the patches that it is divided into.
struct Projection {
  Rgb square;                       ///< integral of B²
  std::array<Rgb, 3> coefficients;  ///< integrals of B phi_a, over the area
};

/// Adds what patch k of the divided scene contributes to the projection onto patch i.
void add_to(Projection& projection, const Solution& fine, PatchId k, const LinearBasis* own,
            const LinearBasis* basis, double whole_area) {
  const Patch& patch = fine.scene->patch(k);
  const double fraction = patch.area / whole_area;
  const Rgb& mean = at(fine.radiosity, k);
  projection.square += square_integral(fine, k);
  projection.coefficients[0] += fraction * mean;
  if (basis == nullptr) {
    return;
  }
  const auto at_center = basis->at(own->center);
  const LinearTerm& term = at(fine.linear_terms, k);
  for (std::size_t a = 0; a < 2; ++a) {
    // A function of the whole in terms of functions of the part: phi = value + s1 psi_1 + s2 psi_2.
    // Their gradients need not be orthogonal: psi_1 is constant across the longest edge.
    const Vec3 &g = basis->gradient[a], &h1 = own->gradient[0], &h2 = own->gradient[1];
    const double h11 = dot(h1, h1), h12 = dot(h1, h2), h22 = dot(h2, h2);
    const double g1 = dot(g, h1), g2 = dot(g, h2);
    const double determinant = h11 * h22 - h12 * h12;
    const double s1 = (g1 * h22 - g2 * h12) / determinant;
    const double s2 = (g2 * h11 - g1 * h12) / determinant;
    projection.coefficients[a + 1] +=
        fraction * (at_center[a] * mean + s1 * term.first + s2 * term.second);
  }
}

/// Per patch of `whole`.
std::vector<Projection> projections(const Scene& whole, const DividedScene& divided,
                                    const Solution& fine) {
  const bool linear = !fine.linear_terms.empty();
  const std::vector<LinearBasis> own = linear ? linear_bases(*divided.scene)
                                              : std::vector<LinearBasis>(),
                                 bases = linear ? linear_bases(whole) : std::vector<LinearBasis>();
  std::vector<Projection> result(whole.patches().size());
  for (PatchId k = 0; k < divided.scene->patch_count(); ++k) {
    const PatchId i = at(divided.parent, k);
    add_to(at(result, i), fine, k, linear ? &at(own, k) : nullptr, linear ? &at(bases, i) : nullptr,
           whole.patch(i).area);
  }
  return result;
}

/// The coefficients of B on patch i.
std::array<Rgb, 3> coefficients(const Solution& solution, PatchId i) {
  if (solution.linear_terms.empty()) {
    return {at(solution.radiosity, i), {}, {}};
  }
  const LinearTerm& term = at(solution.linear_terms, i);
  return {at(solution.radiosity, i), term.first, term.second};
}

}  // namespace

Rgb square_integral(const Solution& solution, PatchId i) {
  const Rgb& mean = at(solution.radiosity, i);
  Rgb sum = mean * mean;
  if (!solution.linear_terms.empty()) {
    const LinearTerm& term = at(solution.linear_terms, i);
    sum += term.first * term.first + term.second * term.second;
  }
  return solution.scene->patch(i).area * sum;
}

PatchErrors patch_errors(const Scene& whole, const DividedScene& divided, const Solution& fine,
                         const Solution* coarse) {
  const std::vector<Projection> onto = projections(whole, divided, fine);
  PatchErrors errors;
  for (PatchId i = 0; i < whole.patch_count(); ++i) {
    const Projection& p = at(onto, i);
    const double area = whole.patch(i).area;
    Rgb represented;
    for (const Rgb& c : p.coefficients) {
      represented += c * c;
    }
    errors.unrepresented.push_back(largest_of({}, p.square - area * represented));
    if (coarse != nullptr) {
      const std::array<Rgb, 3> found = coefficients(*coarse, i);
      Rgb squares;
      for (std::size_t a = 0; a < found.size(); ++a) {
        const Rgb off = p.coefficients[a] - found[a];
        squares += off * off;
      }
      errors.displaced.push_back(area * squares);
    }
  }
  return errors;
}

}  // namespace transillum
