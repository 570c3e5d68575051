// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The command palette and the menus of right clicks.
#include <QClipboard>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QSet>
#include <QTableView>
#include <QToolButton>
#include <QTreeWidget>

#include "patches/patch_table.h"
#include "solved_window.h"
#include "widgets/build.h"
#include "widgets/command_palette.h"
#include "widgets/theme.h"

namespace transillum::viewer::palette_test {

using namespace test;

namespace {

struct OpenPalette {
  QPointer<CommandPalette> dialog;
  QLineEdit* query;
  QTreeWidget* list;

  explicit OpenPalette(const TestWindow& window) {
    window.findChild<QAction*>("command_palette_action")->trigger();
    dialog = window.findChild<CommandPalette*>();
    query = dialog->findChild<QLineEdit*>("palette_query");
    list = dialog->findChild<QTreeWidget*>("palette_list");
  }
  QString first(const QString& text) const {
    query->clear();
    QTest::keyClicks(query, text);
    return list->topLevelItemCount() > 0 ? list->topLevelItem(0)->text(0) : QString();
  }
  bool closes_on_return() const {
    QTest::keyClick(query, Qt::Key_Return);
    return wait_for([this] { return dialog.isNull(); });
  }
};

/// The menu of a right click, once it is shown.
QMenu* popup_menu() {
  QMenu* menu = nullptr;
  (void)wait_for([&menu] {
    menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    return menu != nullptr;
  });
  return menu;
}

bool choose(const QMenu& menu, const QString& name) {
  const auto actions = menu.actions();
  const auto found = std::find_if(actions.begin(), actions.end(), [&](const QAction* action) {
    return action->objectName() == name;
  });
  if (found == actions.end() || !(*found)->isEnabled()) {
    return false;
  }
  (*found)->trigger();
  return true;
}

}  // namespace

class PaletteTest : public QObject {
  Q_OBJECT

 private slots:
  void words_fit_by_beginnings_then_parts_then_abbreviations() {
    const QString text = "Export the lesson as HTML";
    QCOMPARE(palette_misfit("", text), 0);
    QCOMPARE(palette_misfit("exp less", text), 0);
    QVERIFY(palette_misfit("port", text) > 0);
    QVERIFY(palette_misfit("exrt", text) > palette_misfit("port", text));
    QVERIFY(palette_misfit("lesson export", text) == 0);
    QVERIFY(palette_misfit("lesson video", text) < 0);
    QVERIFY(palette_misfit("xrt", text) < 0);
  }

