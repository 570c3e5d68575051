// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/built_in/scene_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/text_file.h"
#include "scene/build/joining.h"
#include "scene/read/gltf/gltf_reader.h"
#include "scene/read/obj_reader.h"
#include "scene/read/off_reader.h"
#include "scene/read/ply_reader.h"
#include "scene/read/radiance_reader.h"
#include "scene/read/stl_reader.h"
#include "scene/read/view3d_reader.h"
#include "scene/read/vtk/vtk_reader.h"
#include "scene/read/vtk/vtp_reader.h"

namespace transillum {
namespace {

using Reader = SceneDescription (*)(const std::filesystem::path&, const ReadOptions&,
                                    const Cancellation&);

struct Format {
  const char* ending;
  const char* name;
  Reader read;
  bool has_triangles_only = false;
  bool joins_by_itself = false;
};

constexpr Format formats[] = {
    {".obj", "Wavefront OBJ", read_obj},
    {".gltf", "glTF", read_gltf, true, true},
    {".glb", "binary glTF", read_gltf, true, true},
    {".ply", "Stanford PLY", read_ply},
    {".stl", "STL", read_stl, true},
    {".off", "Object File Format", read_off},
    {".rad", "Radiance", read_radiance},
    {".vs3", "View3D", read_view3d},
    {".vtp", "VTK PolyData", read_vtp},
    {".vtk", "legacy VTK PolyData", read_vtk},
};

const Format* format_of(const std::string& path) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  const auto* const found =
      std::find_if(std::begin(formats), std::end(formats),
                   [&](const Format& format) { return format.ending == ending; });
  return found == std::end(formats) ? nullptr : found;
}

}  // namespace

const std::vector<SceneFormat>& scene_formats() {
  static const std::vector<SceneFormat> all = [] {
    std::vector<SceneFormat> list;
    for (const Format& format : formats) {
      list.push_back({format.ending, format.name});
    }
    return list;
  }();
  return all;
}

bool is_scene_file(const std::string& path) { return format_of(path) != nullptr; }

SceneDescription read_scene_file(const std::string& path, const ReadOptions& options,
                                 const Cancellation& cancellation) {
  const Format* format = format_of(path);
  if (format == nullptr) {
    throw InputError(path + ": not a scene file");
  }
  SceneDescription read = format->read(path, options, cancellation);
  if (format->joins_by_itself || !options.join.value_or(format->has_triangles_only)) {
    return read;
  }
  SceneDescription joined = join_faces(read, cancellation).description;
  if (joined.face_count() < read.face_count()) {
    joined.notes.push_back(
        fmt::format("{}: {} faces joined to {}", path, read.face_count(), joined.face_count()));
  }
  return joined;
}

}  // namespace transillum
