// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "radiosity/reflected_light.h"
#include "radiosity/sun_light.h"
#include "transillum/first_shot.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/transfers.h"

namespace transillum {

/// The numbers that a solve computes: B_i of every patch, or with Basis::linear the coefficients
/// b_ia of its functions, as unknown 3 i + a. What is the same for all functions of a patch is
/// given for each of them, so that one equation serves both bases:
///   b_u = e_u + rho_u (h_u of the shot and the sun + 4 / (M A_u) sum_d sum_v T(u,v,omega_d) b_v).
struct Unknowns {
  std::size_t per_patch;              ///< 1, or 3
  std::vector<double> area;           ///< measure of its patch: ∫ phi_a², m²
  std::vector<Rgb> exitance;          ///< E_i for phi_0, 0 for the others
  std::vector<Rgb> reflectance;       ///< reflectance of its patch
  std::vector<Rgb> shot_exitance;     ///< DirectLight's
  std::vector<Rgb> sun_irradiance;    ///< SunLight's; empty without a sun
  std::vector<Rgb> given_irradiance;  ///< from the first shot and the sun

  /// @throws InputError where functions are linear and `shot` has no linear terms
  Unknowns(const Scene& scene, Basis basis, const DirectLight& shot, const SunLight& sun = {});

  std::size_t count() const { return area.size(); }
  ReflectedLight light() const { return {exitance, per_patch}; }
  /// The unknown of phi_0 on patch i: the mean of B.
  std::size_t mean_of(PatchId i) const { return static_cast<std::size_t>(i) * per_patch; }
  /// The values of phi_0, one per patch.
  std::vector<Rgb> means(const std::vector<Rgb>& values) const;
};

/// Calls visit(t, a, b) for each exchange and all functions a of its receiver and b of its source:
/// t is T^ab between their unknowns. Receivers rise.
template <class Visit>
void for_each_exchange(const Transfers& transfers, std::size_t per_patch, Visit visit) {
  const std::vector<Transfer>& exchanges = transfers.exchanges;
  if (per_patch == 1) {
    for (const Transfer& t : exchanges) {
      visit(t, 0, 0);
    }
    return;
  }
  const auto n = static_cast<PatchId>(per_patch);
  for (std::size_t k = 0, end = 0; k < exchanges.size(); k = end) {
    const PatchId receiver = exchanges[k].receiver;
    while (end < exchanges.size() && exchanges[end].receiver == receiver) {
      ++end;
    }
    for (PatchId a = 0; a < n; ++a) {
      for (std::size_t m = k; m < end; ++m) {
        for (PatchId b = 0; b < n; ++b) {
          const double moment =
              transfers.moments[m].of(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
          visit(Transfer{n * receiver + a, n * exchanges[m].source + b, moment}, a, b);
        }
      }
    }
  }
}

}  // namespace transillum
