// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/palette_actions.h"

#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDockWidget>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QPushButton>
#include <QRegularExpression>
#include <QTabBar>
#include <QToolButton>
#include <set>
#include <string>

#include "colors/quantity.h"
#include "scene/camera_menu.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "window/base/dock_layouts.h"
#include "window/base/open_scene.h"

namespace transillum::viewer {

namespace {

QString without_marks(QString text) { return text.remove('&'); }

QString keys_of(const QAction& action) {
  QStringList keys;
  for (const QKeySequence& key : action.shortcuts()) {
    keys << key.toString(QKeySequence::NativeText);
  }
  return keys.join(QLatin1Char(' '));
}

/// The reason why all actions of a menu are disabled.
struct Obstacle {
  bool exists = false;
  QString why = {};  ///< may be empty
};

/// The obstacle of what a control leads to, within another obstacle.
template <class Control>
Obstacle obstacle_of(const Control& control, const Obstacle& outer) {
  return outer.exists ? outer
                      : Obstacle{!control.isEnabled(), control.property(why_disabled).toString()};
}

/// @param taken  actions that the palette has already, or in another form
void add_action(QAction& action, const QString& place, const Obstacle& outer,
                std::set<const QAction*>& taken, std::vector<PaletteEntry>& entries) {
  if (action.isSeparator() || !action.isVisible() || action.text().isEmpty() ||
      !taken.insert(&action).second) {
    return;
  }
  const Obstacle obstacle = obstacle_of(action, outer);
  entries.push_back({without_marks(action.text()), place, keys_of(action), !obstacle.exists,
                     [action = QPointer<QAction>(&action)] {
                       if (action) {
                         action->trigger();
                       }
                     },
                     obstacle.why});
}

/// Adds the actions of a menu and of the menus in it. An action in a disabled menu is not possible.
void add_menu(QMenu& menu, const QString& place, const Obstacle& outer,
              std::set<const QAction*>& taken, std::vector<PaletteEntry>& entries) {
  emit menu.aboutToShow();  // some menus are filled then
  for (QAction* action : menu.actions()) {
    if (!action->menu()) {
      add_action(*action, place, outer, taken, entries);
    } else if (taken.insert(action).second) {
      add_menu(*action->menu(), place + QStringLiteral(" › ") + without_marks(action->text()),
               obstacle_of(*action, outer), taken, entries);
    }
  }
}

/// The text of a button, or where it has an icon alone the first line of its tool tip.
QString text_of(const QAbstractButton& button) {
  const QString text = without_marks(button.text()).trimmed();
  static const QRegularExpression rest(QStringLiteral("( \\(|\n|: ).*"),
                                       QRegularExpression::DotMatchesEverythingOption);
  return text.size() > 1 ? text : without_marks(button.toolTip()).remove(rest);
}

/// Whether a button does something by itself, rather than being a part of a field, list or tab.
bool is_command(const QAbstractButton& button, const QWidget& place) {
  const bool is_known = qobject_cast<const QToolButton*>(&button) ||
                        qobject_cast<const QPushButton*>(&button) ||
                        qobject_cast<const QCheckBox*>(&button);
  if (!is_known || !button.isVisibleTo(&place) || text_of(button).isEmpty()) {
    return false;
  }
  for (const QWidget* over = button.parentWidget(); over && over != &place;
       over = over->parentWidget()) {
    if (qobject_cast<const QTabBar*>(over) || qobject_cast<const QLineEdit*>(over) ||
        qobject_cast<const QAbstractSpinBox*>(over) || qobject_cast<const QComboBox*>(over) ||
        qobject_cast<const QAbstractItemView*>(over)) {
      return false;
    }
  }
  return true;
}

}  // namespace

PaletteActions::PaletteActions(const WindowFrame& frame, DockLayouts& docks)
    : QObject(&frame.window), frame_(frame), docks_(docks) {
  action_ = make_key_action(this, "command_palette_action", tr("Find a command…"),
                            tr("List everything that the window can do, narrowed by typing"),
                            QKeySequence(QStringLiteral("Ctrl+K")));
  connect(action_, &QAction::triggered, this, &PaletteActions::show);
}

void PaletteActions::show() {
  auto* palette = new CommandPalette(
      entries(), [this](const QString& query) { return patch_of(query); }, &frame_.window);
  palette->show();
}

std::vector<PaletteEntry> PaletteActions::entries() {
  std::vector<PaletteEntry> entries;
  std::set<const QAction*> taken{action_};
  // These actions show a panel or hide it; the palette always shows it.
  for (const QDockWidget* dock : frame_.window.findChildren<QDockWidget*>()) {
    taken.insert(dock->toggleViewAction());
  }
  for (const QAction* action : frame_.window.menuBar()->actions()) {
    if (action->menu()) {
      add_menu(*action->menu(), without_marks(action->text()), obstacle_of(*action, {}), taken,
               entries);
    }
  }
  for (const QToolButton* button :
       {frame_.page.findChild<QToolButton*>(QStringLiteral("show")),
        static_cast<QToolButton*>(frame_.page.findChild<CameraMenu*>())}) {
    add_menu(*button->menu(), button->text().trimmed(),
             obstacle_of(*button->menu()->menuAction(), obstacle_of(*button, {})), taken, entries);
  }
  add_panels(entries);
  add_quantities(entries);
  add_buttons(*frame_.page.scene_view()->parentWidget(), tr("Scene"), {}, taken, entries);
  for (const std::string& panel : docks_.panels()) {
    const QDockWidget* dock = dock_of(panel);
    add_buttons(*dock->widget(), dock->windowTitle(), panel, taken, entries);
  }
  add_other_actions(taken, entries);
  add_surfaces(entries);
  return entries;
}

const QDockWidget* PaletteActions::dock_of(const std::string& panel) const {
  return frame_.window.findChild<QDockWidget*>(QString::fromStdString(panel) +
                                               QStringLiteral("_dock"));
}

void PaletteActions::add_buttons(const QWidget& widget, const QString& place,
                                 const std::string& panel, std::set<const QAction*>& taken,
                                 std::vector<PaletteEntry>& entries) {
  for (QAbstractButton* button : widget.findChildren<QAbstractButton*>()) {
    const auto* tool = qobject_cast<const QToolButton*>(button);
    if (!is_command(*button, widget) ||
        (tool && tool->defaultAction() && !taken.insert(tool->defaultAction()).second)) {
      continue;
    }
    if (tool && tool->menu()) {
      if (taken.insert(tool->menu()->menuAction()).second) {
        add_menu(*tool->menu(), place + QStringLiteral(" › ") + text_of(*button),
                 obstacle_of(*tool->menu()->menuAction(), obstacle_of(*button, {})), taken,
                 entries);
      }
      continue;
    }
    entries.push_back({text_of(*button), place, button->shortcut().toString(), button->isEnabled(),
                       [this, panel, pressed = QPointer<QAbstractButton>(button)] {
                         if (pressed && !panel.empty()) {
                           docks_.bring_to_front(panel);
                         }
                         if (pressed) {
                           pressed->click();
                         }
                       },
                       button->property(why_disabled).toString()});
  }
}

void PaletteActions::add_other_actions(std::set<const QAction*>& taken,
                                       std::vector<PaletteEntry>& entries) {
  for (QAction* action : frame_.window.findChildren<QAction*>()) {
    if (!action->objectName().isEmpty() && !action->menu()) {
      add_action(*action, tr("Window"), {}, taken, entries);
    }
  }
}

void PaletteActions::add_panels(std::vector<PaletteEntry>& entries) {
  for (const std::string& panel : docks_.panels()) {
    entries.push_back({dock_of(panel)->windowTitle(), tr("Panel"), {}, true, [this, panel] {
                         docks_.bring_to_front(panel);
                       }});
  }
}

void PaletteActions::add_quantities(std::vector<PaletteEntry>& entries) {
  for (const QuantityTraits& traits : quantity_traits()) {
    entries.push_back(
        {tr("Show %1").arg(QCoreApplication::translate("Quantity", traits.name)),
         tr("Quantity"),
         {},
         frame_.state.scene.loaded() != nullptr,
         [this, quantity = traits.quantity] { frame_.state.colors.set_quantity(quantity); }});
  }
}

void PaletteActions::add_surfaces(std::vector<PaletteEntry>& entries) {
  const auto loaded = frame_.state.scene.loaded();
  if (!loaded) {
    return;
  }
  const auto add = [&](const QString& name, const QString& kind, auto belongs) {
    entries.push_back({tr("Select %1").arg(name), kind, {}, true, [this, loaded, belongs] {
                         if (loaded != frame_.state.scene.loaded()) {
                           return;  // another scene has been opened since
                         }
                         std::vector<PatchId> patches;
                         for (PatchId i = 0; i < loaded->scene->patch_count(); ++i) {
                           if (belongs(loaded->scene->patch(i))) {
                             patches.push_back(i);
                           }
                         }
                         frame_.state.selection.select_all(std::move(patches));
                       }});
  };
  constexpr std::size_t most_names = 2000;
  std::int32_t index = 0;
  for (const Material& material : loaded->scene->materials()) {
    if (!material.name.empty() && entries.size() < most_names) {
      add(QString::fromStdString(material.name), tr("Material"),
          [index](const Patch& patch) { return patch.material == index; });
    }
    ++index;
  }
  index = 0;
  for (const std::string& group : loaded->scene->groups()) {
    if (entries.size() < most_names) {
      add(QString::fromStdString(group), tr("Group"),
          [index](const Patch& patch) { return patch.group == index; });
    }
    ++index;
  }
}

std::vector<PaletteEntry> PaletteActions::patch_of(const QString& query) {
  bool is_number = false;
  const PatchId patch = query.section(QLatin1Char(' '), -1).toInt(&is_number);
  const auto loaded = frame_.state.scene.loaded();
  if (!is_number || !loaded || patch < 0 || patch >= loaded->scene->patch_count()) {
    return {};
  }
  return {{tr("Select patch %1").arg(patch), tr("Patch"), {}, true, [this, patch] {
             frame_.state.selection.select(patch);
           }}};
}

}  // namespace transillum::viewer
