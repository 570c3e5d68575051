// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/difference_picture.h"

#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "map/color_legend.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

QColor color_of_share(double share) {
  const double t = std::clamp(share / DifferencePicture::full_color_at, 0.0, 1.0);
  const auto channel = [t](int from, int to) { return from + static_cast<int>(t * (to - from)); };
  return {channel(0xff, 0xc0), channel(0xff, 0x1a), channel(0xff, 0x1a)};
}

}  // namespace

DifferencePicture::DifferencePicture(Selection& selection, QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("difference_picture"));
  canvas_ = new MapCanvas(selection);
  canvas_->setObjectName(QStringLiteral("difference_canvas"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(canvas_, 1);
  layout->addWidget(new ColorLegend([](double t) { return color_of_share(t * full_color_at); },
                                    tr("0 to %1 % of a patch").arg(100 * full_color_at)));
}

void DifferencePicture::show(const std::shared_ptr<const RecordedMap>& map,
                             std::shared_ptr<const EngineComparison> comparison) {
  comparison_ = std::move(comparison);
  if (!map || !comparison_ || !comparison_->ok() || comparison_->loaded != map->loaded) {
    canvas_->clear();
    return;
  }
  auto colors = std::make_shared<std::vector<Color8>>();
  for (PatchId i = 0; i < map->loaded->scene->patch_count(); ++i) {
    const QColor color = color_of_share(share(i));
    colors->push_back({static_cast<std::uint8_t>(color.red()),
                       static_cast<std::uint8_t>(color.green()),
                       static_cast<std::uint8_t>(color.blue())});
  }
  MapCanvas::Content content;
  content.map = map;
  content.step = map->record().fullest_step();
  content.patch_colors = std::move(colors);
  canvas_->show_map(std::move(content));
}

double DifferencePicture::share(PatchId patch) const {
  if (!comparison_ || !comparison_->ok()) {
    return -1;
  }
  const double projected = at(comparison_->projected, patch);
  // Another patch gains the area that one patch loses, so half of the difference belongs to this
  // patch.
  return projected > 0 ? at(comparison_->transfers.differences, patch) / (2 * projected) : 0;
}

}  // namespace transillum::viewer
