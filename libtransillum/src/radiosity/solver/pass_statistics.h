// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/error/light_directions.h"
#include "radiosity/error/shot_check.h"
#include "radiosity/exchange/visible_area_sums.h"
#include "transillum/first_shot.h"
#include "transillum/patch_sums.h"
#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// Measurements along each direction, made once: areas, closure, counts and the error of the
/// quadrature of the cosine. Later passes along the same direction are not added again.
class PassStatistics {
 public:
  /// Keeps references to `scene` and `shot`.
  /// @param shot its sources do not count as direct light
  /// @param share the patches of the coverages of passes
  /// @param per_patch unknowns per patch
  /// @param reflectance of each patch
  PassStatistics(const Scene& scene, bool two_way, const DirectLight& shot,
                 const OwnedPatches& owned, std::size_t per_patch,
                 const std::vector<Rgb>& reflectance);

  /// Starts another set of directions (semi-iterative scheme): clears areas() and
  /// quadrature_errors(); all other values continue over all sets.
  void begin_set();
  /// Adds the first pass along a direction.
  void add(const Pass& pass);

  /// Extends quadrature_errors() to all patches, in a group.
  void complete_errors();
  /// Completes what is summed per patch.
  void complete();

  /// Areas of the current set of directions.
  const VisibleAreaSums& areas() const { return areas_; }
  /// Entry d: eps (eq. 17) of the first d + 1 passes of the current set, largest over patches.
  const std::vector<double>& quadrature_errors() const { return quadrature_errors_; }
  /// Per patch: share of its visible area at which receivers see its back.
  std::vector<double> back_seen_fractions() const;
  /// Sets transfers, counts, closure defects and escaped.
  void write_to(SolveStatistics& statistics) const;

  /// For StateOutput and StateInput.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    auto& c = self.counts_;
    archive(self.areas_, self.quadrature_errors_, self.projected_, self.covered_,
            self.closure_relative_, self.closure_grazing_, self.closure_moments_, self.light_,
            self.shot_, self.transfer_count_, c.pairs, c.cuts, c.decisions, c.exact_decisions,
            c.exact_queries, c.pixels, c.missed, c.seconds_order, c.seconds_bins, c.seconds_clip);
    archive.fixed(self.facing_area_, self.back_seen_, self.uncovered_);
  }

 private:
  const Scene& scene_;
  bool two_way_;
  OwnedPatches owned_;
  VisibleAreaSums areas_;
  std::vector<double> quadrature_errors_;
  std::size_t complete_errors_ = 0;  ///< number of them that are of all patches
  std::vector<double> facing_area_;  ///< per patch: projected area over all passes, both directions
  std::vector<double> back_seen_;    ///< per patch: of that, seen by receivers from its back
  std::vector<double> uncovered_;    ///< per patch: of that, with no patch above
  double projected_ = 0;             ///< projected area of all patches, m²
  double covered_ = 0;               ///< the part of it with a patch above, m²
  /// Largest ClosureDefect so far
  double closure_relative_ = 0, closure_grazing_ = 0, closure_moments_ = 0;
  LightDirections light_;
  ShotCheck shot_;
  std::int64_t transfer_count_ = 0;
  PassCounts counts_;
};

}  // namespace transillum
