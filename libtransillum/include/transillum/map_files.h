// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "transillum/export.h"
#include "transillum/scene.h"
#include "transillum/visibility_map.h"

namespace TRANSILLUM_API transillum {

/// A text that names a place of a map.
struct MapLabel {
  std::string text;  ///< UTF-8, one line
  Vec2 point;        ///< on the plane, m
};

/// Options of write_map() for pictures (.svg, .pdf, .png).
struct MapPictureOptions {
  static constexpr int smallest_size = 200;  ///< pixels
  static constexpr int largest_size = 8192;  ///< pixels
  int size = 1200;  ///< pixels along the longer side, smallest_size … largest_size
  /// sRGB of each patch's front side; empty: by its exitance or reflectance.
  std::vector<std::array<std::uint8_t, 3>> patch_colors{};
  std::vector<MapLabel> labels{};  ///< drawn over the map
  /// Title, any bytes; empty for none. Unset: names the scene in .svg and .pdf, none in .png.
  std::optional<std::string> title{};
  bool transparent = false;    ///< neither paper nor the map's dark background is drawn
  double pixels_per_inch = 0;  ///< resolution that .png records; 0 means unknown

  /// @throws InputError naming the size and its range.
  void validate() const;
};

/// Why the map is empty, as a phrase for the user; empty if it is not.
std::string empty_map_reason(const Scene& scene, const VisibilityMap& map);

/// Checks that `path` is writable and ends in .svg, .pdf, .png, .vtp or .json.
/// @throws InputError
void check_map_path(const std::filesystem::path& path);

/// Whether `path` ends in .svg, .pdf or .png, to which MapPictureOptions apply.
bool is_map_picture(const std::filesystem::path& path);

/// Writes the map in the format given by the extension of `path`, completely or not at all.
///
/// - .svg: a figure with title, legend and scale bar; one path per patch, of class
///   `patch pN front` or `patch pN back`, with its area in `data-area` (m², sum of its polygons)
///   and a tool tip; .pdf: the same figure, of vectors and text, without tool tips.
/// - .png: the same polygons, anti-aliased, without text but labels; its text chunks describe it.
/// - .vtp: polygons at z = 0 in plane coordinates, with cell arrays patch, front, area.
/// - .json: frame, receiver and polygons; numbers read back bit for bit.
///
/// For a map drawn in pixels, rectangles of pixels take the place of the polygons, and the
/// differences from the exact map are marked (.vtp: cell array `difference` is 1; .json:
/// `differences`). Pictures show the plane seen along omega, so u points to the left and v up.
/// @param path the file to write.
/// @param scene the scene of `map`.
/// @param map any.
/// @param options of pictures.
/// @throws InputError as check_map_path, for a size out of range, or where `path` is a file of the
/// scene; std::runtime_error if the file cannot be written.
void write_map(const std::filesystem::path& path, const Scene& scene, const VisibilityMap& map,
               const MapPictureOptions& options = {});

/// Writes the map as the figure that write_map() writes to a file ending in .svg.
/// @throws InputError for a size out of range.
void write_map_svg(std::ostream& out, const Scene& scene, const VisibilityMap& map,
                   const MapPictureOptions& options = {});

}  // namespace TRANSILLUM_API transillum
