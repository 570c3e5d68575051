// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QUndoStack>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::viewer {

/// A material by name, with its new values.
struct MaterialChange {
  std::string name;
  Rgb exitance;     ///< E, W/m²
  Rgb reflectance;  ///< rho, 0 to below 1
};

/// The materials of a scene with the user's changes, which can be undone.
///
/// Threads: the main thread only.
class MaterialEdits : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Sets the original materials of a scene and clears the undo stack.
  void start_with(std::vector<Material> materials);
  const std::vector<Material>& materials() const { return now_; }
  const std::vector<Material>& originals() const { return originals_; }
  /// Whether any material differs from the original.
  bool any() const;

  /// Sets E (W/m²) and rho of one material. Changes since begin_drag() are undone together.
  void set(int material, const Rgb& exitance, const Rgb& reflectance);
  void begin_drag() { ++drag_; }
  /// Restores all originals, as one undoable change.
  void restore();
  /// All materials that differ from the originals.
  std::vector<MaterialChange> changes() const;
  /// Sets the originals with `changes` and clears the undo stack.
  /// @return names in `changes` that no material has
  std::vector<std::string> start_over(const std::vector<MaterialChange>& changes);

  QUndoStack& undo_stack() { return undo_; }

 signals:
  void changed();

 private:
  class Change;
  void put(int material, const Rgb& exitance, const Rgb& reflectance);

  std::vector<Material> originals_, now_;
  int drag_ = 0;
  QUndoStack undo_;
};

}  // namespace transillum::viewer
