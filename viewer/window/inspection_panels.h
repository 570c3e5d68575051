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

/// The panels that inspect a scene: tables of patches, materials to change, a kept run to compare
/// with; with their docks and menus.
class InspectionPanels : public QObject {
  Q_OBJECT

 public:
  InspectionPanels(Relighting& relighting, Selection& selection, ColorChoice& colors,
                   SolveRunner& runner, QWidget* window);

  void add_materials_to(DockLayouts& docks);
  void add_tables_to(DockLayouts& docks);
  /// Adds the menus Edit and Compare.
  void add_to(QMenuBar& bar);

  MaterialPanel& materials() const { return *materials_; }

  void show_scene(const LoadedScene& loaded);
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);

 signals:
  void failed(const QString& message);

 private:
  Relighting& relighting_;
  MaterialPanel* materials_;
  PatchTablePanel* tables_;
  CompareActions* compare_;
  QDockWidget* table_dock_ = nullptr;
};

}  // namespace transillum::viewer
