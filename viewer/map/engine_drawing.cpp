// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Computes V after a step by a discrete engine or engine corrected, finds its errors against the
// exact V, and draws pixels.
#include "map/engine_drawing.h"

#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "map/polygon_text.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

double area_of(const std::vector<VisibilityMap::Polygon>& polygons) {
  double sum = 0;
  for (const VisibilityMap::Polygon& polygon : polygons) {
    sum += polygon.area;
  }
  return sum;
}

QPolygonF polygon_of(const VisibilityMap& map, const VisibilityMap::Polygon& polygon,
                     const MapTransform& transform) {
  QPolygonF result;
  for (const Vec2& p : map.outline(polygon)) {
    result.append(transform.to_pixels(p));
  }
  return result;
}

}  // namespace

std::shared_ptr<const PixelView> make_pixel_view(const std::shared_ptr<const RecordedMap>& map,
                                                 std::int32_t step, const MapEngineChoice& choice,
                                                 const Cancellation& cancellation) {
  auto view = std::make_shared<PixelView>();
  const LoadedScene& loaded = *map->loaded;
  EngineOptions options;
  options.resolution = choice.resolution;
  options.order = choice.order;
  view->of = map;
  view->step = step;
  view->choice = choice;
  try {
    if (choice.shows(EngineTraits::Picture::corrected)) {
      view->corrected =
          corrected_map_after(loaded.scene, loaded.tree, map->record(), step, cancellation);
      view->wrong = view->corrected->wrong_share();
      return view;
    }
    const PixelMap pixels = pixel_map_after({*choice.engine, options}, *loaded.scene, *loaded.tree,
                                            map->record(), step, cancellation);
    view->drawn = drawn_in_pixels(*loaded.scene, pixels, cancellation);
    if (choice.differences) {
      const VisibilityMap exact = map_after(map->record(), step);
      mark_differences(pixels, exact, view->drawn, cancellation);
      const double shown = std::max(area_of(exact.polygons), area_of(view->drawn.polygons));
      view->wrong = shown > 0 ? area_of(view->drawn.pixels.differences) / shown : 0;
    }
  } catch (const Canceled&) {
    throw;
  } catch (const std::exception& error) {
    view->failure = error.what();
  }
  return view;
}

void draw_pixels(QPainter& painter, const PixelView& view, const MapTransform& transform,
                 const std::vector<Color8>& patch_colors, const QBrush& back_side,
                 const Cancellation& cancellation) {
  const VisibilityMap& map = view.drawn;
  painter.save();
  // Without antialiasing there are no seams between adjacent rectangles.
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(Qt::NoPen);
  std::size_t done = 0;
  const auto check_canceled = [&] {
    if (done++ % 256 == 0) {
      cancellation.throw_if_canceled();
    }
  };
  for (const VisibilityMap::Polygon& polygon : map.polygons) {
    check_canceled();
    const Color8& c = at(patch_colors, polygon.patch);
    painter.setBrush(polygon.front_facing ? back_side : QBrush(QColor(c[0], c[1], c[2])));
    painter.drawPolygon(polygon_of(map, polygon, transform));
  }
  painter.setBrush(theme::difference);
  for (const VisibilityMap::Polygon& polygon : map.pixels.differences) {
    check_canceled();
    painter.drawPolygon(polygon_of(map, polygon, transform));
  }
  // Lines are thinner if the engine's pixels are about as small as a line.
  const double side = transform.scale * map.pixels.side;
  painter.setPen(QPen(QColor(0, 0, 0, 130), std::clamp(0.15 * side, 0.3, 1.5)));
  painter.setRenderHint(QPainter::Antialiasing);
  const std::vector<Vec2>& ends = map.pixels.borders;
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    check_canceled();
    painter.drawLine(transform.to_pixels(ends[k]), transform.to_pixels(ends[k + 1]));
  }
  painter.restore();
}

namespace {

constexpr double full_color_at = 0.25;
/// Fragments with a smaller open fraction get no outline and no label.
constexpr double hidden = 1e-6;

QColor between(const QColor& from, const QColor& to, double fraction) {
  const auto channel = [fraction](int a, int b) {
    return static_cast<int>(std::lround(a + fraction * (b - a)));
  };
  return {channel(from.red(), to.red()), channel(from.green(), to.green()),
          channel(from.blue(), to.blue())};
}

double open_fraction(const CorrectedMap::Fragment& fragment) {
  return std::clamp(fragment.open / fragment.area, 0.0, 1.0);
}

QPolygonF polygon_of(const CorrectedMap& map, const CorrectedMap::Fragment& fragment,
                     const MapTransform& transform) {
  QPolygonF polygon;
  for (const Vec2& p : map.outline(fragment)) {
    polygon.append(transform.to_pixels(p));
  }
  return polygon;
}

QColor color_of(const CorrectedMap::Fragment& fragment, const FragmentColors& colors) {
  if (colors.differences) {
    return color_of_surplus((fragment.open - fragment.exact) / fragment.area);
  }
  const Color8& c = at(colors.of_patches, fragment.patch);
  return between(theme::scene_background, QColor(c[0], c[1], c[2]),
                 0.25 + 0.75 * open_fraction(fragment));
}

}  // namespace

QColor color_of_surplus(double surplus) {
  const double fraction = std::min(std::abs(surplus) / full_color_at, 1.0);
  return between(QColor(0xd8, 0xdc, 0xe0), surplus < 0 ? theme::outside : theme::inside, fraction);
}

void draw_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                    const FragmentColors& colors, const Cancellation& cancellation) {
  painter.save();
  std::vector<QPolygonF> outlines;
  std::size_t done = 0;
  for (const CorrectedMap::Fragment& fragment : map.fragments) {
    if (done++ % 64 == 0) {
      cancellation.throw_if_canceled();
    }
    const QPolygonF polygon = polygon_of(map, fragment, transform);
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(Qt::NoPen);
    painter.setBrush(fragment.front_facing ? colors.back_side : QBrush(color_of(fragment, colors)));
    painter.drawPolygon(polygon);
    const bool open = !fragment.front_facing && fragment.open > hidden * fragment.area;
    if (open && fragment.area * transform.scale * transform.scale > 60) {
      outlines.push_back(polygon);
    }
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 150), 1.2 * theme::scale()));
  for (const QPolygonF& polygon : outlines) {
    if (done++ % 64 == 0) {
      cancellation.throw_if_canceled();
    }
    painter.drawPolygon(polygon);
  }
  painter.restore();
}

void label_corrected(QPainter& painter, const CorrectedMap& map, const MapTransform& transform,
                     double pixel_ratio) {
  PolygonLabels labels(painter, pixel_ratio);
  for (const CorrectedMap::Fragment& fragment : map.fragments) {
    if (fragment.front_facing || fragment.open <= hidden * fragment.area) {
      continue;
    }
    const QString fraction = QString::number(100 * open_fraction(fragment), 'f', 0);
    labels.write(polygon_of(map, fragment, transform),
                 QObject::tr("%1: %2 %").arg(fragment.patch).arg(fraction));
  }
}

}  // namespace transillum::viewer
