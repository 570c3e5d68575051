// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "transillum/choice.h"

namespace transillum {

/// Why a BoundaryView of engine fast failed, so that another view repeats the visibility query.
enum class QueryFailure : std::uint8_t {
  none,          ///< no view has failed
  thin,          ///< the face is too thin, or too nearly edge-on, to have its area in doubles
  cut_needle,    ///< the BSP tree has cut the face to a needle
  flat,          ///< the corners of a needle, as rounded, bound no area
  candidate,     ///< the corners of a candidate that the tree has cut to a needle bound no area
  inconsistent,  ///< rounding has made the boundary of the visible region inconsistent
  crowded        ///< the visible region has too many boundary segments
};
/// Their names (choice.h).
template <>
const Choices& choices_of<QueryFailure>();

/// The number of values of QueryFailure.
inline constexpr std::size_t query_failures = 7;
/// A number of queries for each QueryFailure.
using FailureCounts = std::array<std::int32_t, query_failures>;

/// The most frequent reason; QueryFailure::none where all are 0.
QueryFailure main_of(const FailureCounts& counts);

/// The cost of visibility queries. Where a query is shared by a block of patches, they share time
/// and candidates, and the first one has the numbers of queries.
struct PatchCost {
  double seconds = 0;           ///< wall time, s
  std::int64_t queries = 0;     ///< queries of a fragment, or of its part in one bin
  std::int64_t candidates = 0;  ///< fragments compared with what they have left, repeats included
  FailureCounts repeated{};     ///< by its reason: queries repeated in another frame
  FailureCounts exact{};        ///< by its reason: queries repeated with exact predicates

  /// PassCounts::exact_queries.
  std::int64_t exact_queries() const;
  /// The most frequent reason of exact queries, else of repeated ones; none where none failed: the
  /// number of candidates is the reason then.
  QueryFailure main_reason() const;
  /// Adds all of it.
  PatchCost& operator+=(const PatchCost& other);
};

}  // namespace transillum
