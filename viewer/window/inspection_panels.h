// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "colors/color_choice.h"
#include "model/requests/relighting.h"
#include "model/snapshot.h"
#include "radiosity/form_factors/light_paths.h"
#include "state/hidden_patches.h"
#include "state/selection.h"

class QDockWidget;
class QMenuBar;
class QUndoStack;

namespace transillum::viewer {

class CompareActions;
class DockLayouts;
class ErrorPage;
class MaterialPanel;
class SurfacePanel;
class PatchInspector;
class PatchTablePanel;
class ReceivedView;
class PathPanel;
class KeptRunPanel;
class SelectionActions;
class WarningList;
struct SharedState;

/// The panels that inspect a scene: tables of patches, materials to change, kept runs to compare;
/// with their docks and menus.
class InspectionPanels : public QObject {
  Q_OBJECT

 public:
  InspectionPanels(SharedState& state, HiddenPatches& hidden, QWidget* window);

  void add_materials_to(DockLayouts& docks);
  /// Adds what is about the light of the selected patch, and the panel `received` among it.
  void add_light_to(DockLayouts& docks, QWidget& received);
  void add_tables_to(DockLayouts& docks);
  /// Opens what the links of an inspector name. The docks have the panels.
  void follow_links(PatchInspector& inspector, ReceivedView& received);
  /// Adds the menus Edit and Compare.
  void add_to(QMenuBar& bar);

  /// Whether a panel still waits for its content.
  bool busy() const;
  MaterialPanel& materials() const { return *materials_; }
  ErrorPage& errors() const;
  /// Turns the panel "Surfaces" to the errors, and brings it to the front.
  void show_errors();

  void show_scene(const LoadedScene& loaded);
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);

 signals:
  void failed(const QString& message);
  /// Passes WarningList::face_chosen() and KeptRunPanel::patch_chosen() on.
  void face_chosen();
  /// Passes PathPanel::paths_shown() on.
  void paths_shown(std::shared_ptr<const transillum::LightPaths> paths, int emphasized);

 private:
  QUndoStack& undo_;
  Relighting& relighting_;
  MaterialPanel* materials_;
  PatchTablePanel* tables_;
  SurfacePanel* surfaces_;
  PathPanel* paths_;
  WarningList* warnings_;
  CompareActions* compare_;
  KeptRunPanel* runs_;
  SelectionActions* selecting_;
  QDockWidget *table_dock_ = nullptr, *material_dock_ = nullptr;
  DockLayouts* docks_ = nullptr;  ///< set by add_light_to()
};

}  // namespace transillum::viewer
