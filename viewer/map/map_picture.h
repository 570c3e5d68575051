// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QPointF>
#include <QSizeF>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "colors/color_map.h"
#include "model/recorded_map.h"
#include "state/focus.h"
#include "transillum/engine.h"

namespace transillum::viewer {

/// From meters on the transillumination plane to pixels. The map is seen along omega, so u points
/// to the left and v up.
struct MapTransform {
  Vec2 center;       ///< meters; lies at `middle`
  QPointF middle;    ///< pixels
  double scale = 1;  ///< pixels a meter

  QPointF to_pixels(const Vec2& p) const {
    return {middle.x() - scale * (p.x - center.x), middle.y() - scale * (p.y - center.y)};
  }
  Vec2 to_meters(const QPointF& p) const {
    return {center.x - (p.x() - middle.x()) / scale, center.y - (p.y() - middle.y()) / scale};
  }
  friend bool operator==(const MapTransform& a, const MapTransform& b) {
    return a.center.x == b.center.x && a.center.y == b.center.y && a.middle == b.middle &&
           a.scale == b.scale;
  }
};

/// How V is drawn: exactly, in the pixels of an engine that has some (has_pixels()), or as engine
/// corrected takes it. (A hemicube has another picture: HemicubeView.)
struct PixelChoice {
  std::optional<Engine> engine;              ///< none: exactly
  PaintersOrder order = PaintersOrder::bsp;  ///< painter's
  int resolution = 64;                       ///< pixels along the longer side
  bool differences = true;                   ///< mark where pixels are wrong

  friend bool operator==(const PixelChoice&, const PixelChoice&) = default;
};
struct PixelView;

/// What one picture of a map shows.
struct MapPictureRequest {
  std::shared_ptr<const RecordedMap> map;
  std::int32_t step = 0;
  Phase phase = Phase::after;
  bool step_shown = false;  ///< mark what the step did; else V is drawn alone
  bool labels = false;      ///< number of the patch where a fragment has room for it
  PixelChoice pixels;
  std::shared_ptr<const PixelView> known_pixels;  ///< of an earlier picture; may be another's
  std::shared_ptr<const std::vector<Color8>> patch_colors;
  MapTransform transform;  ///< to logical pixels
  QSizeF size;             ///< logical
  double pixel_ratio = 1;
};

struct MapPicture {
  MapPictureRequest request;
  QImage image;
  std::shared_ptr<const PixelView> pixels;  ///< drawn, where pixels were asked for
  std::vector<std::int32_t> rows;  ///< drawn: of V, or the parts that a step is splitting it into
};

}  // namespace transillum::viewer
