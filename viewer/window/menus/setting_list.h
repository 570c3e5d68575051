// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

class QWidget;

namespace transillum::viewer {

/// All settings of a solve with type, default and description, as a page of HTML.
QString setting_page();
/// Shows that page in a non-modal dialog.
void show_settings(QWidget& parent);

}  // namespace transillum::viewer
