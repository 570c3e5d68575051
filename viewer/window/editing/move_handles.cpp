// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A drag is computed from its start: the point of the handle's line or plane under the pointer then
// and now gives the move, the angle or the factor.
#include "window/editing/move_handles.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "scene/scene_page.h"
#include "transillum/at.h"
#include "window/editing/move_panel.h"

namespace transillum::viewer {

namespace {

constexpr double arrow_pixels = 90, reach_pixels = 8;
constexpr double turn_step = 15, scale_step = 0.1;
/// Places along an arrow of length 1.
constexpr double knob_place = 1.22, square_begin = 0.28, square_end = 0.5, arc_radius = 0.78;
constexpr int arc_points = 16;

/// Colors of x, y and z, which differ in brightness too.
QColor color_of(int axis) {
  constexpr std::array<QRgb, 3> colors{0xffff6b5e, 0xff7fd858, 0xff6fb1ff};
  return QColor::fromRgb(at(colors, axis));
}

double rounded_to(double value, double step) { return step * std::nearbyint(value / step); }

double distance(const QPointF& p, const QPointF& a, const QPointF& b) {
  const QPointF ab = b - a, ap = p - a;
  const double length = QPointF::dotProduct(ab, ab);
  const double t = length > 0 ? std::clamp(QPointF::dotProduct(ap, ab) / length, 0.0, 1.0) : 0.0;
  const QPointF d = ap - t * ab;
  return std::sqrt(QPointF::dotProduct(d, d));
}

/// Distance in pixels; 0 inside a square.
double distance(const QPointF& p, const MoveHandles::Handle& handle) {
  if (handle.kind == MoveHandles::Kind::slide && handle.shape.containsPoint(p, Qt::OddEvenFill)) {
    return 0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k + 1 < handle.shape.size(); ++k) {
    least = std::min(least, distance(p, handle.shape[k], handle.shape[k + 1]));
  }
  return least;
}

}  // namespace

MoveHandles::MoveHandles(SceneEdits& edits, const MovePanel& panel)
    : QWidget(edits.frame().page.scene_view()->canvas()),
      edits_(edits),
      panel_(panel),
      view_(*edits.frame().page.scene_view()) {
  setObjectName("move_handles");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
  view_.canvas()->installEventFilter(this);
  view_.canvas()->setMouseTracking(true);
  // Callouts lie above.
  lower();
  connect(&edits_, &SceneEdits::changed, this, &MoveHandles::follow);
  connect(&view_, &SceneView::about_to_draw, this, qOverload<>(&QWidget::update));
  follow();
}

void MoveHandles::follow() {
  setGeometry(parentWidget()->rect());
  setVisible(edits_.active() && edits_.has_target());
  update();
}

double MoveHandles::world_size() const {
  const ViewPoint view = view_.view_point();
  const Vec3 forward = normalized(view.target - view.eye);
  const double depth = std::max(dot(edits_.center() - view.eye, forward), 1e-9);
  const double height = 2 * depth * std::tan(0.5 * view.view_angle * std::numbers::pi / 180);
  return arrow_pixels * height / std::max(view_.canvas()->height(), 1);
}

Vec3 MoveHandles::axis_of(const Handle& handle, const Vec3& turn) {
  const Vec3 axis = unit_of_axis(handle.axis);
  return handle.kind == Kind::scale ? turned(axis, turn) : axis;
}

std::vector<MoveHandles::Handle> MoveHandles::handles() const {
  std::vector<Handle> found;
  if (!edits_.has_target()) {
    return found;
  }
  const Vec3 center = edits_.center();
  const double size = world_size();
  const auto add = [&](Kind kind, int axis, const std::vector<Vec3>& points) {
    Handle handle{kind, axis, {}};
    for (const Vec3& p : points) {
      handle.shape.append(view_.pixel_of(center + size * p));
    }
    found.push_back(std::move(handle));
  };
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 a = unit_of_axis((axis + 1) % 3), b = unit_of_axis((axis + 2) % 3);
    add(Kind::slide, axis,
        {square_begin * (a + b), square_end * a + square_begin * b, square_end * (a + b),
         square_begin * a + square_end * b, square_begin * (a + b)});
    std::vector<Vec3> arc;
    for (int k = 0; k <= arc_points; ++k) {
      const double angle = 0.5 * std::numbers::pi * (0.12 + 0.76 * k / arc_points);
      arc.push_back(arc_radius * (std::cos(angle) * a + std::sin(angle) * b));
    }
    add(Kind::turn, axis, arc);
  }
  for (int axis = 0; axis < 3; ++axis) {
    add(Kind::move, axis, {0.12 * unit_of_axis(axis), unit_of_axis(axis)});
    const Vec3 knob = axis_of({Kind::scale, axis, {}}, edits_.placement().turn);
    add(Kind::scale, axis, {(knob_place - 0.04) * knob, (knob_place + 0.04) * knob});
  }
  return found;
}

