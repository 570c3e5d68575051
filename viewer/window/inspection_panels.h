// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "colors/color_choice.h"
#include "model/relighting.h"
#include "model/snapshot.h"
#include "state/selection.h"

class QDockWidget;
class QMenuBar;

namespace transillum::viewer {

class CompareActions;
class DockLayouts;
class MaterialPanel;
class PatchTablePanel;
class SolveRunner;

/// What serves to look into a scene beside its picture: tables of patches, materials to be changed,
/// runs to be compared; with their docks and menus.
class InspectionPanels : public QObject {
  Q_OBJECT

 public:
  InspectionPanels(Selection& selection, ColorChoice& colors, SolveRunner& runner,
                   QWidget* window);

  void add_materials_to(DockLayouts& docks);
  void add_tables_to(DockLayouts& docks);
  /// Edit and Compare.
  void add_to(QMenuBar& bar);

  void show_scene(const LoadedScene& loaded);
  /// What the views are to show of a snapshot of the solver: with the light of changed materials.
  std::shared_ptr<const SolverSnapshot> lit(std::shared_ptr<const SolverSnapshot> snapshot);
  /// Of lit().
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  bool up_to_date() const { return !relighting_.busy(); }
  MaterialEdits& edits() { return relighting_.edits(); }

 signals:
  /// lit() gives another light for this snapshot of the solver.
  void light_changed(std::shared_ptr<const transillum::viewer::SolverSnapshot> snapshot);
  void failed(const QString& message);

 private:
  Relighting relighting_;
  std::shared_ptr<const SolverSnapshot> newest_;
  MaterialPanel* materials_;
  PatchTablePanel* tables_;
  CompareActions* compare_;
  QDockWidget* table_dock_ = nullptr;
};

}  // namespace transillum::viewer
