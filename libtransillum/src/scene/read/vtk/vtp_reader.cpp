// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include "base/text_file.h"
#include "scene/read/vtk/vtk_polygons.h"
#include "scene/read/vtk/vtp_file.h"

namespace transillum {
namespace {

/// Most corners per byte of the file, which is packed.
constexpr std::size_t largest_ratio = 16;

VtkCells cells_of(const VtpFile& file, const char* section, std::size_t count) {
  VtkCells cells;
  if (count == 0) {
    return cells;
  }
  cells.ends = file.whole_numbers(section, "offsets", count);
  const std::int64_t size = cells.ends.back();
  const auto most = static_cast<std::int64_t>(largest_ratio * file.bytes());
  if (size < 0 || size > most) {
    file.fail(fmt::format("{} end at {}, which is not in the range 0 to {}", section, size, most));
  }
  cells.points = file.whole_numbers(section, "connectivity", static_cast<std::size_t>(size));
  return cells;
}

std::vector<VtkArray> arrays_of(const VtpFile& file, const char* section, std::size_t entries) {
  std::vector<VtkArray> arrays;
  for (const std::string& name : file.names(section)) {
    const auto [type, components] = file.kind(section, name);
    const bool has_bytes = type == "UInt8";
    if (is_read_by_scenes(name, components, has_bytes)) {
      arrays.push_back(
          {name, components, has_bytes, file.numbers(section, name, components, entries)});
    }
  }
  return arrays;
}

std::vector<std::string> names_of(const VtpFile& file, const std::string& name) {
  return file.has("FieldData", name) && file.kind("FieldData", name).type == "String"
             ? file.strings(name)
             : std::vector<std::string>();
}

}  // namespace

SceneDescription read_vtp(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation) {
  const VtpFile file(path, cancellation, largest_scene_file);
  VtkPolygons polygons;
  polygons.name = file.name();
  polygons.points = file.numbers("Points", "Points", 3, file.points());
  polygons.polygons = cells_of(file, "Polys", file.polygons());
  polygons.strips = cells_of(file, "Strips", file.strips());
  polygons.other_cells = file.other_cells();
  polygons.of_cells = arrays_of(file, "CellData", file.cells());
  polygons.of_points = arrays_of(file, "PointData", file.points());
  polygons.cell_scalars = file.scalars("CellData");
  polygons.point_scalars = file.scalars("PointData");
  polygons.materials = names_of(file, "materials");
  polygons.groups = names_of(file, "groups");
  return scene_of(polygons, options, cancellation);
}

}  // namespace transillum
