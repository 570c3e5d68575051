// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What the menu Help shows.
#pragma once

#include <QString>
#include <vector>

class QWidget;
class QMainWindow;

namespace transillum::viewer {

/// Shows name, version, authors of the method and license, until it is closed.
void show_about(QWidget* parent);

/// Shows the user guide in a non-modal dialog; its links lead to its pages and to the glossary.
void show_guide(QWidget& parent);

/// All settings of a solve with type, default and description, as a page of HTML.
QString setting_page();
/// Shows that page in a non-modal dialog.
void show_settings(QWidget& parent);

/// A key of the window and what it does.
struct KeyUse {
  QString keys;
  QString text;
  bool enabled = true;  ///< whether the action of the key is enabled now
};
struct KeySection {
  QString menu;
  std::vector<KeyUse> keys;
};

/// All keys of the window's menus, in the order of the menus; read from the actions.
std::vector<KeySection> keys_of(const QMainWindow& window);
/// All keys as a page of HTML in two columns, with the functions of the pointer.
QString key_page(const QMainWindow& window);
/// Shows that page in a non-modal dialog.
void show_keys(QMainWindow& window);

}  // namespace transillum::viewer
