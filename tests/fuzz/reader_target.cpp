// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: the OBJ reader, and the construction of patches from faces. An input is an OBJ file;
// the text after a line `%mtl` is the MTL file that it may use as `m.mtl`.
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>

#include "fuzz/require.h"
#include "fuzz/scene_checks.h"
#include "support/temporary_folder.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/scene.h"

namespace transillum::fuzz {
namespace {

constexpr std::string_view separator = "\n%mtl\n";

/// Checks that a written scene reads back bit for bit.
void check_written(const test::TemporaryFolder& folder, const SceneDescription& description) {
  const std::filesystem::path path = folder.path() / "written.obj";
  write_obj(path, description);
  const SceneDescription again = describe_scene(path.string());
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

/// The vector area of each face, twice: the integral of its normal.
std::map<std::int32_t, Vec3> vector_areas(const Scene& scene, PatchId step) {
  std::map<std::int32_t, Vec3> areas;
  for (PatchId i = 0; i < scene.patch_count(); i += step) {
    Vec3& area = areas[scene.patch(i).face];
    area = area + doubled_area(scene, scene.outline(i));
  }
  return areas;
}

/// @param fine the same faces, two-sided and divided.
void check_division(const Scene& scene, const Scene& fine) {
  const double rounding = rounding_of_areas(scene) * fine.patch_count();
  // A bent face has the vector area that its boundary has, however it is divided, but for corners
  // that are in no triangle. They are off the face along an axis, whose cosine with its normal is
  // at least 1/sqrt(3).
  const auto whole = vector_areas(scene, 1), parts = vector_areas(fine, 2);
  std::map<std::int32_t, double> bends;
  double all_bends = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const double bend = std::sqrt(3) * bend_of(scene, i);
    bends[scene.patch(i).face] += bend;
    all_bends += bend;
  }
  require(whole.size() == parts.size(), "division keeps all faces");
  for (const auto& [face, area] : whole) {
    const auto found = parts.find(face);
    require(found != parts.end() && max_abs(found->second - area) <= 2 * bends[face] + rounding,
            "the parts of a face have its vector area");
  }
  // Parts may be steeper than their face: a corner that is a thousandth of the width off its plane,
  // over a tenth of the width, adds 5e-5 to the area of that part.
  require(std::abs(total_area(fine) - 2 * total_area(scene)) <=
              5e-5 * total_area(scene) + 2 * all_bends + rounding,
          "refined, both sides have the same area");
}

void check_file(const test::TemporaryFolder& folder, const std::string& path) {
  const SceneDescription description = describe_scene(path);
  const Scene scene(description);
  check(scene);
  check_written(folder, description);
  // Some hundred patches, however large the faces are.
  const double area = total_area(scene);
  if (!(area > 0 && std::isfinite(area))) {
    return;
  }
  const Scene fine(description, {.two_sided = true, .max_patch_area = area / 100});
  check(fine);
  check_division(scene, fine);
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
