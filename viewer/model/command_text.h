// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/run_options.h"
#include "transillum/material_changes.h"
#include "transillum/picture.h"
#include "transillum/scene.h"
#include "transillum/vec3.h"

namespace transillum::viewer {

/// The line for a shell that makes the same solve with the program `transillum`, to the same bits.
/// Only options that differ from their defaults are in it.
/// @param scene a file or a built-in
/// @param changes of materials, in addition to options.input
std::string solve_command(const std::string& scene, const RunOptions& options,
                          const std::vector<MaterialChange>& changes);
/// The same for the visibility map of one direction.
/// @param omega the direction, written with all digits
/// @param steps of the direction that are done; all if not set
/// @param receiver  the patch whose map it is; no_patch: V
std::string map_command(const std::string& scene, const RunOptions& options,
                        const std::vector<MaterialChange>& changes, const Vec3& omega,
                        std::optional<std::int32_t> steps = {}, PatchId receiver = no_patch);

/// How the program `transillum` shows a solve.
struct PictureCommand {
  Camera camera;              ///< a perspective
  int width = 0, height = 0;  ///< pixels
  bool false_colors = false;  ///< a color map, up to 1 / `exposure`
  double exposure = 1;        ///< B times it is the color
};
/// The line that makes a solve, and of its result a picture.
/// @param solve  of solve_command()
std::string picture_command(const std::string& solve, const PictureCommand& picture);

}  // namespace transillum::viewer
