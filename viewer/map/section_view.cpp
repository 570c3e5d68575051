// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel Section: draws the section of the direction in focus, in the colors of the map.
#include "map/section_view.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "map/map_painter.h"
#include "map/map_sheet.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/callout_painter.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double bar_height = 12;       // the intervals' height, logical pixels
constexpr double click_distance = 10;   // logical pixels
constexpr double least_for_label = 22;  // length of a segment or an interval, logical pixels

QPointF middle_of(const QPointF& a, const QPointF& b) { return (a + b) / 2; }

double length_of(const QPointF& a, const QPointF& b) {
  return std::hypot(b.x() - a.x(), b.y() - a.y());
}

/// From a point to a line from a to b.
double distance_from(const QPointF& point, const QPointF& a, const QPointF& b) {
  const QPointF along = b - a;
  const double square = std::max(QPointF::dotProduct(along, along), 1e-12);
  const double place = std::clamp(QPointF::dotProduct(point - a, along) / square, 0.0, 1.0);
  return length_of(point, a + place * along);
}

/// From meters in the plane of the section to logical pixels.
struct SectionTransform {
  QPointF origin;
  double scale = 1;

  QPointF operator()(const Vec2& p) const {
    return {origin.x() + scale * p.x, origin.y() - scale * p.y};
  }
  Vec2 inverse(const QPointF& p) const {
    return {(p.x() - origin.x()) / scale, (origin.y() - p.y()) / scale};
  }
};

/// Leaves room for the caption above and the scale bar below.
SectionTransform fit(const Section& section, const QSizeF& size) {
  const auto [left, right, bottom, top] = section.box();
  constexpr double side = 18, above = 30, below = 40;
  const double width = std::max(size.width() - 2 * side, 10.0);
  const double height = std::max(size.height() - above - below, 10.0);
  SectionTransform result;
  result.scale =
      std::min(width / std::max(right - left, 1e-12), height / std::max(top - bottom, 1e-12));
  result.origin = QPointF(side + width / 2 - result.scale * (left + right) / 2,
                          above + height / 2 + result.scale * (bottom + top) / 2);
  return result;
}

/// Draws one picture, in logical pixels.
class SectionPainting {
 public:
  SectionPainting(const Section& section, const RecordedMap& map, const Focus& focus,
                  const std::vector<Color8>& colors, const MapSheet& sheet)
      : section_(section),
        map_(map),
        colors_(colors),
        sheet_(sheet),
        painter_(sheet.painter),
        to_pixels_(fit(section, sheet.size)),
        hatch_(back_side_brush(1)),
        step_(focus.at_step() ? focus.position().step : -1),
        phase_(focus.phase()) {}

  const SectionTransform& transform() const { return to_pixels_; }

  void paint(const std::vector<SectionView::Shown>& shown, const Selection& selection) {
    for (const SectionView::Shown& one : shown) {
      draw_strip(one);
    }
    draw_line(shown);
    draw_segments(selection);
    if (step_ >= 0) {
      mark_step();
    }
    draw_omega();
    sheet_.draw_scale_bar(to_pixels_.scale);
  }

  QPointF omega_tip() const { return omega_foot() + 34 * direction(section_.omega); }

 private:
  QPointF direction(const Vec2& d) const { return {d.x, -d.y}; }
  QPointF omega_foot() const {
    return QPointF(sheet_.size.width() - 30, sheet_.size.height() - 12) -
           QPointF(std::max(0.0, 34 * section_.omega.x), std::max(0.0, -34 * section_.omega.y));
  }
  const MapRecord::Row& row(std::int32_t r) const { return map_.row(r); }
  QColor color_of(PatchId patch) const {
    const Color8& c = at(colors_, patch);
    return {c[0], c[1], c[2]};
  }
  QBrush brush_of(std::int32_t r) const {
    return row(r).front_facing ? hatch_ : QBrush(color_of(row(r).patch));
  }
  std::array<QPointF, 4> bar_of(const Section::Interval& interval) const {
    const QPointF down = -bar_height * theme::scale() * direction(section_.omega);
    const QPointF low = to_pixels_(section_.on_line(interval.low));
    const QPointF high = to_pixels_(section_.on_line(interval.high));
    return {low, high, high + down, low + down};
  }

