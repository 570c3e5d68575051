// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// One direction in the open scene and in the scene of another run: what changed in the map, and
// what one patch sees of the others over all directions.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "model/requests/recorded_map.h"
#include "model/requests/slow_quantities.h"

namespace transillum::viewer {

/// A run to show beside the open scene, along the direction of a map.
struct DirectionRequest {
  std::shared_ptr<const SolverSnapshot> kept;     ///< the other run; its scene needs no tree
  std::shared_ptr<const SolverSnapshot> current;  ///< the run of the open scene
  std::shared_ptr<const RecordedMap> map;         ///< the open scene's map
  /// The row of form factors of the selected patch in the open scene; not set without one.
  std::optional<RowRequest> row;
};

struct DirectionComparison {
  /// A patch that both scenes have: with the same number, as part of the same face. Each value is
  /// of the other run, then of the open scene.
  struct Row {
    PatchId patch = no_patch;
    std::array<double, 2> seen{};       ///< area over which it exchanges light along omega, m²
    std::array<double, 2> factors{};    ///< sum of its form factors
    std::array<double, 2> radiosity{};  ///< luminance of B, W/m²

    /// The change of `seen`, m²; 0 up to rounding.
    double change() const {
      constexpr double rounding = 1e-12;
      const double difference = seen[1] - seen[0];
      return std::abs(difference) > rounding ? difference : 0;
    }
  };
  /// A form factor of the selected patch. Both values are of the directions of the open scene's
  /// solve: only the scenes differ.
  struct Factor {
    PatchId source = no_patch;
    std::array<double, 2> value{};
  };
  std::shared_ptr<const RecordedMap> kept_map;  ///< the other scene's map
  std::shared_ptr<const RecordedMap> map;       ///< DirectionRequest::map
  std::vector<Row> rows;                        ///< the largest change of the seen area first
  /// Numbers of patches that only one of the scenes has, the other first.
  std::array<PatchId, 2> unmatched{};
  PatchId receiver = no_patch;       ///< RowRequest::receiver; no_patch where only one scene has it
  std::vector<Factor> factors = {};  ///< F of the receiver, above 0 in a scene; by source
};

/// Compares directions; keeps the tree, the newest map and the newest row of the other scene.
///
/// Threads: one at a time.
class DirectionComparer {
 public:
  /// @throws Canceled, and what record_map() throws
  DirectionComparison operator()(const DirectionRequest& request, const Cancellation& cancellation);

 private:
  /// Finds the form factors of a row that differs from the last one.
  void compare_factors(const RowRequest& row, const Cancellation& cancellation);

  std::shared_ptr<const LoadedScene> loaded_;
  std::shared_ptr<const RecordedMap> map_;
  std::optional<RowRequest> row_;  ///< whose factors are known
  std::vector<DirectionComparison::Factor> factors_;
};

/// The area over which each patch exchanges light along the direction of a map, m².
std::vector<double> exchanged_areas(const RecordedMap& map);

}  // namespace transillum::viewer
