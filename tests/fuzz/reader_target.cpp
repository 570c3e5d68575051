// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: the OBJ reader, and the construction of patches from faces. An input is an OBJ file;
// the text after a line `%mtl` is the MTL file that it may use as `m.mtl`.
#include <cmath>
#include <cstdint>
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

void check_file(const test::TemporaryFolder& folder, const std::string& path) {
  const SceneDescription description = describe_scene(path);
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
