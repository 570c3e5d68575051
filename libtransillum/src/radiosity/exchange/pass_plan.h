// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/solve_options.h"

namespace transillum {

/// The direction of each pass of each iteration.
///
/// Any initial part of the passes is spread over the sphere. With R replicas, pass k belongs to
/// replica k mod R; each replica is a set of the sampling with its own rotation. The passes of a
/// replica that is added later follow one another after all others.
class PassPlan {
 public:
  explicit PassPlan(const SolveOptions& options) : options_(options) {}

  /// Appends a replica with as many directions as the last has.
  void add_replica();
  int added_replicas() const { return added_; }
  /// SolveOptions::directions and ::replicas, those added included.
  int directions() const { return options_.directions + added_ * per_replica(); }
  int replicas() const { return options_.replicas + added_; }
  /// The replica that pass k of an iteration belongs to.
  std::size_t replica_of(int k) const;

  /// Number of passes of an iteration, including those taken from kept sums.
  int passes(int iteration) const;
  /// Whether each iteration has its own directions.
  bool renews() const { return traits_of(options_.scheme).renews_directions; }
  /// The M directions of an iteration; one of fewer passes uses the first of them.
  std::vector<Vec3> directions(int iteration) const;

 private:
  int per_replica() const { return options_.directions / options_.replicas; }
  std::vector<Vec3> set_of(int replica, int count, int iteration) const;

  SolveOptions options_;
  int added_ = 0;  ///< replicas
};

}  // namespace transillum
