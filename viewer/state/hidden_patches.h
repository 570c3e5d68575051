// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <span>
#include <vector>

#include "transillum/scene.h"

class QUndoStack;

namespace transillum::viewer {

/// The patches that the 3-D view omits, so that the patches behind them are seen. They still take
/// part in the solve.
class HiddenPatches : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Changes can be undone there, except reset(). Without a stack, they cannot.
  void set_undo_stack(QUndoStack* undo) { undo_ = undo; }
  /// Begins with a new scene, or a saved state.
  /// @param hidden  its hidden patches, each below `patches`
  void reset(PatchId patches, std::span<const PatchId> hidden = {});
  /// Whether each patch is hidden, one per patch.
  const std::vector<bool>& flags() const { return flags_; }
  bool hidden(PatchId patch) const;
  bool any() const;
  void hide(std::span<const PatchId> patches);
  /// Hides all other patches.
  void isolate(std::span<const PatchId> patches);
  void show_all();

 signals:
  void changed();

 private:
  void change(const QString& what, std::vector<bool> flags);

  std::vector<bool> flags_;
  QUndoStack* undo_ = nullptr;
};

}  // namespace transillum::viewer
