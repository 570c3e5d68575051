// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <vector>

class QMainWindow;

namespace transillum::viewer {

/// A key of the window and what it does now.
struct KeyUse {
  QString keys;
  QString text;
  bool enabled = true;  ///< it does something as things stand
};
struct KeyGroup {
  QString menu;
  std::vector<KeyUse> keys;
};

/// All keys of the window's menus, in their order: made of the actions themselves.
std::vector<KeyGroup> keys_of(const QMainWindow& window);
/// The same as a page of HTML in two columns, with what the pointer does.
QString key_page(const QMainWindow& window);
/// Shows that page until it is closed; the window can be used beside it.
void show_keys(QMainWindow& window);

}  // namespace transillum::viewer
