// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Surfaces". Snapshots arrive often while a solve runs; their powers are added up a few
// times a second at most, on a thread of their own, and only while the panel is visible.
#include "patches/surface_panel.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QTabWidget>
#include <QTableView>
#include <QTimer>
#include <QToolButton>
#include <QUndoStack>
#include <algorithm>
#include <utility>

#include "colors/color_scale.h"
#include "model/snapshot_values.h"
#include "patches/error_page.h"
#include "patches/table_rows.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

constexpr int parts_interval_ms = 400;
constexpr int power_column = 2;  // column of the table of exchanges
constexpr Rgb first_exitance{10, 10, 10}, first_reflectance{0.5, 0.5, 0.5};

QString count_of(std::size_t number, const char* one, const char* several) {
  return number == 1 ? SurfacePanel::tr(one)
                     : SurfacePanel::tr(several).arg(count_text(static_cast<std::int64_t>(number)));
}

QString total_text(const PowerTable& table, SurfaceKind by, bool received_known) {
  const QString kinds = by == SurfaceKind::group
                            ? count_of(table.surfaces.size(), "1 group", "%1 groups")
                            : count_of(table.surfaces.size(), "1 material", "%1 materials");
  const QString size =
      SurfacePanel::tr("%1, %2, %3 m²")
          .arg(kinds,
               count_of(static_cast<std::size_t>(table.total.patches), "1 patch", "%1 patches"),
               number_text(table.total.area));
  const auto watts = [](const Rgb& power) { return number_text(luminance(power)); };
  return received_known
             ? SurfacePanel::tr("%1: %2 W emitted, %3 W received, %4 W absorbed")
                   .arg(size, watts(table.total.emitted), watts(table.total.received),
                        watts(table.total.absorbed))
             : SurfacePanel::tr("%1: %2 W emitted; received light is known after an iteration")
                   .arg(size, watts(table.total.emitted));
}

}  // namespace

SurfacePanel::SurfacePanel(Relighting& relighting, Selection& selection, HiddenPatches& hidden,
                           ColorChoice& colors, QWidget* parent)
    : QWidget(parent),
      relighting_(relighting),
      selection_(selection),
      hidden_(hidden),
      tabs_(new QTabWidget),
      counter_(
          *this,
          [](const std::shared_ptr<const SolverSnapshot>& snapshot, const Cancellation&) {
            return power_tables(snapshot);
          },
          [this](const auto&, std::shared_ptr<const PowerTables> tables, const QString& error) {
            if (tables) {
              show_tables(std::move(tables));
            } else {
              emit failed(error);
            }
          },
          CurrentJob::finish) {
  tabs_->setDocumentMode(true);
  tabs_->setObjectName("surface_tabs");
  buttons_ = make_buttons();
  groups_ = add_page(tr("Groups"), "group_table");
  materials_ = add_page(tr("Materials"), "material_table");
  exchanges_ = add_page(tr("Exchange"), "exchange_table");
  exchanges_.view->sortByColumn(power_column, Qt::DescendingOrder);
  errors_ = new ErrorPage(colors, *tabs_);
  refresh_timer_ = new QTimer(this);
  refresh_timer_->setSingleShot(true);
  auto* layout = make_column(this, {}, 0);
  layout->addWidget(tabs_, 1);
  layout->addWidget(buttons_);
  connect(refresh_timer_, &QTimer::timeout, this, &SurfacePanel::refresh);
  connect(tabs_, &QTabWidget::currentChanged, this, [this] {
    buttons_->setVisible(tabs_->currentWidget() != errors_->widget());
    refresh();
    show_state();
  });
  connect(&relighting_.edits(), &MaterialEdits::changed, this, &SurfacePanel::show_state);
  connect(&selection_, &Selection::patches_changed, this, [this] {
    if (!selects_) {
      // A marked row means that its patches are selected.
      groups_.view->clearSelection();
      materials_.view->clearSelection();
      show_state();
    }
  });
  clear();
}

TablePage SurfacePanel::add_page(const QString& title, const char* name) {
  const bool pairs = qstrcmp(name, "exchange_table") == 0;
  const QString name_width = QStringLiteral("Name of it");
  const TablePage page =
      add_table_page(*tabs_, title, name,
                     pairs ? QStringList{name_width, name_width}
                           : QStringList{name_width, QStringLiteral("88888"),
                                         QStringLiteral("88.888"), QStringLiteral("8.8888"),
                                         QStringLiteral("8.8888"), QStringLiteral("8.8888")});
  page.view->setTabKeyNavigation(false);
  page.view->setContextMenuPolicy(Qt::ActionsContextMenu);
  if (!pairs) {
    page.view->addActions({select_, hide_, isolate_, emit_, reflect_, copy_});
    connect(page.view->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this, page](const QModelIndex& index) {
              if (index.isValid() && page.view->hasFocus()) {
                select_current();
              }
            });
    connect(page.view, &QTableView::clicked, this, &SurfacePanel::select_current);
  }
  return page;
}

