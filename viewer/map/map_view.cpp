// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel of the visibility map: title, one canvas, two (before and after the step) or a
// hemicube, phase buttons and engine menu. It follows Focus (direction, step, phase) and
// ColorChoice.
#include "map/map_view.h"

#include <QButtonGroup>
#include <QMenu>
#include <QPainter>
#include <QStackedWidget>
#include <QTimer>
#include <QToolButton>
#include <utility>

#include "colors/pointer_label.h"
#include "colors/run_beside.h"
#include "map/engine_drawing.h"
#include "map/engine_menu.h"
#include "map/hemicube_view.h"
#include "map/phase_pair.h"
#include "map/polygon_text.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/elided.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int recolor_interval_ms = 700;

QToolButton* text_button(const QString& text, const QString& tip, bool checkable) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setToolTip(tip);
  button->setCheckable(checkable);
  return button;
}

/// Counts rounding errors as 0.
QString percent_of(double fraction) {
  return QString::number(fraction < 1e-9 ? 0 : 100 * fraction, 'g', 2);
}

QString legend_entry(const QColor& color, const QString& name) {
  return QStringLiteral("<span style='color:%1'>■</span> %2").arg(color.name(), name);
}

}  // namespace

MapView::MapView(Focus& focus, Selection& selection, const ColorChoice& colors,
                 const RunBeside& beside, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection), colors_(colors), beside_(beside) {
  title_ = named("map_title", new ClauseLabel);
  step_text_ = named("map_text", new ClauseLabel);
  step_text_->setForegroundRole(QPalette::PlaceholderText);
  second_ = make_canvas(selection, "map_canvas_before");
  canvas_ = make_canvas(selection, "map_canvas");
  second_->hide();
  canvases_ = new QWidget;
  canvases_->setMinimumHeight(52);
  side_by_side_ = make_row(canvases_, {}, 2);
  side_by_side_->addWidget(second_, 1);
  side_by_side_->addWidget(canvas_, 1);
  connect(second_, &MapCanvas::view_changed, this, [this] { canvas_->set_view(second_->view()); });
  connect(canvas_, &MapCanvas::view_changed, this, [this] { second_->set_view(canvas_->view()); });
  pair_ = new PhasePair(*this);

  auto* text = make_column({10, 6, 10, 6}, 1);
  text->addWidget(title_);
  text->addWidget(step_text_);
  auto* layout = make_column(this, {}, 0);
  layout->addLayout(text);
  hemicube_ = named("hemicube_view", new HemicubeView(selection));
  hemicube_->setMinimumHeight(52);
  pictures_ = new QStackedWidget;
  pictures_->addWidget(canvases_);
  pictures_->addWidget(hemicube_);
  layout->addWidget(pictures_, 1);
  layout->addWidget(make_controls());

  recolor_timer_ = new QTimer(this);
  recolor_timer_->setSingleShot(true);
  connect(recolor_timer_, &QTimer::timeout, this, &MapView::show_position);
  connect(&focus_, &Focus::moved, this, &MapView::show_position);
  connect(&focus_, &Focus::target_changed, this, &MapView::show_title);
  connect(&focus_, &Focus::probed, this, &MapView::show_position);
  connect(&selection_, &Selection::changed, this, [this] {
    wholes_->checkedId() == static_cast<int>(Whole::patch) ? show_position() : show_title();
  });
  connect(pair_, &PhasePair::changed, this, &MapView::show_position);
  connect(hemicube_, &HemicubeView::shown, this, &MapView::show_title);
  connect(&colors_, &ColorChoice::changed, this, &MapView::show_position);
  connect(&beside_, &RunBeside::changed, this, &MapView::show_position);
  show_title();
}

