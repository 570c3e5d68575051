// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What the menu Help shows.
#pragma once

#include <QString>
#include <vector>

class QMainWindow;
class QMenu;

namespace transillum::viewer {

/// All settings of a solve with type, default and description, as a page of HTML.
QString setting_page();

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
/// Lets the menus of a window show the tool tips of their actions, which say why one is disabled.
void show_tips_of_menus(const QMainWindow& window);
/// Adds the guide, the keys, the settings and what the program is, each in a dialog.
void add_help_pages(QMenu& menu, QMainWindow& window);

}  // namespace transillum::viewer
