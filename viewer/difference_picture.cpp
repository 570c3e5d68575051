// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "difference_picture.h"

#include <QPainter>
#include <algorithm>
#include <utility>

#include "map_painter.h"
#include "theme.h"

namespace transillum::viewer {

namespace {

constexpr int legend_height = 30;

QColor color_of_share(double share) {
  const double t = std::clamp(share / DifferencePicture::full_color_at, 0.0, 1.0);
  const auto channel = [t](int from, int to) { return from + static_cast<int>(t * (to - from)); };
  return {channel(0xff, 0xc0), channel(0xff, 0x1a), channel(0xff, 0x1a)};
}

/// A bar of the colours, and what its ends are.
void draw_legend(QPainter& painter, const QRect& place) {
  const QRect bar(place.left() + 10, place.top() + 8, place.width() / 3, 12);
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  gradient.setColorAt(0, color_of_share(0));
  gradient.setColorAt(1, color_of_share(DifferencePicture::full_color_at));
  painter.setPen(theme::on_dark_dim);
  painter.fillRect(bar, gradient);
  painter.drawRect(bar);
  painter.setPen(theme::on_dark);
  painter.drawText(
      QRect(bar.right() + 8, place.top(), place.right() - bar.right() - 12, place.height() - 2),
      Qt::AlignVCenter | Qt::AlignLeft,
      QObject::tr("0 … %1 % seen otherwise").arg(100 * DifferencePicture::full_color_at));
}

}  // namespace

DifferencePicture::DifferencePicture(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("difference_picture"));
  setMinimumSize(160, 110);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void DifferencePicture::show(std::shared_ptr<const RecordedMap> map,
                             std::shared_ptr<const EngineComparison> comparison) {
  map_ = std::move(map);
  comparison_ = std::move(comparison);
  update();
}

double DifferencePicture::share(PatchId patch) const {
  if (!comparison_ || !comparison_->ok()) return -1;
  const auto i = static_cast<std::size_t>(patch);
  const double projected = comparison_->projected[i];
  // What one patch loses another gets: of either half of the difference is its own.
  return projected > 0 ? comparison_->transfers.differences[i] / (2 * projected) : 0;
}

void DifferencePicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  if (!map_ || !comparison_ || !comparison_->ok() || comparison_->loaded != map_->loaded) {
    painter.setPen(theme::on_dark_dim);
    painter.drawText(rect(), Qt::AlignCenter, tr("Nothing compared"));
    return;
  }
  auto colors = std::make_shared<std::vector<Color8>>();
  for (PatchId i = 0; i < map_->loaded->scene->patch_count(); ++i) {
    const QColor color = color_of_share(share(i));
    colors->push_back({static_cast<std::uint8_t>(color.red()),
                       static_cast<std::uint8_t>(color.green()),
                       static_cast<std::uint8_t>(color.blue())});
  }
  MapPictureRequest request;
  request.map = map_;
  request.step = map_->record().fullest_step();
  request.patch_colors = colors;
  // The room that fit_map() leaves below for a scale bar takes the legend.
  request.size = QSizeF(width(), height());
  request.transform = fit_map(*map_, request.size);
  request.pixel_ratio = devicePixelRatioF();
  QImage image = paint_map(request).image;
  image.setDevicePixelRatio(request.pixel_ratio);
  painter.drawImage(QPointF(0, 0), image);
  draw_legend(painter, QRect(0, height() - legend_height, width(), legend_height));
}

}  // namespace transillum::viewer
