// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QUndoStack>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::viewer {

/// A material by its name, and what it was changed to.
struct MaterialChange {
  std::string name;
  Rgb exitance;     ///< E, W/m²
  Rgb reflectance;  ///< rho, 0 to below 1
};

/// A scene's materials as the user has changed them; every change can be undone.
class MaterialEdits : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Starts over with a scene's own; there is nothing to undo then.
  void start_with(std::vector<Material> materials);
  const std::vector<Material>& materials() const { return now_; }
  const std::vector<Material>& originals() const { return originals_; }
  /// Whether any differs from the scene's own.
  bool any() const;

  /// E and rho of one material. Changes of one drag, from begin_drag() on, are undone as one.
  void set(int material, const Rgb& exitance, const Rgb& reflectance);
  void begin_drag() { ++drag_; }
  /// All as the scene has them.
  void restore();
  /// What differs from the scene's own.
  std::vector<MaterialChange> changes() const;
  /// The scene's own but for `changes`, as where a session begins: nothing can be undone.
  /// @return the names that no material has.
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