std::optional<MoveHandles::Handle> MoveHandles::handle_at(const QPointF& position) const {
  std::optional<Handle> nearest;
  double least = reach_pixels;
  for (const Handle& handle : handles()) {
    const double pixels = distance(position, handle);
    if (pixels < least) {
      least = pixels;
      nearest = handle;
    }
  }
  return nearest;
}

std::optional<Vec3> MoveHandles::grip_at(const Drag& drag, const QPointF& position) const {
  const auto [eye, sight] = view_.ray_at(position);
  const Vec3 axis = axis_of(drag.handle, drag.placement.turn);
  const Vec3 from = drag.center - eye;
  constexpr double parallel = 1e-3;
  const double along = dot(axis, sight);
  if (drag.handle.kind == Kind::move || drag.handle.kind == Kind::scale) {
    // The point of the axis that is nearest to the line of sight.
    const double across = 1 - along * along;
    if (across < parallel * parallel) {
      return std::nullopt;
    }
    return drag.center + (along * dot(from, sight) - dot(from, axis)) / across * axis;
  }
  if (std::abs(along) < parallel) {
    return std::nullopt;
  }
  const double reach = dot(from, axis) / along;
  return reach > 0 ? std::optional(eye + reach * sight) : std::nullopt;
}

bool MoveHandles::press(const QPointF& position) {
  const auto handle = handle_at(position);
  if (!handle) {
    return false;
  }
  drag_ = Drag{*handle, edits_.placement(), edits_.center(), world_size()};
  drag_->grip = grip_at(*drag_, position);
  if (!drag_->grip) {
    drag_.reset();
  }
  update();
  return drag_.has_value();
}

void MoveHandles::move_to(const QPointF& position, bool other_grid) {
  const auto grip = grip_at(*drag_, position);
  if (!grip) {
    return;
  }
  const bool snaps = panel_.on_grid() != other_grid;
  const int axis = drag_->handle.axis;
  FacePlacement placement = drag_->placement;
  const Vec3 axis_direction = axis_of(drag_->handle, drag_->placement.turn);
  const Vec3 arm = *drag_->grip - drag_->center, arm_now = *grip - drag_->center;
  switch (drag_->handle.kind) {
    case Kind::move:
    case Kind::slide: {
      Vec3 by = *grip - *drag_->grip;
      for (int k = 0; k < 3; ++k) {
        if ((k == axis) != (drag_->handle.kind == Kind::move)) {
          coordinate(by, k) = 0;
        } else if (snaps) {
          coordinate(by, k) = rounded_to(coordinate(by, k), panel_.step());
        }
      }
      placement.move = placement.move + by;
      break;
    }
    case Kind::turn: {
      double angle = std::atan2(dot(cross(arm, arm_now), axis_direction), dot(arm, arm_now)) * 180 /
                     std::numbers::pi;
      if (snaps) {
        angle = rounded_to(angle, turn_step);
      }
      placement.turn = turned_further(placement.turn, axis, angle);
      break;
    }
    case Kind::scale: {
      double factor = dot(arm_now, axis_direction) / dot(arm, axis_direction);
      if (snaps) {
        factor = rounded_to(factor, scale_step);
      }
      constexpr double least = 0.01;
      coordinate(placement.scale, axis) *= std::max(factor, least);
      break;
    }
  }
  edits_.place(placement);
}

void MoveHandles::step_by(int axis, double steps) {
  FacePlacement placement = edits_.placement();
  coordinate(placement.move, axis) += steps * panel_.step();
  edits_.place(placement);
}

bool MoveHandles::is_own_key(int key) {
  switch (key) {
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown:
    case Qt::Key_Plus:
    case Qt::Key_Minus:
      return true;
    default:
      return false;
  }
}

