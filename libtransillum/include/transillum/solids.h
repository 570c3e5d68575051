// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Closed parts of a scene as solids. Models from elsewhere often let them cross or touch: what lies
// inside another solid is divided, sorted and solved, though no light ever reaches it.

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// The findings of unite_solids().
struct SolidsReport {
  std::int64_t solids = 0;   ///< closed parts that face outward
  std::int64_t rooms = 0;    ///< closed parts that face inward, and are in no solid
  std::int64_t united = 0;   ///< parts that were united with another one
  std::int64_t refused = 0;  ///< parts that cross or touch another one and keep their faces
  std::int64_t open = 0;     ///< other parts: open or two-sided, or edges of more than two faces
  double area_before = 0;    ///< area of all faces, m²
  double area_after = 0;     ///< the same afterwards, m²
  std::vector<std::int32_t> removed;  ///< numbers of faces of which nothing is left, ascending
  std::vector<std::int32_t> cut;      ///< numbers of faces of which a part is left, ascending
  std::vector<std::string> sentences;  ///< for the user, a few
};

/// Unites closed parts that cross, contain or touch one another, exactly (CGAL): what lies inside
/// or against another solid is removed, and faces are cut where it begins. A part is a set of faces
/// that are connected by edges that two of them share. Faces keep their number, material and group;
/// those that nothing cuts keep their outline and order. A closed part that faces inward is a hole
/// of the solid around it, or else the room: what its solids have behind its walls goes, too, and
/// where they touch a wall there is no wall. Of several rooms, none is changed. Open and two-sided
/// parts, and parts whose faces cross one another, keep their faces.
///
/// Points are moved within the rounding of their file first, as by Scene. New corners are rounded
/// to doubles.
/// @param description that Scene accepts.
/// @throws Canceled
SolidsReport unite_solids(SceneDescription& description, const Cancellation& cancellation = {});

/// About the fraction of the area of all faces that lies inside or against another solid, by
/// testing some thousand points, each against the parts around it.
/// @return in [0,1]; standard error below 0.01
/// @throws Canceled
double share_inside_solids(const SceneDescription& description,
                           const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