QAction* SurfacePanel::add_action(const char* name, const QString& text, const QString& tip,
                                  const char* key, void (SurfacePanel::*what)()) {
  auto* action = make_action(this, name, text, tip);
  if (key != nullptr) {
    action->setShortcut(QKeySequence(QString::fromLatin1(key)));
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  }
  addAction(action);
  connect(action, &QAction::triggered, this, what);
  return action;
}

QWidget* SurfacePanel::make_buttons() {
  select_ =
      add_action("select_surface", tr("Select its patches"), tr("Select all its patches (Return)"),
                 "Return", &SurfacePanel::select_current);
  // H and I are keys of the window, which act on the selected patches: the patches of the marked
  // row.
  hide_ = add_action("hide_surface", tr("Hide"),
                     tr("Hide the patches of the row in the scene (H); Shift+H shows all"), nullptr,
                     &SurfacePanel::hide_current);
  isolate_ =
      add_action("isolate_surface", tr("Isolate"), tr("Hide all other patches in the scene (I)"),
                 nullptr, &SurfacePanel::isolate_current);
  emit_ = add_action("emit_surface", tr("Make it emit"),
                     tr("Set an exitance of 10 W/m² (E); the sliders in Materials change it"), "E",
                     &SurfacePanel::make_emit);
  reflect_ = add_action("reflect_surface", tr("Make it reflect"),
                        tr("Set the exitance to 0 (R); ρ stays, or becomes 0.5 where it is 0"), "R",
                        &SurfacePanel::make_reflect);
  copy_ = add_action("copy_surface", tr("Copy the name"), tr("Copy the name of the row"), nullptr,
                     &SurfacePanel::copy_name);
  auto* buttons = new QWidget;
  auto* row = make_row(buttons, {8, 4, 8, 6});
  for (QAction* action : {hide_, isolate_, emit_, reflect_}) {
    auto* button = named(action->objectName() + "_button", new QToolButton);
    button->setDefaultAction(action);
    row->addWidget(button);
  }
  row->addStretch(1);
  return buttons;
}

void SurfacePanel::clear() {
  counter_.clear();
  tables_ = nullptr;
  for (const TablePage& page : {groups_, materials_, exchanges_}) {
    page.table->set_contents({}, {});
    page.caption->setText(scene_ ? tr("Adding up powers…")
                                 : tr("Open a scene to list its groups and materials."));
  }
  show_state();
}

void SurfacePanel::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  snapshot_ = nullptr;
  if (scene_->groups().empty() && tabs_->currentIndex() == 0) {
    tabs_->setCurrentIndex(1);
  }
  clear();
}

void SurfacePanel::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  errors_->show_snapshot(snapshot);
  snapshot_ = std::move(snapshot);
  if (watched_ && !refresh_timer_->isActive()) {
    refresh_timer_->start(tables_ ? parts_interval_ms : 0);
  }
  show_state();
}

void SurfacePanel::show_errors() { tabs_->setCurrentWidget(errors_->widget()); }

bool SurfacePanel::busy() const {
  return counter_.busy() || (watched_ && refresh_timer_->isActive());
}

void SurfacePanel::set_watched(bool watched) {
  watched_ = watched;
  refresh();
}

void SurfacePanel::refresh() {
  if (!watched_ || !snapshot_) {
    return;
  }
  if (tabs_->currentIndex() == 2 && !snapshot_->form_factors) {
    emit form_factors_requested();
  }
  if (!tables_ || tables_->snapshot != snapshot_) {
    counter_.request(snapshot_);
  }
}

void SurfacePanel::show_tables(std::shared_ptr<const PowerTables> tables) {
  if (!snapshot_ || tables->snapshot->loaded != snapshot_->loaded) {
    return;
  }
  tables_ = std::move(tables);
  show_surfaces(groups_, tables_->groups, SurfaceKind::group);
  show_surfaces(materials_, tables_->materials, SurfaceKind::material);
  show_exchanges();
  show_state();
}

void SurfacePanel::show_surfaces(const TablePage& page, const PowerTable& table, SurfaceKind by) {
  PatchRows rows = rows_of_parts(table, tables_->received_known);
  page.table->set_contents(std::move(rows.patches), std::move(rows.columns));
  page.caption->setText(total_text(table, by, tables_->received_known));
}

