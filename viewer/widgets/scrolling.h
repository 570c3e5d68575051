// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

class QWidget;

namespace transillum::viewer {

/// `content` with a scroll bar where it is too high, and never too narrow for it.
QWidget* scrollable(QWidget* content);
/// Scrolls what is about `part`, if anything does, until it is seen.
void scroll_to(QWidget* part);

}  // namespace transillum::viewer
