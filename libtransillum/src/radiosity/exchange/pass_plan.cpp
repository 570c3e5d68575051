// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/exchange/pass_plan.h"

#include <algorithm>
#include <utility>

#include "transillum/at.h"
#include "transillum/directions.h"

namespace transillum {
namespace {

/// Smallest number of directions per replica in the first iteration of the growing scheme.
constexpr int min_directions = 16;

}  // namespace

void PassPlan::add_replica() { ++added_; }

std::size_t PassPlan::replica_of(int k) const {
  return static_cast<std::size_t>(
      k < options_.directions ? k % options_.replicas
                              : options_.replicas + (k - options_.directions) / per_replica());
}

int PassPlan::passes(int iteration) const {
  if (options_.scheme != Scheme::growing) {
    return directions();
  }
  int doublings = 0;
  while (options_.directions >> (doublings + 1) >= min_directions * options_.replicas) {
    ++doublings;
  }
  return options_.directions >> std::max(doublings - iteration, 0);
}

std::vector<Vec3> PassPlan::set_of(int replica, int count, int iteration) const {
  const Sampling sampling = options_.used_sampling();
  auto set = renews() ? directions_of_iteration(sampling, count, options_.seed, iteration)
                      : make_directions(sampling, count, options_.seed);
  if (options_.rotation || options_.replicas > 1) {
    set = rotated(std::move(set),
                  options_.rotation.value_or(options_.seed) + static_cast<std::uint64_t>(replica));
  }
  std::vector<Vec3> ordered;
  for (const int k : progressive_order(sampling, count)) {
    ordered.push_back(at(set, k).direction);
  }
  return ordered;
}

std::vector<Vec3> PassPlan::directions(int iteration) const {
  const int replicas = options_.replicas;
  std::vector<Vec3> directions(static_cast<std::size_t>(options_.directions));
  for (int r = 0; r < replicas; ++r) {
    const int count = (options_.directions - r + replicas - 1) / replicas;
    auto place = static_cast<std::size_t>(r);
    for (const Vec3& direction : set_of(r, count, iteration)) {
      directions[place] = direction;
      place += static_cast<std::size_t>(replicas);
    }
  }
  for (int r = replicas; r < this->replicas(); ++r) {
    const auto set = set_of(r, per_replica(), iteration);
    directions.insert(directions.end(), set.begin(), set.end());
  }
  return directions;
}

}  // namespace transillum
