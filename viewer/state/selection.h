// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "transillum/scene.h"

namespace transillum::viewer {

/// The patch that all views highlight. Views follow it and do not refer to each other.
class Selection : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// no_patch when nothing is selected.
  PatchId patch() const { return patch_; }
  void select(PatchId patch);

 signals:
  void changed(transillum::PatchId patch);

 private:
  PatchId patch_ = no_patch;
};

}  // namespace transillum::viewer
