// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/pair_picture.h"

#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "map/color_legend.h"
#include "support/has_index.h"
#include "transillum/at.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

Color8 color8_of_share(double share) {
  return color_of(ColorMap::diverging, 0.5 + share / (2 * PairPicture::full_color_at));
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
                       std::shared_ptr<const EngineComparison> comparison, PatchId receiver) {
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

double PairPicture::share(PatchId source) const {
  return has_index(shares_, source) ? at(shares_, source) : 0;
}

}  // namespace transillum::viewer