MapCanvas* MapView::make_canvas(Selection& selection, const char* name) {
  auto* canvas = named(name, new MapCanvas(selection));
  canvas->setMinimumHeight(26);  // two of them above one another in a low panel
  auto* pointer = new PointerLabel(colors_, *canvas, [this, canvas](const QPoint& position) {
    // Only the open scene has values.
    const auto shown = canvas->map_shown();
    if (shown && snapshot_ && shown->loaded != snapshot_->loaded) {
      return PointedPatch();
    }
    return PointedPatch{canvas->patch_at(position), canvas->patch_point_at(position)};
  });
  connect(pointer, &PointerLabel::form_factors_requested, &colors_,
          &ColorChoice::form_factors_requested);
  pointer->set_details(
      [canvas](const QPoint& position) {
        const std::int32_t row = canvas->row_at(position);
        return row == MapRecord::no_row ? QString() : row_text(*canvas->map_shown(), row);
      },
      [canvas](const QPoint& position) { return canvas->box_of_row(canvas->row_at(position)); });
  connect(&focus_, &Focus::moved, pointer, &PointerLabel::point_again);
  connect(pointer, &PointerLabel::rested, canvas,
          [canvas](const QPoint& position) { canvas->mark_row(canvas->row_at(position)); });
  connect(pointer, &PointerLabel::left, canvas, [canvas] { canvas->mark_row(MapRecord::no_row); });
  connect(canvas, &MapCanvas::painted, this, &MapView::show_title);
  canvas->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(canvas, &QWidget::customContextMenuRequested, this,
          [this, canvas](const QPoint& position) { show_context_menu(*canvas, position); });
  connect(canvas, &MapCanvas::clicked, this, [this, canvas](const QPointF& position) {
    focus_.set_probe(canvas->point_at(position));
  });
  return canvas;
}

void MapView::show_context_menu(const MapCanvas& canvas, const QPoint& position) {
  const auto point = canvas.point_at(position);
  if (!point || !focus_.map()) {
    return;
  }
  auto* menu = named("map_menu", new QMenu(this));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  // Searches this direction only: along other directions the point is elsewhere on the plane.
  const auto add_run = [&](const QString& text, StepOrder order) {
    RunPosition target = focus_.position();
    const bool begins = !focus_.at_step() && order == StepOrder::forward;
    target.step = find_changes_at(*point)(focus_.map()->history, begins ? -1 : target.step, order);
    QAction* run =
        menu->addAction(text, this, [this, target] { focus_.go_to(target, StepReason::found); });
    enable_if(*run, target.step != MapHistory::none, tr("No such fragment covers it"));
  };
  add_run(tr("Run to the next fragment that covers this point"), StepOrder::forward);
  add_run(tr("Run back to the previous fragment that covers this point"), StepOrder::backward);
  menu->addAction(tr("List the patches along the line through this point"), this,
                  [this, point] { focus_.set_probe(point); });
  menu->popup(canvas.mapToGlobal(position));
}

QWidget* MapView::make_whole_buttons() {
  wholes_ = new QButtonGroup(this);
  whole_buttons_ = new QWidget;
  auto* row = make_row(whole_buttons_, {}, 4);
  const auto add = [&](Whole whole, const char* name, const QString& text, const QString& tip) {
    QToolButton* button = named(name, text_button(text, tip, true));
    wholes_->addButton(button, static_cast<int>(whole));
    row->addWidget(button);
  };
  add(Whole::complete, "map_complete", tr("Complete"),
      tr("Show both sides of the direction: the fronts that emit, seen along ω,\n"
         "and the fronts that receive, seen along −ω, at the same places of the plane"));
  add(Whole::receivers, "map_receivers", tr("Receivers only"),
      tr("Show only the fronts that receive, seen along −ω"));
  add(Whole::patch, "map_seen", tr("What a patch sees"), tr("Show what the selected patch sees"));
  wholes_->button(static_cast<int>(Whole::complete))->setChecked(true);
  connect(wholes_, &QButtonGroup::idClicked, this, &MapView::show_position);
  return whole_buttons_;
}

