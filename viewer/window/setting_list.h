// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

class QWidget;

namespace transillum::viewer {

/// All settings of a solve with type, default and sentence, as a page of HTML.
QString setting_page();
/// Shows that page until it is closed.
void show_settings(QWidget& parent);

}  // namespace transillum::viewer
