// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lobes of the selected patch as polar plots. The arriving light is drawn as lines, one for each
// direction of the set; the leaving light as a surface, because it is known in every direction.
// Both are drawn in the color of the light, seen obliquely, the patch's normal upward.
#include "directions/lobe_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/number_text.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

using std::numbers::pi;
constexpr double margin_of_plot = 12;  ///< pixels

/// The hue of a light, and its brightness by its fraction of the largest.
QColor light_color(const Rgb& light, double fraction) {
  const double largest = max_abs(light);
  if (!(largest > 0)) {
    return theme::on_dark_dim;
  }
  const double bright = 0.35 + 0.65 * std::sqrt(std::clamp(fraction, 0.0, 1.0));
  const auto channel = [&](double v) {
    return std::pow(std::clamp(v / largest, 0.0, 1.0), 1 / 2.2) * bright;
  };
  return QColor::fromRgbF(channel(light.r), channel(light.g), channel(light.b));
}

double largest_of_rays(const std::vector<LobeView::Ray>& rays) {
  double largest = 0;
  for (const LobeView::Ray& ray : rays) {
    largest = std::max(largest, luminance(ray.light));
  }
  return largest;
}

QString shape_text(const Lobe& lobe) {
  return lobe.shape == LobeShape::phong
             ? LobeView::tr("exponent n = %1").arg(number_text(lobe.exponent))
             : LobeView::tr("roughness %1").arg(number_text(lobe.roughness));
}

}  // namespace

LobeView::LobeView(const Selection& selection, const ColorChoice& colors, QWidget* parent)
    : QWidget(parent), selection_(selection), colors_(colors) {
  setToolTip(tr("Drag to rotate; the length in a direction is the light along it"));
  connect(&selection_, &Selection::changed, this, &LobeView::forget);
  connect(&colors_, &ColorChoice::eye_changed, this, qOverload<>(&QWidget::update));
}

void LobeView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  const bool same = snapshot_ && snapshot_->glossy == snapshot->glossy;
  snapshot_ = std::move(snapshot);
  if (!same) {
    forget();
  }
}

void LobeView::clear() {
  snapshot_ = nullptr;
  forget();
}

void LobeView::forget() {
  known_ = false;
  arriving_.clear();
  leaving_.clear();
  sun_ = {};
  update();
}

QString LobeView::message() const {
  if (!snapshot_ || !snapshot_->glossy) {
    return tr(
        "Lobes reflect in glossy runs only: check Glossy in the solve settings, for a scene "
        "whose materials have lobes");
  }
  return selection_.patch() == no_patch ? tr("Click a patch to see what arrives and what it sends")
                                        : QString();
}

void LobeView::find_light() {
  if (known_ || !message().isEmpty()) {
    return;
  }
  known_ = true;
  const PatchId patch = selection_.patch();
  const GlossyLight& light = *snapshot_->glossy;
  normal_ = light.scene().patch(patch).normal;
  // The camera is in front; turned by turn_, what leaves toward it points to the right.
  const Vec3 to_eye = colors_.eye() - light.scene().patch(patch).center;
  const Vec3 level = to_eye - dot(to_eye, normal_) * normal_;
  const Vec3 other = std::abs(normal_.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 toward = norm(level) > 1e-6 ? normalized(level) : normalized(cross(normal_, other));
  ahead_ = -toward;
  right_ = cross(ahead_, normal_);
  const auto in_frame = [&](const Vec3& d) {
    return Vec3{dot(d, right_), dot(d, ahead_), dot(d, normal_)};
  };
  sun_ = {in_frame(snapshot_->options.sky.sun.direction), light.sun_irradiance(patch)};
  const auto arriving = light.arriving(patch);
  for (int k = 0; k < std::ssize(arriving); ++k) {
    arriving_.push_back(
        {in_frame(light.direction(patch, k)), arriving[static_cast<std::size_t>(k)]});
  }
  for (int ring = 0; ring <= rings; ++ring) {
    // The outermost ring stays just above the horizon: no light leaves below the patch.
    const double theta = std::min(pi / 2 * ring / rings, pi / 2 - 1e-6);
    for (int sector = 0; sector < sectors; ++sector) {
      const double phi = 2 * pi * sector / sectors;
      const Vec3 d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                   std::cos(theta)};
      const Vec3 world = d.x * right_ + d.y * ahead_ + d.z * normal_;
      leaving_.push_back({d, light.radiance(patch, world)});
    }
  }
}

