// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Visibility as engines other than the exact ones see it: what they compute, and its drawing.
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

/// The color of a relative error, -1 to 1: blue if negative, light gray at zero, orange if
/// positive; saturated from a quarter on.
QColor color_of_surplus(double surplus);

/// How fragments are colored.
struct FragmentColors {
  const std::vector<Color8>& of_patches;  ///< front sides: darker where less is open
  const QBrush& back_side;
  /// Front sides get color_of_surplus() of the error of the open fraction instead.
  bool differences = false;
};
/// Draws whole fragments over one another, the farthest first, then the outlines of those that are
/// partly open.
/// @throws Canceled
void draw_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                    const FragmentColors& colors, const Cancellation& cancellation);
/// Writes patch number and open fraction, percent, on fragments with room for it.
void label_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                     double pixel_ratio);

}  // namespace transillum::viewer
