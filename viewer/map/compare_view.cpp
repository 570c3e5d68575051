// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Compares two engines on the direction in focus. Their transfers come from
// compare_engines(); the maps are painted by MapCanvas, the differences by DifferencePicture (by
// patch) and PairPicture (by polygon), and listed by PairTable.
#include "map/compare_view.h"

#include <QComboBox>
#include <QGridLayout>
#include <QItemSelectionModel>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QStackedWidget>
#include <QTableView>
#include <QTimer>
#include <utility>

#include "map/difference_pictures.h"
#include "map/hemicube_view.h"
#include "map/map_canvas.h"
#include "map/pair_table.h"
#include "state/breakpoints.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "visibility/pixels/pixel_map.h"
#include "widgets/build.h"
#include "widgets/elided.h"
#include "widgets/engine_text.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

/// Shortest time between two comparisons while the newest direction is followed.
constexpr int refresh_interval_ms = 400;
constexpr int map_height = 110;  ///< size hint, pixels

QString percent_text(double fraction) { return number_text(100 * fraction) + QStringLiteral(" %"); }

QString values_text(const EngineComparison::Side& side, double exchanged) {
  const QString values[] = {
      CompareView::tr("%1 ms").arg(number_text(1000 * side.seconds)),
      CompareView::tr("%1 pairs").arg(count_text(static_cast<std::int64_t>(side.pairs))),
      CompareView::tr("%1 m² exchanged").arg(number_text(exchanged)),
      CompareView::tr("%1 covered").arg(percent_text(side.covered_fraction))};
  QString text;
  for (QString value : values) {
    text += (text.isEmpty() ? QString() : QStringLiteral(", ")) +
            value.replace(QLatin1Char(' '), QChar(QChar::Nbsp));  // lines end between values
  }
  return text;
}

QString direction_text(const EngineComparison& c) {
  QString text = CompareView::tr(
                     "Along this direction, “%3” assigns %1 of the area that “%2” finds to "
                     "other pairs of patches.")
                     .arg(percent_text(c.transfers.misplaced), engine_label(c.first.engine),
                          engine_label(c.other.engine));
  const Transfer& largest = c.transfers.largest;
  if (largest.receiver == no_patch) {
    return text;
  }
  return text + CompareView::tr(" Largest difference: patches %1 and %2, %3 m² %4.")
                    .arg(largest.receiver)
                    .arg(largest.source)
                    .arg(number_text(std::abs(largest.area)),
                         largest.area > 0 ? CompareView::tr("less") : CompareView::tr("more"));
}

/// The pairs of patches, except those that differ only by rounding.
std::vector<PairDifference> pairs_of(const TransferComparison& transfers) {
  constexpr double rounding = 1e-13;  // relative to the whole exchanged area
  std::vector<PairDifference> pairs = transfers.pairs;
  std::erase_if(pairs, [&](const PairDifference& pair) {
    return std::abs(pair.first - pair.other) < rounding * transfers.exchanged;
  });
  return pairs;
}

QString row_text(const EngineComparison& c, std::size_t directions) {
  QString text = CompareView::tr(
                     "Form factors have no direction, so one patch is compared: “%4” assigns %3 "
                     "of the area that patch %1 sees by “%2” to other patches (all %5 directions "
                     "of the run).")
                     .arg(c.eye)
                     .arg(engine_label(c.first.engine), percent_text(c.transfers.misplaced),
                          engine_label(c.other.engine))
                     .arg(directions);
  const Transfer& largest = c.transfers.largest;
  if (largest.receiver == no_patch) {
    return text;
  }
  const double area = at(c.projected, c.eye);
  return text + CompareView::tr(" Largest difference: patch %1, form factor %2 %3.")
                    .arg(largest.source)
                    .arg(number_text(std::abs(largest.area) / area),
                         largest.area > 0 ? CompareView::tr("less") : CompareView::tr("more"));
}

}  // namespace