bool MoveHandles::take_key(int key, Qt::KeyboardModifiers modifiers) {
  if (key == Qt::Key_Escape && drag_) {
    drag_.reset();
    edits_.cancel();
    return true;
  }
  if (!is_own_key(key)) {
    return false;
  }
  const ViewPoint view = view_.view_point();
  const int up = edits_.vertical_axis();
  const Vec3 forward = view.target - view.eye;
  const Vec3 right = cross(forward, view.up);
  int across = (up + 1) % 3, away = (up + 2) % 3;
  if (std::abs(coordinate(right, away)) > std::abs(coordinate(right, across))) {
    std::swap(across, away);
  }
  const auto sign = [](double v) { return v < 0 ? -1.0 : 1.0; };
  FacePlacement placement = edits_.placement();
  const bool is_positive =
      key == Qt::Key_Right || key == Qt::Key_Up || key == Qt::Key_PageUp || key == Qt::Key_Plus;
  const double direction = is_positive ? 1 : -1;
  const bool is_level = key == Qt::Key_Left || key == Qt::Key_Right;
  if (key == Qt::Key_Plus || key == Qt::Key_Minus) {
    placement.scale = (is_positive ? 1 + scale_step : 1 / (1 + scale_step)) * placement.scale;
    edits_.place(placement);
  } else if ((modifiers & Qt::ShiftModifier) != 0) {
    const int axis = is_level ? up : key == Qt::Key_Up || key == Qt::Key_Down ? across : away;
    placement.turn = turned_further(placement.turn, axis, direction * turn_step);
    edits_.place(placement);
  } else if (key == Qt::Key_PageUp || key == Qt::Key_PageDown) {
    step_by(up, direction);
  } else if (is_level) {
    step_by(across, direction * sign(coordinate(right, across)));
  } else {
    step_by(away, direction * sign(coordinate(forward, away)));
  }
  return true;
}

bool MoveHandles::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) {
    follow();
  }
  if (isHidden()) {
    return QWidget::eventFilter(watched, event);
  }
  switch (event->type()) {
    case QEvent::MouseButtonPress: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      return mouse->button() == Qt::LeftButton && press(mouse->localPos());
    }
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      if (drag_) {
        move_to(mouse->localPos(), (mouse->modifiers() & Qt::ControlModifier) != 0);
        return true;
      }
      const auto now =
          mouse->buttons() == Qt::NoButton ? handle_at(mouse->localPos()) : std::optional<Handle>();
      if (now.has_value() != hovered_.has_value() || (now && !now->is_like(*hovered_))) {
        hovered_ = now;
        update();
        if (now) {  // the plate of the patch below goes
          QEvent leave(QEvent::Leave);
          QCoreApplication::sendEvent(view_.canvas(), &leave);
        }
      }
      return now.has_value();
    }
    case QEvent::MouseButtonRelease:
      if (drag_) {
        drag_.reset();
        edits_.finish();
        update();
        return true;
      }
      return false;
    case QEvent::ShortcutOverride: {
      const int key = static_cast<QKeyEvent*>(event)->key();
      if (is_own_key(key) || (key == Qt::Key_Escape && drag_)) {
        event->accept();
        return true;
      }
      return false;
    }
    case QEvent::KeyPress: {
      const auto* key = static_cast<QKeyEvent*>(event);
      return take_key(key->key(), key->modifiers());
    }
    default:
      return QWidget::eventFilter(watched, event);
  }
}

void MoveHandles::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double scale = theme::scale();
  const auto line = [&](const QPolygonF& shape, const QColor& color, double width) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 150), (width + 2.4) * scale, Qt::SolidLine, Qt::RoundCap,
                        Qt::RoundJoin));
    painter.drawPolyline(shape);
    painter.setPen(QPen(color, width * scale, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(shape);
  };
  for (const Handle& handle : handles()) {
    const bool held = drag_ ? drag_->handle.is_like(handle) : hovered_ && hovered_->is_like(handle);
    if (drag_ && !held) {
      continue;  // the target shows better alone
    }
    const QColor color = held ? theme::processed : color_of(handle.axis);
    const double width = held ? 3 : 2;
    const QPointF end = handle.shape.back();
    if (handle.kind == Kind::slide) {
      QColor fill = color;
      fill.setAlpha(held ? 190 : 110);
      painter.setPen(QPen(QColor(0, 0, 0, 150), scale));
      painter.setBrush(fill);
      painter.drawPolygon(handle.shape);
    } else if (handle.kind == Kind::scale) {
      const double half = (held ? 6 : 5) * scale;
      painter.setPen(QPen(QColor(0, 0, 0, 170), 1.2 * scale));
      painter.setBrush(color);
      painter.drawRect(QRectF(end.x() - half, end.y() - half, 2 * half, 2 * half));
    } else {
      line(handle.shape, color, width);
    }
    const QPointF along = end - handle.shape.front();
    const double length = std::hypot(along.x(), along.y());
    if (handle.kind == Kind::move && length > 4) {
      const QPointF unit = along / length, side(-unit.y(), unit.x());
      painter.setPen(QPen(QColor(0, 0, 0, 150), 1.2 * scale));
      painter.setBrush(color);
      const QPointF base = end - 6 * scale * unit;
      painter.drawPolygon(
          QPolygonF({end + 7 * scale * unit, base + 5 * scale * side, base - 5 * scale * side}));
    }
  }
}

}  // namespace transillum::viewer
