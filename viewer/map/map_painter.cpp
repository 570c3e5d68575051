// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Paints V of a recorded map (MapPictureRequest) into an image: exactly, with the changes of one
// step, or as another engine computes it. Runs on any thread.
#include "map/map_painter.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "map/engine_drawing.h"
#include "map/polygon_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

const QColor back_hatch{0x6b, 0x74, 0x80};

bool is_outside(const QPolygonF& polygon, const QRectF& view) {
  return !polygon.boundingRect().intersects(view);
}

QColor mixed(const QColor& a, const QColor& b, double fraction_of_b) {
  const auto channel = [&](int x, int y) {
    return static_cast<int>(std::lround(x + fraction_of_b * (y - x)));
  };
  return {channel(a.red(), b.red()), channel(a.green(), b.green()), channel(a.blue(), b.blue())};
}

double area(const QPolygonF& polygon) {
  double twice = 0;
  for (int k = 0; k < polygon.size(); ++k) {
    const QPointF& a = polygon[k];
    const QPointF& b = polygon[(k + 1) % polygon.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return std::abs(twice) / 2;
}

}  // namespace

// Diagonal lines in a tile: a pattern brush would be too coarse on a screen with two device pixels
// per logical pixel.
QBrush back_side_brush(double pixel_ratio) {
  const int size = static_cast<int>(std::lround(6 * pixel_ratio));
  QImage tile(size, size, QImage::Format_RGB32);
  tile.fill(plain_back_side);
  QPainter painter(&tile);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(back_hatch, pixel_ratio));
  for (const int shift : {-size, 0, size}) {
    painter.drawLine(QPointF(shift - 1, size + 1), QPointF(shift + size + 1, -1));
  }
  painter.end();
  return QBrush(tile);
}

double scale_bar_room(double height) { return height > 160 ? 34 : 0; }

MapTransform fit_map(const RecordedMap& map, const QSizeF& size) {
  double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL;
  for (const Vec3& p : map.loaded->scene->points()) {
    const Vec2 q = map.record().frame.project(p);
    left = std::min(left, q.x);
    right = std::max(right, q.x);
    bottom = std::min(bottom, q.y);
    top = std::max(top, q.y);
  }
  // Logical pixels. In a low picture the map is beside the scale bar, not above it.
  const double margin = std::min(14.0, 0.06 * size.height());
  const double width = std::max(size.width() - 2 * margin, 10.0);
  const double height = std::max(size.height() - 2 * margin - scale_bar_room(size.height()), 10.0);
  MapTransform transform;
  transform.center = {(left + right) / 2, (bottom + top) / 2};
  transform.middle = {margin + width / 2, margin + height / 2};
  transform.scale =
      std::min(width / std::max(right - left, 1e-12), height / std::max(top - bottom, 1e-12));
  return transform;
}

QPolygonF row_polygon(const MapRecord& record, const MapRecord::Row& row,
                      const MapTransform& transform) {
  QPolygonF polygon;
  const auto outline = record.outline(row);
  polygon.reserve(static_cast<int>(outline.size()));
  for (const Vec2& p : outline) {
    polygon.append(transform.to_pixels(p));
  }
  return polygon;
}

QRectF step_bounds(const RecordedMap& map, std::int32_t step) {
  if (step < 0 || map.history.step(step).row == MapRecord::no_row) {
    return {};
  }
  QPolygonF all;
  std::vector<std::int32_t> rows = map.history.cut_at(step);
  rows.push_back(map.history.step(step).row);
  for (const std::int32_t r : rows) {
    for (const Vec2& p : map.record().outline(map.row(r))) {
      all.append({p.x, p.y});
    }
  }
  return all.boundingRect();
}

