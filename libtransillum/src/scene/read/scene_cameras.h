// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/vec3.h"

namespace transillum {

/// A camera that a scene's file has.
struct SceneCamera {
  std::string name;  ///< name of its node, else its own, else "camera N"
  Vec3 eye;          ///< position, m
  Vec3 direction;    ///< unit vector toward the middle of its picture
  Vec3 up;           ///< unit vector that is up in its picture
  /// Vertical angle of view, degrees; an orthographic camera has none.
  std::optional<double> field_of_view = std::nullopt;
  double height = 0;  ///< height that its picture shows, m; 0 for a perspective
};

/// Reads the cameras of a glTF file's scene, in the order of its nodes; other files have none.
/// @param path the file.
/// @param scale meters per unit of the coordinates, as ReadOptions::scale.
/// @param cancellation checked while reading.
/// @throws InputError naming the file and what is wrong; Canceled
std::vector<SceneCamera> read_cameras(const std::string& path, double scale = 1,
                                      const Cancellation& cancellation = {});

}  // namespace transillum