CompareView::CompareView(Focus& focus, Selection& selection, const ColorChoice& colors,
                         QWidget* parent)
    : QWidget(parent),
      focus_(focus),
      selection_(selection),
      colors_(colors),
      comparer_(*this, &compare_engines,
                [this](const EngineRequest& request,
                       std::shared_ptr<const EngineComparison> comparison, const QString& error) {
                  show_comparison(comparison
                                      ? std::move(comparison)
                                      : std::make_shared<const EngineComparison>(
                                            failed_comparison(request, error.toStdString())));
                }) {
  first_ = make_choice("first", Engine::fast);
  other_ = make_choice("other", Engine::zbuffer);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(2);
  grid->setVerticalSpacing(0);
  grid->addLayout(column_of(first_), 0, 0);
  grid->addLayout(column_of(other_), 0, 1);
  difference_ = new DifferencePicture(selection_);
  difference_->canvas()->set_height_hint(map_height);
  by_polygon_ = new PairPicture(selection_);
  by_polygon_->canvas()->set_height_hint(map_height);
  link({first_.map, other_.map, difference_->canvas(), by_polygon_->canvas()});
  grid->addWidget(difference_, 1, 0);
  grid->addWidget(by_polygon_, 1, 1);
  grid->addWidget(make_words(), 2, 0, 1, 2);
  grid->addWidget(make_list(), 3, 0, 1, 2);
  for (const int part : {0, 1}) {
    grid->setRowStretch(part, 3);
    grid->setColumnStretch(part, 1);
  }
  grid->setRowStretch(3, 1);

  request_timer_ = new QTimer(this);
  request_timer_->setSingleShot(true);
  request_timer_->setInterval(refresh_interval_ms);
  connect(request_timer_, &QTimer::timeout, this, &CompareView::send_request);
  connect(&focus_, &Focus::moved, this, [this] {
    if (isVisible() && !request_timer_->isActive()) {
      request_timer_->start();
    }
  });
  connect(&selection_, &Selection::changed, this, [this] {
    if (list_->currentIndex().row() < 0) {
      by_polygon_->show(focus_.map(), comparison_, receiver_to_show());
    }
    if (!first_.has_directions() || !other_.has_directions()) {
      request_timer_->start();
    }
  });
  connect(&focus_, &Focus::probed, this, &CompareView::show_maps);
  connect(&colors_, &ColorChoice::changed, this, &CompareView::show_maps);
  show_comparison(nullptr);
}

void CompareView::make_large_action() {
  large_ = make_action(
      this, "compare_large", tr("Compare engines, large"),
      tr("Give the comparison of engines most of the window, or restore the layout (G)"),
      Qt::Key_G);
  large_->setIconText(tr("Large"));
  large_->setCheckable(true);
  connect(large_, &QAction::toggled, this, &CompareView::enlarged);
}

QWidget* CompareView::make_words() {
  text_ = named("compare_words", new QLabel);
  text_->setWordWrap(true);
  text_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  worst_ = named(
      "worst_pair", new QPushButton(tr("Worst pair")),
      tr("Select the patch of the largest difference and go to the step where it meets the other "
         "patch of the pair"));
  connect(worst_, &QPushButton::clicked, this, [this] {
    const Transfer& worst = comparison_->transfers.largest;
    go_to(worst.receiver, worst.source);
  });
  make_large_action();
  auto* large = button_for(large_);
  auto* words = new QWidget;
  auto* row = make_row(words, {10, 6, 10, 6});
  row->addWidget(text_, 1);
  row->addWidget(worst_, 0, Qt::AlignTop);
  row->addWidget(large, 0, Qt::AlignTop);
  return words;
}

QTableView* CompareView::make_list() {
  pairs_ = new PairTable(this);
  list_ = named("pair_differences", new QTableView,
                tr("Pairs of patches in which the engines differ. A chosen pair is shown in the "
                   "maps; Return or a double-click goes to the step where the two meet."));
  list_->setModel(pairs_);
  list_->setSelectionBehavior(QAbstractItemView::SelectRows);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->setMinimumHeight(90);
  set_up_value_table(*list_, {"888888", "888888"});
  connect(list_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& index) { show_pair(index.row()); });
  connect(list_, &QTableView::activated, this, [this](const QModelIndex& index) {
    const PairDifference& pair = pairs_->pair(index.row());
    go_to(pair.receiver, pair.source);
  });
  return list_;
}

void CompareView::show_pair(int row) {
  by_polygon_->show(focus_.map(), comparison_, receiver_to_show());
  if (row >= 0) {
    selection_.select(pairs_->pair(row).source);  // outlined in all maps
  }
}

/// The receiver of the chosen pair; else the selected patch, if it sees anything; else the receiver
/// of the largest difference.
PatchId CompareView::receiver_to_show() const {
  if (list_->currentIndex().isValid()) {
    return pairs_->pair(list_->currentIndex().row()).receiver;
  }
  const auto map = focus_.map();
  const PatchId selected = selection_.patch();
  if (map && selected != no_patch) {
    for (const std::int32_t k : map->history.steps_of(selected)) {
      const MapHistory::Step& step = map->history.step(k);
      if (step.patch == selected && step.front_facing && step.cut > 0) {
        return selected;
      }
    }
  }
  return comparison_ ? comparison_->transfers.largest.receiver : no_patch;
}

