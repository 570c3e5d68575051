// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/vec3.h"

namespace transillum {

/// 0-based number of a patch; the caller's, everywhere, to the end.
using PatchId = std::int32_t;
inline constexpr PatchId no_patch = -1;
/// Index into Scene::points().
using PointId = std::int32_t;

/// What a diffuse surface does with light.
struct Material {
  std::string name;
  Rgb reflectance;  ///< rho, 0 <= rho < 1 a channel (MTL: Kd)
  Rgb exitance;     ///< E, emitted, W/m², >= 0 (MTL: Ke)
};

/// Polygons as a reader or a generator delivers them: not checked yet.
struct SceneDescription {
  std::string name;  ///< file or built-in, as error messages shall call it
  std::vector<Vec3> points;
  std::vector<Material> materials;
  std::vector<PointId> corners;           ///< all outlines, one after the other
  std::vector<std::uint32_t> face_begin;  ///< where face f starts in `corners`
  std::vector<std::int32_t> face_material;
  std::vector<std::int32_t> face_line;  ///< line of face f in the file, 0 if there is none
  std::vector<std::string> notes;       ///< the reader's own remarks, for Scene::report()

  std::size_t face_count() const { return face_begin.size(); }
  std::span<const PointId> outline(std::size_t face) const {
    const std::size_t begin = face_begin[face];
    const std::size_t end = face + 1 < face_begin.size() ? face_begin[face + 1] : corners.size();
    return {corners.data() + begin, end - begin};
  }
  /// Adds a face, counter-clockwise seen from its lit side.
  void add_face(std::span<const PointId> outline, int material, int line = 0) {
    face_begin.push_back(static_cast<std::uint32_t>(corners.size()));
    corners.insert(corners.end(), outline.begin(), outline.end());
    face_material.push_back(material);
    face_line.push_back(line);
  }
};

/// How faces become patches.
struct SceneOptions {
  bool two_sided = false;     ///< every face gives two opposite patches, front first
  double max_patch_area = 0;  ///< m²; refine larger faces; 0: leave faces as they are
};

/// A planar polygon of constant radiosity.
struct Patch {
  Vec3 normal;            ///< unit, on the lit side
  double area = 0;        ///< m², > 0
  Vec3 center;            ///< centroid of the outline's area
  std::int32_t face = 0;  ///< 0-based order of its face in the file
  std::int32_t material = 0;
  std::uint32_t outline_begin = 0, outline_end = 0;  ///< in the scene's outline corners
};

/// A convex piece of a patch, planar to rounding. Pieces of one patch do not overlap.
struct Piece {
  PatchId patch = no_patch;
  std::uint32_t begin = 0, end = 0;  ///< in the scene's piece corners
};

/// What was found and mended on the way from faces to patches.
struct SceneReport {
  std::vector<std::string> warnings;    ///< sentences for the user, at most a few dozen
  std::int64_t faces = 0;               ///< faces in the file
  std::int64_t dropped_degenerate = 0;  ///< faces without area, left out
  std::int64_t cut_non_planar = 0;      ///< faces cut into triangles
  std::int64_t refined = 0;             ///< faces cut by max_patch_area
  std::int64_t unused_points = 0;
  std::int64_t coincident_faces = 0;  ///< faces with the same points as an earlier one
};

/// A scene of patches: checked once, then never changed.
///
/// Threads: immutable, so any number of threads may read it.
class Scene {
 public:
  /// Checks `description` and makes patches of it.
  /// @throws InputError naming the scene, the line, the face and what is wrong.
  /// @throws Canceled
  Scene(const SceneDescription& description, const SceneOptions& options = {},
        const Cancellation& cancellation = {});

  const std::string& name() const { return name_; }
  PatchId patch_count() const { return static_cast<PatchId>(patches_.size()); }
  const std::vector<Patch>& patches() const { return patches_; }
  const Patch& patch(PatchId i) const { return at(patches_, i); }
  /// Distinct points: no two have the same coordinates.
  const std::vector<Vec3>& points() const { return points_; }
  const Vec3& point(PointId p) const { return at(points_, p); }
  /// Outline of patch i, counter-clockwise seen from its lit side; may be concave.
  std::span<const PointId> outline(PatchId i) const {
    const Patch& p = patch(i);
    return {outline_corners_.data() + p.outline_begin, p.outline_end - p.outline_begin};
  }
  const std::vector<Piece>& pieces() const { return pieces_; }
  std::span<const PointId> corners(const Piece& piece) const {
    return {piece_corners_.data() + piece.begin, piece.end - piece.begin};
  }
  const std::vector<Material>& materials() const { return materials_; }
  const Material& material(PatchId i) const { return at(materials_, patch(i).material); }
  /// E of patch i, W/m².
  const Rgb& exitance(PatchId i) const { return material(i).exitance; }
  /// rho of patch i.
  const Rgb& reflectance(PatchId i) const { return material(i).reflectance; }
  const Bounds& bounds() const { return bounds_; }
  const SceneReport& report() const { return report_; }
  const SceneOptions& options() const { return options_; }

 private:
  std::string name_;
  SceneOptions options_;
  std::vector<Vec3> points_;
  std::vector<Material> materials_;
  std::vector<Patch> patches_;
  std::vector<PointId> outline_corners_;
  std::vector<Piece> pieces_;
  std::vector<PointId> piece_corners_;
  Bounds bounds_;
  SceneReport report_;
};

/// Reads the file or makes the built-in that `spec` names: a path ending in .obj, or
/// `sphere-flake`, `cornell-box`, `furnace`, `boards`, `rooms`, `stars`, with parameters as in
/// `sphere-flake:levels=2,slices=17,stacks=8`.
/// @throws InputError with "did you mean" where a name is nearly right.
SceneDescription describe_scene(const std::string& spec, const Cancellation& cancellation = {});

/// describe_scene, then Scene.
std::shared_ptr<const Scene> load_scene(const std::string& spec, const SceneOptions& options = {},
                                        const Cancellation& cancellation = {});

/// A built-in scene, for lists and help.
struct BuiltInScene {
  std::string name;
  std::string summary;     ///< one sentence
  std::string parameters;  ///< with their defaults, as they may follow the name and a colon
};
const std::vector<BuiltInScene>& built_in_scenes();

}  // namespace transillum
