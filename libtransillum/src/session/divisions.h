// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Divisions of patches by name, as in SceneInput::divided. A name is a surface, "all",
// "patch:3,7-20" with numbers of patches, which are those after the divisions before it, or
// "shadows:1,0,2" with a direction to a light at infinity.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// The name of all patches.
inline constexpr const char* all_patches_name = "all";

/// The numbers of all patches.
std::vector<PatchId> all_patches(const Scene& scene);
/// The patches of a surface, in ascending order; empty if there is none of this name.
/// @param kept AccuracyGoal::surfaces: these are surfaces whatever their area
std::vector<PatchId> patches_of_surface(const Scene& scene, const std::string& name,
                                        const std::vector<std::string>& kept);
/// "patch:3,7-20".
/// @param patches in ascending order
std::string division_by_numbers(std::span<const PatchId> patches);
/// The entry that divides patches along the edges of shadows cast by a light at infinity.
/// @param to_light of any length above 0
std::string division_by_shadows(const Vec3& to_light);
/// The entry that divides these patches of a scene: `name`, if it means them, or their numbers.
/// @param patches in ascending order
std::string division_name(const Scene& scene, const std::string& name,
                          std::span<const PatchId> patches);
/// A scene in which patches are divided, by one name after the other.
/// @param names SceneInput::divided
/// @throws InputError where there is no such surface or patch, or memory is too small; Canceled
std::shared_ptr<const Scene> divided_scene(std::shared_ptr<const Scene> scene,
                                           const std::vector<std::string>& names,
                                           const Cancellation& cancellation = {});

}  // namespace transillum
