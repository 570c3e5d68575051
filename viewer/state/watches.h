// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "visibility/map/map_history.h"

class QUndoStack;

namespace transillum::viewer {

/// A value of each step of a direction, to be followed over the steps.
struct Watch {
  enum class Kind {
    patch_area,      ///< area of `patch` in V after the step, m²
    closure_defect,  ///< defect of the step's receiver, 0 to 1; NaN if the step has no receiver
    map_size,        ///< number of polygons of V after the step
  };
  Kind kind = Kind::map_size;
  PatchId patch = no_patch;

  friend bool operator==(const Watch&, const Watch&) = default;
};

/// The watched values: entry 0 is the value before the first step, entry k + 1 the value of step k.
/// NaN stands for a step without a value.
std::vector<double> values_of(const Watch& watch, const MapHistory& history);
QString text_of(const Watch& watch);
/// The name of a kind in files.
const char* name_of(Watch::Kind kind);
std::optional<Watch::Kind> watch_kind(const std::string& name);

/// The watches of the open scene: patches of another scene have the same numbers.
class Watches : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;
  static constexpr std::size_t most = 6;

  /// Changes can be undone there, except set_list(). Without a stack, they cannot.
  void set_undo_stack(QUndoStack* undo) { undo_ = undo; }
  const std::vector<Watch>& list() const { return list_; }
  void set_list(std::vector<Watch> list);
  /// Empties the list if the scene is another one.
  void set_scene(const std::string& scene);
  /// Sets the list of a scene, which may be opened next.
  void set_list_of(const std::string& scene, std::vector<Watch> list);
  /// Adds a watch, unless it is in the list or the list has `most`.
  void add(const Watch& watch);
  void remove(std::size_t k);

 signals:
  void changed();

 private:
  void change(const QString& what, std::vector<Watch> list);

  std::string scene_, next_scene_;
  std::vector<Watch> list_, next_list_;
  QUndoStack* undo_ = nullptr;
};

}  // namespace transillum::viewer
