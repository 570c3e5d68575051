// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <vector>

#include "transillum/scene.h"

namespace transillum::viewer {

/// The patches that all views highlight. Views follow it and do not refer to each other. One of
/// them is the selected patch, which views of a single patch show.
class Selection : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// no_patch when nothing is selected.
  PatchId patch() const { return patch_; }
  /// All selected patches, ascending; patch() is one of them.
  const std::vector<PatchId>& patches() const { return patches_; }
  bool contains(PatchId patch) const;
  /// Selects one patch, or none.
  void select(PatchId patch);
  /// Adds a patch, which becomes patch(), or removes it. no_patch changes nothing.
  void toggle(PatchId patch);
  /// Selects several patches, ascending. patch() remains if it is one of them.
  void select_all(std::vector<PatchId> patches);

 signals:
  void changed(transillum::PatchId patch);  ///< patch() has changed
  void patches_changed();                   ///< patches() have changed; emitted after changed()

 private:
  void set(PatchId patch, std::vector<PatchId> patches);

  PatchId patch_ = no_patch;
  std::vector<PatchId> patches_;
};

}  // namespace transillum::viewer
