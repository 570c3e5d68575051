// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The input of every computation. A SceneDescription holds polygons as a file reader, a generator
// or the caller's own code delivers them; the constructor of Scene checks them and turns faces into
// patches and convex pieces. load_scene() does both for a file or a built-in scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// 0-based number of a patch: the order of the caller's faces, in every interface of the library.
using PatchId = std::int32_t;
/// No patch.
inline constexpr PatchId no_patch = -1;
/// Index into Scene::points().
using PointId = std::int32_t;
/// No group, in SceneDescription::face_group and Patch::group.
inline constexpr std::int32_t no_group = -1;

/// How a lobe spreads light about the direction in which a mirror would reflect it.
enum class LobeShape {
  phong,  ///< cos^n of the angle to the mirror direction (Lafortune and Willems 1994)
  ggx,    ///< microfacets of the distribution GGX (Walter et al. 2007)
};

/// The glossy part of a surface's reflection; only glossy solves read it (SolveOptions::glossy).
struct Lobe {
  /// Fraction of the light from any direction that it reflects, >= 0 per channel (MTL: Ks). Where
  /// with rho it exceeds what a surface can reflect, used_lobe() lowers it.
  Rgb reflectance;
  LobeShape shape = LobeShape::phong;  ///< shape of the distribution
  double exponent = 0;                 ///< n, for LobeShape::phong, >= 0 (MTL: Ns)
  double roughness = 1;  ///< for LobeShape::ggx, 0 to 1: alpha = roughness² (glTF; MTL: Pr)

  /// Whether it reflects anything.
  bool present() const { return max_abs(reflectance) > 0; }
  /// Exact comparison of all members.
  friend bool operator==(const Lobe&, const Lobe&) = default;
};

/// Optical properties of a surface: diffuse, and a lobe that only glossy solves use.
struct Material {
  std::string name;  ///< name in the file; not necessarily unique
  Rgb reflectance;   ///< rho, diffuse, 0 <= rho < 1 per channel (MTL: Kd)
  Rgb exitance;      ///< E, emitted, W/m², >= 0 (MTL: Ke)
  Lobe lobe = {};    ///< its glossy part; by default none
};

/// Unchecked polygons, as a reader or a generator delivers them.
struct SceneDescription {
  std::string name;                          ///< file or built-in scene; used in error messages
  std::vector<Vec3> points;                  ///< m
  std::vector<Material> materials;           ///< referred to by face_material
  std::vector<PointId> corners;              ///< the outlines of all faces, concatenated
  std::vector<std::uint32_t> face_begin;     ///< index in `corners` where face f starts
  std::vector<std::int32_t> face_material;   ///< index in `materials` of face f
  std::vector<std::int32_t> face_line;       ///< line of face f in the file; 0 if unknown
  std::vector<std::int32_t> face_number;     ///< Patch::face of the patches of face f, >= 0 and
                                             ///< ascending; faces of one number are parts of one
                                             ///< face; f if the list is empty
  std::vector<std::string> groups;           ///< names of groups of faces (OBJ: `g` and `o`)
  std::vector<std::int32_t> face_group;      ///< index in `groups` of face f, or no_group; empty:
                                             ///< no face has a group
  std::vector<std::uint8_t> face_two_sided;  ///< 1: face f gives two opposite patches, front first;
                                             ///< 0: the face gives one; if the list is empty, all
                                             ///< faces give one
  /// By face number of the file, where faces were joined: the number of the face that it is now a
  /// part of, its own if it was not joined to one before it, -1 if the file has no such face.
  /// Empty: no face was joined.
  std::vector<std::int32_t> joined_to;
  /// Half a unit of the last digit of coordinates, m; 0: found from the digits of `points`. A Scene
  /// moves its points by up to 8 of it, so that faces are planar and touch as before rounding.
  double coordinate_rounding = 0;
  /// Whether the faces are patches that a Scene has made, as in a result: no point is moved, and
  /// corners may be off the plane by up to 2 % of the width.
  bool faces_are_patches = false;
  std::vector<std::string> notes;  ///< the reader's warnings, for Scene::report()
  std::vector<std::string> files;  ///< read for it: the OBJ, then its MTL files

