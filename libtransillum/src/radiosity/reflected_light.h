// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Reflected light, B - E, to which relative values refer. E of a small lamp exceeds all
// reflected light a million times, and would hide any error (decisions/0079-reflected-light.md).
#pragma once

#include <cstddef>
#include <vector>

#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// The reflected light of a scene's patches.
///
/// It is measured on patches that do not emit; on all patches where all emit, or where the others
/// reflect nothing. Lists have one value per unknown, `per_patch` for each patch.
class ReflectedLight {
 public:
  /// Takes the exitance of the scene's materials.
  explicit ReflectedLight(const Scene& scene, std::size_t per_patch = 1);
  /// @param exitance W/m², one per unknown; 0 except for the mean of a patch
  ReflectedLight(std::vector<Rgb> exitance, std::size_t per_patch);

  /// Whether unknown u belongs to a patch that emits.
  bool emits(std::size_t u) const { return emits_[u / per_patch_] != 0; }
  /// E, W/m², one per unknown.
  const std::vector<Rgb>& exitance() const { return exitance_; }
  /// B - E of an unknown with B = `b`, W/m².
  Rgb of(std::size_t u, const Rgb& b) const { return b - exitance_[u]; }
  /// For each unknown, whether its reflected light is measured.
  /// @param b B, W/m²
  std::vector<char> measured(const std::vector<Rgb>& b) const;
  /// B - E, W/m², where it is measured, and 0 elsewhere.
  std::vector<Rgb> of(const std::vector<Rgb>& b) const;

 private:
  std::vector<Rgb> exitance_;
  std::size_t per_patch_;
  std::vector<char> emits_;  ///< by patch
};

/// Whether no patch receives light although sources emit and patches mostly see each other, so that
/// an engine of samples has missed all sources: B = E is no result then.
bool is_all_light_lost(const Solution& solution);

/// Whether the changes of an iteration are rounding, which further iterations do not decrease.
inline bool is_rounding(const IterationRecord& record) {
  constexpr double rounding = 1e-12;  // relative to the largest reflected light
  return record.change <= rounding && record.contraction >= 1;
}

/// Bounds of the light that an iteration has not yet propagated.
class RemainderBound {
 public:
  /// @param area of the patch of each unknown, m²
  /// @param reflectance of the patch of each unknown
  RemainderBound(ReflectedLight light, std::vector<double> area, std::vector<Rgb> reflectance,
                 std::size_t per_patch);

  /// Sets change, change_of_b, changes, remainder, remainder_dimmest and unlit_area of `record`,
  /// for an iteration of eq. 11.
  /// @param b B after the iteration, W/m²
  /// @param changes of B by the iteration, W/m²
  /// @param contraction bound on the factor by which an iteration reduces the changes
  /// @param largest_change of any radiance, times pi, W/m²; where lobes take part, it can exceed
  /// all `changes`, in all channels in proportion
  void describe(IterationRecord& record, const std::vector<Rgb>& b, const std::vector<Rgb>& changes,
                double contraction, double largest_change = 0) const;
  /// Sets remainder, remainder_dimmest and unlit_area of `record`.
  /// @param left bound of what B is off by, W/m²
  void describe(IterationRecord& record, const std::vector<Rgb>& b,
                const std::vector<Rgb>& left) const;
  /// Largest |change| over the largest reflected light.
  double relative_change(const std::vector<Rgb>& b, const std::vector<Rgb>& changes) const;
  /// Power of the changes over the emitted power, in the channel where it is largest.
  /// @param from_sky irradiance from the sky, W/m², one per patch; empty if there is none
  double changed_power(const std::vector<Rgb>& changes, const std::vector<Rgb>& from_sky) const;

 private:
  /// Unknowns: the means of the patches of some part of the scene.
  using Unknowns = std::vector<std::size_t>;
  /// @param bound_of bound of the power that a part is missing in a channel, W
  template <class BoundOf>
  void describe_unknowns(IterationRecord& record, const std::vector<Rgb>& b,
                         BoundOf bound_of) const;
  /// The part of `lit` with the least reflected light, a tenth of its area.
  Unknowns dimmest(Unknowns lit, const std::vector<Rgb>& reflected, double Rgb::*channel) const;

  ReflectedLight light_;
  std::vector<double> area_;
  std::vector<Rgb> reflectance_;
  std::size_t per_patch_;
};

}  // namespace transillum
