// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/camera_menu.h"

#include <QAction>
#include <QInputDialog>
#include <QMenu>

#include "scene/scene_view.h"

namespace transillum::viewer {

namespace {

constexpr int bookmark_keys = 9;

}  // namespace

CameraMenu::CameraMenu(SceneView& scene_view, CameraBookmarks& bookmarks, QWidget* parent)
    : QToolButton(parent), scene_view_(scene_view), bookmarks_(bookmarks) {
  setObjectName("camera");
  setText(tr("Look "));
  setToolTip(tr("Where the scene is looked from"));
  setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(tr("Look"), this);
  const auto add = [&](const char* name, const QString& text, const QKeySequence& key,
                       const auto& look) {
    QAction* action = menu->addAction(text, this, look, key);
    action->setObjectName(QString::fromLatin1(name));
  };
  add("view_first", tr("As at first"), Qt::Key_Home, [this] { scene_view_.reset_view(); });
  add("view_fit", tr("At all of it, from here"), QKeySequence(QStringLiteral("Shift+Home")),
      [this] { scene_view_.look_at_all(); });
  add("view_patch", tr("At the selected patch"), Qt::Key_Z,
      [this] { scene_view_.look_at_selected(); });
  menu->addSeparator();
  const auto add_side = [&](const char* name, const QString& text, Side side) {
    add(name, text, {}, [this, side] { scene_view_.look_from_side(side); });
  };
  add_side("view_front", tr("From the front"), Side::front);
  add_side("view_back", tr("From the back"), Side::back);
  add_side("view_left", tr("From the left"), Side::left);
  add_side("view_right", tr("From the right"), Side::right);
  add_side("view_top", tr("From above"), Side::top);
  add_side("view_bottom", tr("From below"), Side::bottom);
  menu->addSeparator();
  add("keep_view", tr("Keep this view"), QKeySequence(QStringLiteral("Ctrl+B")),
      [this] { bookmarks_.add(scene_view_.view_point()); });
  kept_ = menu->addMenu(tr("Kept views"));
  kept_->setObjectName("kept_views");
  setMenu(menu);
  connect(&bookmarks_, &CameraBookmarks::changed, this, &CameraMenu::fill_bookmarks,
          Qt::QueuedConnection);  // one of the menu's own actions may be the cause
  fill_bookmarks();
}

void CameraMenu::fill_bookmarks() {
  kept_->clear();
  kept_->setEnabled(!bookmarks_.all().empty());
  int number = 0;
  for (const CameraBookmarks::Bookmark& bookmark : bookmarks_.all()) {
    QAction* action = kept_->addAction(
        bookmark.name, this, [this, view = bookmark.view] { scene_view_.look_from(view); });
    if (++number <= bookmark_keys) {
      action->setShortcut(QKeySequence(QStringLiteral("Alt+%1").arg(number)));
    }
  }
  kept_->addSeparator();
  QMenu* rename = kept_->addMenu(tr("Rename"));
  rename->setObjectName("rename_view");
  QMenu* remove = kept_->addMenu(tr("Remove"));
  remove->setObjectName("remove_view");
  for (std::size_t k = 0; k < bookmarks_.all().size(); ++k) {
    const QString& name = bookmarks_.all()[k].name;
    rename->addAction(name, this, [this, k] { ask_for_name(k); });
    remove->addAction(name, this, [this, k] { bookmarks_.remove(k); });
  }
  remove->addSeparator();
  remove->addAction(tr("All of them"), &bookmarks_, &CameraBookmarks::clear);
}

void CameraMenu::ask_for_name(std::size_t k) {
  const QString name = QInputDialog::getText(this, tr("Rename a kept view"), tr("Name:"),
                                             QLineEdit::Normal, bookmarks_.all()[k].name);
  if (k < bookmarks_.all().size()) {
    bookmarks_.rename(k, name.trimmed());
  }
}

}  // namespace transillum::viewer
