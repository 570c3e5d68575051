// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The window as a whole: how much is on the screen in each layout, and what must not move or change
// by itself.
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QMainWindow>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QWheelEvent>
#include <cmath>

#include "lessons/lesson_panel.h"
#include "scene/color_controls.h"
#include "scene/show_menu.h"
#include "screen_checks.h"
#include "solved_window.h"
#include "window/base/view_state_applier.h"

namespace transillum::viewer::workspaces_test {

using namespace test;

namespace {

std::unique_ptr<TestWindow> window_of(const QSize& size) {
  auto window = make_window();
  window->resize(size);
  handle_posted();
  return window;
}

/// Opens the box as a user of the first page does, by the card of a layout.
bool begins(TestWindow& window, const char* layout) {
  window.findChild<QAction*>(layout)->trigger();
  return wait_for([&] { return window.snapshot() && window.snapshot()->progress.finished; }) &&
         comes_to_rest(window);
}

QList<QTabBar*> tab_bars(const QMainWindow& window) {
  QList<QTabBar*> bars;
  for (QTabBar* bar : window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    if (bar->isVisible()) {
      bars << bar;
    }
  }
  return bars;
}

/// By WCAG 2.1: relative luminance, and the contrast of two colors.
double luminance_of(const QColor& color) {
  const auto linear = [](double c) {
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}
double contrast(const QColor& a, const QColor& b) {
  const double x = luminance_of(a), y = luminance_of(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

/// Turns the wheel over a widget, as Qt does for the pointer.
void turn_wheel(QWidget& widget) {
  const QPointF place = widget.rect().center();
  QWheelEvent event(place, widget.mapToGlobal(place.toPoint()), {}, {0, -120}, Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(&widget, &event);
}

}  // namespace

class WorkspacesTest : public QObject {
  Q_OBJECT

 private slots:
  void few_controls_are_on_the_first_screen_data() {
    QTest::addColumn<QString>("layout");
    QTest::addColumn<int>("most");
    QTest::newRow("teach") << "layout_teach" << 30;
    QTest::newRow("inspect") << "layout_inspect" << 45;
    QTest::newRow("step") << "layout_debug" << 45;
  }
  void few_controls_are_on_the_first_screen() {
    QFETCH(QString, layout);
    QFETCH(int, most);
    for (const QSize& size : {small_screen, QSize(1600, 1000)}) {
      const auto window = window_of(size);
      QVERIFY(begins(*window, layout.toLatin1()));
      const QStringList controls = controls_of(*window);
      qInfo() << layout << size << controls.size();
      QVERIFY(controls.size() > 15);  // the count sees them
      QVERIFY2(controls.size() <= most, qPrintable(controls.join("; ")));
      save_picture(*window, QStringLiteral("%1-%2").arg(layout).arg(size.width()));
    }
  }

  void the_current_layout_is_marked() {
    const auto window = window_of(small_screen);
    const auto checked = [&] {
      QStringList names;
      for (const char* name : {"start", "layout_teach", "layout_inspect", "layout_debug"}) {
        if (window->findChild<QAction*>(name)->isChecked()) {
          names << name;
        }
      }
      return names;
    };
    QCOMPARE(checked(), QStringList("start"));
    for (const char* name : {"layout_debug", "layout_inspect", "layout_teach", "layout_teach"}) {
      window->findChild<QAction*>(name)->trigger();
      QCOMPARE(checked(), QStringList(name));
    }
    window->findChild<QAction*>("start")->trigger();
    QCOMPARE(checked(), QStringList("start"));
  }

  // The map is what the layout to step is about.
  void the_map_takes_half_of_the_window_in_step() {
    for (const QSize& size : {small_screen, QSize(1600, 1000)}) {
      const auto window = window_of(size);
      QVERIFY(begins(*window, "layout_debug"));
      const auto* map = window->findChild<QDockWidget*>("map_dock");
      const auto area = [](const QSize& s) { return 1.0 * s.width() * s.height(); };
      const double fraction = area(map->size()) / area(window->size());
      QVERIFY2(fraction >= 0.49, qPrintable(QString::number(fraction)));
      QVERIFY(window->views().map.canvas()->height() >= 240);
      QVERIFY(window->findChild<SceneView*>()->width() < map->width());
    }
  }

  void the_map_of_a_lesson_is_high_enough_on_a_small_screen() {
    const auto window = window_of(small_screen);
    window->views().lessons.show_page(2, 1);
    QVERIFY(comes_to_rest(*window));
    const int height = window->views().map.canvas()->height();
    QVERIFY2(height >= 240, qPrintable(QString::number(height)));
  }

  // A map of 100,000 patches takes a second and 180 MB.
  void maps_are_recorded_only_where_a_panel_shows_them() {
    const auto window = make_window(16);
    window->views().docks.arrange(Layout::inspect);
    window->scene.open("furnace", window->views().settings.options(), {Goal::Kind::finished});
    QVERIFY(wait_for([&] { return window->runner.state() == RunState::finished; }) &&
            comes_to_rest(*window));
    QVERIFY(!window->focus.map());
    window->views().docks.bring_to_front("map");
    QVERIFY(wait_for([&] { return window->focus.map() != nullptr; }));
  }

  // Where no lesson is about it, an arrow over a solved scene says nothing.
  void the_direction_leaves_the_scene_with_its_solve() {
    const auto window = window_of(small_screen);
    QVERIFY(begins(*window, "layout_inspect"));
    window->findChild<QAction*>("layout_teach")->trigger();
    QVERIFY(comes_to_rest(*window));
    Callout omega;
    omega.anchor = Callout::Anchor::direction;
    const auto shown = [&] {
      return window->findChild<SceneView*>()->anchor_of(omega).has_value();
    };
    QVERIFY(!shown());
    window->findChild<QAction*>("layout_debug")->trigger();
    QVERIFY(wait_for([&] { return window->focus.map() != nullptr; }));
    window->focus.go_to({0, 3, 2});
    QVERIFY(wait_for(shown));
    QVERIFY(wait_for([&] { return window->focus.arrived() && window->settled(); }));
    window->findChild<QAction*>("layout_teach")->trigger();
    QVERIFY(comes_to_rest(*window) && !shown());
    window->views().docks.bring_to_front("map");
    QVERIFY(wait_for(shown));
  }

  void the_algorithm_begins_with_a_whole_line() {
    const auto window = window_of(small_screen);
    QVERIFY(begins(*window, "layout_debug"));
    QVERIFY(wait_for([&] { return window->focus.map() != nullptr; }));
    auto* dock = window->findChild<QDockWidget*>("algorithm_dock");
    window->views().docks.bring_to_front("algorithm");
    const auto* area = qobject_cast<QScrollArea*>(dock->widget());
    QVERIFY(area);
    int checked = 0;
    for (const int step : {0, 5, 60, 300}) {
      window->focus.go_to({0, 3, step});
      QVERIFY(wait_for([&] { return window->focus.arrived() && window->settled(); }));
      handle_posted();
      for (const auto* line : area->widget()->findChildren<QLabel*>()) {
        if (!line->isVisible() || !line->text().contains(QString::fromUtf8("←"))) {
          continue;
        }
        const int above = line->mapTo(area->viewport(), QPoint()).y();
        QVERIFY2(above >= 0 || above + line->height() <= 0, qPrintable(line->text()));
        ++checked;
      }
    }
    QVERIFY(checked > 0);
  }

  void a_stack_has_at_most_four_tabs() {
    const auto window = window_of(small_screen);
    for (const char* layout : {"layout_teach", "layout_inspect", "layout_debug"}) {
      QVERIFY(begins(*window, layout));
      for (const std::string& panel : window->views().docks.panels()) {
        window->views().docks.bring_to_front(panel);
        handle_posted();
        const auto* dock = window->findChild<QDockWidget*>(QString::fromStdString(panel + "_dock"));
        QVERIFY2(dock->isVisible(), panel.c_str());
        for (QTabBar* bar : tab_bars(*window)) {
          QVERIFY2(bar->count() <= 4, panel.c_str());
          QVERIFY(!bar->usesScrollButtons());
          QVERIFY(bar->tabRect(bar->count() - 1).right() <= bar->width());
        }
      }
    }
  }

  void columns_keep_their_widths_whatever_they_show() {
    const SolvedWindow solved("rooms:n=2");
    QVERIFY(solved.ready);
    solved.window->resize(small_screen);
    QVERIFY(comes_to_rest(*solved.window));
    const QRect before = solved.scene_view->geometry();
    for (const PatchId patch : {0, 5, 17}) {
      solved.window->selection.select(patch);
      QVERIFY(comes_to_rest(*solved.window));
      QCOMPARE(solved.scene_view->geometry(), before);
    }
    // Longer values need another width; the column stays, and can be scrolled.
    auto* content = solved.window->findChild<QLabel*>("patch_id");
    content->setMinimumWidth(900);
    QVERIFY(comes_to_rest(*solved.window));
    QCOMPARE(solved.scene_view->geometry(), before);
  }

  void the_wheel_changes_only_what_has_the_focus() {
    const auto window = window_of(small_screen);
    window->show();
    QApplication::setActiveWindow(window.get());
    QVERIFY(begins(*window, "layout_inspect"));
    for (const std::string& panel : window->views().docks.panels()) {
      window->views().docks.bring_to_front(panel);
      handle_posted();
      for (auto* list : window->findChildren<QComboBox*>()) {
        if (!list->isVisible() || !list->isEnabled() || list->hasFocus()) {
          continue;
        }
        const int before = list->currentIndex();
        turn_wheel(*list);
        QVERIFY2(list->currentIndex() == before && !list->hasFocus(),
                 qPrintable(list->objectName()));
      }
      for (auto* field : window->findChildren<QSpinBox*>()) {
        const int before = field->value();
        if (field->isVisible() && field->isEnabled() && !field->hasFocus()) {
          turn_wheel(*field);
          QVERIFY2(field->value() == before, qPrintable(field->objectName()));
        }
      }
    }
    auto* quantity = window->findChild<QComboBox*>("quantity");
    quantity->setFocus();
    QVERIFY(wait_for([&] { return quantity->hasFocus(); }));
    const int before = quantity->currentIndex();
    turn_wheel(*quantity);
    QVERIFY(quantity->currentIndex() != before);
  }

  void the_keys_of_a_presenter_belong_to_the_lesson() {
    const auto window = window_of(small_screen);
    QApplication::setActiveWindow(window.get());
    LessonPanel& lessons = window->views().lessons;
    const int last = static_cast<int>(lessons.lessons().size()) - 1;
    const int end = static_cast<int>(at(lessons.lessons(), last).pages.size()) - 1;
    lessons.show_page(last, end);
    QVERIFY(comes_to_rest(*window));
    auto* quantity = window->findChild<QComboBox*>("quantity");
    quantity->setFocus();
    QVERIFY(wait_for([&] { return quantity->hasFocus(); }));
    const int before = quantity->currentIndex();
    QTest::keyClick(quantity, Qt::Key_PageDown);
    QCOMPARE(quantity->currentIndex(), before);
    QCOMPARE(lessons.page(), end);
    QTest::keyClick(quantity, Qt::Key_PageUp);
    QCOMPARE(lessons.page(), end - 1);
    QCOMPARE(quantity->currentIndex(), before);
  }

  void a_projector_shows_the_panel_that_the_page_needs() {
    const auto window = window_of(small_screen);
    window->views().lessons.show_page(1, 0);
    QVERIFY(comes_to_rest(*window));
    window->activateWindow();  // without a window manager, a closed menu leaves none active
    QVERIFY(wait_for([&] { return window->isActiveWindow(); }));
    QTest::keyClick(window.get(), Qt::Key_P);
    QVERIFY(wait_for([&] { return window->isFullScreen(); }, 20000));
    const auto* map = window->findChild<QDockWidget*>("map_dock");
    const auto* page = window->findChild<QDockWidget*>("lesson_dock");
    const auto* scene = window->findChild<SceneView*>();
    QVERIFY(wait_for([&] { return map->isVisible() && page->width() > scene->width(); }));
    QVERIFY(scene->isVisible() && !window->findChild<QWidget*>("settings_dock")->isVisible());
    const auto is_wide = [&](const QWidget& view) { return view.width() > 0.25 * window->width(); };
    QVERIFY2(wait_for([&] { return is_wide(*map) && is_wide(*scene); }, 20000),
             qPrintable(QString("%1 %2").arg(map->width()).arg(scene->width())));
    save_picture(*window, "projector-panel");
    QTest::keyClick(window.get(), Qt::Key_PageDown);  // this page wants a large map
    const auto is_large = [&] {
      return scene->isVisible() && map->width() > page->width() &&
             map->width() > 1.5 * scene->width();
    };
    QVERIFY2(wait_for(is_large, 20000),
             qPrintable(QString("%1 %2").arg(map->width()).arg(scene->width())));
    save_picture(*window, "projector-large");
    QTest::keyClick(window.get(), Qt::Key_Escape);
    QVERIFY(wait_for([&] { return !window->isFullScreen(); }));
    auto* leave = window->findChild<QToolButton*>("leave_full_screen");
    QVERIFY(!leave->isVisible());
    QTest::keyClick(window.get(), Qt::Key_P);
    QVERIFY(wait_for([&] { return window->isFullScreen() && leave->isVisible(); }, 20000));
    QVERIFY(window->rect().contains(leave->geometry()));
    leave->click();
    QVERIFY(wait_for([&] { return !window->isFullScreen(); }));
  }

  void several_bars_share_one_place() {
    const auto window = window_of(small_screen);
    window->open("furnace");
    QVERIFY(comes_to_rest(*window));
    ScenePage& page = window->views().page;
    page.light_bar()->show_message(Banner::Kind::offer, "light");
    page.reading_bar()->show_message(Banner::Kind::offer, "reading");
    QVERIFY(page.light_bar()->isVisible() && !page.reading_bar()->isVisible());
    auto* next = page.light_bar()->findChild<QPushButton*>("next_message");
    QCOMPARE(next->text(), QString("1 of 2 ›"));
    next->click();
    QVERIFY(!page.light_bar()->isVisible() && page.reading_bar()->isVisible());
    window->show_failure("wrong");
    QVERIFY(page.banner()->isVisible() && !page.reading_bar()->isVisible());
    QCOMPARE(page.reading_bar()->text(), QString("reading"));
    // The first page shows only what is about the window.
    window->findChild<QAction*>("start")->trigger();
    QVERIFY(page.banner()->isVisible());
    page.banner()->dismiss();
    QVERIFY(!page.light_bar()->isVisible() && !page.reading_bar()->isVisible());
    window->findChild<QAction*>("start")->trigger();
    QVERIFY(page.light_bar()->isVisible());
    page.light_bar()->dismiss();
    QVERIFY(page.reading_bar()->isVisible());
    QVERIFY(!page.reading_bar()->findChild<QPushButton*>("next_message")->isVisible());
  }

  void a_lesson_leaves_nothing_behind() {
    const auto window = window_of(small_screen);
    window->open("furnace");
    QVERIFY(comes_to_rest(*window));
    const ShowMenu& show = *window->views().page.color_controls()->show_menu();
    const auto state = [&] {
      QStringList overlays;
      for (const Overlay overlay : all_overlays) {
        overlays << QString::number(show.overlay(overlay)->isChecked());
      }
      return overlays.join(' ') + QStringLiteral(" | %1 %2 %3 %4")
                                      .arg(static_cast<int>(window->colors.quantity()))
                                      .arg(show.clip()->choice().has_value())
                                      .arg(static_cast<int>(window->focus.phase()))
                                      .arg(window->views().settings.solve_options().directions);
    };
    const QString before = state();
    ViewState page;
    page.scene = "boards";
    page.options.solve.directions = 8;
    page.focus = FocusChoice{0, 1, 3, Phase::before};
    page.overlays = {Overlay::normals, Overlay::wireframe};
    page.clip = ClipPlane{};
    page.quantity = Quantity::irradiance;
    page.outlines = true;
    page.layout = Layout::teach;
    window->applier().show_page(page);
    QVERIFY(comes_to_rest(*window));
    QVERIFY(window->views().docks.current() == Layout::teach && state() != before);
    window->files().open_scene("furnace");
    QVERIFY(wait_for([&] { return window->scene.spec() == "furnace"; }));
    QVERIFY(comes_to_rest(*window));
    QCOMPARE(state(), before);
    QVERIFY(window->views().docks.current() == Layout::inspect);
  }

  void text_and_the_selected_tab_have_contrast_data() {
    QTest::addColumn<bool>("dark");
    QTest::newRow("light") << false;
    QTest::newRow("dark") << true;
  }
  void text_and_the_selected_tab_have_contrast() {
    QFETCH(bool, dark);
    theme::apply(*qApp, {dark, false});
    const QPalette palette = QApplication::palette();
    QStringList low;
    const auto check = [&](const char* what, const QColor& a, const QColor& b, double least) {
      if (contrast(a, b) < least) {
        low << QStringLiteral("%1: %2").arg(QLatin1String(what)).arg(contrast(a, b));
      }
    };
    constexpr double of_text = 4.5, of_marks = 3;
    for (const QColor& ground : {theme::window, theme::paper, theme::title}) {
      check("text", theme::ink, ground, of_text);
      check("dim text", theme::ink_dim, ground, of_text);
    }
    for (const auto group : {QPalette::Active, QPalette::Inactive}) {
      check("window", palette.color(group, QPalette::WindowText),
            palette.color(group, QPalette::Window), of_text);
      check("field", palette.color(group, QPalette::Text), palette.color(group, QPalette::Base),
            of_text);
      check("button", palette.color(group, QPalette::ButtonText),
            palette.color(group, QPalette::Button), of_text);
      check("hint", palette.color(group, QPalette::PlaceholderText),
            palette.color(group, QPalette::Base), of_text);
      check("selected", palette.color(group, QPalette::HighlightedText),
            palette.color(group, QPalette::Highlight), of_text);
      check("tip", palette.color(group, QPalette::ToolTipText),
            palette.color(group, QPalette::ToolTipBase), of_text);
    }
    // The tab of the layout in use is filled with it; the tab of a panel has a line of it.
    check("layout", theme::accent, theme::window, of_marks);
    check("panel", theme::accent, theme::title, of_marks);
    theme::apply(*qApp, {});
    QVERIFY2(low.isEmpty(), qPrintable(low.join("; ")));
  }
};

const test::Registered registered("workspaces", test::run_as_viewer<WorkspacesTest>);

}  // namespace transillum::viewer::workspaces_test

#include "workspaces_test.moc"
