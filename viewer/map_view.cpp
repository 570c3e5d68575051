// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map_view.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "map_canvas.h"
#include "number_text.h"
#include "theme.h"

namespace transillum::viewer {

namespace {

constexpr int recolor_interval_ms = 700;

}  // namespace

MapView::MapView(Selection& selection, const ColorChoice& colors, QWidget* parent)
    : QWidget(parent), colors_(colors) {
  title_ = new QLabel;
  step_text_ = new QLabel;
  step_text_->setForegroundRole(QPalette::PlaceholderText);
  // Long words must not widen the window: they are cut off before that.
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  step_text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  canvas_ = new MapCanvas(selection);
  canvas_->setObjectName("map_canvas");
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setObjectName("map_step");
  slider_->setEnabled(false);
  slider_->setToolTip(tr("The map after this step: one step processes one polygon"));
  fullest_ = new QToolButton;
  fullest_->setText(tr("Fullest"));
  fullest_->setCheckable(true);
  fullest_->setChecked(true);
  fullest_->setToolTip(tr("Show each direction after the step at which most of it shines"));
  auto* fit = new QToolButton;
  fit->setIcon(theme::icon(theme::Icon::frame));
  fit->setToolTip(tr("Show all of the map"));

  auto* words = new QVBoxLayout;
  words->setContentsMargins(10, 6, 10, 6);
  words->setSpacing(1);
  words->addWidget(title_);
  words->addWidget(step_text_);
  auto* controls = new QHBoxLayout;
  controls->setContentsMargins(10, 6, 8, 6);
  controls->setSpacing(8);
  controls->addWidget(new QLabel(tr("Step")));
  controls->addWidget(slider_, 1);
  controls->addWidget(fullest_);
  controls->addWidget(fit);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addLayout(words);
  layout->addWidget(canvas_, 1);
  layout->addLayout(controls);

  recolor_timer_ = new QTimer(this);
  recolor_timer_->setSingleShot(true);
  connect(recolor_timer_, &QTimer::timeout, this, &MapView::show_step);
  connect(slider_, &QSlider::valueChanged, this, [this] {
    fullest_->setChecked(false);
    show_step();
  });
  connect(fullest_, &QToolButton::clicked, this, [this](bool checked) {
    if (checked && map_) show_map(map_);
  });
  connect(fit, &QToolButton::clicked, canvas_, &MapCanvas::fit);
  connect(canvas_, &MapCanvas::painted, this, &MapView::show_title);
  connect(&colors_, &ColorChoice::changed, this, &MapView::show_step);
  show_title();
}

std::int32_t MapView::step() const { return slider_->value() - 1; }

void MapView::show_map(std::shared_ptr<const RecordedMap> map) {
  map_ = std::move(map);
  const MapRecord& record = map_->record;
  const double share =
      slider_->maximum() > 0 ? static_cast<double>(slider_->value()) / slider_->maximum() : 1;
  {
    // The slider counts finished steps: 0 is the empty map before the first one.
    const QSignalBlocker quiet(slider_);
    slider_->setRange(0, record.step_count());
    slider_->setPageStep(std::max(record.step_count() / 20, 1));
    slider_->setValue(fullest_->isChecked()
                          ? record.fullest_step() + 1
                          : static_cast<int>(std::lround(share * record.step_count())));
    slider_->setEnabled(true);
  }
  show_step();
}

void MapView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  if (map_ && !recolor_timer_->isActive()) recolor_timer_->start(recolor_interval_ms);
}

void MapView::clear() {
  map_ = nullptr;
  snapshot_ = nullptr;
  recolor_timer_->stop();
  slider_->setEnabled(false);
  canvas_->clear();
  show_title();
}

bool MapView::up_to_date() const { return canvas_->up_to_date() && !recolor_timer_->isActive(); }

void MapView::show_step() {
  if (!map_ || !snapshot_ || snapshot_->loaded != map_->loaded) return;
  recolor_timer_->stop();
  auto patch_colors = std::make_shared<std::vector<Color8>>();
  colors_.scale().color(snapshot_->radiosity, *patch_colors);
  canvas_->show_map(map_, step(), std::move(patch_colors));
}

void MapView::show_title() {
  if (!map_) {
    title_->setText(tr("No direction yet"));
    step_text_->setText(tr("Seen along ω, toward the light that crosses the plane"));
    return;
  }
  title_->setText(tr("Direction %1 of %2, seen along ω")
                      .arg(count_text(map_->direction), count_text(map_->passes)));
  title_->setToolTip(
      tr("ω = %1 points to where the light comes from").arg(vector_text(map_->record.frame.omega)));
  step_text_->setText(tr("V after step %1 of %2: %3 fragments")
                          .arg(count_text(step() + 1), count_text(map_->record.step_count()),
                               count_text(static_cast<std::int64_t>(canvas_->fragment_count()))));
}

}  // namespace transillum::viewer
