// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/difference_pictures.h"

#include <QPainter>
#include <algorithm>
#include <utility>

#include "support/has_index.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

ColorLegend::ColorLegend(std::function<QColor(double)> color, const QString& range)
    : color_(std::move(color)), range_(range) {
  setFixedHeight(fontMetrics().height() + 12);
}

void ColorLegend::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  const QRect bar(10, (height() - 12) / 2, width() / 3, 12);
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  constexpr int stops = 8;
  for (int k = 0; k <= stops; ++k) {
    gradient.setColorAt(k / double{stops}, color_(k / double{stops}));
  }
  painter.setPen(theme::on_dark_dim);
  painter.fillRect(bar, gradient);
  painter.drawRect(bar);
  painter.setPen(theme::on_dark);
  painter.drawText(rect().adjusted(bar.right() + 8, 0, -4, 0), Qt::AlignVCenter | Qt::AlignLeft,
                   range_);
}

namespace {

QColor color_of_fraction(double fraction) {
  const double t = std::clamp(fraction / DifferencePicture::full_color_at, 0.0, 1.0);
  const auto channel = [t](int from, int to) { return from + static_cast<int>(t * (to - from)); };
  return {channel(0xff, 0xc0), channel(0xff, 0x1a), channel(0xff, 0x1a)};
}

}  // namespace

DifferencePicture::DifferencePicture(Selection& selection, QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("difference_picture"));
  canvas_ = named("difference_canvas", new MapCanvas(selection));
  auto* layout = make_column(this, {}, 0);
  layout->addWidget(canvas_, 1);
  layout->addWidget(new ColorLegend([](double t) { return color_of_fraction(t * full_color_at); },
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
    const QColor color = color_of_fraction(fraction(i));
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

double DifferencePicture::fraction(PatchId patch) const {
  if (!comparison_ || !comparison_->ok()) {
    return -1;
  }
  const double projected = at(comparison_->projected, patch);
  // Another patch gains the area that one patch loses, so half of the difference belongs to this
  // patch.
  return projected > 0 ? at(comparison_->transfers.differences, patch) / (2 * projected) : 0;
}

namespace {

Color8 color8_of_share(double fraction) {
  return color_of(ColorMap::diverging, 0.5 + fraction / (2 * PairPicture::full_color_at));
}

}  // namespace

PairPicture::PairPicture(Selection& selection, QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("pair_picture"));
  canvas_ = named("pair_canvas", new MapCanvas(selection));
  auto* layout = make_column(this, {}, 0);
  layout->addWidget(canvas_, 1);
  layout->addWidget(new ColorLegend(
      [](double t) {
        const Color8 c = color8_of_share((2 * t - 1) * full_color_at);
        return QColor(c[0], c[1], c[2]);
      },
      tr("−%1 to %1 % of a pair").arg(100 * full_color_at)));
}

void PairPicture::show(const std::shared_ptr<const RecordedMap>& map,
                       const std::shared_ptr<const EngineComparison>& comparison,
                       PatchId receiver) {
  shares_.clear();
  receiver_ = receiver;
  const bool any = map && comparison && comparison->ok() && comparison->eye == no_patch &&
                   comparison->loaded == map->loaded && receiver != no_patch &&
                   comparison->direction == map->record().frame.omega;
  if (!any) {
    receiver_ = no_patch;
    canvas_->clear();
    return;
  }
  const Scene& scene = *map->loaded->scene;
  shares_.assign(static_cast<std::size_t>(scene.patch_count()), 0);
  for (const PairDifference& pair : comparison->transfers.pairs) {
    if (pair.receiver == receiver) {
      at(shares_, pair.source) = (pair.other - pair.first) / std::max(pair.other, pair.first);
    }
  }
  auto colors = std::make_shared<std::vector<Color8>>();
  std::transform(shares_.begin(), shares_.end(), std::back_inserter(*colors), color8_of_share);
  MapCanvas::Content content;
  content.map = map;
  content.receiver = receiver;
  content.patch_colors = std::move(colors);
  content.caption = tr("what patch %1 sees").arg(receiver);
  canvas_->show_map(std::move(content));
}

double PairPicture::fraction(PatchId source) const {
  return has_index(shares_, source) ? at(shares_, source) : 0;
}

}  // namespace transillum::viewer