  // The rays at both ends of an interval, up to what is seen there.
  void draw_strip(const SectionView::Shown& shown) {
    const auto strip = strip_of(section_, map_, shown.interval, shown.receiver);
    if (!strip) {
      return;
    }
    std::array<QPointF, 4> corners;
    std::transform(strip->begin(), strip->end(), corners.begin(), to_pixels_);
    const bool back = row(shown.interval.row).front_facing;
    QColor fill = back ? plain_back_side : color_of(row(shown.interval.row).patch);
    fill.setAlpha(back ? 40 : 70);
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(fill);
    painter_.drawPolygon(corners.data(), 4);
    painter_.setPen(QPen(theme::on_dark_dim, theme::scale(), Qt::DashLine));
    painter_.drawLine(corners[0], corners[1]);
    painter_.drawLine(corners[3], corners[2]);
  }

  void draw_line(const std::vector<SectionView::Shown>& shown) {
    for (const SectionView::Shown& one : shown) {
      if (one.receiver == no_patch) {
        draw_bar(one.interval);
      }
    }
  }

  void draw_bar(const Section::Interval& interval) {
    const auto bar = bar_of(interval);
    painter_.setPen(QPen(Qt::black, theme::scale()));
    painter_.setBrush(brush_of(interval.row));
    painter_.drawPolygon(bar.data(), 4);
    if (length_of(bar[0], bar[1]) > least_for_label) {
      // On the far side of the line: the bar itself is too low for text.
      write(middle_of(bar[2], bar[3]) - 9 * theme::scale() * direction(section_.omega),
            QString::number(row(interval.row).patch));
    }
  }

  void draw_segments(const Selection& selection) {
    for (const Section::Segment& segment : section_.segments) {
      const QPointF a = to_pixels_(segment.a), b = to_pixels_(segment.b);
      const QPointF back = -2.5 * theme::scale() * direction(segment.front);
      if (selection.contains(segment.patch)) {
        draw_line_of(a + back / 2, b + back / 2, theme::selection, 11);
      }
      draw_line_of(a + back, b + back, plain_back_side.lighter(150), 4);
      draw_line_of(a, b, color_of(segment.patch), 4);
      if (selection.contains(segment.patch)) {
        draw_knob(a);
        draw_knob(b);
      }
      if (length_of(a, b) > least_for_label) {
        write(middle_of(a, b) - 4.5 * back, QString::number(segment.patch));
      }
    }
  }

  // To be dragged.
  void draw_knob(const QPointF& end) {
    painter_.setPen(QPen(Qt::black, theme::scale()));
    painter_.setBrush(theme::selection);
    painter_.drawEllipse(end, 4 * theme::scale(), 4 * theme::scale());
  }

  void mark_step() {
    const MapHistory::Step& step = map_.history.step(step_);
    const Section::Interval* interval =
        step.row == MapRecord::no_row ? nullptr : section_.interval_of(step.row);
    if (!interval) {
      return;  // edge-on, or beside the section
    }
    const auto outline_bars = [&](const std::vector<std::int32_t>& rows, const QColor& color) {
      for (const std::int32_t r : rows) {
        if (const Section::Interval* part = section_.interval_of(r)) {
          outline(*part, color);
        }
      }
    };
    if (phase_ != Phase::before) {
      outline_bars(map_.history.outside_at(step_), theme::outside);
    }
    if (phase_ == Phase::split) {
      outline_bars(map_.history.inside_at(step_), theme::inside);
    } else {
      outline(*interval, theme::processed);
    }
    if (const auto strip = strip_of(section_, map_, *interval, no_patch)) {
      draw_line_of(to_pixels_((*strip)[1]), to_pixels_((*strip)[2]), theme::processed, 5);
      painter_.setPen(QPen(theme::processed, theme::scale(), Qt::DashLine));
      painter_.drawLine(to_pixels_((*strip)[0]), to_pixels_((*strip)[1]));
      painter_.drawLine(to_pixels_((*strip)[3]), to_pixels_((*strip)[2]));
    }
  }

  void outline(const Section::Interval& interval, const QColor& color) {
    const auto bar = bar_of(interval);
    painter_.setBrush(Qt::NoBrush);
    painter_.setPen(QPen(color, 3 * theme::scale()));
    painter_.drawPolygon(bar.data(), 4);
  }

