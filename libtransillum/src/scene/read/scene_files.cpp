// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>

#include "base/text_file.h"
#include "scene/build/joining.h"
#include "scene/read/scene_readers.h"

namespace transillum {
namespace {

struct Format {
  const char* ending;
  const char* name;
  SceneReader* read;
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

SceneDescription read(const Format& format, const std::string& path, const ReadOptions& options,
                      const Cancellation& cancellation) {
  try {
    return format.read(path, options, cancellation);
  } catch (const std::bad_alloc&) {
    throw InputError(path + ": not enough memory");
  }
}

const Format* format_of(const std::string& path) {
  const std::string ending = lower_case_ending(path);
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
  SceneDescription faces = read(*format, path, options, cancellation);
  if (format->joins_by_itself || !options.join.value_or(format->has_triangles_only)) {
    return faces;
  }
  SceneDescription joined = join_faces(faces, cancellation).description;
  if (joined.face_count() < faces.face_count()) {
    joined.notes.push_back(
        fmt::format("{}: {} faces joined to {}", path, faces.face_count(), joined.face_count()));
  }
  return joined;
}

}  // namespace transillum
