// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Draws the lanes of iterations, directions and steps, and moves Focus by mouse and keys. Bars show
// the cuts (gray) and exchanges (orange) of the steps in each pixel column.
#include "stepping/timeline_lanes.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "support/number_text.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

// Widths of the text left and right of a lane.
double name_width() { return 78 * theme::scale(); }
/// Beside a thin lane lies the button that leaves the projector mode.
double way_out_width() { return 78 * theme::scale(); }
double lane_height() { return 18 * theme::scale(); }  // height of the upper lanes

}  // namespace

double TimelineLanes::value_width() const {
  constexpr double least = 128, margin = 16;
  double width = least * theme::scale();
  for (const Lane lane : {Lane::iterations, Lane::directions, Lane::steps}) {
    const QString widest = count_text(count_of(lane));
    width = std::max(width,
                     margin + fontMetrics().horizontalAdvance(tr("%1 of %2").arg(widest, widest)));
  }
  return width + (thin_ ? way_out_width() : 0);
}

// While the newest direction is followed, the lanes show the same direction as the map.
const RunPosition& TimelineLanes::position_shown() const {
  return focus_.following() && focus_.map() ? focus_.position() : focus_.target();
}

TimelineLanes::TimelineLanes(Focus& focus, Selection& selection, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection) {
  setFocusPolicy(Qt::StrongFocus);
  setToolTip(tr(
      "Click or drag to go to an iteration, direction or step; with Shift, one pixel is one step.\n"
      "Arrow keys: one step, with Ctrl one direction. Page Up and Page Down: a twentieth of the "
      "steps."));
  connect(&focus_, &Focus::moved, this, [this] {
    if (focus_.map() != counted_) {
      count_columns();
    }
    update();
  });
  connect(&focus_, &Focus::target_changed, this, qOverload<>(&QWidget::update));
  connect(&focus_, &Focus::filtered, this, &TimelineLanes::count_columns);
  connect(&selection_, &Selection::changed, this, &TimelineLanes::count_columns);
}

void TimelineLanes::set_marks(Marks marks) {
  marks_ = std::move(marks);
  count_columns();
}

void TimelineLanes::set_thin(bool thin) {
  thin_ = thin;
  updateGeometry();
  count_columns();
}

QSize TimelineLanes::minimumSizeHint() const {
  constexpr int thin_height = 36, least_height = 59;
  return {300, thin_ ? theme::scaled(thin_height) : least_height};
}

void TimelineLanes::set_progress(int iteration, int directions) {
  done_iteration_ = iteration;
  done_directions_ = directions;
  update();
}

QRectF TimelineLanes::rect_of(Lane lane) const {
  const double width_left = std::max(width() - name_width() - value_width(), 20.0);
  if (thin_) {
    const double top = lane == Lane::steps ? 3 : 0;
    return {name_width(), top, width_left, lane == Lane::steps ? height() - 6.0 : 0.0};
  }
  const double top = lane == Lane::iterations   ? 3
                     : lane == Lane::directions ? 3 + lane_height()
                                                : 7 + 2 * lane_height();
  const double bottom = lane == Lane::steps ? height() - 5 : top + lane_height() - 4;
  return {name_width(), top, width_left, bottom - top};
}

double TimelineLanes::position(const QRectF& lane, int k, int count) {
  return lane.left() + lane.width() * (k + 0.5) / std::max(count, 1);
}

int TimelineLanes::index(const QRectF& lane, double x, int count) {
  const double fraction = (x - lane.left()) / lane.width();
  return std::clamp(static_cast<int>(std::floor(fraction * count)), 0, std::max(count - 1, 0));
}

// The lane of steps begins with the empty map before the first step.
int TimelineLanes::count_of(Lane lane) const {
  switch (lane) {
    case Lane::iterations:
      return focus_.iterations();
    case Lane::directions:
      return focus_.passes_of(position_shown().iteration);
    default:
      return focus_.map() ? focus_.map()->history.step_count() + 1 : 0;
  }
}

