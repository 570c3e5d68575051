// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Appearance of the window: projector mode, dark mode, full screen, layouts, and keys.
#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QDockWidget>
#include <QFontInfo>
#include <QMenuBar>
#include <QRegularExpression>
#include <QScrollBar>
#include <QSettings>
#include <QTextBrowser>
#include <cmath>

#include "lessons/lesson_panel.h"
#include "solved_window.h"
#include "state/watches.h"
#include "stepping/event_table.h"
#include "stepping/watch_chart.h"
#include "test_files.h"
#include "user_guide.h"
#include "widgets/banner.h"
#include "widgets/full_screen.h"
#include "widgets/theme.h"
#include "window/base/dock_layouts.h"
#include "window/menus/help_pages.h"

namespace transillum::viewer::appearance_test {

using namespace test;

namespace {

// Keys go to the active window; without a window manager, it must be activated here.
std::unique_ptr<TestWindow> make_active_window() {
  auto window = make_window();
  window->activateWindow();
  (void)QTest::qWaitForWindowActive(window.get());
  return window;
}

/// The contrast of two colors by WCAG 2.1, 1 to 21.
double contrast_of(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& color) {
    const auto linear = [](double v) {
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
           0.0722 * linear(color.blueF());
  };
  const auto [darker, lighter] = std::minmax({luminance(a), luminance(b)});
  return (lighter + 0.05) / (darker + 0.05);
}

}  // namespace

class AppearanceTest : public QObject {
  Q_OBJECT

 private slots:
  void projector_mode_enlarges_and_can_be_switched_off() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const int size = QFontInfo(solved.window->font()).pixelSize();
    solved.trigger("projector");
    QVERIFY(QFontInfo(solved.window->font()).pixelSize() >= 1.2 * size - 1);
    QVERIFY(theme::scale() >= 1.2);
    solved.trigger("projector");
    QCOMPARE(QFontInfo(solved.window->font()).pixelSize(), size);
  }

