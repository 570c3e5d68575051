// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <optional>

#include "map/section_view.h"
#include "window/editing/scene_edits.h"

namespace transillum::viewer {

/// Segments of the panel Section are dragged: the object that a segment belongs to is moved, or
/// turned and stretched about the end that is not held. Of the room itself, which encloses all
/// else, a face alone is moved. Moves are across the axis along which the section looks.
class SectionDrag : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  SectionDrag(SceneEdits& edits, SectionView& view);

 private:
  void begin(const SectionView::Grip& grip);
  void move_to(const Vec2& to);
  void end();
  bool is_cut_off(const Vec3& end, int axis) const;

  SceneEdits& edits_;
  SectionView& view_;
  /// The points of space that are dragged, as they were at first, m.
  struct Held {
    Vec3 held, center;
    std::optional<Vec3> fixed;
    int axis = 0;  ///< along which the section looks
  };
  std::optional<Held> held_;
  bool was_active_ = false;
  SceneEdits::Reach reach_before_ = SceneEdits::Reach::object;
};

}  // namespace transillum::viewer
