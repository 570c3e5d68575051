// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "show_menu.h"

#include <QAction>
#include <QMenu>

namespace transillum::viewer {

ShowMenu::ShowMenu(QWidget* parent) : QToolButton(parent) {
  setObjectName("show");
  setText(tr("Show "));
  setToolTip(tr("What is drawn beside the coloured patches"));
  setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(this);
  menu->setToolTipsVisible(true);
  const auto add = [&](const char* name, const QString& text, const QString& tip) {
    QAction* action = menu->addAction(text);
    action->setObjectName(QString::fromLatin1(name));
    action->setToolTip(tip);
    action->setCheckable(true);
    return action;
  };
  outlines_ = add("show_outlines", tr("Outlines"), tr("The edges of the patches"));
  direction_ = add("show_direction", tr("Direction"),
                   tr("The latest direction as an arrow with its plane (D)"));
  direction_->setChecked(true);
  setMenu(menu);
}

}  // namespace transillum::viewer
