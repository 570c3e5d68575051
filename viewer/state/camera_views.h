// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <optional>
#include <span>
#include <vector>

#include "transillum/scene.h"

class QUndoStack;

namespace transillum::viewer {

/// A camera position, meters in scene coordinates.
struct ViewPoint {
  Vec3 eye, target, up;
  double view_angle = 30;  ///< vertical, degrees
  double radius = 1;       ///< radius of the region of interest around `target`, meters

  friend bool operator==(const ViewPoint&, const ViewPoint&) = default;
};

/// A direction along a coordinate axis.
struct NamedAxis {
  const char* name;  ///< such as "+z"
  Vec3 direction;
};
/// All six.
std::span<const NamedAxis> named_axes();

/// The view of a scene after it is opened. Back faces are not drawn, so a closed room is viewed
/// from outside, through its nearest wall.
/// @param aspect  width / height of the picture
/// @param up  the vertical, unit; if it is not set, the vertical of the built-in scene, or +y
ViewPoint initial_view(const Scene& scene, double aspect, const std::optional<Vec3>& up = {});

/// A view of the whole scene, with the eye in the direction `toward_eye` from its center.
/// @param view_angle  vertical, degrees
ViewPoint view_of_all(const Scene& scene, const Vec3& toward_eye, const Vec3& up, double view_angle,
                      double aspect);

/// Sides of a scene for standard views.
enum class Side { front, back, left, right, top, bottom };

/// A view of the whole scene from a side.
/// @param aspect, up  as of its initial view
ViewPoint standard_view(const Scene& scene, Side side, double aspect,
                        const std::optional<Vec3>& up = {});
/// A view of the whole scene in the viewing direction of `from`.
ViewPoint fitting_view(const Scene& scene, const ViewPoint& from, double aspect);
/// A close view of one patch in the viewing direction of `from`, turned to the front of the patch
/// if needed.
ViewPoint patch_view(const Scene& scene, PatchId patch, const ViewPoint& from);

/// The view from the same eye, whose angle across the smaller side of the picture stays.
/// @param before, now  width / height of the picture
ViewPoint widened(const ViewPoint& from, double before, double now);

/// The view after the eye has moved around the target: about `vertical` by `azimuth`, and up by
/// `elevation`, to at most 89 degrees against the horizontal. `up` of the view is `vertical`, so
/// that it is upright.
/// @param vertical  unit vector
/// @param azimuth, elevation  degrees
ViewPoint turned(const ViewPoint& from, const Vec3& vertical, double azimuth, double elevation);

/// The user's list of camera positions.
class CameraBookmarks : public QObject {
  Q_OBJECT

 public:
  struct Bookmark {
    QString name;
    ViewPoint view;
  };
  using QObject::QObject;

  const std::vector<Bookmark>& all() const { return bookmarks_; }
  /// Changes can be undone there, except set(). Without a stack, they cannot.
  void set_undo_stack(QUndoStack* undo) { undo_ = undo; }
  /// @param name  if it is empty, "View" and an unused number
  void add(const ViewPoint& view, const QString& name = {});
  void rename(std::size_t k, const QString& name);
  void remove(std::size_t k);
  void clear();
  void set(std::vector<Bookmark> bookmarks);

 signals:
  void changed();

 private:
  void change(const QString& what, std::vector<Bookmark> bookmarks);
  bool has(const QString& name) const;

  std::vector<Bookmark> bookmarks_;
  QUndoStack* undo_ = nullptr;
};

}  // namespace transillum::viewer