int TimelineLanes::index_at(Lane lane) const {
  switch (lane) {
    case Lane::iterations:
      return position_shown().iteration;
    case Lane::directions:
      return position_shown().direction;
    default:
      return focus_.position().step + 1;
  }
}

void TimelineLanes::count_columns() {
  counted_ = focus_.map();
  columns_.clear();
  update();
  if (!counted_) {
    return;
  }
  const QRectF lane = rect_of(Lane::steps);
  columns_.resize(static_cast<std::size_t>(std::ceil(lane.width())));
  const MapHistory& history = counted_->history;
  const auto column = [&](std::int32_t step) -> Column& {
    const double x = position(lane, step + 1, history.step_count() + 1) - lane.left();
    return columns_[std::min(static_cast<std::size_t>(x), columns_.size() - 1)];
  };
  const EventFilter& filter = focus_.filter();
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    if (filter.on() && !filter.passes_at(history, k)) {
      continue;
    }
    column(k).cuts += history.step(k).cut;
    column(k).exchanges += history.step(k).exchanges;
  }
  for (const std::int32_t k : history.steps_of(selection_.patch())) {
    column(k).selected = true;
  }
  if (marks_) {
    for (const std::int32_t k : marks_(history)) {
      column(k).marked = true;
    }
  }
}

void TimelineLanes::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const bool any = focus_.passes() > 0;
  const auto value = [&](Lane lane, int at) {
    return any ? tr("%1 of %2").arg(count_text(at), count_text(count_of(lane))) : QString();
  };
  if (!thin_) {
    draw_lane(painter, Lane::iterations, tr("Iteration"), index_at(Lane::iterations),
              count_of(Lane::iterations), value(Lane::iterations, index_at(Lane::iterations) + 1));
    draw_lane(painter, Lane::directions, tr("Direction"), index_at(Lane::directions),
              count_of(Lane::directions), value(Lane::directions, index_at(Lane::directions) + 1));
  }
  const int steps = std::max(count_of(Lane::steps) - 1, 0);
  draw_lane(painter, Lane::steps, tr("Step"), index_at(Lane::steps), count_of(Lane::steps),
            focus_.map() ? tr("%1 of %2").arg(count_text(index_at(Lane::steps)), count_text(steps))
                         : QString());
}

void TimelineLanes::draw_lane(QPainter& painter, Lane lane, const QString& name, int at, int count,
                              const QString& value) const {
  const QRectF rect = rect_of(lane);
  painter.setPen(theme::ink_dim);
  const QRectF name_rect(10, rect.top() - 4, name_width() - 18, std::min(rect.height() + 8, 26.0));
  painter.drawText(name_rect, Qt::AlignVCenter | Qt::AlignLeft, name);
  painter.setPen(theme::ink);
  const QRectF value_rect(rect.right() + 10, name_rect.top(), value_width() - 14,
                          name_rect.height());
  painter.drawText(value_rect, Qt::AlignVCenter | Qt::AlignLeft, value);

  painter.setPen(Qt::NoPen);
  painter.setBrush(theme::hover);
  painter.drawRoundedRect(rect, 2, 2);
  if (count == 0 || focus_.passes() == 0) {
    return;
  }
  QRectF done = rect;
  const bool newest = focus_.target().iteration >= done_iteration_;
  if (lane == Lane::directions && newest) {
    done.setWidth(rect.width() * done_directions_ / std::max(count, 1));
  }
  if (lane != Lane::steps) {
    painter.setBrush(theme::finished);
    painter.drawRoundedRect(done, 2, 2);
  } else {
    draw_columns(painter);
  }
  // Separators, if the cells are wide enough.
  if (count > 1 && rect.width() / count > 5) {
    painter.setPen(QPen(theme::window, 1));
    for (int k = 1; k < count; ++k) {
      const double x = rect.left() + rect.width() * k / count;
      painter.drawLine(QPointF(x, rect.top()), QPointF(x, rect.bottom()));
    }
  }
  const double x = position(rect, at, count);
  const double half = std::clamp(rect.width() / count / 2, 1.5, 5.0);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme::accent);
  painter.drawRoundedRect(QRectF(x - half, rect.top() - 2, 2 * half, rect.height() + 4), 1.5, 1.5);
}

