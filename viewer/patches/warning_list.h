// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QListWidget>
#include <memory>

#include "state/selection.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// The warnings about a scene's file. A click selects the patches of the face that a warning is
/// about.
class WarningList : public QListWidget {
  Q_OBJECT

 public:
  explicit WarningList(Selection& selection, QWidget* parent = nullptr);

  void show_scene(std::shared_ptr<const Scene> scene);

 signals:
  /// The patches of a face have been selected.
  void face_chosen();

 private:
  void choose(const QListWidgetItem& item);

  Selection& selection_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace transillum::viewer
