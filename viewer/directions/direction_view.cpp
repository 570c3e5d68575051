// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sphere of directions: one point per processed direction (and its opposite in two-way runs),
// colored by its contribution to the irradiance of the selected patch. Directions and B come from
// the solver's snapshot, visible areas from PerDirectionVisibility.
#include "directions/direction_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "directions/received_light.h"
#include "state/camera_views.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double click_radius = 6;  ///< pixels

/// Position on the color bar, 0 to 1. The square root keeps the many weak directions apart, beside
/// the few that lead to a lamp.
double color_position(double fraction) { return std::sqrt(fraction); }

}  // namespace

DirectionView::DirectionView(Focus& focus, Selection& selection, const ColorChoice& colors,
                             PerDirectionVisibility& visibility, QWidget* parent)
    : QWidget(parent),
      focus_(focus),
      selection_(selection),
      colors_(colors),
      visibility_(visibility) {
  setToolTip(tr("Drag to rotate the sphere; click a point to go to that direction"));
  connect(&focus_, &Focus::moved, this, [this] {
    request_visibility();
    update();
  });
  connect(&colors_, &ColorChoice::changed, this, qOverload<>(&QWidget::update));
  connect(&selection_, &Selection::changed, this, [this] {
    request_visibility();
    update();
  });
  connect(&visibility_, &PerDirectionVisibility::grown, this, qOverload<>(&QWidget::update));
}

void DirectionView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  if (!snapshot_ || snapshot->loaded != snapshot_->loaded) {
    const ViewPoint view = initial_view(*snapshot->loaded->scene, 1);
    toward_ = normalized(view.eye - view.target);
    right_ = normalized(cross(view.up, toward_));
    up_ = cross(toward_, right_);
    turn_ = tilt_ = 0;
  }
  snapshot_ = std::move(snapshot);
  request_visibility();
  update();
}

void DirectionView::clear() {
  snapshot_ = nullptr;
  visibility_.clear();
  update();
}

void DirectionView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  request_visibility();
}

int DirectionView::iteration() const {
  const bool new_each_iteration = snapshot_->options.scheme == Scheme::semi_iterative;
  return new_each_iteration && focus_.map() ? focus_.position().iteration
                                            : snapshot_->progress.iteration;
}

int DirectionView::directions_done() const {
  if (!snapshot_) {
    return 0;
  }
  const SolveProgress& progress = snapshot_->progress;
  if (iteration() < progress.iteration) {
    return snapshot_->passes_of(iteration());
  }
  return progress.direction > 0 || progress.iteration == 0 ? progress.direction : progress.passes;
}

bool DirectionView::needs_visibility() const {
  return snapshot_ && selection_.patch() != no_patch && directions_done() > 0 && isVisible();
}

void DirectionView::request_visibility() {
  if (!needs_visibility()) {
    return;
  }
  visibility_.request(
      visibility_request(*snapshot_, iteration(), directions_done(), selection_.patch()));
}

std::vector<DirectionView::Point> DirectionView::points() const {
  std::vector<Point> points;
  for (int k = 0; k < directions_done(); ++k) {
    const Vec3& omega = at(directions(), k);
    points.push_back({omega, k, false});
    if (snapshot_->options.two_way) {
      points.push_back({-omega, k, true});
    }
  }
  return points;
}

std::vector<double> DirectionView::received() const {
  std::vector<double> received;
  if (!needs_visibility() || visibility_.found().empty()) {
    return received;
  }
  const auto& found = visibility_.found();
  const std::size_t count = std::min(found.size(), static_cast<std::size_t>(directions_done()));
  for (const ReceivedLight& light :
       received_light(visibility_.current_request(), {found.data(), count}, snapshot_->radiosity,
                      directions_done())) {
    received.push_back(luminance(light.irradiance));
  }
  return received;
}

QString DirectionView::caption() const {
  if (selection_.patch() == no_patch) {
    return tr("Select a patch to see which directions light it");
  }
  const QString patch = count_text(selection_.patch());
  if (visibility_.complete()) {
    return tr("Color: contribution of each to the irradiance of patch %1").arg(patch);
  }
  return tr("Computing what patch %1 sees: direction %2 of %3")
      .arg(patch, count_text(static_cast<int>(visibility_.found().size())),
           count_text(directions_done()));
}