  /// Number of faces.
  std::size_t face_count() const { return face_begin.size(); }
  /// The points of face number `face`, counter-clockwise seen from its front side.
  std::span<const PointId> outline(std::size_t face) const {
    const std::size_t begin = face_begin[face];
    const std::size_t end = face + 1 < face_begin.size() ? face_begin[face + 1] : corners.size();
    return {corners.data() + begin, end - begin};
  }
  /// The number by which face f is known outside the description: Patch::face of its patches.
  std::int32_t number_of(std::size_t f) const {
    return f < face_number.size() ? at(face_number, f) : static_cast<std::int32_t>(f);
  }
  /// Index in `groups` of face number `face`, or no_group.
  std::int32_t group_of(std::size_t face) const {
    return face_group.empty() ? no_group : at(face_group, face);
  }
  /// Whether face number `face` lights and receives on both sides.
  bool is_two_sided(std::size_t face) const {
    return !face_two_sided.empty() && at(face_two_sided, face) != 0;
  }
  /// Appends a one-sided face.
  /// @param outline indices into `points`, counter-clockwise seen from the front side, which is
  /// the side that emits and receives.
  /// @param material index into `materials`.
  /// @param line line number for error messages; 0 if there is none.
  /// @param group index into `groups`, or no_group.
  void add_face(std::span<const PointId> outline, int material, int line = 0,
                int group = no_group) {
    if (group != no_group || !face_group.empty()) {
      face_group.resize(face_count(), no_group);
      face_group.push_back(group);
    }
    if (!face_two_sided.empty()) {
      face_two_sided.resize(face_count() + 1, 0);
    }
    face_begin.push_back(static_cast<std::uint32_t>(corners.size()));
    corners.insert(corners.end(), outline.begin(), outline.end());
    face_material.push_back(material);
    face_line.push_back(line);
  }
};

/// How a file is read: what replaces missing or impossible values, and the unit of its lengths.
struct ReadOptions {
  /// The reflectance an MTL file's value of 1 and more is lowered to, if nothing else is asked for.
  static constexpr double default_max_reflectance = 0.98;

  /// rho of faces whose material is missing, not defined or has no name, and of textured
  /// materials without a readable texture; 0 <= rho < 1.
  double default_reflectance = 0.5;
  /// Largest rho per channel, 0 <= max < 1: larger values of a file are lowered to it. Unset:
  /// values of 1 and more, and those within 1e-6 of 1, are lowered to default_max_reflectance, and
  /// others are kept. Built-in scenes are not changed.
  std::optional<double> max_reflectance = std::nullopt;
  /// Meters per unit of the coordinates, > 0; built-in scenes are scaled too.
  double scale = 1;
  /// Whether faces of one plane, material and group that share edges are joined to one. If unset,
  /// only faces of formats that have triangles alone, glTF and STL, are joined.
  std::optional<bool> join = std::nullopt;
  /// Whether a glTF file's emissive colors are luminances, cd/m², at 683 lm/W, instead of
  /// radiances.
  bool photometric = false;

  /// @throws InputError naming the value and the valid range
  void validate() const;
  /// Exact comparison of all members.
  friend bool operator==(const ReadOptions&, const ReadOptions&) = default;
};

/// Names of units of length that ReadOptions::scale can be given by: mm, cm, m, in, ft.
std::vector<std::string> length_unit_names();
/// Meters per unit.
/// @throws InputError with the valid names
double length_unit_from_name(const std::string& name);

/// How faces become patches.
struct SceneOptions {
  bool two_sided = false;     ///< every face gives two opposite patches, front first
  double max_patch_area = 0;  ///< m²; faces larger than this are subdivided; 0 subdivides none

  /// Exact comparison of all members.
  friend bool operator==(const SceneOptions&, const SceneOptions&) = default;
};

/// A planar polygon of constant radiosity.
struct Patch {
  Vec3 normal;                      ///< unit, on the front side
  double area = 0;                  ///< m², > 0
  Vec3 center;                      ///< centroid, m
  std::int32_t face = 0;            ///< 0-based number of its face in the description, or its
                                    ///< SceneDescription::face_number
  std::int32_t material = 0;        ///< index into Scene::materials()
  std::int32_t group = no_group;    ///< index into Scene::groups(), or no_group
  std::uint32_t outline_begin = 0;  ///< first index in the scene's outline corners
  std::uint32_t outline_end = 0;    ///< one past the last index
};

/// A convex part of a patch, planar up to rounding, including the rounding of coordinates in a file
/// (decisions/0048-precision-of-files.md). Pieces of one patch do not overlap.
struct Piece {
  PatchId patch = no_patch;  ///< the patch it is a part of
  std::uint32_t begin = 0;   ///< first index in the scene's piece corners
  std::uint32_t end = 0;     ///< one past the last index
};

/// Findings and repairs when faces became patches.
struct SceneReport {
  std::vector<std::string> warnings;    ///< sentences for the user, at most a few dozen
  std::int64_t faces = 0;               ///< faces in the description
  std::int64_t removed_degenerate = 0;  ///< faces without area, removed
  std::int64_t cut_non_planar = 0;      ///< faces cut into triangles
  std::int64_t refined = 0;             ///< faces subdivided by SceneOptions::max_patch_area
  std::int64_t unused_points = 0;       ///< points that no face refers to
  std::int64_t coincident_faces = 0;    ///< faces with the same points as an earlier one
  /// Faces that others on the same points cover on each side that they light, by number: no light
  /// reaches them, so H = 0 and B = E. Of those that face the same way, the brightest is not
  /// covered, then the smallest, then the last.
  std::vector<std::int32_t> covered_faces;
  std::vector<std::int32_t> joined_to;  ///< SceneDescription::joined_to
};

