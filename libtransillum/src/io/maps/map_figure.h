// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/maps/map_drawing.h"

namespace transillum {

/// Layout and texts of a map's figure, which the SVG and PDF files share. Lengths are in pixels of
/// a screen with scale 1, y downward.
struct MapFigure {
  static constexpr double padding = 24, header = 104, footer = 92;
  /// Sizes of fonts, and base lines of the header's texts.
  static constexpr double title_size = 20, text_size = 13, note_size = 15;
  static constexpr double title_base = 42, direction_base = 66, content_base = 86;

  /// A line of known length.
  struct ScaleBar {
    double left, right, y;
    double meters;
  };
  struct LegendEntry {
    Color8 color;
    std::string label;
    double left;
  };

  MapFigure(const Scene& scene, const VisibilityMap& map, const MapPictureOptions& options);

  bool in_pixels = false;    ///< the map is drawn in pixels
  double width = 0;          ///< width of the page
  double height = 0;         ///< height of the page
  double left = 0;           ///< left side of the map; its upper side is at `header`
  MapLayout layout;          ///< place of the map; its transform is to the page
  std::string title;         ///< with the whole name of the scene
  std::string short_title;   ///< shortened to the width of the page
  std::string direction;     ///< the line below the title
  std::string content;       ///< the second line below the title
  std::string empty_reason;  ///< in the middle of an empty map
  std::optional<ScaleBar> scale_bar;
  Vec2 axes;                        ///< where u, to the left, and v, upward, begin
  std::vector<LegendEntry> legend;  ///< in a row
  double legend_top = 0;            ///< upper side of its samples, 16 x 12 pixels each
};

}  // namespace transillum
