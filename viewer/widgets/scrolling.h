// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

class QWidget;

namespace transillum::viewer {

/// A vertical scroll area around `content`, never narrower than it.
QWidget* scrollable(QWidget* content);
/// Scrolls the area around `part`, if any, until it is visible.
void scroll_to(QWidget* part);

}  // namespace transillum::viewer
