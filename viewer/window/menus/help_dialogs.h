// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

class QWidget;

namespace transillum::viewer {

/// Shows name, version, authors of the method and license, until it is closed.
void show_about(QWidget* parent);

}  // namespace transillum::viewer