void SurfacePanel::show_exchanges() {
  const bool by_groups = scene_ && !scene_->groups().empty();
  const PowerTable& table = by_groups ? tables_->groups : tables_->materials;
  PatchRows rows = rows_of_exchanges(table);
  exchanges_.table->set_contents(std::move(rows.patches), std::move(rows.columns));
  exchanges_.caption->setText(table.exchanged.empty() ? why_no_form_factors(*tables_->snapshot)
                              : by_groups
                                  ? tr("Light that goes from one group to another directly.")
                                  : tr("Light that goes from one material to another "
                                       "directly; the scene has no groups."));
}

SurfaceKind SurfacePanel::current_kind() const {
  return tabs_->currentIndex() == 0 ? SurfaceKind::group : SurfaceKind::material;
}

const SurfacePower* SurfacePanel::current() const {
  if (!tables_ || tabs_->currentIndex() > 1) {
    return nullptr;
  }
  const bool groups = current_kind() == SurfaceKind::group;
  const TablePage& page = groups ? groups_ : materials_;
  const QModelIndex index = page.view->currentIndex();
  if (!index.isValid()) {
    return nullptr;
  }
  return &at((groups ? tables_->groups : tables_->materials).surfaces,
             page.table->patch(index.row()));
}

std::vector<PatchId> SurfacePanel::patches_of(const SurfacePower& surface) const {
  const bool groups = current_kind() == SurfaceKind::group;
  std::vector<PatchId> patches;
  for (PatchId i = 0; i < scene_->patch_count(); ++i) {
    const Patch& patch = scene_->patch(i);
    if ((groups ? patch.group : patch.material) == surface.index) {
      patches.push_back(i);
    }
  }
  return patches;
}

std::string SurfacePanel::target_of(const SurfacePower& surface) const {
  return surface.index < 0
             ? std::string()
             : (current_kind() == SurfaceKind::group ? "group:" : "material:") + surface.name;
}

void SurfacePanel::select_current() {
  if (const SurfacePower* surface = current()) {
    selects_ = true;
    selection_.select_all(patches_of(*surface));
    selects_ = false;
  }
  show_state();
}

void SurfacePanel::hide_current() {
  if (const SurfacePower* surface = current()) {
    hidden_.hide(patches_of(*surface));
  }
}

void SurfacePanel::isolate_current() {
  if (const SurfacePower* surface = current()) {
    hidden_.isolate(patches_of(*surface));
  }
}

void SurfacePanel::make_emit() {
  const SurfacePower* surface = current();
  if (!surface || target_of(*surface).empty()) {
    return;
  }
  const std::string target = target_of(*surface);
  relighting_.edits().begin_drag();
  relighting_.edits().set_exitance(target, first_exitance);
  emit target_changed(target);
}

void SurfacePanel::make_reflect() {
  const SurfacePower* surface = current();
  if (!surface || target_of(*surface).empty()) {
    return;
  }
  const std::string target = target_of(*surface);
  const bool black = max_abs(relighting_.edits().values_of(target).reflectance) == 0;
  MaterialEdits& edits = relighting_.edits();
  edits.begin_drag();
  edits.begin_macro(tr("make %1 reflect").arg(target_text(target)));
  edits.set_exitance(target, {});
  if (black) {
    edits.set_reflectance(target, first_reflectance);
  }
  edits.end_macro();
  emit target_changed(target);
}

void SurfacePanel::copy_name() {
  if (const SurfacePower* surface = current()) {
    QGuiApplication::clipboard()->setText(QString::fromStdString(surface->name));
  }
}

void SurfacePanel::show_state() {
  const SurfacePower* surface = current();
  const QString no_row = tr("No row is chosen");
  for (QAction* action : {select_, hide_, isolate_, copy_}) {
    enable_if(*action, surface != nullptr, no_row);
  }
  const bool fits = !snapshot_ || snapshot_->form_factors_fit;
  const bool has_target = surface && surface->index >= 0;
  bool all_emit = false, none_emits = true, black = false;
  if (has_target && relighting_.edits().materials()) {
    const PatchMaterials& materials = *relighting_.edits().materials();
    const std::vector<PatchId> patches = patches_of(*surface);
    const auto emits = [&](PatchId i) { return max_abs(materials.of(i).exitance) > 0; };
    all_emit = std::all_of(patches.begin(), patches.end(), emits);
    none_emits = std::none_of(patches.begin(), patches.end(), emits);
    black = max_abs(materials.of(patches.front()).reflectance) == 0;
  }
  const QString obstacle = !surface      ? no_row
                           : !has_target ? tr("These patches are in no group")
                           : !fits       ? tr("The form factors exceed the memory limit")
                                         : QString();
  enable_if(*emit_, has_target && fits && !all_emit,
            obstacle.isEmpty() ? tr("All its patches emit") : obstacle);
  enable_if(*reflect_, has_target && fits && (!none_emits || black),
            obstacle.isEmpty() ? tr("All its patches reflect, and none emits") : obstacle);
}

}  // namespace transillum::viewer