const std::vector<LobeView::Ray>& LobeView::arriving() {
  find_light();
  return arriving_;
}

const LobeView::Ray& LobeView::sun() {
  find_light();
  return sun_;
}

const std::vector<LobeView::Ray>& LobeView::leaving() {
  find_light();
  return leaving_;
}

const LobeView::Ray* LobeView::strongest() const {
  const auto found = std::max_element(
      arriving_.begin(), arriving_.end(),
      [](const Ray& a, const Ray& b) { return luminance(a.light) < luminance(b.light); });
  return found == arriving_.end() || !(luminance(found->light) > 0) ? nullptr : &*found;
}

Vec3 LobeView::toward_eye() const {
  const Vec3 d =
      normalized(colors_.eye() - snapshot_->glossy->scene().patch(selection_.patch()).center);
  return {dot(d, right_), dot(d, ahead_), dot(d, normal_)};
}

/// In view coordinates: x to the right, y up, z toward the viewer.
Vec3 LobeView::turned(const Vec3& d) const {
  const double x = std::cos(turn_) * d.x - std::sin(turn_) * d.y;
  const double y = std::sin(turn_) * d.x + std::cos(turn_) * d.y;
  return {x, std::cos(tilt_) * d.z + std::sin(tilt_) * y,
          std::sin(tilt_) * d.z - std::cos(tilt_) * y};
}

QPointF LobeView::position_of(const Plot& plot, const Vec3& direction, double length) const {
  const Vec3 p = turned(direction);
  return plot.center + plot.radius * length * QPointF(p.x, -p.y);
}

LobeView::Plot LobeView::plot_in(const QRectF& area, const std::vector<Ray>& rays) const {
  // The hemisphere needs its radius above the center, and the ring's height below.
  const int line = fontMetrics().height();
  const QRectF room = area.adjusted(margin_of_plot, 2.4 * line, -margin_of_plot, -1.6 * line);
  const double below = std::abs(std::sin(tilt_));
  const double radius =
      std::max(16.0, std::min(room.width() / 2, room.height() / (1 + below + 0.05)));
  const QPointF center(room.center().x(), room.center().y() + radius * (1 - below) / 2);
  return {area, center, radius, largest_of_rays(rays)};
}

void LobeView::draw_ground(QPainter& painter, const Plot& plot) const {
  const double height = std::abs(std::sin(tilt_));
  painter.setBrush(QColor(0x2a, 0x30, 0x38));
  for (const double ring : {1.0, 0.5}) {
    QColor line = theme::on_dark_dim;
    line.setAlphaF(ring == 1 ? 0.9 : 0.5);
    painter.setPen(QPen(line, 1));
    painter.drawEllipse(plot.center, ring * plot.radius, ring * plot.radius * height);
    painter.setBrush(Qt::NoBrush);
  }
  QColor faint = theme::on_dark_dim;
  faint.setAlphaF(0.5);
  painter.setPen(QPen(faint, 1, Qt::DotLine));
  const QRectF dome(plot.center - QPointF(plot.radius, plot.radius),
                    QSizeF(2 * plot.radius, 2 * plot.radius));
  painter.drawArc(dome, 0, 180 * 16);
  painter.setPen(QPen(theme::selection, 1.5));
  painter.drawLine(plot.center, position_of(plot, {0, 0, 1}, 1));
}