QRectF DirectionView::caption_rect() const {
  const int line = fontMetrics().height();
  const QRect room(12, 8 + line, width() - 24, 3 * line);
  return fontMetrics().boundingRect(room, Qt::AlignLeft | Qt::TextWordWrap, caption());
}

QRectF DirectionView::sphere_rect() const {
  const double top = caption_rect().bottom() + 4;
  return {12, top, width() - 24.0, height() - legend_height() - top};
}

double DirectionView::legend_height() const { return fontMetrics().height() + 28; }

double DirectionView::radius() const {
  const QRectF room = sphere_rect();
  return std::max(20.0, 0.5 * std::min(room.width(), room.height() - 12));
}

QPointF DirectionView::center() const { return sphere_rect().center(); }

/// In view coordinates: x to the right, y up, z toward the viewer.
Vec3 DirectionView::rotated(const Vec3& direction) const {
  const Vec3 d{dot(direction, right_), dot(direction, up_), dot(direction, toward_)};
  const double x = std::cos(turn_) * d.x + std::sin(turn_) * d.z;
  const double z = -std::sin(turn_) * d.x + std::cos(turn_) * d.z;
  return {x, std::cos(tilt_) * d.y - std::sin(tilt_) * z,
          std::sin(tilt_) * d.y + std::cos(tilt_) * z};
}

QPointF DirectionView::position_of(const Vec3& rotated) const {
  return center() + radius() * QPointF(rotated.x, -rotated.y);
}

void DirectionView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::scene_background);
  if (directions_done() == 0) {
    painter.setPen(theme::on_dark_dim);
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("Every processed direction appears here as a point"));
    return;
  }
  draw_sphere(painter);
  draw_points(painter, false);
  draw_normal(painter);
  draw_points(painter, true);
  draw_focus(painter);
  draw_legend(painter);
}

void DirectionView::draw_sphere(QPainter& painter) const {
  painter.setPen(QPen(theme::on_dark_dim.darker(160), 1));
  painter.setBrush(QColor(0x2a, 0x30, 0x38));
  painter.drawEllipse(center(), radius(), radius());
  painter.setBrush(Qt::NoBrush);
  // Three great circles, their far halves fainter.
  for (int circle = 0; circle < 3; ++circle) {
    for (int half = 0; half < 2; ++half) {
      QPainterPath path;
      bool open = false;
      for (int k = 0; k <= 96; ++k) {
        const double a = 2 * std::numbers::pi * k / 96;
        const double c = std::cos(a), s = std::sin(a);
        const Vec3 p = rotated(circle == 0   ? Vec3{c, 0, s}
                               : circle == 1 ? Vec3{c, s, 0}
                                             : Vec3{0, c, s});
        if ((p.z >= 0) != (half == 1)) {
          open = false;
          continue;
        }
        if (open) {
          path.lineTo(position_of(p));
        } else {
          path.moveTo(position_of(p));
        }
        open = true;
      }
      QColor line = theme::on_dark_dim;
      line.setAlphaF(half == 1 ? 0.45 : 0.15);
      painter.setPen(QPen(line, 1));
      painter.drawPath(path);
    }
  }
}

void DirectionView::draw_points(QPainter& painter, bool front) const {
  const std::vector<Point> shown = points();
  const std::vector<double> power = received();
  const double largest = power.empty() ? 0 : *std::max_element(power.begin(), power.end());
  const double size =
      std::clamp(1.6 * radius() / std::sqrt(static_cast<double>(shown.size())), 1.6, 5.0);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const Vec3 p = rotated(shown[k].omega);
    if ((p.z >= 0) != front) {
      continue;
    }
    QColor color = theme::on_dark_dim;
    double scale = 0.6;
    if (k < power.size() && power[k] > 0) {
      const Color8 c = color_of(colors_.map(), color_position(power[k] / largest));
      color = QColor(c[0], c[1], c[2]);
      scale = 1;
    }
    color.setAlphaF(front ? 1 : 0.25);
    painter.setBrush(color);
    // The points are outlined: the dark end of the color map would vanish on the dark background.
    painter.setPen(front && scale == 1 ? QPen(theme::on_dark_dim, 0.7) : QPen(Qt::NoPen));
    painter.drawEllipse(position_of(p), scale * size, scale * size);
  }
}

