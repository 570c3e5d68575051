// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Opening scenes in the window: what is loaded, how many patches it gets, and running its solve.
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QScrollBar>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTimer>

#include "lessons/lesson_panel.h"
#include "scene/build/patch_count.h"
#include "scene/color_controls.h"
#include "scene/start_page.h"
#include "solved_window.h"
#include "test_files.h"

namespace transillum::viewer::opening_test {

using namespace test;

class OpeningTest : public QObject {
  Q_OBJECT

 private slots:
  void actions_control_the_solve() {
    const SolvedWindow solved("cornell-box");
    QVERIFY(solved.ready);
    // Solve again with many directions.
    solved.window->runner.restart(
        [] {
          SolveOptions options;
          options.directions = 100000;
          return options;
        }(),
        {});
    QVERIFY(wait_for([&] { return solved.window->snapshot()->progress.passes == 100000; }));
    solved.trigger("one_direction");
    QVERIFY(wait_for([&] { return solved.window->snapshot()->progress.direction == 1; }));
    QVERIFY(wait_for([&] { return solved.window->runner.state() == RunState::paused; }));
    solved.trigger("run");
    QVERIFY(wait_for([&] { return solved.window->snapshot()->progress.direction > 20; }));
    solved.trigger("pause");
    QVERIFY(wait_for([&] { return solved.window->runner.state() == RunState::paused; }));
    const int at = solved.window->snapshot()->progress.direction;
    QVERIFY(solved.text("phase").startsWith("Paused"));
    // No other pass was made in between: the next pass follows directly.
    solved.trigger("one_direction");
    QVERIFY(wait_for([&] { return solved.window->snapshot()->progress.direction > at; }));
    QVERIFY(wait_for([&] { return solved.window->runner.state() == RunState::paused; }));
    QCOMPARE(solved.window->snapshot()->progress.direction, at + 1);
    solved.trigger("stop");
    QVERIFY(wait_for([&] { return solved.window->snapshot()->progress.direction == 0; }));
  }

  void a_bad_file_is_reported_and_the_old_scene_stays() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    const QString file =
        write_file(folder.filePath("broken.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n");
    solved.window->open(file);
    QVERIFY(wait_for([&] { return !solved.window->banner_text().isEmpty(); }));
    QVERIFY2(solved.window->banner_text().contains("broken.obj"),
             qPrintable(solved.window->banner_text()));
    QVERIFY(solved.text("scene_summary").contains("furnace"));
    QVERIFY(solved.scene_view->isVisible());
  }

  void another_scene_has_its_own_patch_area() {
    const auto window = make_window(8);
    window->set_options(SolveOptions{.directions = 8}, {false, 0.05});
    window->files().open_scene("cornell-box");
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    const std::size_t refined = window->snapshot()->radiosity.size();
    QVERIFY(refined > 40);
    window->files().open_scene("cornell-box");
    QVERIFY(wait_for([&] { return window->settled(); }));
    QCOMPARE(window->snapshot()->radiosity.size(), refined);
    window->files().open_scene("boards");
    QVERIFY(wait_for([&] { return window->windowTitle().startsWith("boards"); }));
    QCOMPARE(window->views().settings.scene_options().max_patch_area, 0.0);
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    QCOMPARE(window->snapshot()->loaded->scene->patch_count(), load_scene("boards")->patch_count());
  }

  void says_how_many_patches_an_area_makes_and_asks_about_very_many() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    auto* area = solved.window->findChild<QLineEdit*>("max_patch_area");
    const auto* forecast = solved.window->findChild<QLabel*>("patch_forecast");
    const QString usual = forecast->text();
    QVERIFY2(usual.startsWith(count_text(27)), qPrintable(usual));
    area->setText("0.01");
    const std::int64_t count = count_patches(*solved.window->snapshot()->loaded->scene, 0.01);
    QVERIFY(wait_for([&] { return forecast->text().startsWith(count_text(count)); }));
    QCOMPARE(solved.window->findChild<QSpinBox*>("patches_wanted")->value(),
             static_cast<int>(count));
    area->clear();
    QCOMPARE(forecast->text(), usual);

