// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: the OBJ reader, and the construction of patches from faces. An input is an OBJ file;
// the text after a line `%mtl` is the MTL file that it may use as `m.mtl`.
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>

#include "fuzz/require.h"
#include "scene/read/obj_reader.h"
#include "support/temporary_folder.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::fuzz {
namespace {

constexpr std::string_view separator = "\n%mtl\n";

/// Newell vector of an outline: its normal times twice its area.
Vec3 doubled_area(const Scene& scene, std::span<const PointId> outline) {
  Vec3 sum;
  const Vec3 origin = scene.point(outline[0]);
  for (std::size_t k = 2; k < outline.size(); ++k) {
    sum = sum + cross(scene.point(outline[k - 1]) - origin, scene.point(outline[k]) - origin);
  }
  return sum;
}

double area_of(const Scene& scene) {
  double sum = 0;
  for (const Patch& patch : scene.patches()) {
    sum += patch.area;
  }
  return sum;
}

/// Largest effect of the rounding of coordinates on an area in the scene, m².
double rounding_of_areas(const Scene& scene) {
  double largest = 0;
  for (const Vec3& p : scene.points()) {
    largest = std::max(largest, max_abs(p));
  }
  return 256 * 0x1p-52 * largest * scene.bounds().diagonal();
}

/// Uncertainty of the area of a slightly bent patch that is treated as planar, m²: a corner that is
/// straight in the projection along an axis, but not in the projection along the normal, is in no
/// triangle.
double bend_of(const Scene& scene, PatchId i) {
  const Patch& patch = scene.patch(i);
  Bounds box;
  double deviation = 0;
  for (const PointId p : scene.outline(i)) {
    box.add(scene.point(p));
    deviation = std::max(deviation, std::abs(dot(patch.normal, scene.point(p) - patch.center)));
  }
  return deviation * box.diagonal();
}

void check(const Scene& scene) {
  const double rounding = rounding_of_areas(scene);
  std::vector<double> piece_area(static_cast<std::size_t>(scene.patch_count()));
  for (const Piece& piece : scene.pieces()) {
    require(piece.end - piece.begin >= 3, "a piece has three corners");
    const Vec3& normal = scene.patch(piece.patch).normal;
    const double area = dot(normal, doubled_area(scene, scene.corners(piece))) / 2;
    at(piece_area, piece.patch) += area;
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Patch& patch = scene.patch(i);
    require(patch.area > 0 && std::isfinite(patch.area), "a patch has an area");
    require(std::abs(norm(patch.normal) - 1) < 1e-12, "a normal is a unit vector");
    require(is_finite(patch.center), "a patch has a center");
    require(std::abs(at(piece_area, i) - patch.area) <=
                1e-9 * patch.area + bend_of(scene, i) + rounding,
            "the pieces cover the patch");
    const Rgb &rho = scene.reflectance(i), &e = scene.exitance(i);
    for (const double channel : {rho.r, rho.g, rho.b}) {
      require(channel >= 0 && channel < 1, "0 <= rho < 1");
    }
    for (const double channel : {e.r, e.g, e.b}) {
      require(channel >= 0 && std::isfinite(channel), "0 <= E < infinity");
    }
  }
}

/// Checks that a written scene reads back bit for bit.
void check_written(const test::TemporaryFolder& folder, const SceneDescription& description) {
  const std::filesystem::path path = folder.path() / "written.obj";
  write_obj(path, description);
  const SceneDescription again = read_obj(path);
  require(again.points == description.points, "points read back");
  require(again.corners == description.corners && again.face_begin == description.face_begin,
          "faces read back");
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const auto& before = at(description.materials, description.face_material[f]);
    const auto& after = at(again.materials, again.face_material[f]);
    require(before.reflectance == after.reflectance && before.exitance == after.exitance,
            "materials read back");
  }
}

void check_file(const test::TemporaryFolder& folder, const std::string& path) {
  const SceneDescription description = read_obj(path);
  const Scene scene(description);
  check(scene);
  check_written(folder, description);
  // Some hundred patches, however large the faces are.
  const double area = area_of(scene);
  if (!(area > 0 && std::isfinite(area))) {
    return;
  }
  const Scene fine(description, {.two_sided = true, .max_patch_area = area / 100});
  check(fine);
  // Parts of a face that deviates from its plane by a thousandth of its width have other planes.
  require(std::abs(area_of(fine) - 2 * area) <=
              1e-5 * area + rounding_of_areas(scene) * fine.patch_count(),
          "refined, both sides have the same area");
}

}  // namespace
}  // namespace transillum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace transillum;
  static const test::TemporaryFolder folder;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = input.find(fuzz::separator);
  const bool has_materials = end != std::string_view::npos;
  const std::string path = folder.write("scene.obj", input.substr(0, end));
  folder.write("m.mtl", has_materials ? input.substr(end + fuzz::separator.size()) : "");
  try {
    fuzz::check_file(folder, path);
  } catch (const InputError& error) {
    fuzz::require(std::string_view(error.what()).find('\n') == std::string_view::npos,
                  "an error is one line");
  }
  return 0;
}
