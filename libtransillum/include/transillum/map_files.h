// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "transillum/scene.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// How a map is drawn, where the file is a picture.
struct MapPictureOptions {
  static constexpr int smallest_size = 200, largest_size = 8192;
  int size = 1200;  ///< pixels along the longer side, smallest_size to largest_size
  /// sRGB of what shines down, one a patch; empty: by what it emits or reflects.
  std::vector<std::array<std::uint8_t, 3>> patch_colors{};
};

/// Why there is nothing to see on the map, in a few words; empty where there is something.
std::string empty_map_reason(const Scene& scene, const VisibilityMap& map);

/// check_writable, and @throws InputError unless `path` ends in .svg, .vtp, .png or .json.
void check_map_path(const std::filesystem::path& path);

/// Writes the map as the ending of `path` says, whole or not at all. `scene` is the map's.
///
/// .svg: a figure with title, legend and scale bar; a path a patch, of class `patch pN front` or
///   `patch pN back`, with its area in `data-area` (m², sum of its polygons) and a tool tip.
/// .png: the same polygons without words, smoothed; what they mean is in its text fields.
/// .vtp: polygons at z = 0 of the plane's coordinates, cell arrays patch, front, area.
/// .json: frame, receiver and polygons; numbers read back bit for bit.
/// Of a map drawn in pixels rectangles of pixels take the polygons' place, and pictures mark where
/// it differs from the exact one (.vtp: cells whose array `difference` is 1; .json: `differences`).
/// Pictures are seen along omega, so u points to the left and v up.
/// @throws InputError as check_map_path; std::runtime_error where it cannot be written.
void write_map(const std::filesystem::path& path, const Scene& scene, const VisibilityMap& map,
               const MapPictureOptions& options = {});

}  // namespace transillum
