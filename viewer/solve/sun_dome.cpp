// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/sun_dome.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double dome_degree = std::numbers::pi / 180;
constexpr double margin = 16;  // for the names of the directions, px

}  // namespace

SunDome::SunDome(QWidget* parent) : QWidget(parent) {
  setObjectName("sun_dome");
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setToolTip(
      tr("The sky seen from above: drag the sun, or move it with the arrow keys. The center is the "
         "zenith, the rim the horizon"));
  setAccessibleName(tr("Position of the sun"));
}

void SunDome::set_position(const SolarPosition& position) {
  position_ = position;
  update();
}

void SunDome::set_path(std::vector<SolarPosition> path) {
  path_ = std::move(path);
  update();
}

double SunDome::radius() const { return std::min(width(), height()) / 2.0 - margin; }

QPointF SunDome::place_of(const SolarPosition& position) const {
  const double r = radius() * (90 - position.elevation) / 90;
  const double angle = position.azimuth * dome_degree;
  return center() + QPointF(r * std::sin(angle), -r * std::cos(angle));
}

void SunDome::drag_to(const QPointF& place) {
  const QPointF from = place - center();
  const double r = std::hypot(from.x(), from.y());
  const double azimuth = r > 0 ? std::atan2(from.x(), -from.y()) / dome_degree : position_.azimuth;
  move_to({azimuth < 0 ? azimuth + 360 : azimuth, 90 - 90 * std::min(1.0, r / radius())});
}

void SunDome::move_to(const SolarPosition& position) {
  if (position != position_) {
    set_position(position);
    emit moved(position_);
  }
}

void SunDome::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void SunDome::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void SunDome::keyPressEvent(QKeyEvent* event) {
  const double step = event->modifiers() & Qt::ShiftModifier ? 10 : 1;
  SolarPosition to = position_;
  switch (event->key()) {
    case Qt::Key_Left:
      to.azimuth -= step;
      break;
    case Qt::Key_Right:
      to.azimuth += step;
      break;
    case Qt::Key_Up:
      to.elevation = std::min(90.0, to.elevation + step);
      break;
    case Qt::Key_Down:
      to.elevation = std::min(to.elevation, std::max(0.0, to.elevation - step));
      break;
    default:
      QWidget::keyPressEvent(event);
      return;
  }
  to.azimuth = std::fmod(to.azimuth + 360, 360);
  move_to(to);
}

void SunDome::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPointF middle = center();
  const double r = radius();
  painter.setPen(QPen(theme::rule, 1));
  painter.setBrush(theme::paper);
  painter.drawEllipse(middle, r, r);
  painter.setBrush(Qt::NoBrush);
  for (const double elevation : {30.0, 60.0}) {
    painter.drawEllipse(middle, r * (90 - elevation) / 90, r * (90 - elevation) / 90);
  }
  painter.drawLine(middle - QPointF(r, 0), middle + QPointF(r, 0));
  painter.drawLine(middle - QPointF(0, r), middle + QPointF(0, r));
  painter.setPen(theme::ink_dim);
  const auto name = [&](const QString& text, double x, double y) {
    const QPointF at = middle + (r + margin / 2) * QPointF(x, y);
    painter.drawText(QRectF(at - QPointF(margin, margin), QSizeF(2 * margin, 2 * margin)),
                     Qt::AlignCenter, text);
  };
  name(tr("N"), 0, -1);
  name(tr("E"), 1, 0);
  name(tr("S"), 0, 1);
  name(tr("W"), -1, 0);
  painter.setPen(QPen(theme::warm, 1.5));
  for (std::size_t k = 1; k < path_.size(); ++k) {
    if (path_[k - 1].elevation >= 0 && path_[k].elevation >= 0) {
      painter.drawLine(place_of(path_[k - 1]), place_of(path_[k]));
    }
  }
  if (position_.elevation >= 0) {
    painter.setPen(QPen(hasFocus() ? theme::accent : theme::ink, hasFocus() ? 2 : 1));
    painter.setBrush(theme::processed);
    painter.drawEllipse(place_of(position_), 6, 6);
  }
}

}  // namespace transillum::viewer