/// A scene of patches: checked once, then never changed.
///
/// Threads: immutable, so any number of threads may read it.
class Scene {
 public:
  /// Checks `description` and converts its faces to patches.
  /// @throws InputError naming the scene, the line, the face and what is wrong.
  /// @throws Canceled
  Scene(const SceneDescription& description, const SceneOptions& options = {},
        const Cancellation& cancellation = {});
  /// The patches of another scene with other materials, whose values are not checked.
  /// @param of_patch index into `materials` for each patch
  Scene(const Scene& other, std::vector<Material> materials,
        const std::vector<std::int32_t>& of_patch);

  /// SceneDescription::name.
  const std::string& name() const { return name_; }
  /// SceneDescription::files, which must not be overwritten.
  const std::vector<std::string>& files() const { return files_; }
  /// Number of patches.
  PatchId patch_count() const { return static_cast<PatchId>(patches_.size()); }
  /// All patches, by PatchId.
  const std::vector<Patch>& patches() const { return patches_; }
  /// Patch i.
  const Patch& patch(PatchId i) const { return at(patches_, i); }
  /// Distinct points: no two have the same coordinates.
  const std::vector<Vec3>& points() const { return points_; }
  /// Point p, m.
  const Vec3& point(PointId p) const { return at(points_, p); }
  /// Outline of patch i, counter-clockwise seen from its front side; may be concave.
  std::span<const PointId> outline(PatchId i) const {
    const Patch& p = patch(i);
    return {outline_corners_.data() + p.outline_begin, p.outline_end - p.outline_begin};
  }
  /// The convex pieces of all patches, by patch.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Corners of a piece, counter-clockwise seen from the patch's front side.
  std::span<const PointId> corners(const Piece& piece) const {
    return {piece_corners_.data() + piece.begin, piece.end - piece.begin};
  }
  /// All materials; Patch::material is an index into them.
  const std::vector<Material>& materials() const { return materials_; }
  /// Names of all groups of faces; Patch::group is an index into them.
  const std::vector<std::string>& groups() const { return groups_; }
  /// Material of patch i.
  const Material& material(PatchId i) const { return at(materials_, patch(i).material); }
  /// E of patch i, W/m².
  const Rgb& exitance(PatchId i) const { return material(i).exitance; }
  /// rho of patch i.
  const Rgb& reflectance(PatchId i) const { return material(i).reflectance; }
  /// Whether any patch emits: without light, every solve gives B = 0. Time: linear in the patches.
  bool has_light() const;
  /// Bounding box of all points, m.
  const Bounds& bounds() const { return bounds_; }
  /// Warnings and counts from the checks.
  const SceneReport& report() const { return report_; }
  /// The options it was built with.
  const SceneOptions& options() const { return options_; }

 private:
  friend class PatchDivision;  // makes a scene from another, for divide()
  /// With the name, files, materials, groups, report and options of another, and no patches.
  struct WithoutPatches {};
  Scene(const Scene& other, WithoutPatches);

  std::string name_;
  std::vector<std::string> files_;
  SceneOptions options_;
  std::vector<Vec3> points_;
  std::vector<Material> materials_;
  std::vector<std::string> groups_;
  std::vector<Patch> patches_;
  std::vector<PointId> outline_corners_;
  std::vector<Piece> pieces_;
  std::vector<PointId> piece_corners_;
  Bounds bounds_;
  SceneReport report_;
};

/// A format of scene files.
struct SceneFormat {
  std::string ending;  ///< in lower case, with its dot
  std::string name;    ///< its name, such as "Wavefront OBJ"
};
/// All formats that describe_scene() reads, by the ending of a file's name.
const std::vector<SceneFormat>& scene_formats();
/// Whether `path` ends as one of scene_formats(), in upper or lower case.
bool is_scene_file(const std::string& path);

/// Reads a file or generates a built-in scene.
/// @param spec a path of a scene file (is_scene_file()), or the name of a built-in scene
/// (built_in_scenes()), with parameters as in `sphere-flake:levels=2,slices=17,stacks=8`.
/// @param read what replaces missing values, and the unit of lengths. What was replaced is noted in
/// SceneDescription::notes.
/// @param cancellation checked while reading.
/// @throws InputError; for an unknown name similar to a known one the message suggests it.
/// @throws Canceled
SceneDescription describe_scene(const std::string& spec, const ReadOptions& read = {},
                                const Cancellation& cancellation = {});

/// describe_scene(), then Scene.
/// @throws InputError, Canceled
std::shared_ptr<const Scene> load_scene(const std::string& spec, const SceneOptions& options = {},
                                        const ReadOptions& read = {},
                                        const Cancellation& cancellation = {});

/// Name and parameters of a built-in scene, for lists and help.
struct BuiltInScene {
  std::string name;        ///< its name, which describe_scene() accepts
  std::string summary;     ///< one sentence
  std::string parameters;  ///< with their defaults, as they may follow the name and a colon
};
/// All built-in scenes.
const std::vector<BuiltInScene>& built_in_scenes();

}  // namespace TRANSILLUM_API transillum
