// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/inspection_panels.h"

#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QUndoStack>
#include <utility>

#include "directions/received_view.h"
#include "model/solver/solve_runner.h"
#include "patches/compare_actions.h"
#include "patches/error_page.h"
#include "patches/kept_run_panel.h"
#include "patches/material_panel.h"
#include "patches/patch_inspector.h"
#include "patches/patch_table_panel.h"
#include "patches/path_panel.h"
#include "patches/selection_actions.h"
#include "patches/surface_panel.h"
#include "patches/warning_list.h"
#include "widgets/build.h"
#include "widgets/scrolling.h"
#include "window/base/dock_layouts.h"
#include "window/base/window_views.h"

namespace transillum::viewer {

InspectionPanels::InspectionPanels(SharedState& state, HiddenPatches& hidden, QWidget* window)
    : QObject(window), undo_(state.undo), relighting_(state.relighting) {
  materials_ = new MaterialPanel(relighting_, state.selection, state.colors);
  tables_ = named("table_panel", new PatchTablePanel(state.selection));
  surfaces_ =
      named("surface_panel", new SurfacePanel(relighting_, state.selection, hidden, state.colors));
  paths_ = named("path_panel", new PathPanel(state.selection));
  warnings_ = new WarningList(state.selection);
  connect(warnings_, &WarningList::face_chosen, this, &InspectionPanels::face_chosen);
  selecting_ = new SelectionActions(state.selection, hidden, this);
  hidden.set_undo_stack(&undo_);
  compare_ = new CompareActions(state.colors, window, this);
  connect(compare_, &CompareActions::failed, this, &InspectionPanels::failed);
  runs_ = new KeptRunPanel(state.colors, state.selection, state.beside, *compare_->keep(),
                           *compare_->difference());
  connect(runs_, &KeptRunPanel::patch_chosen, this, &InspectionPanels::face_chosen);
  state.colors.kept_runs().set_undo_stack(&undo_);
  connect(&state.colors, &ColorChoice::form_factors_requested, &state.runner,
          &SolveRunner::include_form_factors);
  connect(&relighting_, &Relighting::form_factors_requested, &state.runner,
          &SolveRunner::include_form_factors);
  connect(&relighting_, &Relighting::solve_requested, &state.runner, [&runner = state.runner] {
    runner.set_goal({.kind = Goal::Kind::finished, .without_light = true});
  });
  connect(&relighting_, &Relighting::solver_light_requested, &state.runner, &SolveRunner::relight);
  connect(tables_, &PatchTablePanel::form_factors_requested, &state.runner,
          &SolveRunner::include_form_factors);
  connect(paths_, &PathPanel::form_factors_requested, &state.runner,
          &SolveRunner::include_form_factors);
  connect(paths_, &PathPanel::paths_shown, this, &InspectionPanels::paths_shown);
  connect(paths_, &PathPanel::failed, this, &InspectionPanels::failed);
  connect(tables_, &PatchTablePanel::failed, this, &InspectionPanels::failed);
  connect(surfaces_, &SurfacePanel::form_factors_requested, &state.runner,
          &SolveRunner::include_form_factors);
  connect(surfaces_, &SurfacePanel::failed, this, &InspectionPanels::failed);
  connect(surfaces_->errors(), &ErrorPage::failed, this, &InspectionPanels::failed);
  connect(&state.runner, &SolveRunner::state_changed, surfaces_->errors(), &ErrorPage::show_state);
  connect(surfaces_, &SurfacePanel::target_changed, this, [this](const std::string& target) {
    materials_->show_target(target);
    material_dock_->show();
    material_dock_->raise();
  });
  connect(&relighting_, &Relighting::failed, this, &InspectionPanels::failed);
}

void InspectionPanels::add_materials_to(DockLayouts& docks) {
  material_dock_ = docks.add(tr("Materials"), "material_dock", scrollable(materials_));
  // The signal is also sent for tabs behind others, whose isVisible() is always true.
  connect(material_dock_, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    if (visible) {
      emit relighting_.form_factors_requested();
    }
  });
}