void TimelineLanes::draw_columns(QPainter& painter) const {
  const QRectF lane = rect_of(Lane::steps);
  int most = 1;
  for (const Column& column : columns_) {
    most = std::max(most, column.cuts);
  }
  painter.setRenderHint(QPainter::Antialiasing, false);
  const double room = lane.height() - 9;  // breakpoints are above, the selected patch's ticks below
  const double base = lane.bottom() - 4;
  const auto height = [&](int count) {
    return room * std::sqrt(count / static_cast<double>(most));
  };
  const double cell = lane.width() / std::max(count_of(Lane::steps), 1);
  const double width = std::max(std::floor(cell) - 1, 1.0);
  const auto draw_bar = [&](double x, int count, const QColor& color) {
    painter.fillRect(QRectF(std::round(x - width / 2), base - height(count), width, height(count)),
                     color);
  };
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const double x = lane.left() + static_cast<double>(k);
    draw_bar(x, columns_[k].cuts, {0x9a, 0xa5, 0xb4});
    draw_bar(x, columns_[k].exchanges, theme::inside);
  }
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const double x = lane.left() + static_cast<double>(k);
    if (columns_[k].selected) {
      painter.fillRect(QRectF(x, base, 2, 4), theme::selection);
    }
    if (columns_[k].marked) {
      painter.fillRect(QRectF(x - 1, lane.top(), 3, 4), QColor(0xc6, 0x28, 0x28));
    }
  }
  painter.setRenderHint(QPainter::Antialiasing);
}

void TimelineLanes::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  count_columns();
}

void TimelineLanes::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || focus_.passes() == 0) {
    return;
  }
  const double y = event->localPos().y();
  scrubbed_ = Lane::steps;
  for (const Lane lane : {Lane::directions, Lane::iterations}) {
    if (!thin_ && y < rect_of(lane).bottom() + 2) {
      scrubbed_ = lane;
    }
  }
  scrubbing_ = true;
  press_x_ = event->localPos().x();
  if (!(event->modifiers() & Qt::ShiftModifier)) {
    scrub(press_x_);
  }
  press_index_ = index_at(scrubbed_);
}

void TimelineLanes::mouseMoveEvent(QMouseEvent* event) {
  if (!scrubbing_) {
    return;
  }
  const double x = event->localPos().x();
  if (!(event->modifiers() & Qt::ShiftModifier)) {
    scrub(x);
    return;
  }
  const QRectF rect = rect_of(scrubbed_);
  scrub(position(rect, press_index_ + static_cast<int>(x - press_x_), count_of(scrubbed_)));
}

void TimelineLanes::mouseReleaseEvent(QMouseEvent*) { scrubbing_ = false; }

void TimelineLanes::scrub(double x) {
  const int k = index(rect_of(scrubbed_), x, count_of(scrubbed_));
  const RunPosition shown = position_shown();
  switch (scrubbed_) {
    case Lane::iterations:
      return focus_.go_to_direction(k, shown.direction);
    case Lane::directions:
      return focus_.go_to_direction(shown.iteration, k);
    case Lane::steps:
      return focus_.go_to({shown.iteration, shown.direction, k - 1});
  }
}

void TimelineLanes::keyPressEvent(QKeyEvent* event) {
  const bool by_direction = event->modifiers() & Qt::ControlModifier;
  const auto move = [&](int by) {
    by_direction ? focus_.direction_by(by) : static_cast<void>(focus_.step_by(by));
  };
  const int page = std::max(count_of(Lane::steps) / 20, 1);
  switch (event->key()) {
    case Qt::Key_Right:
      return move(1);
    case Qt::Key_Left:
      return move(-1);
    case Qt::Key_PageDown:
      focus_.step_by(page);
      return;
    case Qt::Key_PageUp:
      focus_.step_by(-page);
      return;
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace transillum::viewer
