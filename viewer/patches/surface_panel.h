// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <string>
#include <vector>

#include "model/requests/power_tables.h"
#include "model/requests/relighting.h"
#include "patches/patch_table.h"
#include "radiosity/analysis/power_table.h"
#include "state/hidden_patches.h"
#include "state/selection.h"
#include "support/newest_result.h"

class QAction;
class QTabWidget;
class QTimer;

namespace transillum::viewer {

class ColorChoice;
class ErrorPage;

/// The groups and the materials of the scene with their powers, the powers that they exchange, and
/// the errors of surfaces.
/// A row selects its patches; actions hide or isolate them, and make them emit or reflect.
class SurfacePanel : public QWidget {
  Q_OBJECT

 public:
  SurfacePanel(Relighting& relighting, Selection& selection, HiddenPatches& hidden,
               ColorChoice& colors, QWidget* parent = nullptr);

  void show_scene(std::shared_ptr<const Scene> scene);
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  /// While the panel is hidden, nothing is added up.
  void set_watched(bool watched);
  /// Whether the tables wait for sums.
  bool busy() const;
  ErrorPage* errors() const { return errors_; }
  /// Turns to the errors.
  void show_errors();

 signals:
  void form_factors_requested();
  void failed(const QString& message);
  /// A target of MaterialEdits has been made to emit or to reflect.
  void target_changed(const std::string& target);

 private:
  TablePage add_page(const QString& title, const char* name);
  QWidget* make_buttons();
  QAction* add_action(const char* name, const QString& text, const QString& tip, const char* key,
                      void (SurfacePanel::*what)());
  void refresh();
  void show_tables(std::shared_ptr<const PowerTables> tables);
  void show_surfaces(const TablePage& page, const PowerTable& table, SurfaceKind by);
  void show_exchanges();
  void show_state();
  void clear();

  /// The part of the current row; null without one, and on other pages than groups and materials.
  const SurfacePower* current() const;
  SurfaceKind current_kind() const;
  std::vector<PatchId> patches_of(const SurfacePower& surface) const;
  /// The part's target of MaterialEdits; empty for the patches of no group.
  std::string target_of(const SurfacePower& surface) const;
  void select_current();
  void hide_current();
  void isolate_current();
  void make_emit();
  void make_reflect();
  void copy_name();

  Relighting& relighting_;
  Selection& selection_;
  HiddenPatches& hidden_;
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::shared_ptr<const PowerTables> tables_;
  QTabWidget* tabs_;
  TablePage groups_, materials_, exchanges_;
  ErrorPage* errors_;
  QWidget* buttons_;  ///< actions of groups and materials
  QAction *select_, *hide_, *isolate_, *emit_, *reflect_, *copy_;
  bool watched_ = false;
  bool selects_ = false;   ///< while the panel itself changes the selection
  QTimer* refresh_timer_;  ///< limits how often powers are added up
  NewestResult<std::shared_ptr<const SolverSnapshot>, PowerTables> counter_;
};

}  // namespace transillum::viewer
