// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/directions.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/choice.h"
#include "sampling/sequences.h"
#include "sampling/sphere_map.h"
#include "transillum/at.h"

namespace transillum {

const std::vector<std::string>& sampling_names() {
  static const std::vector<std::string> names{"hammersley",
                                              "centered-hammersley",
                                              "scrambled-hammersley",
                                              "halton",
                                              "sobol",
                                              "fibonacci",
                                              "antipodal",
                                              "random"};
  return names;
}

Sampling sampling_from_name(const std::string& name) {
  // The former, British spelling: scripts still use it.
  const std::string& current = name == "centred-hammersley" ? sampling_names()[1] : name;
  return choice_from_name<Sampling>(sampling_names(), "sampling", current);
}

const std::string& name_of(Sampling sampling) { return at(sampling_names(), sampling); }

bool is_seeded(Sampling sampling) {
  return sampling == Sampling::scrambled_hammersley || sampling == Sampling::sobol ||
         sampling == Sampling::random;
}

bool is_extensible(Sampling sampling) {
  return sampling == Sampling::halton || sampling == Sampling::sobol ||
         sampling == Sampling::random;
}

bool is_spiral(Sampling sampling) {
  return sampling == Sampling::fibonacci || sampling == Sampling::antipodal;
}

Sampling default_sampling(bool two_way) {
  return two_way ? Sampling::antipodal : Sampling::fibonacci;
}

std::vector<DirectionSample> with_opposites(std::vector<DirectionSample> samples) {
  const std::size_t count = samples.size();
  samples.reserve(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    samples.push_back(sample_along(-samples[k].direction));
  }
  return samples;
}

std::vector<int> progressive_order(Sampling sampling, int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  if (is_extensible(sampling)) {
    return order;
  }
  // Ranks of the radical inverses: the order in which van der Corput's points fill the interval,
  // scaled to 0 … count-1 for any count. The base differs from those of the sampling, else prefixes
  // would cover only a corner of the square.
  const std::uint32_t base = is_spiral(sampling) ? 2 : 3;
  std::vector<std::pair<double, int>> keyed;
  keyed.reserve(order.size());
  for (int k = 0; k < count; ++k) {
    keyed.emplace_back(radical_inverse(static_cast<std::uint32_t>(k), base), k);
  }
  std::sort(keyed.begin(), keyed.end());
  for (int rank = 0; rank < count; ++rank) {
    at(order, at(keyed, rank).second) = rank;
  }
  return order;
}

}  // namespace transillum