  void does_what_is_typed() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready);
    {
      const OpenPalette palette(*shown.window);
      QCOMPARE(palette.first("15"), QString("Select patch 15"));
      QVERIFY(palette.closes_on_return());
    }
    QVERIFY(wait_for([&] { return shown.window->selection.patch() == 15; }));
    {
      const OpenPalette palette(*shown.window);
      QCOMPARE(palette.first("surfaces"), QString("Surfaces"));  // not a lesson about surfaces
      QCOMPARE(palette.first("compare engines"), QString("Compare engines"));
      QCOMPARE(palette.first("irradiance"), QString("Show Irradiance H"));
      QCOMPARE(palette.first("no such thing"), QString("Nothing has these words"));
      QTest::keyClick(palette.query, Qt::Key_Return);
      QVERIFY(palette.dialog);
      QCOMPARE(palette.first("shadow edges show"), QString("Shadow edges"));
      QCOMPARE(palette.first("events pan"), QString("Events"));
      save_picture(*palette.dialog, "palette");
      QVERIFY(palette.closes_on_return());
    }
    QVERIFY(
        wait_for([&] { return shown.window->findChild<QDockWidget*>("event_dock")->isVisible(); }));
    const Scene& scene = *shown.window->snapshot()->loaded->scene;
    const QString red = QString::fromStdString(scene.material(0).name);
    {
      const OpenPalette palette(*shown.window);
      QCOMPARE(palette.first(red + " material"), "Select " + red);
      QVERIFY(palette.closes_on_return());
    }
    QVERIFY(wait_for([&] { return shown.window->selection.patches().size() > 1; }));
    for (const PatchId i : shown.window->selection.patches()) {
      QCOMPARE(QString::fromStdString(scene.material(i).name), red);
    }
    {
      const OpenPalette palette(*shown.window);
      QVERIFY(palette.first("furnace built").startsWith("furnace"));
      QVERIFY(palette.closes_on_return());
    }
    QVERIFY(wait_for([&] { return shown.window->windowTitle().startsWith("furnace"); }));
  }

  void offers_the_buttons_of_panels() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready);
    shown.window->focus.show_whole();
    QVERIFY(wait_for([&] { return shown.window->focus.map() && shown.window->settled(); }));
    auto* receivers = shown.window->findChild<QToolButton*>("map_receivers");
    auto* map = shown.window->findChild<QDockWidget*>("map_dock");
    QVERIFY(receivers && map && receivers->isEnabled() && !receivers->isChecked());
    map->hide();
    {
      const OpenPalette palette(*shown.window);
      QCOMPARE(palette.first("receivers only"), QString("Receivers only"));
      QCOMPARE(palette.list->topLevelItem(0)->text(1), map->windowTitle());
      QVERIFY(palette.closes_on_return());
    }
    QVERIFY(wait_for([&] { return receivers->isChecked() && map->isVisible(); }));
    const OpenPalette palette(*shown.window);
    QSet<QString> offered;
    for (const auto* button : map->widget()->findChildren<QToolButton*>()) {
      if (button->isVisible() && !button->text().isEmpty() && !button->menu()) {
        const QString text = button->text().remove('&').trimmed();
        palette.query->setText(text + ' ' + map->windowTitle());
        QVERIFY2(!palette.list->findItems(text, Qt::MatchExactly).isEmpty(), qPrintable(text));
        offered << text;
      }
    }
    QVERIFY(offered.contains("Complete") && offered.contains("Zoom"));
    // An icon is named by its tool tip, an entry of a menu by itself.
    QCOMPARE(palette.first("show the whole map"), QString("Show the whole map"));
    QCOMPARE(palette.first("mark errors map"), QString("Mark errors"));
    // Every action of the window that is not hidden, whether a menu has it or not.
    for (const auto* action : shown.window->findChildren<QAction*>()) {
      const auto* dock = qobject_cast<QDockWidget*>(action->parent());
      if (action->objectName().isEmpty() || action->text().isEmpty() || action->menu() || dock ||
          !action->isVisible() || action->isSeparator() ||
          action->objectName() == "command_palette_action") {
        continue;
      }
      const QString text = QString(action->text()).remove('&');
      palette.query->setText(text.simplified());
      QVERIFY2(!palette.list->findItems(text, Qt::MatchExactly).isEmpty(), qPrintable(text));
    }
  }

  void shows_keys_and_fits_a_small_window() {
    QWidget small;
    small.resize(640, 400);
    auto* narrow = new CommandPalette(
        {}, [](const QString&) { return std::vector<PaletteEntry>(); }, &small);
    QVERIFY(narrow->width() < 640 && narrow->height() < 400);
    const SolvedWindow shown("furnace");
    const OpenPalette palette(*shown.window);
    QCOMPARE(palette.first("select the group"), QString("Select the group"));
    QCOMPARE(palette.list->topLevelItem(0)->text(2), QString("Ctrl+G"));
    // No patch is selected, so that this is not possible, and Return does nothing.
    QTest::keyClick(palette.query, Qt::Key_Return);
    QVERIFY(palette.dialog);
    QTest::keyClick(palette.query, Qt::Key_Escape);
    QVERIFY(wait_for([&] { return palette.dialog.isNull(); }));
  }

  void what_a_disabled_menu_has_is_disabled_for_its_reason() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready);
    QMenu* const outer = shown.window->menuBar()->actions().back()->menu()->addMenu("Outer");
    QAction* const action = outer->addMenu("Inner")->addAction("Action of a disabled menu");
    enable_if(*outer->menuAction(), false, "The reason of the test");
    QVERIFY(action->isEnabled());
    bool triggered = false;
    connect(action, &QAction::triggered, this, [&triggered] { triggered = true; });
    const OpenPalette palette(*shown.window);
    QCOMPARE(palette.first("action of a disabled menu"), QString("Action of a disabled menu"));
    QCOMPARE(palette.list->topLevelItem(0)->toolTip(0), QString("The reason of the test"));
    QTest::keyClick(palette.query, Qt::Key_Return);
    QVERIFY(palette.dialog);
    QVERIFY(!triggered);
  }

  void has_a_border_in_both_themes() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready);
    for (const bool dark : {false, true}) {
      theme::apply(*qApp, {.dark = dark});
      const OpenPalette palette(*shown.window);
      QVERIFY(palette.dialog->isVisible());
      const QImage image = palette.dialog->grab().toImage();
      const int right = image.width() - 1, bottom = image.height() - 1;
      for (const QPoint at : {QPoint(0, bottom / 2), QPoint(right, bottom / 2),
                              QPoint(right / 2, 0), QPoint(right / 2, bottom)}) {
        QCOMPARE(image.pixelColor(at), theme::accent);
      }
      save_picture(*palette.dialog, dark ? "palette-dark" : "palette-light");
      palette.dialog->close();
      QVERIFY(wait_for([&palette] { return palette.dialog.isNull(); }));
    }
    theme::apply(*qApp);
  }

  void a_right_click_in_the_scene_offers_what_a_patch_can_do() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready);
    QWidget* canvas = shown.scene_view->canvas();
    const QPoint center = canvas->rect().center();
    const PatchId patch = shown.scene_view->patch_at(center);
    QVERIFY(patch != no_patch);
    QTest::mouseClick(canvas, Qt::RightButton, {}, center);
    QMenu* menu = popup_menu();
    QVERIFY(menu);
    save_picture(*menu, "patch-menu");
    QCOMPARE(shown.window->selection.patch(), patch);
    QVERIFY(choose(*menu, "copy_number"));
    QCOMPARE(QGuiApplication::clipboard()->text(), QString::number(patch));
    QVERIFY(choose(*menu, "step_query"));
    QVERIFY(wait_for([&] {
      const auto& focus = shown.window->focus;
      const std::int32_t step = focus.position().step;
      return focus.map() && step >= 0 && focus.map()->history.step(step).patch == patch;
    }));
    QVERIFY(choose(*menu, "select_material"));
    QVERIFY(shown.window->selection.patches().size() > 1);
    QVERIFY(choose(*menu, "hide_selection"));
    QVERIFY(shown.window->views().page.hidden().hidden(patch));
    menu->close();
    shown.trigger("undo");
    QVERIFY(!shown.window->views().page.hidden().any());
  }

  void a_right_click_in_the_table_is_about_its_row() {
    const SolvedWindow shown("cornell-box");
    auto* table = shown.window->findChild<QTableView*>("patch_table");
    shown.window->views().docks.bring_to_front("table");
    QVERIFY(wait_for([&] { return table->model()->rowCount() > 3; }));
    emit table->customContextMenuRequested(table->visualRect(table->model()->index(3, 0)).center());
    QMenu* menu = popup_menu();
    QVERIFY(menu);
    QCOMPARE(shown.window->selection.patch(), qobject_cast<PatchTable*>(table->model())->patch(3));
    QVERIFY(choose(*menu, "show_paths"));
    QVERIFY(shown.window->findChild<QDockWidget*>("paths_dock")->isVisible());
    menu->close();
  }

  void values_of_charts_are_copied() {
    const SolvedWindow shown("furnace");
    shown.trigger("copy_values");
    QVERIFY(QGuiApplication::clipboard()->text().startsWith("chart,x,change"));
  }
};

const test::Registered registered("palette", test::run_as_viewer<PaletteTest>);

}  // namespace transillum::viewer::palette_test

#include "palette_test.moc"
