// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Which fraction of each patch the sun lights, for many positions of the sun.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// Computes the sunlit fraction of each patch by one exact pass per direction, in parallel.
/// @param scene the scene.
/// @param tree its BSP tree.
/// @param directions unit vectors toward the sun.
/// @param take called with the number of a direction and the fractions, 0 … 1, one per patch, of
/// its area on which the sun falls; 0 where the sun is behind it. In the order of the directions,
/// on the calling thread; the fractions do not depend on the number of threads.
/// @param threads 0 uses all cores.
/// @param cancellation checked during computation.
/// @throws Canceled, and what `take` throws.
void sunlit_fractions(const std::shared_ptr<const Scene>& scene,
                      const std::shared_ptr<const BspTree>& tree, std::span<const Vec3> directions,
                      const std::function<void(std::size_t, const std::vector<double>&)>& take,
                      int threads = 0, const Cancellation& cancellation = {});

/// The fraction of the sky above the horizon that each patch sees, by the cosine: 1 for an
/// unobstructed patch turned upward, 1/2 for a wall.
/// @param scene the scene.
/// @param tree its BSP tree.
/// @param up unit vector toward the zenith.
/// @param directions number of passes, each of which serves two opposite directions.
/// @param threads 0 uses all cores; the result does not depend on it.
/// @param cancellation checked during computation.
/// @returns one per patch, 0 … 1.
/// @throws Canceled
std::vector<double> seen_sky_fractions(const std::shared_ptr<const Scene>& scene,
                                       const std::shared_ptr<const BspTree>& tree, const Vec3& up,
                                       int directions, int threads = 0,
                                       const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