namespace {

/// Draws one picture; coordinates are device pixels.
class MapPainting {
 public:
  /// @param hatch  fill of back sides
  MapPainting(const MapPictureRequest& request, const QBrush& hatch,
              const Cancellation& cancellation)
      : request_(request),
        cancellation_(cancellation),
        history_(request.map->history),
        ratio_(request.pixel_ratio),
        transform_(request.transform),
        hatch_(hatch) {
    transform_.scale *= ratio_;
    transform_.middle *= ratio_;
    // Other engines show V alone, not the changes of a step.
    const bool marked = request.step_shown && !request.choice.engine;
    if (marked && request.step >= 0 && !is_whole()) {
      step_row_ = history_.step(request.step).row;
    }
  }

  MapPicture paint() {
    const QSize size(static_cast<int>(std::lround(request_.size.width() * ratio_)),
                     static_cast<int>(std::lround(request_.size.height() * ratio_)));
    picture_.image = QImage(size, QImage::Format_RGB32);
    picture_.image.fill(theme::scene_background);
    QPainter painter(&picture_.image);
    paint(painter);
    painter.end();
    picture_.image.setDevicePixelRatio(ratio_);
    return std::move(picture_);
  }

  void paint(QPainter& painter) {
    painter_ = &painter;
    picture_.request = request_;
    view_ = QRectF(QPointF(0, 0), request_.size * ratio_);
    picture_.rows = is_whole() ? whole_rows() : drawn_rows();
    if (request_.choice.engine) {
      picture_.pixels = pixels();
      draw(*picture_.pixels);
    } else if (is_whole()) {
      fill_one_over_another();
    } else {
      fill(picture_.rows);
    }
    if (step_row_ != MapRecord::no_row) {
      mark_step();
    }
    if (request_.labels && !draws_corrected()) {
      label(picture_.rows);
    }
  }

 private:
  std::shared_ptr<const PixelView> pixels() const {
    const std::shared_ptr<const PixelView>& known = request_.known_pixels;
    if (known && known->shows(*request_.map, request_.step, request_.choice)) {
      return known;
    }
    return make_pixel_view(request_.map, request_.step, request_.choice, cancellation_);
  }

  bool draws_corrected() const { return request_.choice.shows(EngineTraits::Picture::corrected); }

  void draw(const PixelView& view) {
    if (!view.failure.empty()) {
      return;
    }
    if (!draws_corrected()) {
      draw_pixels(*painter_, view, transform_, *request_.patch_colors, hatch_, cancellation_);
      return;
    }
    draw_corrected(*painter_, *view.corrected, transform_,
                   {.of_patches = *request_.patch_colors,
                    .back_side = hatch_,
                    .differences = request_.choice.differences},
                   cancellation_);
    if (request_.labels) {
      label_corrected(*painter_, *view.corrected, transform_, ratio_);
    }
  }

  std::vector<std::int32_t> rows_seen_by(PatchId receiver) const {
    std::vector<std::int32_t> rows;
    for (const std::int32_t k : history_.steps_of(receiver)) {
      if (history_.step(k).patch == receiver && history_.step(k).front_facing) {
        const auto inside = history_.inside_at(k);
        rows.insert(rows.end(), inside.begin(), inside.end());
      }
    }
    return rows;
  }

  bool is_whole() const {
    return request_.extent != MapExtent::step && request_.receiver == no_patch &&
           !request_.choice.engine;
  }

  // The BSP order is the order from the top: seen along omega, later fragments cover earlier ones.
  std::vector<std::int32_t> whole_rows() const {
    const bool receivers = request_.extent == MapExtent::receivers;
    std::vector<std::int32_t> rows;
    for (std::int32_t k = 0; k < history_.step_count(); ++k) {
      const MapHistory::Step& step = history_.step(k);
      if (step.row != MapRecord::no_row && step.front_facing == receivers) {
        rows.push_back(step.row);
      }
    }
    if (!receivers) {
      std::reverse(rows.begin(), rows.end());
    }
    return rows;
  }