/// A cross at the normal of the selected patch.
void DirectionView::draw_normal(QPainter& painter) const {
  if (!needs_visibility()) {
    return;
  }
  const Vec3 p = rotated(snapshot_->loaded->scene->patch(selection_.patch()).normal);
  QColor color = theme::selection;
  color.setAlphaF(p.z >= 0 ? 1 : 0.4);
  painter.setPen(QPen(color, 2));
  painter.setBrush(Qt::NoBrush);
  const QPointF center = position_of(p);
  painter.drawLine(center - QPointF(6, 0), center + QPointF(6, 0));
  painter.drawLine(center - QPointF(0, 6), center + QPointF(0, 6));
}

void DirectionView::draw_focus(QPainter& painter) const {
  const int pass = focus_.position().direction;
  if (!focus_.map() || pass >= directions_done()) {
    return;
  }
  const Vec3 point = rotated(at(directions(), pass));
  QColor color = theme::processed;
  color.setAlphaF(point.z >= 0 ? 1 : 0.4);
  painter.setPen(QPen(color, 2));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(position_of(point), 7, 7);
}

void DirectionView::draw_legend(QPainter& painter) const {
  const int line = painter.fontMetrics().height();
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(theme::on_dark);
  const auto width_of = [&](const QString& text) {
    return painter.fontMetrics().horizontalAdvance(text);
  };
  const QRect heading(12, 6, width() - 24, line);
  QString count = tr("%1 directions").arg(count_text(directions_done()));
  if (snapshot_->options.two_way) {
    const QString whole = tr("%1 and their opposites").arg(count);
    count = width_of(whole) <= heading.width() ? whole : tr("%1, both ways").arg(count);
  }
  painter.drawText(heading, Qt::AlignLeft, count);
  painter.setFont(font());
  painter.setPen(theme::on_dark_dim);
  const std::vector<double> power = received();
  painter.drawText(caption_rect().adjusted(0, 0, 2, 0), Qt::AlignLeft | Qt::TextWordWrap,
                   caption());
  if (power.empty()) {
    return;
  }

  const double largest = *std::max_element(power.begin(), power.end());
  const QRectF bar(12, height() - legend_height() + 6, width() - 24, 10);
  for (int x = 0; x < static_cast<int>(bar.width()); ++x) {
    const Color8 c = color_of(colors_.map(), x / bar.width());
    painter.fillRect(QRectF(bar.left() + x, bar.top(), 1.5, bar.height()),
                     QColor(c[0], c[1], c[2]));
  }
  const QRectF below(bar.left(), bar.bottom() + 3, bar.width(), line);
  painter.setPen(theme::on_dark);
  painter.drawText(below, Qt::AlignLeft, tr("0"));
  const QString most = tr("%1 W/m²").arg(number_text(largest)), middle = number_text(largest / 4);
  painter.drawText(below, Qt::AlignRight, most);
  // color_position() maps a quarter of the largest value to the middle of the bar.
  if (width_of(middle) / 2.0 + width_of(most) < below.width() / 2 - line / 2.0) {
    painter.drawText(below, Qt::AlignHCenter, middle);
  }
}

std::optional<DirectionView::Point> DirectionView::point_at(const QPointF& where) const {
  std::optional<Point> nearest;
  double distance = click_radius;
  for (const Point& point : points()) {
    const Vec3 p = rotated(point.omega);
    if (p.z < 0) {
      continue;
    }
    const QPointF offset = position_of(p) - where;
    const double d = std::hypot(offset.x(), offset.y());
    if (d >= distance) {
      continue;
    }
    distance = d;
    nearest = point;
  }
  return nearest;
}

void DirectionView::mousePressEvent(QMouseEvent* event) {
  pressed_ = last_ = event->localPos();
  dragged_ = false;
}

void DirectionView::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) {
    return;
  }
  const QPointF at = event->localPos();
  if ((at - pressed_).manhattanLength() > 3) {
    dragged_ = true;
  }
  turn_ += (at.x() - last_.x()) / radius();
  tilt_ = std::clamp(tilt_ + (at.y() - last_.y()) / radius(), -std::numbers::pi / 2,
                     std::numbers::pi / 2);
  last_ = at;
  update();
}

void DirectionView::mouseReleaseEvent(QMouseEvent* event) {
  if (dragged_ || !snapshot_) {
    return;
  }
  const auto point = point_at(event->localPos());
  if (!point) {
    return;
  }
  focus_.go_to_direction(focus_.position().iteration, point->pass);
}

}  // namespace transillum::viewer