CompareView::Choice CompareView::make_choice(const char* name, Engine engine) {
  Choice choice{new ElidedComboBox,           new QSpinBox,       new MapCanvas(selection_),
                new HemicubeView(selection_), new QStackedWidget, new QLabel};
  choice.values->setObjectName(QString::fromLatin1(name) + QStringLiteral("_values"));
  choice.values->setWordWrap(true);
  choice.values->setContentsMargins(10, 4, 10, 4);
  choice.values->setToolTip(
      tr("Processor time for this direction; number of pairs of patches that exchange light; "
         "projected area over which they exchange it; fraction of the receivers' projected area "
         "that sees another patch"));
  choice.picture->addWidget(choice.map);
  choice.picture->addWidget(choice.hemicube);
  choice.map->set_height_hint(map_height);
  choice.map->setObjectName(QString::fromLatin1(name) + QStringLiteral("_map"));
  choice.engine->setObjectName(QString::fromLatin1(name) + QStringLiteral("_engine"));
  choice.engine->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  choice.engine->setMinimumContentsLength(6);
  add_engines(*choice.engine, true);
  choose_engine(*choice.engine, engine);
  choice.engine->setToolTip(engine_sentence(engine));
  choice.resolution->setObjectName(QString::fromLatin1(name) + QStringLiteral("_resolution"));
  choice.resolution->setToolTip(tr("Pixels along the longer side of the map"));
  choice.resolution->setRange(8, PixelMap::largest_resolution);
  choice.resolution->setValue(128);
  choice.resolution->setSingleStep(64);
  choice.resolution->setSuffix(tr(" px"));
  if (!traits_of(engine).takes_resolution) {
    choice.resolution->hide();
  }
  connect(choice.engine, qOverload<int>(&QComboBox::currentIndexChanged), this, [this, choice] {
    const Engine chosen = engine_of(*choice.engine);
    choice.engine->setToolTip(engine_sentence(chosen));
    choice.resolution->setVisible(traits_of(chosen).takes_resolution);
    send_request();
  });
  connect(choice.resolution, QOverload<int>::of(&QSpinBox::valueChanged), this,
          [this] { request_timer_->start(); });
  return choice;
}

QBoxLayout* CompareView::column_of(const Choice& choice) const {
  auto* row = make_row({6, 6, 6, 4}, 4);
  row->addWidget(choice.engine, 1);
  row->addWidget(choice.resolution);
  auto* column = make_column({}, 0);
  column->addLayout(row);
  column->addWidget(choice.picture, 1);
  column->addWidget(choice.values);
  return column;
}

void CompareView::link(const std::vector<MapCanvas*>& maps) {
  for (MapCanvas* map : maps) {
    connect(map, &MapCanvas::view_changed, this, [map, maps] {
      for (MapCanvas* another : maps) {
        if (another != map) {
          another->set_view(map->view());
        }
      }
    });
    connect(map, &MapCanvas::clicked, this,
            [this, map](const QPointF& position) { focus_.set_probe(map->point_at(position)); });
  }
}

bool CompareView::Choice::is_hemicube() const {
  return traits_of(engine_of(*engine)).picture == EngineTraits::Picture::hemicube;
}

bool CompareView::Choice::has_directions() const { return takes_directions(engine_of(*engine)); }

bool CompareView::Choice::up_to_date() const {
  return is_hemicube() ? hemicube->up_to_date() : map->up_to_date();
}

int CompareView::Choice::requested_resolution() const {
  if (is_hemicube()) {
    return resolution->value() / 2 * 2;
  }
  return traits_of(engine_of(*engine)).takes_resolution ? resolution->value() : 0;
}

void CompareView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  if (isVisible() && !up_to_date() && !request_timer_->isActive()) {
    request_timer_->start();
  }
}

void CompareView::clear() {
  snapshot_ = nullptr;
  sent_ = {};
  comparer_.clear();
  for (const Choice* choice : {&first_, &other_}) {
    choice->map->clear();
    choice->hemicube->clear();
  }
  show_comparison(nullptr);
}

bool CompareView::up_to_date() const {
  return comparison_ && !comparing_ && focus_.map() && snapshot_ && current_request() == sent_ &&
         drawn();
}

bool CompareView::drawn() const {
  return first_.up_to_date() && other_.up_to_date() && difference_->canvas()->up_to_date() &&
         by_polygon_->canvas()->up_to_date();
}

bool CompareView::busy() const {
  const bool shown = comparison_ && comparison_->ok();
  return isVisible() && (comparing_ || request_timer_->isActive() || (shown && !drawn()));
}

