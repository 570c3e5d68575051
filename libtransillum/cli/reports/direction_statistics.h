// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <string>

#include "sampling/discrepancy.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum::cli {

/// Quality measures of a set of directions, to compare with the bounds for Hammersley points.
struct DirectionStatistics {
  SolveOptions set;
  double star = 0, star_two_way = 0;  ///< two_way: of the directions and their opposites
  CapDiscrepancy cap, cap_two_way;
  std::shared_ptr<const Scene> scene;    ///< scene whose normals were used; null means all normals
  std::vector<double> one_way, two_way;  ///< eps_i(M) of eq. 17, one per normal
};

DirectionStatistics measure_directions(const SolveOptions& set,
                                       const std::vector<DirectionSample>& samples,
                                       std::shared_ptr<const Scene> scene,
                                       const Cancellation& cancellation);

/// The measures as text.
std::string text_of(const DirectionStatistics& statistics);
/// Writes them as JSON, with eps of every patch if there is a scene.
void write_direction_statistics(const std::string& path, const DirectionStatistics& statistics);

}  // namespace transillum::cli