  void draw_omega() {
    const QPointF foot = omega_foot(), tip = omega_tip();
    const QPointF along = direction(section_.omega), side(-along.y(), along.x());
    painter_.setPen(QPen(theme::on_dark, 2 * theme::scale()));
    painter_.drawLine(foot, tip);
    painter_.drawLine(tip, tip - 8 * along + 4 * side);
    painter_.drawLine(tip, tip - 8 * along - 4 * side);
    painter_.drawText(middle_of(foot, tip) + QPointF(7, 4), QStringLiteral("ω"));
  }

  void draw_line_of(const QPointF& a, const QPointF& b, const QColor& color, double width) {
    painter_.setPen(QPen(color, width * theme::scale(), Qt::SolidLine, Qt::FlatCap));
    painter_.drawLine(a, b);
  }

  void write(const QPointF& middle, const QString& text) {
    const QRectF box = QRectF(painter_.fontMetrics().boundingRect(text));
    painter_.setPen(theme::on_dark);
    painter_.drawText(middle - box.center(), text);
  }

  const Section& section_;
  const RecordedMap& map_;
  const std::vector<Color8>& colors_;
  const MapSheet& sheet_;
  QPainter& painter_;
  SectionTransform to_pixels_;
  QBrush hatch_;
  std::int32_t step_;
  Phase phase_;
};

}  // namespace

SectionView::SectionView(Focus& focus, Selection& selection, const ColorChoice& colors,
                         QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection), colors_(colors) {
  setObjectName("section_view");
  setToolTip(
      tr("Patches are segments, and V is a list of intervals on the line below them.\n"
         "Click a segment or an interval to select its patch. Drag a segment to move its object, "
         "or an end of it to turn and stretch the object"));
  setMouseTracking(true);
  connect(&focus_, &Focus::moved, this, qOverload<>(&QWidget::update));
  connect(&selection_, &Selection::patches_changed, this, qOverload<>(&QWidget::update));
  connect(&colors_, &ColorChoice::changed, this, qOverload<>(&QWidget::update));
}

void SectionView::show_callouts(const std::vector<Callout>& callouts) {
  callouts_ = callouts;
  update();
}

const Section* SectionView::section() const {
  const auto map = focus_.map();
  if (!map) {
    known_ = {};
    return nullptr;
  }
  if (!known_ || known_->map != map) {
    known_ = {map, section_of(*map)};
  }
  return &known_->section;
}

std::vector<SectionView::Shown> SectionView::shown() const {
  std::vector<Shown> result;
  const Section* section = this->section();
  if (!section) {
    return result;
  }
  const MapHistory& history = focus_.map()->history;
  const auto add = [&](const std::vector<std::int32_t>& rows, PatchId receiver) {
    for (const std::int32_t r : rows) {
      const bool exchanges = receiver == no_patch || history.exchanges(r);
      if (const Section::Interval* interval = section->interval_of(r); interval && exchanges) {
        result.push_back({*interval, receiver});
      }
    }
  };
  const std::int32_t step = focus_.picture_step();
  const Phase phase = focus_.at_step() && step >= 0 ? focus_.phase() : Phase::after;
  std::vector<std::int32_t> rows =
      history.record().map_after(phase == Phase::after ? step : step - 1);
  if (!focus_.at_step()) {
    for (std::int32_t k = 0; k < history.step_count(); ++k) {
      if (history.step(k).front_facing) {
        add(history.inside_at(k), history.step(k).patch);
      }
    }
    return result;
  }
  if (phase == Phase::split) {
    std::erase_if(rows, [&](std::int32_t r) { return history.row(r).consumed == step; });
    const auto outside = history.outside_at(step), inside = history.inside_at(step);
    rows.insert(rows.end(), outside.begin(), outside.end());
    rows.insert(rows.end(), inside.begin(), inside.end());
  }
  add(rows, no_patch);
  return result;
}

