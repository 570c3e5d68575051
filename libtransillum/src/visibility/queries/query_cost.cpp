// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/query_cost.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/choice.h"

namespace transillum {
namespace {

constexpr std::array failures{
    Choice{QueryFailure::none, "many-candidates", "Many candidates", "no query was repeated"},
    Choice{QueryFailure::thin, "thin", "Too thin", "the face is too thin, or too nearly edge-on"},
    Choice{QueryFailure::cut_needle, "cut-needle", "Cut to needles",
           "the BSP tree has cut the face to needles"},
    Choice{QueryFailure::flat, "flat", "Flat", "rounding leaves needles of the face no area"},
    Choice{QueryFailure::candidate, "flat-candidate", "Flat candidate",
           "rounding leaves a needle in front of the face no area"},
    Choice{QueryFailure::inconsistent, "inconsistent", "Edges too near",
           "edges in front of the face are nearer to each other than rounding"},
    Choice{QueryFailure::crowded, "crowded", "Too many edges",
           "too many edges bound what the face sees"},
};
static_assert(failures.size() == query_failures);

std::int64_t sum_of(const FailureCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

}  // namespace

template <>
const Choices& choices_of<QueryFailure>() {
  return texts_of<failures>("reason");
}

std::int64_t PatchCost::exact_queries() const { return sum_of(exact); }

QueryFailure main_of(const FailureCounts& counts) {
  return static_cast<QueryFailure>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

QueryFailure PatchCost::main_reason() const {
  return main_of(exact_queries() > 0 ? exact : repeated);
}

PatchCost& PatchCost::operator+=(const PatchCost& other) {
  seconds += other.seconds;
  queries += other.queries;
  candidates += other.candidates;
  for (std::size_t k = 0; k < query_failures; ++k) {
    repeated[k] += other.repeated[k];
    exact[k] += other.exact[k];
  }
  return *this;
}

}  // namespace transillum
