// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// One array of the point or cell data of a VTK file.
struct VtkArray {
  std::string name;
  std::size_t components = 1;
  bool has_bytes = false;      ///< its type is unsigned char
  std::vector<double> values;  ///< `components` per point or cell
};

/// Polygons or strips: the points of all of them, and where each ends.
struct VtkCells {
  std::vector<std::int64_t> points;
  std::vector<std::int64_t> ends;
};

/// Polygons of VTK as a file has them, nothing checked but the number of values of each array.
struct VtkPolygons {
  std::string name;                ///< name of the file
  std::vector<double> points;      ///< x, y, z of each
  VtkCells polygons, strips;       ///< strips of triangles
  std::size_t other_cells = 0;     ///< vertices and lines, whose data come first
  std::vector<VtkArray> of_cells;  ///< arrays that is_read_by_scenes() accepts
  std::vector<VtkArray> of_points;
  std::string cell_scalars, point_scalars;     ///< names of the arrays to show; may be empty
  std::vector<std::string> materials, groups;  ///< names, by number
};

/// Whether the polygons of a scene read an array: rho, E, material, group or face of cells, as in a
/// result, or colors in bytes.
bool is_read_by_scenes(const std::string& name, std::size_t components, bool has_bytes);

/// The scene of polygons. rho and E come from the arrays of a result, else rho is the color of
/// the cell or the mean color of its points.
/// @throws InputError naming the file, the polygon and what is wrong
/// @throws Canceled
SceneDescription scene_of(const VtkPolygons& polygons, const ReadOptions& options,
                          const Cancellation& cancellation);

}  // namespace transillum
