// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/exchange/owned_patches.h"
#include "transillum/first_shot.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum {

/// Compares the light of a first shot with what passes see of the same sources: two methods that
/// share only the scene. Measures nothing without a shot.
class ShotCheck {
 public:
  /// Keeps references to both.
  ShotCheck(const Scene& scene, const DirectLight& shot, const OwnedPatches& owned);

  /// Adds a pass along a direction that is new; it serves its opposite too.
  void add(const Transfers& transfers);
  /// Completes the sums of all patches; to be called before disagreement().
  void complete();

  struct Disagreement {
    /// Largest difference over what the errors of both explain; above 1, one of them is wrong.
    double ratio = 0;
    PatchId patch = -1;  ///< that receives it; -1: all patches together
  };
  Disagreement disagreement() const;

  /// For StateOutput and StateInput, between two passes.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive(self.passes_);
    for (auto& row : self.rows_) {
      archive(row.received, row.squares, row.sent, row.sent_squares, row.sent_facing, row.facing,
              row.facing_squares);
    }
  }

 private:
  /// Sums of one patch over directions: what it receives and, as a source, sends to patches that
  /// it sees, W; and of its projected area times its exitance, which it would send if it saw no
  /// gaps and no backs, W.
  struct Row {
    double received = 0, squares = 0;
    double sent = 0, sent_squares = 0, sent_facing = 0;
    double facing = 0, facing_squares = 0;
    double receives_now = 0, sends_now = 0;  ///< along the direction being added; else 0
  };
  void exchange(PatchId receiver, PatchId source, double area);
  double most_of(PatchId i) const;
  double error_of(PatchId i) const;
  double allowed_of(PatchId i, double received, double shot) const;
  double surprise_of(PatchId i, double received, double shot) const;
  Disagreement of_power() const;

  const Scene& scene_;
  const DirectLight& shot_;
  OwnedPatches owned_;
  std::int64_t passes_ = 0;
  double power_ = 0;              ///< power of all sources, W
  double largest_exitance_ = 0;   ///< W/m²
  std::vector<double> exitance_;  ///< exitance of the shot, sum of channels; empty without one
  std::vector<Row> rows_;         ///< per patch; empty without a shot
  std::vector<PatchId> lit_;      ///< patches that the direction being added has met
};

}  // namespace transillum
