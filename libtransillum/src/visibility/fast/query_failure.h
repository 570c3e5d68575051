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

}  // namespace transillum