QWidget* MapView::make_phase_buttons() {
  phases_ = new QButtonGroup(this);
  phase_buttons_ = new QWidget;
  auto* row = make_row(phase_buttons_, {}, 4);
  const auto add_phase = [&](Phase phase, const char* name, const QString& text,
                             const QString& tip) {
    QToolButton* button =
        named(name, text_button(text, tip + tr("\nNext and previous phase: / and M"), true));
    phases_->addButton(button, static_cast<int>(phase));
    row->addWidget(button);
  };
  whole_ =
      named("map_whole", text_button(tr("Whole"), tr("Show the whole direction, no step"), false));
  connect(whole_, &QToolButton::clicked, &focus_, &Focus::show_whole);
  row->addWidget(whole_);
  add_phase(Phase::before, "phase_before", tr("Before"),
            tr("Show V before the step, with the fragment to insert"));
  add_phase(Phase::split, "phase_split", tr("Split"),
            tr("Show the parts of V inside and outside the fragment"));
  add_phase(Phase::after, "phase_after", tr("After"),
            tr("Show V after the step, with the fragment inserted"));
  row->addWidget(pair_->button());
  connect(phases_, &QButtonGroup::idClicked, this,
          [this](int phase) { focus_.set_phase(static_cast<Phase>(phase)); });
  return phase_buttons_;
}

QWidget* MapView::make_controls() {
  auto* controls = new QWidget;
  rows_ = make_row(controls, {10, 6, 8, 6}, 4);
  auto* first = make_row({}, 0);
  first->addWidget(make_whole_buttons());
  first->addWidget(make_phase_buttons());
  first->addStretch(1);
  auto* row = make_row({}, 4);
  row->addStretch(1);
  rows_->addLayout(first, 1);
  rows_->addLayout(row);
  engine_menu_ = new EngineMenu;
  row->addWidget(engine_menu_);
  connect(engine_menu_, &EngineMenu::changed, this, &MapView::show_position);
  labels_ =
      text_button(tr("Labels"), tr("Write patch numbers on the polygons that have room"), true);
  labels_->setObjectName("map_labels");
  zoom_ = text_button(tr("Zoom"), tr("Zoom to the fragment of the step"), false);
  zoom_->setObjectName("map_near");
  auto* fit = new QToolButton;
  fit->setIcon(theme::icon(theme::Icon::frame));
  fit->setToolTip(tr("Show the whole map"));
  for (QToolButton* button : {labels_, zoom_, fit}) {
    row->addWidget(button);
  }
  connect(labels_, &QToolButton::toggled, this, &MapView::show_position);
  connect(zoom_, &QToolButton::clicked, canvas_, &MapCanvas::fit_step);
  connect(fit, &QToolButton::clicked, canvas_, &MapCanvas::fit);
  return controls;
}

void MapView::choose_whole(Whole whole) {
  wholes_->button(static_cast<int>(whole))->setChecked(true);
  show_position();
}

PatchId MapView::receiver() const {
  return focus_.map() && shown_whole() == Whole::patch ? selection_.patch() : no_patch;
}

void MapView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  const bool first = !snapshot_;
  snapshot_ = std::move(snapshot);
  if (first) {
    show_position();
  } else if (focus_.map() && !recolor_timer_->isActive()) {
    recolor_timer_->start(recolor_interval_ms);
  }
}

void MapView::clear() {
  snapshot_ = nullptr;
  recolor_timer_->stop();
  canvas_->clear();
  second_->clear();
  hemicube_->clear();
  show_title();
}

void MapView::set_labels_shown(bool shown) { labels_->setChecked(shown); }

bool MapView::labels_shown() const { return labels_->isChecked(); }

bool MapView::up_to_date() const {
  const bool painted =
      shows_hemicube() ? hemicube_->up_to_date() : canvas_->up_to_date() && second_->up_to_date();
  return painted && !recolor_timer_->isActive();
}

bool MapView::shows_hemicube() const {
  return engine_menu_->choice().shows(EngineTraits::Picture::hemicube);
}

bool MapView::shows_beside() const { return beside_.run() && !engine_menu_->choice().engine; }

bool MapView::shows_pair() const {
  return !shows_beside() && pair_->choice() != PhasePair::Choice::off &&
         !engine_menu_->choice().engine && focus_.map() && focus_.at_step() &&
         focus_.position().step >= 0;
}