void SectionView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  painter.setRenderHint(QPainter::Antialiasing);
  const Section* section = this->section();
  const auto map = focus_.map();
  const std::vector<Color8>& colors = colors_.patch_colors();
  if (!section || std::ssize(colors) != map->loaded->scene->patch_count()) {
    painter.setPen(theme::on_dark_dim);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The section appears after the first direction"));
    return;
  }
  const MapSheet sheet{painter, size()};
  const auto shown = this->shown();
  SectionPainting painting(*section, *map, focus_, colors, sheet);
  painting.paint(shown, selection_);
  const QString count = count_text(std::ssize(shown));
  sheet.draw_caption(focus_.at_step() ? tr("Intervals of V: %1").arg(count)
                                      : tr("Exchanges along ω: %1").arg(count));
  std::vector<QRectF> taken;
  const std::int32_t step = focus_.picture_step();
  for (const Callout& callout : callouts_) {
    std::optional<QPointF> place;
    if (callout.anchor == Callout::Anchor::direction) {
      place = painting.omega_tip();
    } else if (const auto point = place_in_section(callout, *section, *map, step)) {
      place = painting.transform()(*point);
    }
    if (place && rect().contains(place->toPoint())) {
      draw_callout(painter, *place, QString::fromStdString(callout.text),
                   QRectF(rect()).adjusted(2, 2, -2, -2), taken);
    }
  }
}

QPointF SectionView::pixel_of(const Vec2& point) const { return fit(*section(), size())(point); }

/// An end of a segment before its middle; nothing beside all segments.
std::optional<SectionView::Grip> SectionView::grip_at(const QPointF& position) const {
  const Section* section = this->section();
  if (!section) {
    return std::nullopt;
  }
  const SectionTransform to_pixels = fit(*section, size());
  std::optional<Grip> grip;
  double nearest = click_distance;
  const auto consider = [&](double how_far, const Grip& candidate) {
    if (how_far < nearest) {
      nearest = how_far;
      grip = candidate;
    }
  };
  for (const Section::Segment& segment : section->segments) {
    // The sides of a board are too short to be held by their ends.
    if (length_of(to_pixels(segment.a), to_pixels(segment.b)) > 3 * click_distance) {
      consider(length_of(position, to_pixels(segment.a)), {segment.patch, segment.a, segment.b});
      consider(length_of(position, to_pixels(segment.b)), {segment.patch, segment.b, segment.a});
    }
  }
  if (grip) {
    return grip;
  }
  for (const Section::Segment& segment : section->segments) {
    const QPointF a = to_pixels(segment.a), b = to_pixels(segment.b);
    consider(distance_from(position, a, b),
             {segment.patch, to_pixels.inverse(position), std::nullopt});
  }
  return grip;
}

void SectionView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF position = event->localPos();
  if (!drag_) {
    const auto grip = grip_at(position);
    setCursor(!grip ? Qt::ArrowCursor : grip->fixed ? Qt::CrossCursor : Qt::SizeAllCursor);
    return;
  }
  if (!drag_->moves && length_of(position, drag_->pressed) >= QApplication::startDragDistance()) {
    drag_->moves = true;
    emit grabbed(drag_->grip);
  }
  if (drag_->moves && section()) {
    const Vec2 at = fit(*section(), size()).inverse(position);
    emit dragged({at.x + drag_->offset.x, at.y + drag_->offset.y});
  }
}

void SectionView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && drag_) {
    const bool moved = drag_->moves;
    drag_.reset();
    if (moved) {
      emit released();
    }
  }
}

void SectionView::mousePressEvent(QMouseEvent* event) {
  const Section* section = this->section();
  if (!section || event->button() != Qt::LeftButton) {
    return;
  }
  const SectionTransform to_pixels = fit(*section, size());
  const QPointF pressed = event->localPos();
  if (const auto grip = grip_at(pressed)) {
    const Vec2 at = to_pixels.inverse(pressed);
    drag_ = Drag{*grip, pressed, {grip->held.x - at.x, grip->held.y - at.y}};
  }
  const auto distance = [&](const Vec2& a, const Vec2& b) {
    return distance_from(pressed, to_pixels(a), to_pixels(b));
  };
  double nearest = click_distance;
  PatchId patch = no_patch;
  const auto consider = [&](PatchId candidate, double how_far) {
    if (how_far < nearest) {
      nearest = how_far;
      patch = candidate;
    }
  };
  for (const Section::Segment& segment : section->segments) {
    consider(segment.patch, distance(segment.a, segment.b));
  }
  for (const Shown& one : shown()) {
    if (one.receiver == no_patch) {
      consider(focus_.map()->row(one.interval.row).patch,
               distance(section->on_line(one.interval.low), section->on_line(one.interval.high)));
    }
  }
  if (event->modifiers() & Qt::ControlModifier) {
    selection_.toggle(patch);
  } else {
    selection_.select(patch);
  }
}

}  // namespace transillum::viewer