    area->setText("1e-6");
    bool asked = false;
    QTimer answer;
    connect(&answer, &QTimer::timeout, solved.window.get(), [&] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        asked = box->text().contains("GB");
        box->button(QMessageBox::Cancel)->click();
      }
    });
    answer.start(20);
    solved.window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] { return asked; }));
    QVERIFY(solved.window->settled());
    area->setText("0.01");
    solved.window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] {
      return solved.window->snapshot() &&
             static_cast<std::int64_t>(solved.window->snapshot()->radiosity.size()) == count;
    }));
  }

  void loading_shows_what_is_loaded_and_can_be_canceled_data() {
    QTest::addColumn<bool>("has_scene");
    QTest::newRow("first scene") << false;
    QTest::newRow("with an open scene") << true;
  }
  void loading_shows_what_is_loaded_and_can_be_canceled() {
    QFETCH(bool, has_scene);
    const auto window = make_window(8);
    if (has_scene) {
      window->open("boards");
      QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    }
    const QString title = window->windowTitle();
    auto* bar = window->findChild<Banner*>("loading_bar");
    for (const bool by_key : {false, true}) {
      window->files().open_scene("sphere-flake:levels=4");
      QVERIFY(wait_for([&] { return bar->isVisible(); }));
      QCOMPARE(window->windowTitle(), QString("Loading sphere-flake:levels=4 – transillum"));
      if (by_key) {
        window->findChild<QAction*>("clear_selection")->trigger();
      } else {
        window->findChild<QPushButton*>("cancel_loading")->click();
      }
      QVERIFY(wait_for([&] { return !bar->isVisible(); }));
      QCOMPARE(window->windowTitle(), title);
      QCOMPARE(window->snapshot() != nullptr, has_scene);
    }
  }

  // The lowest rows of letters such as g are drawn, too.
  void cards_of_the_start_page_cut_no_letters() {
    const QString note = "gypq, back";
    QAction action("Teach", nullptr);
    action.setObjectName("teach");
    action.setToolTip(note);
    StartPage page;
    page.set_choices({&action});
    page.resize(1200, 700);
    page.show();
    handle_posted();
    auto* card = page.findChild<QAbstractButton*>("choose_teach");
    const QImage image = card->grab().toImage().convertToFormat(QImage::Format_Grayscale8);
    constexpr int edge = 5, faint = 225;
    std::vector<int> rows;  // that have ink
    for (int y = edge; y < image.height() - edge; ++y) {
      const uchar* row = image.constScanLine(y);
      if (std::any_of(row + edge, row + image.width() - edge, [](uchar v) { return v < faint; })) {
        rows.push_back(y);
      }
    }
    QVERIFY(!rows.empty());
    std::size_t first = rows.size() - 1;  // row of the note, which is the last block of rows
    while (first > 0 && rows[first - 1] == rows[first] - 1) {
      --first;
    }
    const int drawn = rows.back() - rows[first] + 1;
    const int whole = QFontMetrics(card->font()).tightBoundingRect(note).height();
    QVERIFY2(first > 0 && drawn >= whole, qPrintable(QString("%1 of %2").arg(drawn).arg(whole)));
  }

  void titles_of_the_start_page_are_whole_on_a_small_screen() {
    const auto window = make_window(8);
    window->resize(1280 - 16, 720 - 48);
    handle_posted();
    int lessons = 0;
    for (const auto* card : window->findChild<StartPage*>()->findChildren<QAbstractButton*>()) {
      if (card->property("title_fits").isValid()) {
        QVERIFY2(card->property("title_fits").toBool(), qPrintable(card->text()));
        const bool is_lesson = card->objectName().startsWith("lesson_");
        QVERIFY2(!is_lesson || card->property("text_fits").toBool(), qPrintable(card->text()));
        lessons += is_lesson ? 1 : 0;
      }
    }
    QVERIFY(lessons >= 11);
  }

  // The type of a projector is larger, and the page is still as wide as the screen.
  void the_start_page_of_a_projector_is_alone_and_is_not_scrolled_sideways() {
    const auto window = make_window(8);
    window->resize(1280, 720);
    const auto* page = window->findChild<StartPage*>();
    const auto* timeline = window->findChild<QDockWidget*>("timeline_dock");
    QVERIFY(wait_for([&] { return page->isVisible(); }));
    window->findChild<QAction*>("projector")->trigger();
    QVERIFY(wait_for([&] { return window->isFullScreen(); }));
    handle_posted();
    QVERIFY(page->isVisible() && !timeline->isVisible());
    for (const QSize& size : {QSize(1280, 720), QSize(1024, 700)}) {
      window->setFixedSize(size);
      QVERIFY(wait_for([&] { return page->width() == size.width(); }));
      handle_posted();
      QCOMPARE(page->horizontalScrollBar()->maximum(), 0);
      for (const auto* card : page->findChildren<QAbstractButton*>()) {
        const QRect place(card->mapTo(page->viewport(), QPoint()), card->size());
        QVERIFY2(
            !card->isVisible() || (place.left() >= 0 && place.right() < page->viewport()->width()),
            qPrintable(card->text()));
      }
      save_picture(*window, QString("projector-start-%1").arg(size.width()));
    }
    // The scene has its timeline.
    window->open("furnace");
    QVERIFY(wait_for([&] { return !page->isVisible() && timeline->isVisible(); }));
    QVERIFY(window->isFullScreen());
    window->findChild<QAction*>("projector")->trigger();
  }

  // A page as wide as a long name would have to be scrolled sideways.
  void the_name_of_what_is_loaded_fits_the_start_page() {
    const auto window = make_window(8);
    window->resize(1280 - 16, 720 - 48);
    window->files().open_scene("sphere-flake:levels=4,slices=20,stacks=9");
    const auto* title = window->findChild<QLabel*>("start_loading");
    const auto* page = window->findChild<StartPage*>();
    QVERIFY(wait_for([&] { return title->text().contains("Loading"); }));
    QVERIFY(title->isVisible());
    QVERIFY(page->widget()->minimumSizeHint().width() <= page->viewport()->width());
    QCOMPARE(page->horizontalScrollBar()->maximum(), 0);
  }
};

const test::Registered registered("opening", test::run_as_viewer<OpeningTest>);

}  // namespace transillum::viewer::opening_test

#include "opening_test.moc"
