// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "model/snapshot.h"
#include "state/hidden_patches.h"
#include "state/selection.h"

class QAction;
class QMenu;

namespace transillum::viewer {

/// Selects patches that belong together, and hides or isolates the selected patches.
class SelectionActions : public QObject {
  Q_OBJECT

 public:
  SelectionActions(Selection& selection, HiddenPatches& hidden, QObject* parent = nullptr);

  void add_to(QMenu& menu) const;
  void show_scene(std::shared_ptr<const Scene> scene);

 private:
  /// Selects all patches for which belongs(patch) holds.
  template <class Belongs>
  void select_where(const Belongs& belongs);
  void show_state();

  Selection& selection_;
  HiddenPatches& hidden_;
  std::shared_ptr<const Scene> scene_;
  QAction *material_, *group_, *face_, *hide_, *isolate_, *show_all_;
};

}  // namespace transillum::viewer
