// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "geometry/form_factor.h"
#include "transillum/scene.h"

namespace transillum {

/// Coplanar patches that form one convex polygon.
struct MergedFace {
  std::vector<PatchId> patches;  ///< at least 2, ascending; if two-sided, patches of one side
  Corners outline;
  double bend = 0;  ///< largest distance of the patches' corners from the outline's plane, m
};
/// All convex polygons of coplanar patches that share edges, or else of the patches of one face; in
/// the order of their first patches. None has a patch in common with another.
std::vector<MergedFace> merged_faces(const Scene& scene);

/// A convex polygon of one or several patches.
struct MergedPiece {
  Corners outline;
  double bend = 0;  ///< bend of the MergedFace, or of the piece itself, m
  /// The patches that it has parts of, or that coincide with it, ascending. If two-sided, patches
  /// of the first side.
  std::vector<PatchId> patches;
};
/// Convex polygons with the same union as the scene's patches; they may overlap: the outlines of
/// merged_faces(), and the pieces of the other patches.
std::vector<MergedPiece> merged_pieces(const Scene& scene);
/// The scene's pieces, in their order, without those that another one with the same corners on the
/// same side covers.
std::vector<Piece> uppermost_pieces(const Scene& scene);
/// Per patch: itself, or for the second side of a two-sided one the first side.
std::vector<PatchId> first_sides(const Scene& scene);

}  // namespace transillum
