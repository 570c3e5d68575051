// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/radiosity.h"

namespace transillum {

/// Which direction each pass of each step takes.
///
/// Passes come in an order whose every beginning is spread over the sphere. With replicas, pass k
/// belongs to replica k mod R: R sets of the sampling, each turned by a rotation of its own.
class PassPlan {
 public:
  explicit PassPlan(const SolveOptions& options) : options_(options) {}

  /// How many passes a step is made of, those that it takes over from earlier steps included.
  int passes(int step) const;
  /// Whether each step has directions of its own.
  bool renews() const { return options_.scheme == Scheme::semi_iterative; }
  /// The M directions of a step; a step of fewer passes takes the first.
  std::vector<Vec3> directions(int step) const;

 private:
  SolveOptions options_;
};

}  // namespace transillum