  void projector_mode_enlarges_a_lesson() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    solved.window->findChild<LessonPanel*>()->show_page(3, 0);
    const auto* text = solved.window->findChild<QTextBrowser*>("lesson_text");
    const int size = text->document()->defaultFont().pixelSize();
    solved.trigger("projector");
    QVERIFY(text->document()->defaultFont().pixelSize() >= 1.2 * size - 1);
    solved.trigger("projector");
    QCOMPARE(text->document()->defaultFont().pixelSize(), size);
  }

  void projector_mode_shows_page_scene_and_timeline_alone() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    TestWindow& window = *solved.window;
    const auto shown = [&](const char* dock) {
      return window.findChild<QDockWidget*>(dock)->isVisible();
    };
    solved.trigger("projector");
    QVERIFY(window.isFullScreen() && solved.scene_view->isVisible());
    QVERIFY(shown("timeline_dock") && !shown("lesson_dock") && !shown("map_dock"));
    QVERIFY(!window.menuBar()->isVisible());
    auto* lessons = window.findChild<LessonPanel*>();
    for (const int page : {0, 1}) {
      lessons->show_page(0, page);
      QVERIFY(wait_for([&] { return window.settled(); }));
      QVERIFY(window.isFullScreen() && solved.scene_view->isVisible());
      QVERIFY(shown("timeline_dock") && shown("lesson_dock") && !shown("map_dock"));
    }
    // A session that is saved during projector mode has the panels of the window.
    const QByteArray kept = window.views().docks.state();
    const auto* timeline = window.findChild<QDockWidget*>("timeline_dock");
    QVERIFY2(wait_for([&] { return timeline->height() < 0.1 * window.height(); }, 5000),
             qPrintable(QString::number(timeline->height())));
    QTest::keyClick(&window, Qt::Key_F11);
    QVERIFY(wait_for([&] { return !window.isFullScreen(); }, 5000));
    QVERIFY(shown("map_dock") && window.menuBar()->isVisible());
    QVERIFY(window.views().docks.restore(static_cast<int>(Layout::inspect), kept));
    QVERIFY(shown("map_dock") && shown("settings_dock"));
    QVERIFY(theme::scale() == 1);
  }

  void a_session_kept_on_a_full_screen_has_the_panels_of_the_window() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    TestWindow& window = *solved.window;
    const QWidget* canvas = solved.scene_view->canvas();
    QCursor::setPos(canvas->mapToGlobal(canvas->rect().center()));
    const auto* map = window.findChild<QDockWidget*>("map_dock");
    QVERIFY(map->isVisible());
    window.findChild<QAction*>("full_screen")->trigger();
    QVERIFY(wait_for([&] { return window.isFullScreen() && !map->isVisible(); }, 5000));
    const QByteArray kept = window.views().docks.state();
    window.findChild<QAction*>("layout_debug")->trigger();
    QVERIFY(!map->isVisible());
    window.findChild<QAction*>("full_screen")->trigger();
    QVERIFY(wait_for([&] { return !window.isFullScreen(); }, 5000));
    QVERIFY(map->isVisible());
    QVERIFY(window.views().docks.current() == Layout::inspect);
    QVERIFY(window.views().docks.restore(static_cast<int>(Layout::inspect), kept));
    QVERIFY(map->isVisible());
    window.findChild<QAction*>("layout_debug")->trigger();
    QVERIFY(window.views().docks.current() == Layout::debug);
  }

  void page_down_scrolls_before_it_turns_on_a_projector() {
    const auto window = make_active_window();
    Lesson lesson;
    lesson.title = "Long";
    for (const char* title : {"one", "two"}) {
      lesson.pages.push_back({});
      lesson.pages.back().title = title;
      lesson.pages.back().text = std::string(8000, 'x') + "\n\n";
      for (int line = 0; line < 200; ++line) {
        lesson.pages.back().text += "line\n\n";
      }
    }
    auto* lessons = window->findChild<LessonPanel*>();
    lessons->add(lesson);
    lessons->show_page(0, 0);
    window->findChild<QAction*>("projector")->trigger();
    const auto* text = window->findChild<QTextBrowser*>("lesson_text");
    QVERIFY(wait_for([&] { return text->verticalScrollBar()->maximum() > 0; }, 5000));
    int presses = 0;
    while (lessons->page() == 0 && presses < 1000) {
      window->findChild<QAction*>("lesson_next")->trigger();
      ++presses;
    }
    window->findChild<QAction*>("projector")->trigger();
    QCOMPARE(lessons->page(), 1);
    QVERIFY(presses > 2);
  }

  void dark_mode_has_dark_panels() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const auto lightness = [&] {
      const QImage picture =
          solved.window->findChild<QDockWidget*>("settings_dock")->grab().toImage();
      qint64 sum = 0;
      for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
          sum += qGray(picture.pixel(x, y));
        }
      }
      return static_cast<double>(sum) / (picture.width() * picture.height());
    };
    QVERIFY(lightness() > 200);
    solved.trigger("dark");
    QVERIFY2(lightness() < 80, qPrintable(QString::number(lightness())));
    solved.trigger("dark");
    QVERIFY(lightness() > 200);
  }

  // Tabs have a line below in this color.
  void no_line_is_bright_in_dark_mode() {
    theme::apply(*qApp, {.dark = true});
    const QColor line = qApp->palette().color(QPalette::Light);
    theme::apply(*qApp, {.dark = false});
    QVERIFY2(contrast_of(line, theme::scene_background) < 3, qPrintable(line.name()));
  }

  // WCAG 2.1 asks for a contrast of 4.5 of text on its background.
  void text_of_exchanges_can_be_read_in_both_modes() {
    for (const bool dark : {true, false}) {
      theme::apply(*qApp, {.dark = dark});
      EventTable table;
      table.set_events({{.kind = StepEvent::Kind::exchange}});
      const auto ink = table.data(table.index(0, EventTable::of_kind), Qt::ForegroundRole);
      const double contrast = contrast_of(ink.value<QColor>(), theme::paper);
      QVERIFY2(contrast >= 4.5, qPrintable(QString::number(contrast)));
    }
  }

  void answers_can_be_read_in_both_modes() {
    for (const bool dark : {true, false}) {
      theme::apply(*qApp, {.dark = dark});
      for (const QColor& ink : {theme::good, theme::warm}) {
        QVERIFY(contrast_of(ink, theme::paper) >= 4.5 && contrast_of(ink, theme::window) >= 4.5);
      }
    }
  }

  void messages_can_be_read_in_both_modes() {
    Banner banner;
    banner.resize(600, 60);
    for (const bool dark : {true, false}) {
      theme::apply(*qApp, {.dark = dark});
      for (const auto kind : {Banner::Kind::error, Banner::Kind::warning, Banner::Kind::offer}) {
        banner.show_message(kind, "text");
        const QColor background = banner.grab().toImage().pixelColor(5, 5);
        const double contrast = contrast_of(theme::ink, background);
        QVERIFY2(contrast >= 4.5, qPrintable(QString::number(contrast)));
        QVERIFY(background != theme::window);
        // A dark window has no bright bar.
        QCOMPARE(background.lightness() < 128, dark);
      }
    }
  }

  // WCAG 2.1 asks for a contrast of 3 between parts of a picture that must be distinguished.
  void the_position_stands_out_from_its_lane_in_both_modes() {
    for (const bool dark : {true, false}) {
      theme::apply(*qApp, {.dark = dark});
      const double contrast = contrast_of(theme::accent, theme::finished);
      QVERIFY2(contrast >= 3, qPrintable(QString::number(contrast)));
    }
  }

  void lines_of_watched_values_stand_out_in_both_modes() {
    for (const bool dark : {true, false}) {
      theme::apply(*qApp, {.dark = dark});
      for (std::size_t k = 0; k < Watches::most; ++k) {
        const double contrast = contrast_of(WatchChart::color_of(k), theme::hover);
        QVERIFY2(contrast >= 3, qPrintable(QString("%1: %2").arg(k).arg(contrast)));
      }
    }
  }

  void the_cross_that_removes_a_filter_is_seen_in_both_modes() {
    for (const bool dark : {true, false}) {
      theme::apply(*qApp, {.dark = dark});
      const QImage cross = theme::icon(theme::Icon::clear).pixmap(QSize(32, 32)).toImage();
      double most = 0;
      for (int y = 0; y < cross.height(); ++y) {
        for (int x = 0; x < cross.width(); ++x) {
          if (qAlpha(cross.pixel(x, y)) > 200) {
            most = std::max(
                most, contrast_of(cross.pixelColor(x, y), qApp->palette().color(QPalette::Button)));
          }
        }
      }
      QVERIFY2(most >= 3, qPrintable(QString::number(most)));
    }
  }

  void one_view_fills_the_screen() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    TestWindow& window = *solved.window;
    auto* map = window.findChild<QDockWidget*>("map_dock");
    auto* settings = window.findChild<QDockWidget*>("settings_dock");
    window.findChild<FullScreen*>()->show_only({map});
    QVERIFY(wait_for([&] { return map->width() > 0.95 * window.width(); }, 5000));
    QVERIFY(window.isFullScreen() && !settings->isVisible() && !solved.scene_view->isVisible());
    // Shortcuts work although the menu bar is hidden.
    window.activateWindow();  // without a window manager, the first show may leave none active
    QVERIFY(wait_for([&] { return window.isActiveWindow(); }));
    QTest::keyClick(&window, Qt::Key_F11);
    QVERIFY(
        wait_for([&] { return settings->isVisible() && solved.scene_view->isVisible(); }, 5000));
    QVERIFY(!window.isFullScreen() && window.menuBar()->isVisible());
    window.findChild<FullScreen*>()->show_only({window.centralWidget()});
    QVERIFY(wait_for([&] { return solved.scene_view->width() > 0.8 * window.width(); }, 5000));
    QVERIFY(!map->isVisible());
    window.findChild<FullScreen*>()->show_all();
    QVERIFY(map->isVisible());
  }

  // Their effect is seen in the scene.
  void panels_that_change_the_scene_fill_the_screen_with_it() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    TestWindow& window = *solved.window;
    auto* full = window.findChild<QAction*>("full_screen");
    for (const char* panel : {"settings", "material", "move"}) {
      window.views().docks.bring_to_front(panel);
      auto* dock = window.findChild<QDockWidget*>(QString(panel) + "_dock");
      QVERIFY(wait_for([&] { return dock->isVisible(); }));
      QCursor::setPos(dock->mapToGlobal(dock->rect().center()));
      QVERIFY(wait_for([&] {
        const QWidget* under = QApplication::widgetAt(QCursor::pos());
        return under && dock->isAncestorOf(under);
      }));
      full->trigger();
      QVERIFY(wait_for([&] { return window.isFullScreen(); }, 5000));
      QVERIFY(wait_for([&] { return solved.scene_view->width() > 0.4 * window.width(); }, 5000));
      QVERIFY2(dock->isVisible() && solved.scene_view->isVisible(), panel);
      QVERIFY(!window.findChild<QDockWidget*>("map_dock")->isVisible());
      const QRect beside(dock->mapTo(&window, QPoint()), dock->size());
      const QRect scene(solved.scene_view->mapTo(&window, QPoint()), solved.scene_view->size());
      QVERIFY(!beside.intersects(scene));
      full->trigger();
      QVERIFY(wait_for([&] { return !window.isFullScreen(); }, 5000));
    }
  }

  void full_screen_returns_to_a_maximized_window() {
    const auto window = make_active_window();
    window->showMaximized();
    QVERIFY(wait_for([&] { return window->isMaximized(); }, 5000));
    for (const bool full : {true, false}) {
      QTest::keyClick(window.get(), Qt::Key_F11);
      QVERIFY(wait_for([&] { return window->isFullScreen() == full; }, 5000));
    }
    QVERIFY(window->isMaximized());
  }

  void all_keys_are_documented_and_have_one_use() {
    const auto window = make_active_window();
    std::map<QString, QString> uses;
    for (const KeySection& section : keys_of(*window)) {
      for (const KeyUse& key : section.keys) {
        for (const QString& one : key.keys.split(' ')) {
          QVERIFY2(uses.emplace(one, key.text).second, qPrintable(one + ": " + key.text));
        }
      }
    }
    QVERIFY(uses.size() > 30);
    QTest::keyClick(window.get(), Qt::Key_Question);
    auto* dialog = window->findChild<QDialog*>("keys");
    QVERIFY(dialog && dialog->isVisible());
    const QString page = dialog->findChild<QTextBrowser*>()->toPlainText();
    for (const auto& [key, text] : uses) {
      QVERIFY2(page.contains(text), qPrintable(text));
    }

    const QStringList guide = user_guide();
    QVERIFY(guide.size() > 8);
    const QString text = guide.join('\n');
    for (const auto& [key, use] : uses) {
      QVERIFY2(text.contains('`' + key + '`'), qPrintable(key + ": " + use));
    }
    // The tables at the ends of its pages have only keys of the menus, of a saved view, of the kept
    // run, of the list of kept runs, of the timeline and of the panel Surfaces.
    const QStringList others{"Alt+1", "A", "F2", "Del", "←", "→", "Return", "E", "R"};
    static const QRegularExpression quoted(QStringLiteral("`([^`]+)`"));
    int listed = 0;
    for (const QString& one : guide.mid(1)) {
      QVERIFY2(one.contains("\n## Keys\n"), qPrintable(one.section('\n', 0, 0)));
      for (const QString& row : one.mid(one.indexOf("\n## Keys\n")).split('\n')) {
        if (!row.startsWith("| `")) {
          continue;
        }
        auto found = quoted.globalMatch(row.section('|', 1, 1));
        while (found.hasNext()) {
          const QString key = found.next().captured(1);
          QVERIFY2(uses.count(key) > 0 || others.contains(key), qPrintable(key));
          ++listed;
        }
      }
    }
    QVERIFY(listed > 40);
  }

  void layouts_have_keys() {
    const auto window = make_active_window();
    const auto shown = [&](const char* dock) {
      return window->findChild<QDockWidget*>(dock)->isVisible();
    };
    QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
    QVERIFY(shown("lesson_dock") && !shown("map_dock") && !shown("settings_dock"));
    QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
    QVERIFY(!shown("lesson_dock") && shown("settings_dock"));
    QTest::keyClick(window.get(), Qt::Key_3, Qt::ControlModifier);
    QVERIFY(shown("breakpoint_dock") && !shown("settings_dock"));
    window->findChild<QDockWidget*>("breakpoint_dock")->close();
    QTest::keyClick(window.get(), Qt::Key_0, Qt::ControlModifier);
    QVERIFY(shown("breakpoint_dock"));
  }

  void a_layout_is_as_the_user_left_it_until_it_is_reset() {
    const auto window = make_active_window();
    auto* patch = window->findChild<QDockWidget*>("inspector_dock");
    window->views().docks.cover(false);
    patch->close();
    QTest::keyClick(window.get(), Qt::Key_1, Qt::ControlModifier);
    QVERIFY(!patch->isVisible());
    QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
    QVERIFY(!patch->isVisible());
    QTest::keyClick(window.get(), Qt::Key_0, Qt::ControlModifier);
    QVERIFY(patch->isVisible());
  }

  void all_layouts_are_remembered() {
    QSettings settings("transillum", "layouts");
    {
      const auto window = make_active_window();
      window->views().docks.cover(false);
      window->findChild<QDockWidget*>("inspector_dock")->close();
      QTest::keyClick(window.get(), Qt::Key_3, Qt::ControlModifier);
      window->views().docks.save(settings);
    }
    const auto window = make_active_window();
    QVERIFY(window->views().docks.load(settings));
    QVERIFY(window->findChild<QDockWidget*>("breakpoint_dock")->isVisible());
    QTest::keyClick(window.get(), Qt::Key_2, Qt::ControlModifier);
    QVERIFY(!window->findChild<QDockWidget*>("inspector_dock")->isVisible());
    QVERIFY(window->findChild<QDockWidget*>("settings_dock")->isVisible());
  }

  // Nothing is painted while panels are placed; those that become windows meanwhile are painted
  // again, too.
  void a_panel_that_is_restored_as_a_window_is_painted() {
    QSettings settings("transillum", "floating");
    {
      const auto window = make_active_window();
      window->views().docks.bring_to_front("compare");
      window->findChild<QDockWidget*>("compare_dock")->setFloating(true);
      window->views().docks.save(settings);
    }
    const auto window = make_active_window();
    QVERIFY(window->views().docks.load(settings));
    auto* panel = window->findChild<QDockWidget*>("compare_dock");
    QVERIFY(panel->isFloating());
    QVERIFY(panel->updatesEnabled() && panel->widget()->updatesEnabled());
  }

  void a_floating_panel_can_be_maximized_and_docks_again() {
    const auto window = make_active_window();
    auto* panel = window->findChild<QDockWidget*>("compare_dock");
    for (const char* layout : {"layout_reset", "layout_debug", "layout_teach"}) {
      window->views().docks.bring_to_front("compare");
      panel->setFloating(true);
      QVERIFY(panel->isFloating() && panel->isVisible());
      QVERIFY(panel->windowFlags().testFlag(Qt::WindowMaximizeButtonHint));
      QCOMPARE(panel->windowType(), Qt::Tool);  // a tool window stays above
      window->findChild<QAction*>(layout)->trigger();
      QVERIFY2(!panel->isFloating(), layout);
    }
    QVERIFY(!panel->isVisible());
  }
};

const test::Registered registered("appearance", test::run_as_viewer<AppearanceTest>);

}  // namespace transillum::viewer::appearance_test

#include "appearance_test.moc"
