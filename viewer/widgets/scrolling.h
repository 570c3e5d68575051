// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

class QApplication;
class QWidget;

namespace transillum::viewer {

/// A scroll area around `content`, whose width does not depend on it.
QWidget* scrollable(QWidget* content);
/// Scrolls the area around `part`, if any, until it is visible.
void scroll_to(QWidget* part);
/// The wheel changes a combo box, a spin box or a slider only while it has the keyboard focus;
/// otherwise it scrolls what is around it. For all windows; repeated calls have no effect.
void guard_wheel(QApplication& application);

}  // namespace transillum::viewer
