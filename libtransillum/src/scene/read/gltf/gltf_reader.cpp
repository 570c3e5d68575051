// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// From the nodes of a glTF file to faces. Triangles are read with one material each as the file has
// them; after they are joined, each face gets rho and E, averaged over its triangles where textures
// or colors of vertices make them differ.
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "scene/build/description_check.h"
#include "scene/build/joining.h"
#include "scene/build/warnings.h"
#include "scene/read/face_materials.h"
#include "scene/read/gltf/gltf_expansion.h"
#include "scene/read/gltf/gltf_file.h"
#include "scene/read/gltf/gltf_materials.h"
#include "scene/read/gltf/gltf_nodes.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// rho, E and lobes of textured faces are rounded to this many parts, so that they share materials.
constexpr double part_count = 1024;
/// Their roughness to fewer: each is a lobe of its own.
constexpr double roughness_parts = 64;

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& path, const ReadOptions& options,
             const Cancellation& cancellation)
      : options_(options),
        cancellation_(cancellation),
        file_(path, cancellation),
        materials_(file_, options, notes_, cancellation) {
    description_.name = path.string();
  }

  SceneDescription read() {
    for (const PlacedNode& node : placed_nodes(file_)) {
      cancellation_.throw_if_canceled();
      add_node(node);
    }
    if (description_.face_count() == 0) {
      file_.fail(left_out_.without_extent == 0
                     ? "has no triangles"
                     : fmt::format("has no triangles: node {}, or one above it, has a scale of 0",
                                   first_without_extent_));
    }
    note_what_is_left_out();
    add_materials();
    SceneDescription finished = options_.join.value_or(true) ? joined() : separate();
    lower_reflectances(finished);
    finished.files = file_.files();
    finished.coordinate_rounding = rounding_;
    finished.notes = notes_.sentences();
    return finished;
  }

 private:
  const tinygltf::Model& model() const { return file_.model(); }

  void add_node(const PlacedNode& visit) {
    const tinygltf::Node& node = at(model().nodes, visit.node);
    if (node.mesh < 0) {
      return;
    }
    if (static_cast<std::size_t>(node.mesh) >= model().meshes.size()) {
      file_.fail(fmt::format("node {}: mesh {} does not exist; there are {}", visit.node, node.mesh,
                             model().meshes.size()));
    }
    const tinygltf::Mesh& mesh = at(model().meshes, node.mesh);
    place_ = fmt::format("node {}, mesh {}", visit.node, node.mesh);
    if (visit.placement.flattens()) {
      if (left_out_.without_extent++ == 0) {
        first_without_extent_ = visit.node;
      }
      return;
    }
    const std::string& named = node.name.empty() ? mesh.name : node.name;
    group_name_ = named.empty() ? fmt::format("node {}", visit.node) : named;
    group_ = no_group;
    left_out_.skins += node.skin >= 0 ? 1 : 0;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      add_primitive(primitive, visit.placement);
    }
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Placement& placement) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        mode != TINYGLTF_MODE_TRIANGLE_FAN) {
      ++left_out_.lines;
      return;
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
      ++left_out_.without_positions;
      return;
    }
    left_out_.morphs += primitive.targets.empty() ? 0 : 1;
    const std::size_t vertices = add_points(position->second, placement);
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
      file_.count_of(primitive.indices, 3 * (most_gltf_elements - description_.face_count()) + 3);
      corners = file_.indices(primitive.indices);
    } else {
      corners.resize(vertices);
      for (std::size_t v = 0; v < vertices; ++v) {
        corners[v] = static_cast<std::uint32_t>(v);
      }
    }
    const std::int32_t material = material_of(primitive);
    const GltfMaterials::Vertices of_vertices = attributes_of(primitive, material, vertices);
    const bool varies = !of_vertices.texture_points.empty() || !of_vertices.colors.empty();
    for_each_triangle(mode, corners, [&](std::array<std::uint32_t, 3> triangle) {
      for (const std::uint32_t c : triangle) {
        if (c >= vertices) {
          file_.fail(
              fmt::format("{}: vertex {} does not exist; there are {}", place_, c, vertices));
        }
      }
      add_triangle(triangle, placement.mirrors(), material);
      add_colors(
          varies ? materials_.colors(material, of_vertices, triangle) : materials_.colors(material),
          varies);
    });
    first_point_ += vertices;
  }

  /// Keeps the colors of the last triangle, from the first that differs from its material on.
  void add_colors(const SurfaceColors& colors, bool varies) {
    if (!varies && varying_.empty()) {
      return;
    }
    for (std::size_t t = varying_.size(); t + 1 < description_.face_count(); ++t) {
      varying_.push_back(materials_.colors(description_.face_material[t]));
    }
    varying_.push_back(colors);
  }

  /// Returns how many.
  std::size_t add_points(int accessor, const Placement& placement) {
    const std::size_t count =
        file_.count_of(accessor, most_gltf_elements - description_.points.size());
    const std::vector<double> numbers = file_.numbers(accessor, 3);
    double largest = 0;
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 local = vector_of(numbers, 3 * v);
      const Vec3 p = placement.point(local);
      if (!(max_abs(p) <= largest_coordinate) || !is_finite(p)) {
        file_.fail(fmt::format("{}: vertex {} is not a finite point of at most {}", place_, v,
                               largest_coordinate));
      }
      largest = std::max(largest, max_abs(local));
      description_.points.push_back(p);
    }
    rounding_ = std::max(rounding_, placement.growth() * file_.rounding_of(accessor, largest));
    return count;
  }

  std::int32_t material_of(const tinygltf::Primitive& primitive) {
    if (primitive.material < 0) {
      ++left_out_.without_material;
      return materials_.none();
    }
    if (primitive.material >= materials_.none()) {
      file_.fail(fmt::format("{}: material {} does not exist; there are {}", place_,
                             primitive.material, materials_.none()));
    }
    return primitive.material;
  }

  GltfMaterials::Vertices attributes_of(const tinygltf::Primitive& primitive, std::int32_t material,
                                        std::size_t vertices) const {
    GltfMaterials::Vertices of;
    const auto read = [&](const std::string& name, std::size_t components) {
      const auto found = primitive.attributes.find(name);
      std::vector<double> numbers;
      if (found != primitive.attributes.end()) {
        if (file_.count_of(found->second, vertices) != vertices) {
          file_.fail(
              fmt::format("{}: {} must have {} entries, as POSITION has", place_, name, vertices));
        }
        numbers = file_.numbers(found->second, components);
        for (double& v : numbers) {
          v = std::isfinite(v) ? v : 0;
        }
      }
      return numbers;
    };
    for (const int set : materials_.texture_sets(material)) {
      std::vector<double> points = read(fmt::format("TEXCOORD_{}", set), 2);
      if (!points.empty()) {
        of.texture_points[set] = std::move(points);
      }
    }
    of.colors = read("COLOR_0", 3);
    for (double& v : of.colors) {
      v = std::clamp(v, 0.0, 1.0);
    }
    return of;
  }

  template <class Visit>
  void for_each_triangle(int mode, const std::vector<std::uint32_t>& corners, Visit visit) const {
    const std::size_t n = corners.size(), step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (std::size_t k = 0; k + 2 < n; k += step) {
      if (k % 65536 < step) {
        cancellation_.throw_if_canceled();
      }
      const bool odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && k % 2 == 1;
      const std::size_t first = mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : k;
      visit({corners[first], corners[odd ? k + 2 : k + 1], corners[odd ? k + 1 : k + 2]});
    }
  }

  void add_triangle(const std::array<std::uint32_t, 3>& triangle, bool mirrored,
                    std::int32_t material) {
    if (description_.face_count() >= most_gltf_elements) {
      file_.fail(fmt::format("has more than {} triangles", most_gltf_elements));
    }
    if (group_ == no_group) {
      group_ = static_cast<std::int32_t>(description_.groups.size());
      description_.groups.push_back(group_name_);
    }
    std::array<PointId, 3> outline{};
    for (std::size_t k = 0; k < 3; ++k) {
      outline[k] = static_cast<PointId>(first_point_ + triangle[mirrored ? 2 - k : k]);
    }
    const bool two_sided = materials_.is_double_sided(material);
    if (two_sided) {
      description_.face_two_sided.resize(description_.face_count(), 0);
    }
    const bool states_sides = two_sided || !description_.face_two_sided.empty();
    description_.add_face(outline, material, 0, group_);
    if (states_sides) {
      description_.face_two_sided.resize(description_.face_count(), 0);
      description_.face_two_sided.back() = two_sided ? 1 : 0;
    }
  }

  // Materials -------------------------------------------------------------------------------

  void add_materials() {
    for (std::int32_t m = 0; m <= materials_.none(); ++m) {
      const SurfaceColors colors = materials_.colors(m);
      description_.materials.push_back(
          {materials_.name(m), colors.reflectance, colors.exitance, colors.ggx()});
    }
  }

  /// Lowers reflectances as the options say. Notes those that a face has, once for each name: of a
  /// textured material, the mean of the face counts.
  void lower_reflectances(SceneDescription& d) {
    std::vector<char> is_used(d.materials.size(), 0);
    for (const std::int32_t m : d.face_material) {
      at(is_used, m) = 1;
    }
    std::set<std::string> noted;
    for (std::size_t m = 0; m < d.materials.size(); ++m) {
      Material& material = d.materials[m];
      const Rgb given = material.reflectance;
      const std::string place = fmt::format("{}: material {}: ", d.name, material.name);
      const double lowered = lower_reflectance(material.reflectance, options_);
      if (lowered > 0 && is_used[m] != 0 && noted.insert(material.name).second) {
        notes_.add("materials, whose reflectance is lowered",
                   fmt::format("{}reflectance rho {:.6g} {:.6g} {:.6g} is lowered to {}", place,
                               given.r, given.g, given.b, lowered));
      }
      check_material(material, place);
    }
  }

  SceneDescription joined() {
    JoinedFaces result = join_faces(description_, cancellation_);
    SceneDescription& d = result.description;
    if (d.face_count() < description_.face_count()) {
      notes_.add("notes", fmt::format("{}: {} triangles joined to {} polygons", d.name,
                                      description_.face_count(), d.face_count()));
    }
    set_varying(d, [&](std::size_t triangle) {
      return static_cast<std::size_t>(at(result.face_of, triangle));
    });
    return std::move(d);
  }

  SceneDescription separate() {
    SceneDescription d = description_;
    set_varying(d, [](std::size_t triangle) { return triangle; });
    return d;
  }

  /// Gives the faces of textured materials their averages, weighted by area.
  template <class FaceOf>
  void set_varying(SceneDescription& d, FaceOf face_of) {
    if (varying_.empty()) {
      return;
    }
    std::vector<SurfaceColors> sums(d.face_count());
    std::vector<double> areas(d.face_count(), 0.0);
    for (std::size_t t = 0; t < description_.face_count(); ++t) {
      const std::span<const PointId> outline = description_.outline(t);
      const Vec3 a = at(description_.points, outline[0]);
      const double area = norm(
          cross(at(description_.points, outline[1]) - a, at(description_.points, outline[2]) - a));
      // Faces without area have a color too.
      const double weight = std::max(area, 1e-300);
      const std::size_t f = face_of(t);
      sums[f] += weight * varying_[t];
      areas[f] += weight;
    }
    std::map<std::pair<std::int32_t, std::array<double, 10>>, std::int32_t> numbers;
    for (std::size_t f = 0; f < d.face_count(); ++f) {
      assign(d, f, 1 / areas[f] * sums[f], numbers);
    }
  }

  template <class Numbers>
  void assign(SceneDescription& d, std::size_t face, const SurfaceColors& mean, Numbers& numbers) {
    const std::int32_t base = d.face_material[face];
    const SurfaceColors plain = materials_.colors(base);
    // A material without textures keeps its colors to the bit.
    const auto rounded = [](const Rgb& value, const Rgb& whole) {
      const auto channel = [](double v, double of) {
        return of > 0 && std::abs(v - of) > 1e-9 * of
                   ? of * std::round(v / of * part_count) / part_count
                   : of;
      };
      return Rgb{channel(value.r, whole.r), channel(value.g, whole.g), channel(value.b, whole.b)};
    };
    const bool metal = max_abs(plain.reflectance) == 0;  // its texture says how much
    const Rgb rho =
        metal ? rounded(mean.reflectance, {1, 1, 1}) : rounded(mean.reflectance, plain.reflectance);
    const Rgb e = rounded(mean.exitance, plain.exitance);
    // For other materials the lobe is nearly the same everywhere, but where a texture has it.
    const bool of_face = metal || max_abs(mean.lobe - plain.lobe) > 1 / part_count ||
                         std::abs(mean.roughness - plain.roughness) > 1 / roughness_parts;
    const SurfaceColors used{
        rho, e, of_face ? rounded(mean.lobe, {1, 1, 1}) : plain.lobe,
        of_face ? std::round(mean.roughness * roughness_parts) / roughness_parts : plain.roughness};
    const bool same_lobe = max_abs(used.lobe - plain.lobe) <= 1 / part_count &&
                           std::abs(used.roughness - plain.roughness) <= 1 / roughness_parts;
    const auto next = static_cast<std::int32_t>(d.materials.size());
    if (rho == plain.reflectance && e == plain.exitance && same_lobe) {
      return;
    }
    const auto [entry, is_new] =
        numbers.try_emplace({base,
                             {rho.r, rho.g, rho.b, e.r, e.g, e.b, used.lobe.r, used.lobe.g,
                              used.lobe.b, used.roughness}},
                            next);
    if (is_new) {
      d.materials.push_back({materials_.name(base), rho, e, used.ggx()});
    }
    d.face_material[face] = entry->second;
  }

  // Notes -----------------------------------------------------------------------------------

  void note_what_is_left_out() {
    const auto note = [&](std::int64_t count, const std::string& what) {
      if (count > 0) {
        notes_.add("notes", fmt::format("{}: {} {}", description_.name, count, what));
      }
    };
    notes_.add(
        "notes",
        fmt::format("{}: glTF: lengths in meters, y up; rho = base color (1 - metallic), "
                    "E = pi emissive factor strength{}",
                    description_.name,
                    options_.photometric ? " / 683 (from cd/m2)" : " (as radiance, W/(m2 sr))"));
    note(left_out_.without_material, fmt::format("meshes have no material; rho = {}, E = 0 assumed",
                                                 options_.default_reflectance));
    note(left_out_.lines, "meshes of points or lines, omitted");
    note(left_out_.without_positions, "meshes without positions, omitted");
    note(left_out_.without_extent,
         fmt::format("nodes whose scale is 0, omitted; the first is node {}",
                     first_without_extent_));
    note(left_out_.skins, "nodes with a skin, taken in their rest pose");
    note(left_out_.morphs, "meshes with morph targets, taken without them");
    note(static_cast<std::int64_t>(model().lights.size()),
         "lights without a surface (KHR_lights_punctual), omitted: only surfaces emit");
  }

  struct LeftOut {
    std::int64_t lines = 0, without_positions = 0, without_extent = 0, skins = 0, morphs = 0,
                 without_material = 0;
  };

  const ReadOptions& options_;
  const Cancellation& cancellation_;
  Warnings notes_;
  const GltfFile file_;
  GltfMaterials materials_;
  SceneDescription description_;        ///< triangles; face_material: number in the file
  std::vector<SurfaceColors> varying_;  ///< by triangle; empty: no texture or color of a vertex
  double rounding_ = 0;
  int first_without_extent_ = 0;
  std::size_t first_point_ = 0;  ///< first point of the primitive that is read
  std::string place_, group_name_;
  std::int32_t group_ = no_group;
  LeftOut left_out_;
};

}  // namespace

SceneDescription read_gltf(const std::filesystem::path& path, const ReadOptions& options,
                           const Cancellation& cancellation) {
  return GltfReader(path, options, cancellation).read();
}

}  // namespace transillum
