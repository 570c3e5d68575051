// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QBrush>
#include <QPainter>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "colors/color_map.h"
#include "map/map_picture.h"
#include "transillum/corrected_map.h"
#include "transillum/pixel_map.h"

namespace transillum::viewer {

/// V after a step as another engine shows it, and where that is wrong; or why it shows nothing.
/// Immutable.
struct PixelView {
  std::shared_ptr<const RecordedMap> of;
  std::int32_t step = 0;
  PixelChoice choice;
  VisibilityMap drawn;                    ///< in pixels; empty for engine corrected
  std::optional<CorrectedMap> corrected;  ///< for that one
  std::string failure;                    ///< the engine's own words; else empty
  double wrong = 0;  ///< share of what V or the pixels show; 0 where it was not asked for

  bool shows(const RecordedMap& map, std::int32_t after, const PixelChoice& by) const {
    return of.get() == &map && step == after && choice == by;
  }
};
/// @param choice names an engine. Any thread.
/// @throws Canceled
std::shared_ptr<const PixelView> make_pixel_view(const std::shared_ptr<const RecordedMap>& map,
                                                 std::int32_t step, const PixelChoice& choice,
                                                 const Cancellation& cancellation);

/// Fills pixels in their patch's color, backs with `back_side`; coordinates by `transform`.
/// @throws Canceled
void draw_pixels(QPainter& painter, const PixelView& view, const MapTransform& transform,
                 const std::vector<Color8>& patch_colors, const QBrush& back_side,
                 const Cancellation& cancellation);

}  // namespace transillum::viewer
