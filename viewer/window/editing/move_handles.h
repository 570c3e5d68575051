// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPolygonF>
#include <QWidget>
#include <optional>
#include <vector>

#include "scene/scene_view.h"
#include "window/editing/scene_edits.h"

namespace transillum::viewer {

class MovePanel;

/// Handles of the target of SceneEdits over the picture of the scene: arrows and squares move it,
/// arcs turn it, knobs scale it. They are drawn over the picture, not in it, so that they are never
/// hidden in the scene and never part of a saved picture. Keys move the target in steps.
class MoveHandles : public QWidget {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  MoveHandles(SceneEdits& edits, const MovePanel& panel);

  enum class Kind { move, slide, turn, scale };
  /// A handle: along or about an axis, or in the plane across it.
  struct Handle {
    Kind kind = Kind::move;
    int axis = 0;
    QPolygonF shape;  ///< logical pixels; a line, or the outline of a square

    /// Whether both do the same.
    bool is_like(const Handle& other) const { return kind == other.kind && axis == other.axis; }
  };
  /// The handles drawn; none without a target.
  std::vector<Handle> handles() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Drag {
    Handle handle;
    FacePlacement placement;  ///< at its start
    Vec3 center;
    double size = 0;                          ///< world_size()
    std::optional<Vec3> grip = std::nullopt;  ///< place of the handle under the pointer at first
  };

  void follow();
  bool press(const QPointF& position);
  void move_to(const QPointF& position, bool other_grid);
  bool take_key(int key, Qt::KeyboardModifiers modifiers);
  static bool is_own_key(int key);
  std::optional<Handle> handle_at(const QPointF& position) const;
  /// The point of a handle's line or plane under the pointer; not set where the line of sight
  /// misses it.
  std::optional<Vec3> grip_at(const Drag& drag, const QPointF& position) const;
  /// The length of an arrow, m: the same number of pixels at any distance.
  double world_size() const;
  /// The direction of a handle's axis; knobs follow the turn.
  static Vec3 axis_of(const Handle& handle, const Vec3& turn);
  void step_by(int axis, double steps);

  SceneEdits& edits_;
  const MovePanel& panel_;
  SceneView& view_;
  std::optional<Handle> hovered_;
  std::optional<Drag> drag_;
};

}  // namespace transillum::viewer
