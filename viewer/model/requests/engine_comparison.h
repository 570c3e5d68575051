// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/snapshot.h"
#include "transillum/cancellation.h"
#include "visibility/transfers/transfer_comparison.h"

namespace transillum::viewer {

/// Two engines on the same direction. If one has no directions (hemicube, pairs): the row of form
/// factors of one patch by both engines, over all directions of the solve run.
struct EngineComparison {
  struct Side {
    Engine engine = Engine::fast;
    int resolution = 0;           ///< EngineOptions::resolution
    double seconds = 0;           ///< processor time of the direction or row, one thread
    std::size_t pairs = 0;        ///< number of pairs of patches that exchange light
    double covered_fraction = 0;  ///< covered over projected area of all receivers, 0 to 1
    std::string failure;          ///< why the engine gave no result; empty on success
  };
  std::shared_ptr<const LoadedScene> loaded;
  Vec3 direction;
  PatchId eye = no_patch;  ///< patch whose row was compared; no_patch if a direction was compared
  Side first, other;
  TransferComparison transfers;   ///< set if ok(); for a row A_i F_ij, m²
  std::vector<double> projected;  ///< per patch: its area on the plane, m²; or half of A_i F_ij

  bool ok() const { return first.failure.empty() && other.failure.empty(); }
};

/// The direction or row, and the engines, to compare.
struct EngineRequest {
  std::shared_ptr<const LoadedScene> loaded;
  Vec3 direction;
  EngineOptions options;  ///< except the resolution
  Engine first = Engine::fast, other = Engine::corrected;
  int first_resolution = 0, other_resolution = 0;
  // Used if an engine has no directions:
  PatchId eye = no_patch;
  std::shared_ptr<const std::vector<Vec3>> directions;
  bool two_way = true;

  bool compares_rows() const { return !takes_directions(first) || !takes_directions(other); }
  friend bool operator==(const EngineRequest&, const EngineRequest&) = default;
};

/// An engine's failure is in `first.failure` or `other.failure`. Any thread.
/// @throws Canceled
EngineComparison compare_engines(const EngineRequest& request, const Cancellation& cancellation);
/// A comparison without results.
EngineComparison failed_comparison(const EngineRequest& request, const std::string& failure);

}  // namespace transillum::viewer
