// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <vector>

#include "state/initial_view.h"

class QUndoStack;

namespace transillum::viewer {

/// The sides that a scene can be looked at from.
enum class Side { front, back, left, right, top, bottom };

/// The whole of `scene` from a side; which way is up is as in its initial view.
ViewPoint standard_view(const Scene& scene, Side side, double aspect);
/// The whole of `scene` from where `from` looks at it.
ViewPoint fitting_view(const Scene& scene, const ViewPoint& from, double aspect);
/// One patch, near, from where `from` looks; from its lit side where that would show its back.
ViewPoint patch_view(const Scene& scene, PatchId patch, const ViewPoint& from);

/// Places of the camera that the user keeps.
class CameraBookmarks : public QObject {
  Q_OBJECT

 public:
  struct Bookmark {
    QString name;
    ViewPoint view;
  };
  using QObject::QObject;

  const std::vector<Bookmark>& all() const { return bookmarks_; }
  /// Where changes can be taken back, but for set(); null: nowhere.
  void set_undo_stack(QUndoStack* undo) { undo_ = undo; }
  /// Named by a number that is free where there is no name.
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