  // Each polygon with its edges, the farthest first.
  void fill_one_over_another() {
    std::size_t done = 0;
    for (auto r = picture_.rows.rbegin(); r != picture_.rows.rend(); ++r) {
      if (done++ % 64 == 0) {
        cancellation_.throw_if_canceled();
      }
      const QPolygonF polygon = polygon_of(*r);
      if (is_outside(polygon, view_)) {
        continue;
      }
      const Color8& c = at(*request_.patch_colors, row(*r).patch);
      painter_->setRenderHint(QPainter::Antialiasing, false);
      painter_->setPen(Qt::NoPen);
      painter_->setBrush(QColor(c[0], c[1], c[2]));
      painter_->drawPolygon(polygon);
      if (area(polygon) > 30 * ratio_ * ratio_) {
        painter_->setRenderHint(QPainter::Antialiasing);
        outline({polygon}, QColor(0, 0, 0, 80), 0.6);
      }
    }
  }

  std::vector<std::int32_t> drawn_rows() const {
    const MapRecord& record = history_.record();
    if (request_.receiver != no_patch) {
      return rows_seen_by(request_.receiver);
    }
    if (step_row_ == MapRecord::no_row || request_.phase == Phase::after) {
      return record.map_after(request_.step);
    }
    std::vector<std::int32_t> rows = record.map_after(request_.step - 1);
    if (request_.phase == Phase::before) {
      return rows;
    }
    std::erase_if(rows, [&](std::int32_t r) { return row(r).consumed == request_.step; });
    for (const auto& parts :
         {history_.inside_at(request_.step), history_.outside_at(request_.step)}) {
      rows.insert(rows.end(), parts.begin(), parts.end());
    }
    return rows;
  }

  // Polygons are filled without antialiasing, so that shared edges have no seams. Thin antialiased
  // lines over the edges of polygons that are not tiny then smooth them.
  void fill(const std::vector<std::int32_t>& rows) {
    std::vector<QPolygonF> outlines;
    const bool dim = step_row_ != MapRecord::no_row && request_.phase == Phase::split;
    painter_->setPen(Qt::NoPen);
    std::size_t done = 0;
    for (const std::int32_t r : rows) {
      if (done++ % 64 == 0) {
        cancellation_.throw_if_canceled();
      }
      const QPolygonF polygon = polygon_of(r);
      if (is_outside(polygon, view_)) {
        continue;
      }
      const Color8& c = at(*request_.patch_colors, row(r).patch);
      QColor color(c[0], c[1], c[2]);
      if (dim && row(r).made < request_.step) {
        color = mixed(color, theme::scene_background, 0.45);
      }
      painter_->setBrush(row(r).front_facing ? hatch_ : QBrush(color));
      painter_->drawPolygon(polygon);
      if (area(polygon) > 30 * ratio_ * ratio_) {
        outlines.push_back(polygon);
      }
    }
    painter_->setRenderHint(QPainter::Antialiasing);
    outline(outlines, QColor(0, 0, 0, 80), 0.6);
  }

  void mark_step() {
    const std::int32_t step = request_.step;
    const std::vector<QPolygonF> inside = polygons_of(history_.inside_at(step));
    const std::vector<QPolygonF> outside = polygons_of(history_.outside_at(step));
    const QPolygonF polygon = polygon_of(step_row_);
    switch (request_.phase) {
      case Phase::before:
        mark_edges(polygons_of(history_.cut_at(step)));
        veil({polygon}, theme::processed, 70);
        break;
      case Phase::split:
        veil(outside, theme::outside, 215);
        for (const std::int32_t r : history_.inside_at(step)) {
          veil({polygon_of(r)}, theme::inside, history_.exchanges(r) ? 255 : 120);
        }
        // The cutting edges, where the parts meet.
        mark_edges(outside);
        mark_edges(inside);
        break;
      case Phase::after:
        outline(outside, theme::outside, 1.4);
        break;
    }
    outline({polygon}, Qt::black, 4);
    outline({polygon}, theme::processed, 2);
    ring_if_small(polygon);
  }