void InspectionPanels::add_light_to(DockLayouts& docks, QWidget& received) {
  const auto add = [&docks](const QString& title, const char* name, auto* panel) {
    const QDockWidget* dock = docks.add(title, name, panel);
    connect(dock, &QDockWidget::visibilityChanged, panel,
            &std::remove_pointer_t<decltype(panel)>::set_watched);
  };
  add(tr("Light paths"), "paths_dock", paths_);
  docks.add(tr("Received light"), "received_dock", &received);
  add(tr("Surfaces"), "parts_dock", surfaces_);
  docks_ = &docks;
}

void InspectionPanels::add_tables_to(DockLayouts& docks) {
  table_dock_ = docks.add(tr("Patches"), "table_dock", tables_);
  connect(table_dock_, &QDockWidget::visibilityChanged, tables_, &PatchTablePanel::set_watched);
  docks.add(tr("Kept runs"), "runs_dock", runs_);
  docks.add(tr("Warnings"), "warnings_dock", warnings_);
}

void InspectionPanels::add_to(QMenuBar& bar) {
  QMenu* edit = bar.addMenu(tr("&Edit"));
  edit->setObjectName("edit_menu");
  QAction* undo = undo_.createUndoAction(this, tr("Undo"));
  undo->setObjectName("undo");
  undo->setShortcut(QKeySequence(QStringLiteral("Ctrl+Z")));
  QAction* redo = undo_.createRedoAction(this, tr("Redo"));
  redo->setObjectName("redo");
  redo->setShortcuts(
      {QKeySequence(QStringLiteral("Ctrl+Y")), QKeySequence(QStringLiteral("Ctrl+Shift+Z"))});
  const auto enable_undo = [undo](bool can) { enable_if(*undo, can, tr("Nothing to undo")); };
  const auto enable_redo = [redo](bool can) { enable_if(*redo, can, tr("Nothing to redo")); };
  connect(&undo_, &QUndoStack::canUndoChanged, this, enable_undo);
  connect(&undo_, &QUndoStack::canRedoChanged, this, enable_redo);
  enable_undo(undo_.canUndo());
  enable_redo(undo_.canRedo());
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  QAction* find = edit->addAction(
      tr("Find a patch"), this,
      [this] {
        table_dock_->show();
        table_dock_->raise();
        tables_->begin_search();
      },
      QKeySequence::Find);
  find->setObjectName("find_patch");
  selecting_->add_to(*edit);
  compare_->add_to(*bar.addMenu(tr("&Compare")));
}

void InspectionPanels::show_scene(const LoadedScene& loaded) {
  materials_->show_scene(loaded.scene);
  selecting_->show_scene(loaded.scene);
  warnings_->show_scene(loaded.scene);
  tables_->clear();
  surfaces_->show_scene(loaded.scene);
  paths_->clear();
}

void InspectionPanels::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  materials_->show_state();
  paths_->show_snapshot(snapshot);
  surfaces_->show_snapshot(snapshot);
  tables_->show_snapshot(std::move(snapshot));
}

void InspectionPanels::follow_links(PatchInspector& inspector, ReceivedView& received) {
  connect(&inspector, &PatchInspector::panel_wanted, this,
          [this](const std::string& panel) { docks_->bring_to_front(panel); });
  connect(&inspector, &PatchInspector::table_wanted, this, [this](bool partners) {
    docks_->bring_to_front("table");
    tables_->show_selected(partners);
  });
  connect(&inspector, &PatchInspector::directions_wanted, &received,
          [this, &received](const std::vector<PatchId>& sources) {
            docks_->bring_to_front("received");
            received.mark_sources(sources);
          });
}

ErrorPage& InspectionPanels::errors() const { return *surfaces_->errors(); }

void InspectionPanels::show_errors() {
  docks_->bring_to_front("parts");
  surfaces_->show_errors();
}

bool InspectionPanels::busy() const { return paths_->busy() || surfaces_->busy(); }

}  // namespace transillum::viewer
