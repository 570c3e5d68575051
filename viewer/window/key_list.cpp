// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/key_list.h"

#include <QAction>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>

#include "widgets/page_dialog.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QString plain(QString text) { return text.remove('&'); }

void add_keys(const QMenu& menu, std::vector<KeyUse>& keys) {
  for (const QAction* action : menu.actions()) {
    if (action->menu()) {
      add_keys(*action->menu(), keys);
      continue;
    }
    QStringList shortcuts;
    for (const QKeySequence& key : action->shortcuts()) {
      shortcuts << key.toString(QKeySequence::NativeText);
    }
    if (!shortcuts.isEmpty()) {
      keys.push_back({shortcuts.join(' '), plain(action->text()), action->isEnabled()});
    }
  }
}

// The uses of the pointer, and the keys that belong to one view; no action has them.
KeyGroup pointer_group() {
  const auto tr = [](const char* text) { return QMainWindow::tr(text); };
  return {
      tr("Pointer"),
      {{tr("Scene"), tr("drag: rotate; Shift+drag or middle button: pan; wheel: zoom; click: "
                        "select a patch; Ctrl+click: add it, or remove it")},
       {tr("Color bar"), tr("drag: select the patches with values in a range")},
       {tr("Map"), tr("drag: pan; wheel: zoom; double-click: fit; click: select a patch and "
                      "list the patches on its line; right-click: run to a point")},
       {tr("Timeline"), tr("drag: go to a step; Shift+drag: step by step; arrow keys: one step, "
                           "with Ctrl one direction")},
       {tr("Kept runs"), tr("F2 or double-click: rename; Del: remove")},
       {tr("Groups"), tr("Return: select the patches of the row; E: make it emit; R: reflect")},
       {tr("Directions"), tr("drag: rotate the sphere; click: go to a direction")}}};
}

QString html(const KeyGroup& group) {
  QString rows = QStringLiteral("<h3>%1</h3><table cellspacing=0 cellpadding=3>")
                     .arg(group.menu.toHtmlEscaped());
  for (const KeyUse& key : group.keys) {
    rows += QStringLiteral(
                "<tr><td style='white-space: pre'><b>%1</b>&nbsp;&nbsp;</td>"
                "<td style='color: %3'>%2</td></tr>")
                .arg(key.keys.toHtmlEscaped(), key.text.toHtmlEscaped(),
                     (key.enabled ? theme::ink : theme::ink_dim).name());
  }
  return rows + QStringLiteral("</table>");
}

}  // namespace

std::vector<KeyGroup> keys_of(const QMainWindow& window) {
  std::vector<KeyGroup> groups;
  for (const QAction* action : window.menuBar()->actions()) {
    if (!action->menu()) {
      continue;
    }
    KeyGroup group{plain(action->text()), {}};
    add_keys(*action->menu(), group.keys);
    if (!group.keys.empty()) {
      groups.push_back(std::move(group));
    }
  }
  return groups;
}

QString key_page(const QMainWindow& window) {
  std::vector<KeyGroup> groups = keys_of(window);
  groups.push_back(pointer_group());
  std::size_t rows = 0, placed_rows = 0;
  for (const KeyGroup& group : groups) {
    rows += group.keys.size() + 2;
  }
  QString columns[2];
  for (const KeyGroup& group : groups) {
    columns[2 * placed_rows < rows ? 0 : 1] += html(group);
    placed_rows += group.keys.size() + 2;
  }
  return QStringLiteral(
             "<table width='100%'><tr><td width='50%' valign='top'>%1</td>"
             "<td valign='top'>%2</td></tr></table>")
      .arg(columns[0], columns[1]);
}

void show_keys(QMainWindow& window) {
  (new PageDialog("keys", QMainWindow::tr("Keys and mouse"), key_page(window), window))->show();
}

}  // namespace transillum::viewer