void LobeView::draw_arriving(QPainter& painter, const Plot& plot) const {
  std::vector<const Ray*> rays;
  for (const Ray& ray : arriving_) {
    rays.push_back(&ray);
  }
  std::sort(rays.begin(), rays.end(), [this](const Ray* a, const Ray* b) {
    return turned(a->direction).z < turned(b->direction).z;
  });
  const double width = std::clamp(plot.radius / 60, 1.2, 3.0);
  for (const Ray* ray : rays) {
    const double fraction = plot.largest > 0 ? luminance(ray->light) / plot.largest : 0;
    const QColor color = light_color(ray->light, fraction);
    const QPointF end = position_of(plot, ray->direction, fraction);
    painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(plot.center, end);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawEllipse(end, 1.2 * width, 1.2 * width);
  }
}

/// The surface, farthest parts first.
void LobeView::draw_leaving(QPainter& painter, const Plot& plot) const {
  struct Facet {
    double depth;
    QPolygonF outline;
    QColor color;
  };
  std::vector<Facet> facets;
  if (!(plot.largest > 0)) {
    return;
  }
  const auto ray = [&](int ring, int sector) -> const Ray& {
    return at(leaving_, ring * sectors + sector % sectors);
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const Ray* corners[] = {&ray(ring, sector), &ray(ring + 1, sector),
                              &ray(ring + 1, sector + 1), &ray(ring, sector + 1)};
      Facet facet{0, {}, {}};
      Rgb mean;
      Vec3 points[4];
      for (int k = 0; k < 4; ++k) {
        const double length = luminance(corners[k]->light) / plot.largest;
        points[k] = length * turned(corners[k]->direction);
        facet.depth += points[k].z;
        facet.outline << plot.center + plot.radius * QPointF(points[k].x, -points[k].y);
        mean += 0.25 * corners[k]->light;
      }
      // Darker where the surface turns away from the viewer.
      const Vec3 slope = cross(points[2] - points[0], points[3] - points[1]);
      const double size = norm(slope);
      const double facing = size > 0 ? std::abs(slope.z) / size : 1;
      facet.color = light_color(mean, (0.25 + 0.75 * facing) * (0.4 + 0.6 * facing));
      facets.push_back(std::move(facet));
    }
  }
  std::sort(facets.begin(), facets.end(),
            [](const Facet& a, const Facet& b) { return a.depth < b.depth; });
  for (const Facet& facet : facets) {
    painter.setPen(QPen(facet.color.darker(118), 0.6));
    painter.setBrush(facet.color);
    painter.drawPolygon(facet.outline);
  }
}

void LobeView::draw_mark(QPainter& painter, const Plot& plot, const Vec3& direction,
                         const QColor& color, const QString& text) const {
  painter.setPen(QPen(color, 1.6, Qt::DashLine));
  const QPointF end = position_of(plot, direction, 1);
  painter.drawLine(plot.center, end);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  painter.drawEllipse(end, 3, 3);
  const int line = painter.fontMetrics().height(),
            width = painter.fontMetrics().horizontalAdvance(text);
  const bool to_left = end.x() < plot.center.x();
  QRectF place(end.x() + (to_left ? -width - 6 : 6), end.y() - line, width + 2, line);
  place.moveLeft(std::clamp(place.left(), plot.area.left() + 2, plot.area.right() - width - 4));
  place.moveTop(std::max(place.top(), plot.area.top() + 2.2 * line));
  painter.fillRect(place.adjusted(-2, 0, 2, 0), QColor(0x1a, 0x1e, 0x24, 190));
  painter.setPen(color);
  painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, text);
}

void LobeView::draw_texts(QPainter& painter, const Plot& plot, const QString& title,
                          const QString& what) const {
  const int line = painter.fontMetrics().height();
  const QRectF& area = plot.area;
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(theme::on_dark);
  painter.drawText(QRectF(area.left(), area.top(), area.width(), line), Qt::AlignHCenter, title);
  painter.setFont(font());
  painter.setPen(theme::on_dark_dim);
  painter.drawText(
      QRectF(area.left(), area.top() + line, area.width(), line), Qt::AlignHCenter,
      painter.fontMetrics().elidedText(what, Qt::ElideRight, static_cast<int>(area.width())));
  painter.drawText(QRectF(area.left(), area.bottom() - 1.3 * line, area.width(), line),
                   Qt::AlignHCenter,
                   plot.largest > 0 ? tr("outer ring: %1 W/(m² sr)").arg(number_text(plot.largest))
                                    : tr("no light"));
}

