// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <string>

#include "sequence_options.h"
#include "transillum/discrepancy.h"
#include "transillum/scene.h"

namespace transillum::cli {

/// How good a set of directions is, beside what is proven for Hammersley's.
struct DirectionStatistics {
  SequenceOptions set;
  double star = 0;
  CapDiscrepancy cap;
  std::shared_ptr<const Scene> scene;    ///< whose patches' normals were taken; null: all over
  std::vector<double> one_way, two_way;  ///< eps_i(M) of eq. 17, one a normal
};

DirectionStatistics measure_directions(const SequenceOptions& set,
                                       const std::vector<DirectionSample>& samples,
                                       std::shared_ptr<const Scene> scene,
                                       const Cancellation& cancellation);

/// For a reader.
std::string text_of(const DirectionStatistics& statistics);
/// JSON, with eps of every patch where there is a scene.
void write_direction_statistics(const std::string& path, const DirectionStatistics& statistics);

}  // namespace transillum::cli
