// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/reflected_light.h"
#include "transillum/cancellation.h"
#include "transillum/first_shot.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// Checks what is solved with given form factors.
/// @param patch_materials index into `materials` for each patch; empty: Patch::material
/// @throws InputError where a list does not fit the scene or a material is out of range
void check_form_factor_input(const Scene& scene, const FormFactors& form_factors,
                             const std::vector<Material>& materials,
                             std::span<const std::int32_t> patch_materials);

/// The unknowns of a patch, 1 or 3.
/// @throws InputError where functions are linear and the form factors have no moments
std::size_t unknowns_of_patch(const FormFactors& form_factors, Basis basis);

/// @throws InputError unless `patch` is one of the scene's.
void check_receiver(const Scene& scene, PatchId patch);

/// The material of a patch, from lists that check_form_factor_input() has accepted.
const Material& material_of_patch(const Scene& scene, const std::vector<Material>& materials,
                                  std::span<const std::int32_t> patch_materials, PatchId patch);

/// Jacobi iteration of B_i = E_i + rho_i H_i, H_i = sum_j F_ij B_j (eq. 11). Rows are computed in
/// parallel; the result does not depend on the number of threads.
///
/// With several unknowns per patch, B and H are coefficients b_ia of functions phi_a, unknown
/// per_patch i + a, and only phi_0 has E_i.
struct JacobiIteration {
  /// A solve by tolerance that needs more iterations is considered divergent.
  static constexpr int max_iterations = 10'000;

  /// Starts from B = E. Keeps references to the arguments.
  /// @param materials E and rho: one per material of the scene, in its order
  /// @param threads 0: all cores
  /// @param patch_materials index into `materials` for each patch; empty: Patch::material
  /// @param per_patch unknowns of a patch; 3 require FormFactors::moments
  JacobiIteration(const Scene& scene, const FormFactors& form_factors,
                  std::span<const Material> materials, int threads,
                  std::span<const std::int32_t> patch_materials = {}, std::size_t per_patch = 1);

  std::vector<Rgb> b, h;  ///< W/m², one per unknown; `b` may be set to another start
  std::vector<IterationRecord> records;  ///< one per iteration
  bool converged = false;

  /// From now on adds the light of `shot`, and does not gather the exitance that it covers:
  ///   B_i = E_i + rho_i (H_i of the shot + sum_j F_ij (B_j - E_j shot)).
  /// @throws Canceled
  void shoot_first(const DirectLight& shot, const Cancellation& cancellation);
  /// From now on adds to H what each patch receives from a sky; nothing if empty.
  /// @param linear_terms of `irradiance`, one per patch with linear functions
  /// @throws InputError where there is not one mean >= 0 per patch
  void add_sky(std::span<const Rgb> irradiance, std::span<const LinearTerm> linear_terms = {});
  /// Iterates up to `limit` iterations in total, or until the light not yet propagated is at most
  /// `tolerance` of the reflected light (IterationRecord::remainder, remainder_dimmest).
  /// @throws Canceled; NotConvergent where B exceeds the range of numbers
  void run(int limit, double tolerance, const Cancellation& cancellation);
  /// Iterates until the tolerance is reached.
  /// @throws Canceled; NotConvergent where max_iterations do not reach it
  void run_to(double tolerance, const Cancellation& cancellation);

 private:
  /// sum_v F_uv B_v
  Rgb gather(std::size_t unknown, const std::vector<Rgb>& values) const;
  /// Calls visit(u) for every unknown u, on several threads.
  template <class Visit>
  void for_each_row(const Cancellation& cancellation, Visit visit) const;

  /// Material of the patch of an unknown.
  const Material& material(std::size_t unknown) const;
  Rgb exitance(std::size_t unknown) const;
  RemainderBound remainder_bound() const;

  const Scene& scene_;
  const FormFactors& form_factors_;
  std::span<const Material> materials_;
  std::span<const std::int32_t> patch_materials_;
  std::size_t per_patch_;
  std::vector<Rgb> correction_;  ///< by first shot and sky, to sum_j F_ij B_j; may be empty
  int threads_;
};

}  // namespace transillum
