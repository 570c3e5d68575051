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
#include "visibility/fast/corrected_map.h"
#include "visibility/pixels/pixel_map.h"

namespace transillum::viewer {

/// V after a step by another engine, with its errors; or the reason why the engine failed.
/// Immutable.
struct PixelView {
  std::shared_ptr<const RecordedMap> of;
  std::int32_t step = 0;
  MapEngineChoice choice;
  VisibilityMap drawn;                    ///< polygons of pixels; empty for engine corrected
  std::optional<CorrectedMap> corrected;  ///< map of engine corrected
  std::string failure;                    ///< the engine's message; empty on success
  double wrong = 0;  ///< wrong fraction of the area of V or of the pixels; 0 if not requested

  bool shows(const RecordedMap& map, std::int32_t after, const MapEngineChoice& by) const {
    return of.get() == &map && step == after && choice == by;
  }
};
/// Any thread.
/// @param choice with an engine
/// @throws Canceled
std::shared_ptr<const PixelView> make_pixel_view(const std::shared_ptr<const RecordedMap>& map,
                                                 std::int32_t step, const MapEngineChoice& choice,
                                                 const Cancellation& cancellation);

/// Fills pixels in their patch's color, back sides with `back_side`.
/// @throws Canceled
void draw_pixels(QPainter& painter, const PixelView& view, const MapTransform& transform,
                 const std::vector<Color8>& patch_colors, const QBrush& back_side,
                 const Cancellation& cancellation);

}  // namespace transillum::viewer