QString LobeView::heading() const {
  const PatchId patch = selection_.patch();
  const Material& material = material_of(*snapshot_, patch);
  const QString name =
      tr("Patch %1, %2").arg(count_text(patch), QString::fromStdString(material.name));
  const Lobe lobe = used_lobe(material);
  return lobe.present()
             ? tr("%1: its lobe reflects %2 %, %3")
                   .arg(name, number_text(100 * luminance(lobe.reflectance)), shape_text(lobe))
             : tr("%1: diffuse, without a lobe").arg(name);
}

void LobeView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::scene_background);
  const QString instead = message();
  if (!instead.isEmpty()) {
    painter.setPen(theme::on_dark_dim);
    painter.drawText(rect().adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap, instead);
    return;
  }
  find_light();
  const int line = fontMetrics().height();
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(theme::selection);
  painter.drawText(QRect(10, 6, width() - 20, line), Qt::AlignLeft,
                   QFontMetrics(bold).elidedText(heading(), Qt::ElideRight, width() - 20));
  painter.setFont(font());
  const QRectF room(4, 10 + 1.2 * line, width() - 8, height() - 14 - 1.2 * line);
  const bool beside = room.width() > 1.1 * room.height();
  QRectF first = room, second = room;
  if (beside) {
    first.setWidth(room.width() / 2);
    second.setLeft(first.right());
  } else {
    first.setHeight(room.height() / 2);
    second.setTop(first.bottom());
  }
  const Plot left = plot_in(first, arriving_), right = plot_in(second, leaving_);
  draw_ground(painter, left);
  draw_arriving(painter, left);
  draw_texts(
      painter, left, tr("Arrives: Φ"),
      arriving_.empty() ? tr("kept by direction only for lobes") : tr("flux density by direction"));
  draw_ground(painter, right);
  draw_leaving(painter, right);
  draw_marks(painter, left, right);
  draw_texts(painter, right, tr("Leaves: L"), tr("radiance by direction"));
}

/// The sun comes from one direction: its light is no density, and has no length in the left plot.
void LobeView::draw_marks(QPainter& painter, const Plot& left, const Plot& right) const {
  const auto mirrored = [](const Vec3& d) { return Vec3{-d.x, -d.y, d.z}; };
  if (const Ray* source = strongest()) {
    draw_mark(painter, left, source->direction, theme::on_dark, tr("strongest"));
    draw_mark(painter, right, mirrored(source->direction), theme::on_dark, tr("its mirror"));
  }
  if (max_abs(sun_.light) > 0) {
    draw_mark(painter, left, sun_.direction, theme::inside,
              tr("sun: %1 W/m²").arg(number_text(luminance(sun_.light))));
    draw_mark(painter, right, mirrored(sun_.direction), theme::inside, tr("mirror of the sun"));
  }
  const Vec3 eye = toward_eye();
  if (eye.z > 0) {
    const Vec3 world = eye.x * right_ + eye.y * ahead_ + eye.z * normal_;
    draw_mark(painter, right, eye, theme::processed,
              tr("eye: %1").arg(
                  number_text(luminance(snapshot_->glossy->radiance(selection_.patch(), world)))));
  }
}

void LobeView::mousePressEvent(QMouseEvent* event) { last_ = event->localPos(); }

void LobeView::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) {
    return;
  }
  const QPointF moved = event->localPos() - last_;
  last_ = event->localPos();
  turn_ += 0.01 * moved.x();
  tilt_ = std::clamp(tilt_ + 0.01 * moved.y(), 0.02, pi / 2);
  update();
}

}  // namespace transillum::viewer
