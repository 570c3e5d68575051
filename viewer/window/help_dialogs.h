// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

class QWidget;

namespace transillum::viewer {

void show_about(QWidget* parent);

}  // namespace transillum::viewer