  // Bright lines with a dark border, for polygons of any color.
  void mark_edges(const std::vector<QPolygonF>& polygons) {
    outline(polygons, QColor(0, 0, 0, 150), 2.6);
    outline(polygons, theme::on_dark, 1.2);
  }

  void ring_if_small(const QPolygonF& polygon) {
    const QRectF box = polygon.boundingRect();
    constexpr double radius = 16;
    if (std::max(box.width(), box.height()) > 1.2 * radius * ratio_) {
      return;
    }
    painter_->setBrush(Qt::NoBrush);
    for (const QPen& pen : {QPen(Qt::black, 3.5 * ratio_), QPen(theme::processed, 1.5 * ratio_)}) {
      painter_->setPen(pen);
      painter_->drawEllipse(box.center(), radius * ratio_, radius * ratio_);
    }
  }

  void label(const std::vector<std::int32_t>& rows) {
    PolygonLabels labels(*painter_, ratio_);
    for (const std::int32_t r : rows) {
      const QPolygonF polygon = polygon_of(r);
      if (!is_outside(polygon, view_)) {
        labels.write(polygon, QString::number(row(r).patch));
      }
    }
  }

  void veil(const std::vector<QPolygonF>& polygons, QColor color, int alpha) {
    color.setAlpha(alpha);
    painter_->setPen(Qt::NoPen);
    painter_->setBrush(color);
    painter_->setRenderHint(QPainter::Antialiasing, false);
    for (const QPolygonF& polygon : polygons) {
      painter_->drawPolygon(polygon);
    }
    painter_->setRenderHint(QPainter::Antialiasing);
  }

  void outline(const std::vector<QPolygonF>& polygons, const QColor& color, double width) {
    painter_->setBrush(Qt::NoBrush);
    painter_->setPen(
        QPen(color, width * ratio_ * theme::scale(), Qt::SolidLine, Qt::SquareCap, Qt::RoundJoin));
    for (const QPolygonF& polygon : polygons) {
      painter_->drawPolygon(polygon);
    }
  }

  const MapRecord::Row& row(std::int32_t r) const { return history_.row(r); }
  QPolygonF polygon_of(std::int32_t r) const {
    const QPolygonF polygon = row_polygon(history_.record(), row(r), transform_);
    // Not all programs that show vector graphics clip.
    const bool whole = view_.contains(polygon.boundingRect()) || !picture_.image.isNull();
    return whole ? polygon : polygon.intersected(view_);
  }
  std::vector<QPolygonF> polygons_of(const std::vector<std::int32_t>& rows) const {
    std::vector<QPolygonF> polygons;
    for (const std::int32_t r : rows) {
      polygons.push_back(polygon_of(r));
    }
    return polygons;
  }

  const MapPictureRequest& request_;
  const Cancellation& cancellation_;
  const MapHistory& history_;
  double ratio_;
  MapTransform transform_;
  QBrush hatch_;
  std::int32_t step_row_ = MapRecord::no_row;  ///< the step's fragment, if it is to be marked
  QRectF view_;
  MapPicture picture_;
  QPainter* painter_ = nullptr;
};

}  // namespace

MapPicture paint_map(const MapPictureRequest& request, const Cancellation& cancellation) {
  return MapPainting(request, back_side_brush(request.pixel_ratio), cancellation).paint();
}

void paint_map(const MapPictureRequest& request, QPainter& painter) {
  painter.save();
  MapPainting(request, plain_back_side, {}).paint(painter);
  painter.restore();
}

std::int32_t row_at(const MapRecord& record, const std::vector<std::int32_t>& rows, const Vec2& p) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](std::int32_t row) {
    return record.covers(at(record.rows, row), p);
  });
  return found == rows.end() ? MapRecord::no_row : *found;
}

}  // namespace transillum::viewer
