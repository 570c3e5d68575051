// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "radiosity/ratio.h"
#include "transillum/scene.h"
#include "transillum/vec3.h"

namespace transillum {

/// How much the estimate of B changed, W/m², and its reflected light.
struct EstimateChange {
  double change = 0;
  double largest = 0;         ///< reflected light of patches that do not emit
  double largest_of_all = 0;  ///< reflected light of all patches

  double relative() const { return ratio_or_zero(change, largest > 0 ? largest : largest_of_all); }
};

/// The iteration that passes are being added to.
struct IterationUnderWay {
  bool begun = false;
  std::vector<Vec3> directions;  ///< in the order of the passes
  int from_kept_sums = 0;        ///< passes that need not be made: their exchanges are kept
  std::vector<Rgb> estimate;     ///< estimate of B, W/m²; between iterations B itself
  std::vector<double> changes;   ///< changes of the estimate, relative, at each pass made
  std::vector<EstimateChange> changes_of_owned;  ///< in a group: those not yet in `changes`
  double seconds = 0;                            ///< wall time so far
  double energy_defect = 0;                      ///< defect of the last finished iteration

  /// Ends the iteration, which leads to `b`.
  void end(const std::vector<Rgb>& b) {
    begun = false;
    changes.clear();
    changes_of_owned.clear();
    estimate = b;
    seconds = 0;
  }
  /// For StateOutput and StateInput. Directions are not part of the state.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive(self.begun, self.from_kept_sums, self.changes, self.seconds, self.energy_defect);
    archive.fixed(self.estimate);
  }
};

}  // namespace transillum
