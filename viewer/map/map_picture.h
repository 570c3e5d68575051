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
#include "model/requests/recorded_map.h"
#include "state/focus.h"
#include "transillum/engine.h"

namespace transillum::viewer {

/// From meters on the transillumination plane to pixels. The view is along omega, so u points to
/// the left and v up.
struct MapTransform {
  Vec2 center;       ///< meters; drawn at `middle`
  QPointF middle;    ///< pixels
  double scale = 1;  ///< pixels per meter

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

/// How V is drawn: exactly, in the pixels of an engine with has_pixels(), or with the open
/// fractions of engine corrected. (A hemicube has a separate picture: HemicubeView.)
struct MapEngineChoice {
  std::optional<Engine> engine;              ///< nullopt draws V exactly
  PaintersOrder order = PaintersOrder::bsp;  ///< order for engine painter
  int resolution = 64;                       ///< pixels along the longer side
  bool differences = true;                   ///< mark errors

  /// Whether V is shown in this way.
  bool shows(EngineTraits::Picture picture) const {
    return engine && traits_of(*engine).picture == picture;
  }
  friend bool operator==(const MapEngineChoice&, const MapEngineChoice&) = default;
};
struct PixelView;

/// The part of a direction that is drawn.
enum class MapExtent {
  step,       ///< V after a step
  sources,    ///< all fronts that face the plane from above: what emits, seen along omega
  receivers,  ///< all fronts that face it from below: what receives, seen along -omega
};

/// Everything that determines one picture of a map.
struct MapPictureRequest {
  std::shared_ptr<const RecordedMap> map;
  std::int32_t step = 0;
  Phase phase = Phase::after;
  bool step_shown = false;  ///< mark the changes of the step
  bool labels = false;      ///< patch numbers on polygons with room for them
  MapEngineChoice choice;
  std::shared_ptr<const PixelView>
      known_pixels;  ///< pixels of an earlier picture, for reuse; may be of another map
  std::shared_ptr<const std::vector<Color8>> patch_colors;
  MapTransform transform;  ///< to logical pixels
  QSizeF size;             ///< logical
  double pixel_ratio = 1;
  PatchId receiver = no_patch;         ///< draw what this patch sees; V if it is no_patch
  MapExtent extent = MapExtent::step;  ///< for exact maps without receiver
};

struct MapPicture {
  MapPictureRequest request;
  QImage image;
  std::shared_ptr<const PixelView> pixels;  ///< the pixels drawn; null for exact pictures
  std::vector<std::int32_t>
      rows;  ///< drawn: polygons of V, the parts into which a step splits them, or, the nearest
             ///< first, whole fragments that may cover one another
};

}  // namespace transillum::viewer