void CompareView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  send_request();
}

EngineRequest CompareView::current_request() const {
  EngineRequest request;
  request.loaded = focus_.map()->loaded;
  request.direction = focus_.map()->record().frame.omega;
  request.options = snapshot_->options.engine_options;
  request.first = engine_of(*first_.engine);
  request.first_resolution = first_.requested_resolution();
  request.other = engine_of(*other_.engine);
  request.other_resolution = other_.requested_resolution();
  if (request.compares_rows()) {
    request.direction = {};  // unused: requests for other directions are equal
    request.eye = selection_.patch();
    request.directions = snapshot_->directions;
    request.two_way = snapshot_->options.two_way;
  }
  return request;
}

void CompareView::send_request() {
  show_maps();
  if (!isVisible() || !snapshot_ || !focus_.map()) {
    return;
  }
  EngineRequest request = current_request();
  if (request == sent_) {
    return;
  }
  if (request.compares_rows() && request.eye == no_patch) {
    sent_ = {};
    comparer_.clear();
    show_comparison(nullptr);
    text_->setText(
        tr("A hemicube and pairs of patches have no directions: select a patch to compare its form "
           "factors."));
    return;
  }
  sent_ = request;
  comparing_ = true;
  text_->setText(tr("Comparing…"));
  comparer_.request(std::move(request));
}

void CompareView::show_maps() {
  const auto map = focus_.map();
  if (!isVisible() || !snapshot_ || !map || snapshot_->loaded != map->loaded) {
    return;
  }
  MapCanvas::Content content;
  content.map = map;
  content.step = map->record().fullest_step();
  content.probe = focus_.probe();
  content.patch_colors = std::make_shared<const std::vector<Color8>>(colors_.patch_colors());
  for (const Choice* choice : {&first_, &other_}) {
    const Engine engine = engine_of(*choice->engine);
    choice->picture->setCurrentIndex(choice->is_hemicube() ? 1 : 0);
    if (choice->is_hemicube()) {
      choice->hemicube->show_scene(
          {map->loaded, choice->requested_resolution(), false, content.patch_colors});
      continue;
    }
    choice->hemicube->clear();
    content.choice = {};
    const EngineTraits::Picture picture = traits_of(engine).picture;
    if (picture == EngineTraits::Picture::pixels || picture == EngineTraits::Picture::corrected) {
      content.choice.engine = engine;
      content.choice.order = snapshot_->options.engine_options.order;
      content.choice.resolution = choice->resolution->value();
    }
    choice->map->show_map(content);
  }
}

void CompareView::go_to(PatchId receiver, PatchId source) {
  const auto map = focus_.map();
  if (!map || !comparison_ || comparison_->eye != no_patch) {
    return;
  }
  const MapHistory& history = map->history;
  const auto steps = history.steps_of(receiver);
  if (steps.empty()) {
    return;
  }
  std::int32_t step = steps.front();  // where only pixels see the pair
  const Breakpoint pair{Breakpoint::Kind::pair, receiver, source};
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    if (holds(pair, history, k)) {
      step = k;
      break;
    }
  }
  selection_.select(receiver);
  focus_.go_to_step(step);
}

void CompareView::show_comparison(std::shared_ptr<const EngineComparison> comparison) {
  comparison_ = std::move(comparison);
  comparing_ = false;
  worst_->setVisible(comparison_ && comparison_->eye == no_patch &&
                     comparison_->transfers.largest.receiver != no_patch);
  difference_->show(focus_.map(), comparison_);
  pairs_->set_pairs(comparison_ && comparison_->ok() ? pairs_of(comparison_->transfers)
                                                     : std::vector<PairDifference>());
  by_polygon_->show(focus_.map(), comparison_, receiver_to_show());
  for (const Choice* choice : {&first_, &other_}) {
    choice->values->clear();
  }
  if (!comparison_) {
    text_->setText(tr("Solve a scene to compare two engines on one of its directions."));
    return;
  }
  const EngineComparison& c = *comparison_;
  for (const EngineComparison::Side* side : {&c.first, &c.other}) {
    if (side->failure.empty()) {
      continue;
    }
    text_->setText(QStringLiteral("%1: %2").arg(engine_label(side->engine),
                                                QString::fromStdString(side->failure)));
    return;
  }
  first_.values->setText(values_text(c.first, c.transfers.exchanged));
  other_.values->setText(values_text(c.other, c.transfers.other_exchanged));
  text_->setText(c.eye == no_patch ? direction_text(c) : row_text(c, sent_.directions->size()));
}

}  // namespace transillum::viewer