std::optional<MapView::Whole> MapView::shown_whole() const {
  if (focus_.at_step() || engine_menu_->choice().engine) {
    return std::nullopt;
  }
  const auto whole = static_cast<Whole>(wholes_->checkedId());
  return whole == Whole::patch && selection_.patch() == no_patch ? Whole::complete : whole;
}

void MapView::arrange() {
  const bool phases = !shown_whole();
  bool beside = phases;
  if (const auto map = focus_.map(); map && !phases) {
    const QSizeF size = canvases_->size();
    beside = fit_map(*map, {size.width() / 2, size.height()}).scale >
             fit_map(*map, {size.width(), size.height() / 2}).scale;
  }
  // The canvas of V is the right one of two phases; what emits is on the left or above.
  side_by_side_->setDirection(phases   ? QBoxLayout::LeftToRight
                              : beside ? QBoxLayout::RightToLeft
                                       : QBoxLayout::BottomToTop);
}

void MapView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
  // A narrow view has its buttons in two rows, and omits some beside the phases without room.
  constexpr int margins = 22;
  const int room = width() - margins;
  for (QToolButton* extra : {pair_->button(), whole_}) {
    extra->show();
  }
  for (QToolButton* extra : {pair_->button(), whole_}) {
    if (phase_buttons_->sizeHint().width() > room) {
      extra->hide();
    }
  }
  const int of_one_row =
      std::max(phase_buttons_->sizeHint().width(), whole_buttons_->sizeHint().width()) +
      rows_->itemAt(1)->sizeHint().width();
  rows_->setDirection(of_one_row > room ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

std::vector<std::pair<const MapCanvas*, QRectF>> MapView::parts_of(const QSizeF& size) const {
  if (second_->isHidden()) {
    return {{canvas_, QRectF(QPointF(0, 0), size)}};
  }
  constexpr double gap = 2;
  const auto direction = side_by_side_->direction();
  const bool beside = direction != QBoxLayout::BottomToTop;
  const double half = (beside ? size.width() - gap : size.height() - gap) / 2;
  const QSizeF part = beside ? QSizeF(half, size.height()) : QSizeF(size.width(), half);
  const QRectF first(QPointF(0, 0), part);
  const QRectF last = first.translated(beside ? half + gap : 0, beside ? 0 : half + gap);
  const bool second_first = direction == QBoxLayout::LeftToRight;
  return {{canvas_, second_first ? last : first}, {second_, second_first ? first : last}};
}

QImage MapView::picture(const QSize& pixels) const {
  QImage image(pixels, QImage::Format_RGB32);
  image.fill(Qt::black);
  QPainter painter(&image);
  for (const auto& [canvas, part] : parts_of(pixels)) {
    const QRect place = part.toRect();
    painter.drawImage(place.topLeft(), canvas->picture(place.size()));
  }
  return image;
}

void MapView::draw(QPainter& painter, const QSizeF& size, const QColor& ink, bool explained) const {
  for (const auto& [canvas, part] : parts_of(size)) {
    painter.save();
    painter.translate(part.topLeft());
    canvas->draw(painter, part.size(), ink, explained);
    painter.restore();
  }
}

Phase MapView::shown_phase() const {
  if (!shows_pair()) {
    return focus_.phase();
  }
  return pair_->before() ? Phase::before : Phase::after;
}

void MapView::show_position() {
  const auto map = focus_.map();
  if (!map) {
    canvas_->clear();
    second_->clear();
    show_title();
    return;
  }
  if (!snapshot_ || snapshot_->loaded != map->loaded) {
    return;
  }
  recolor_timer_->stop();
  auto patch_colors = std::make_shared<std::vector<Color8>>(colors_.patch_colors());
  pictures_->setCurrentWidget(shows_hemicube() ? static_cast<QWidget*>(hemicube_) : canvases_);
  if (shows_hemicube()) {
    hemicube_->show_scene({map->loaded, engine_menu_->choice().resolution,
                           engine_menu_->choice().differences, std::move(patch_colors)});
    show_title();
    return;
  }
  hemicube_->clear();
  const auto whole = shown_whole();
  MapCanvas::Content content;
  content.map = map;
  // Another engine has no picture of a whole direction.
  content.step = whole ? focus_.position().step : focus_.picture_step();
  content.phase = shown_phase();
  content.step_shown = focus_.at_step();
  content.labels = labels_->isChecked();
  content.choice = engine_menu_->choice();
  content.probe = focus_.probe();
  content.patch_colors = std::move(patch_colors);
  MapCanvas::Content second = content;
  bool two = false;
  if (whole) {
    two = set_whole(*whole, content, second);
  } else if (shows_pair()) {
    two = pair_->choice() == PhasePair::Choice::side_by_side;
    content.caption = pair_->before() ? tr("before") : tr("after");
    second.phase = Phase::before;
    second.caption = tr("before");
  }
  if (const auto compared = shows_beside() ? beside_.comparison() : nullptr) {
    two = true;
    set_beside(*compared, content, second);
  }
  arrange();
  canvas_->show_map(std::move(content));
  if (two) {
    second_->show_map(std::move(second));
    second_->set_view(canvas_->view());
  } else {
    second_->clear();
  }
  second_->setVisible(two);
  show_title();
}

bool MapView::set_whole(Whole whole, MapCanvas::Content& content,
                        MapCanvas::Content& second) const {
  if (whole == Whole::complete) {
    content.extent = MapExtent::sources;
    content.caption = tr("emits, along ω");
    second.extent = MapExtent::receivers;
    second.caption = tr("receives, along −ω");
  } else if (whole == Whole::receivers) {
    content.extent = MapExtent::receivers;
  } else {
    content.receiver = selection_.patch();
  }
  return whole == Whole::complete;
}

void MapView::set_beside(const DirectionComparison& compared, MapCanvas::Content& open,
                         MapCanvas::Content& other) const {
  open.receiver = other.receiver = no_patch;
  open.caption = tr("open scene");
  open.extent = other.extent = focus_.at_step() ? MapExtent::step : MapExtent::sources;
  other.caption = beside_.name();
  other.map = compared.kept_map;
  other.patches = compared.map->loaded->scene->patch_count();
  other.patch_colors = std::make_shared<const std::vector<Color8>>(beside_.patch_colors());
  other.step = beside_.step_beside(focus_.position().step);
  other.step_shown = other.step >= 0 && focus_.at_step();
  other.phase = open.phase;
}

void MapView::show_buttons() {
  const auto map = focus_.map();
  const bool of_engine = engine_menu_->choice().engine.has_value();
  const QString no_phase = !map        ? tr("No direction is shown yet")
                           : of_engine ? tr("The picture of an engine has no phases")
                                       : tr("Two phases are shown");
  phase_buttons_->setVisible(focus_.at_step());
  whole_buttons_->setVisible(!focus_.at_step());
  for (QAbstractButton* button : phases_->buttons()) {
    enable_if(*button, map && !of_engine && !shows_pair(), no_phase);
  }
  for (QAbstractButton* button : wholes_->buttons()) {
    enable_if(*button, map && !of_engine, no_phase);
  }
  if (map && !of_engine) {
    enable_if(*wholes_->button(static_cast<int>(Whole::patch)), selection_.patch() != no_patch,
              tr("No patch is selected"));
  }
  enable_if(*pair_->button(), map && !of_engine, no_phase);
  const QString no_zoom = tr("The hemicube is shown as a whole, without numbers");
  enable_if(*zoom_, map && focus_.at_step() && !shows_hemicube(),
            shows_hemicube() ? no_zoom
            : map            ? tr("No step is shown")
                             : no_phase);
  enable_if(*labels_, !shows_hemicube(), no_zoom);
  phases_->button(static_cast<int>(focus_.phase()))->setChecked(true);
}

QStringList MapView::direction_clauses() const {
  const auto map = focus_.map();
  const QString direction = tr("Direction %1 of %2")
                                .arg(count_text(map->direction + 1),
                                     count_text(focus_.passes_of(focus_.position().iteration)));
  if (focus_.at_step()) {
    return {tr("%1, step %2 of %3")
                .arg(direction, count_text(focus_.position().step + 1),
                     count_text(map->history.step_count())),
            text_of(focus_.reason())};
  }
  // Maps of many polygons take longer than the directions of the solve.
  const QString shown =
      shown_whole() == Whole::complete ? tr("%1, complete").arg(direction) : direction;
  const int newest = focus_.target().direction;
  return focus_.arrived() || newest == map->direction
             ? QStringList{shown}
             : QStringList{shown, tr("direction %1 follows").arg(count_text(newest + 1))};
}

QString MapView::whole_text() const {
  const auto polygons = [](const MapCanvas& canvas) {
    return count_text(static_cast<std::int64_t>(canvas.polygon_count()));
  };
  switch (*shown_whole()) {
    case Whole::complete:
      return tr("%1 fragments emit, %2 receive").arg(polygons(*canvas_), polygons(*second_));
    case Whole::receivers:
      return tr("%1 fragments receive, seen along −ω").arg(polygons(*canvas_));
    case Whole::patch:
      break;
  }
  const PatchId patch = selection_.patch();
  return canvas_->polygon_count() > 0
             ? tr("Patch %1 sees %2 polygons").arg(patch).arg(polygons(*canvas_))
             : tr("Patch %1 sees nothing along ω").arg(patch);
}

void MapView::show_title() {
  const auto map = focus_.map();
  show_buttons();
  if (!map) {
    title_->set_clauses(
        {focus_.arrived()
             ? tr("No direction yet")
             : tr("Recording direction %1…").arg(count_text(focus_.target().direction + 1))});
  } else if (shows_hemicube()) {
    title_->set_clauses({tr("Hemicube, seen from inside")},
                        tr("Half a cube on the center of the selected patch, unfolded: the top in "
                           "the middle, the four sides around it"));
  } else {
    title_->set_clauses(
        direction_clauses(),
        tr("ω = %1 points toward the source").arg(vector_text(map->record().frame.omega)));
  }
  step_text_->set_clauses(
      step_clauses(),
      tr("Drag to move, wheel to zoom, double-click to show all, click to select a patch"));
}

QStringList MapView::step_clauses() const {
  const auto map = focus_.map();
  if (!map) {
    return {tr("View along ω, toward the source")};
  }
  if (shows_hemicube()) {
    return {hemicube_->status_text().toHtmlEscaped()};
  }
  if (canvas_->pixels()) {
    return {pixel_text()};
  }
  if (shows_beside() && beside_.comparison()) {
    return {tr("The open scene and %1, along the same ω").arg(beside_.name().toHtmlEscaped())};
  }
  if (shown_whole()) {
    return {whole_text()};
  }
  if (shown_phase() == Phase::split && focus_.position().step >= 0) {
    return {QStringLiteral("%1 &nbsp; %2 &nbsp; %3")
                .arg(legend_entry(theme::processed.darker(120), tr("fragment")),
                     legend_entry(theme::inside, tr("inside list")),
                     legend_entry(theme::outside, tr("outside list")))};
  }
  const std::int32_t after = focus_.position().step + (shown_phase() == Phase::before ? 0 : 1);
  const auto polygons = static_cast<std::int64_t>(canvas_->polygon_count());
  return {
      tr("V after %1 of %2 steps").arg(count_text(after), count_text(map->history.step_count())),
      (polygons == 1 ? tr("%1 polygon") : tr("%1 polygons")).arg(count_text(polygons))};
}

QString MapView::pixel_text() const {
  const PixelView& view = *canvas_->pixels();
  if (!view.failure.empty()) {
    return tr("The engine failed");
  }
  const QString after =
      tr("V after %1 of %2 steps")
          .arg(count_text(view.step + 1), count_text(focus_.map()->history.step_count()));
  if (view.corrected) {
    return after + tr(", fragments not cut: %1 % of the area is wrong").arg(percent_of(view.wrong));
  }
  if (!view.choice.differences) {
    return after + tr(", pixel size %1 m").arg(number_text(view.drawn.pixels.side));
  }
  return after + tr(": %1 % of the area differs").arg(100 * view.wrong, 0, 'g', 2);
}

}  // namespace transillum::viewer
