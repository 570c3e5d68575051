// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// A scene in which some patches of another are divided.
struct DividedScene {
  std::shared_ptr<const Scene> scene;  ///< with the patches divided
  std::vector<PatchId> parent;  ///< of each of its patches, the patch of the other that it is in
};

/// Number of patches that divide() makes of patch i, if they are not too thin for the precision of
/// coordinates, in which case it is left whole. Triangles give four similar ones; convex
/// quadrilaterals two by two cells, or four in a row where they are more than twice as long as
/// wide; others their convex pieces, or triangles. The other side of a face is not counted.
int division_count(const Scene& scene, PatchId i);
/// Divides patches; the others keep their order, faces, groups and materials. Patches on the same
/// points, such as the two sides of a face, are divided together.
/// @param patches of `scene`, in any order.
/// @throws InputError where a Scene cannot have so many patches; Canceled
DividedScene divide(const Scene& scene, std::span<const PatchId> patches,
                    const Cancellation& cancellation = {});

/// A straight cut through a patch: from a to b, two points of its plane, m.
struct PatchCut {
  PatchId patch = no_patch;
  Vec3 a, b;
};
/// Divides patches along cuts into convex cells, so that no cut lies inside a cell, but where one
/// would be too thin for the precision of coordinates. A cell that a cut meets is cut across; a
/// concave patch with cuts is divided into its pieces in any case.
/// @param cuts in any order
/// @throws InputError where memory is too small, or a Scene cannot have so many patches; Canceled
DividedScene divide_along(const Scene& scene, std::span<const PatchCut> cuts,
                          const Cancellation& cancellation = {});

/// A polygon in place of patches of a scene that it consists of.
struct UnitedPatch {
  PatchId like = no_patch;       ///< one of them: its face, material, group and normal
  std::vector<PointId> outline;  ///< convex; empty: the patch as it is
};
/// A scene with the points of another, and other patches.
/// @param patches in the order of the result
/// @throws Canceled
std::shared_ptr<const Scene> with_united(const Scene& scene, std::span<const UnitedPatch> patches,
                                         const Cancellation& cancellation = {});

}  // namespace transillum
