// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/radiosity.h"

namespace transillum {

/// The direction of each pass of each iteration.
///
/// Any initial part of the passes is spread over the sphere. With R replicas, pass k belongs to
/// replica k mod R; each replica is a set of the sampling with its own rotation.
class PassPlan {
 public:
  explicit PassPlan(const SolveOptions& options) : options_(options) {}

  /// Number of passes of an iteration, including those taken from kept sums.
  int passes(int iteration) const;
  /// Whether each iteration has its own directions.
  bool renews() const { return options_.scheme == Scheme::semi_iterative; }
  /// The M directions of an iteration; one of fewer passes uses the first of them.
  std::vector<Vec3> directions(int iteration) const;

 private:
  SolveOptions options_;
};

}  // namespace transillum
