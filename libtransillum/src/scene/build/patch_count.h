// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// How many patches a limit of their area makes, and which limit makes about a given number: known
// before the refined scene is made.

#include <cstddef>
#include <cstdint>
#include <string>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// The number of patches that the description of `unrefined` gives with
/// SceneOptions::max_patch_area = `max_patch_area` (m², > 0) and otherwise the same options.
/// @param unrefined a scene made with max_patch_area = 0.
/// Time: linear in the faces. No limit is checked: the number may be too large for a Scene, and is
/// then at least 2^62.
std::int64_t count_patches(const Scene& unrefined, double max_patch_area);

/// Bytes that a scene of `patches` patches, its BSP tree and the passes of a solve take, about,
/// without kept form factors (SolveOptions::memory): measured on scenes that are cut little. Deep
/// trees take several times as much.
/// @param patches of the scene.
/// @param replicas SolveOptions::replicas.
/// @param unknowns per patch: 1, or 3 of Basis::linear.
std::uint64_t expected_memory(std::int64_t patches, int replicas = 1, int unknowns = 1);

/// Checks, before a scene is made or solved, that its expected_memory() is free: on the machine, in
/// the process's control group and by its own limit.
/// @param name of the scene, for the message.
/// @param patches, replicas, unknowns as for expected_memory().
/// @throws std::runtime_error that tells both; not where a Scene cannot have so many patches at all
void check_memory(const std::string& name, std::int64_t patches, int replicas = 1,
                  int unknowns = 1);

/// The number of patches into which pictures and windows divide a scene's faces where nothing else
/// is asked for: 2000 for fewer than 1000 faces; else 0, which does not divide them.
std::int64_t usual_patches(std::size_t faces);

/// A limit for patch areas with which the scene has about `patches` patches (m²).
///
/// Faces are cut into grids of nearly equal cells, all by the same limit, so not every number is
/// possible: a cube has 6, 12, 24 … Of triangles and quadrilaterals, the number reached is between
/// half and twice the number asked for, and nearer where faces are many or differ. A face with more
/// corners is first cut into triangles if it is cut at all, which may exceed that. The limit has as
/// few digits as give the same number.
/// @param unrefined a scene made with max_patch_area = 0.
/// @param patches > 0; where the unrefined scene has as many or more, the result is 0: no limit.
/// @throws InputError where `patches` is less than 1 or more than a Scene may have
/// @throws Canceled
double max_patch_area_for(const Scene& unrefined, std::int64_t patches,
                          const Cancellation& cancellation = {});

/// Whether any face has a patch on each side.
bool has_two_sided_faces(const Scene& scene);

}  // namespace transillum
