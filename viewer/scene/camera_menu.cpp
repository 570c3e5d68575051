// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/camera_menu.h"

#include <QAction>
#include <QInputDialog>
#include <QMenu>

#include "scene/scene_view.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr int bookmark_keys = 9;

}  // namespace

CameraMenu::CameraMenu(SceneView& scene_view, CameraBookmarks& bookmarks, QWidget* parent)
    : QToolButton(parent), scene_view_(scene_view), bookmarks_(bookmarks) {
  setObjectName("camera");
  setText(tr("Camera "));
  setToolTip(tr("Choose or save a viewpoint"));
  setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(tr("Camera"), this);
  const auto add = [&](const char* name, const QString& text, const QKeySequence& key,
                       const auto& move) {
    QAction* action = menu->addAction(text, this, move, key);
    action->setObjectName(QString::fromLatin1(name));
  };
  add("view_first", tr("Initial view"), Qt::Key_Home, [this] { scene_view_.reset_view(); });
  add("view_fit", tr("Fit the whole scene"), QKeySequence(QStringLiteral("Shift+Home")),
      [this] { scene_view_.fit_all(); });
  add("view_patch", tr("Fit the selected patch"), Qt::Key_Z,
      [this] { scene_view_.fit_selected(); });
  menu->addSeparator();
  const auto add_side = [&](const char* name, const QString& text, Side side) {
    add(name, text, {}, [this, side] { scene_view_.view_from_side(side); });
  };
  add_side("view_front", tr("From the front"), Side::front);
  add_side("view_back", tr("From the back"), Side::back);
  add_side("view_left", tr("From the left"), Side::left);
  add_side("view_right", tr("From the right"), Side::right);
  add_side("view_top", tr("From above"), Side::top);
  add_side("view_bottom", tr("From below"), Side::bottom);
  menu->addSeparator();
  turntable_ = menu->addAction(tr("Turntable"));
  turntable_->setObjectName("turntable");
  turntable_->setCheckable(true);
  turntable_->setShortcut(Qt::Key_U);
  turntable_->setToolTip(
      tr("A drag turns the scene about its vertical, which stays upright; "
         "otherwise about any axis, as a ball"));
  menu->setToolTipsVisible(true);
  connect(turntable_, &QAction::toggled, &scene_view_, &SceneView::set_turntable);
  menu->addSeparator();
  add("keep_view", tr("Save this view"), QKeySequence(QStringLiteral("Ctrl+B")),
      [this] { bookmarks_.add(scene_view_.view_point()); });
  saved_ = menu->addMenu(tr("Saved views"));
  saved_->setObjectName("kept_views");
  setMenu(menu);
  connect(&bookmarks_, &CameraBookmarks::changed, this, &CameraMenu::fill_bookmarks,
          Qt::QueuedConnection);  // an action of this menu may have changed them
  fill_bookmarks();
}

void CameraMenu::fill_bookmarks() {
  saved_->clear();
  enable_if(*saved_->menuAction(), !bookmarks_.all().empty(), tr("No view is saved"));
  int number = 0;
  for (const CameraBookmarks::Bookmark& bookmark : bookmarks_.all()) {
    QAction* action = saved_->addAction(
        bookmark.name, this, [this, view = bookmark.view] { scene_view_.set_view_point(view); });
    if (++number <= bookmark_keys) {
      action->setShortcut(QKeySequence(QStringLiteral("Alt+%1").arg(number)));
    }
  }
  saved_->addSeparator();
  QMenu* rename = saved_->addMenu(tr("Rename"));
  rename->setObjectName("rename_view");
  QMenu* remove = saved_->addMenu(tr("Remove"));
  remove->setObjectName("remove_view");
  for (std::size_t k = 0; k < bookmarks_.all().size(); ++k) {
    const QString& name = bookmarks_.all()[k].name;
    rename->addAction(name, this, [this, k] { ask_for_name(k); });
    remove->addAction(name, this, [this, k] { bookmarks_.remove(k); });
  }
  remove->addSeparator();
  remove->addAction(tr("All"), &bookmarks_, &CameraBookmarks::clear);
}

void CameraMenu::ask_for_name(std::size_t k) {
  const QString name = QInputDialog::getText(this, tr("Rename a saved view"), tr("Name:"),
                                             QLineEdit::Normal, bookmarks_.all()[k].name);
  if (k < bookmarks_.all().size()) {
    bookmarks_.rename(k, name.trimmed());
  }
}

}  // namespace transillum::viewer
