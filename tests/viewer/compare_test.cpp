// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The panel that compares two engines on one direction.
#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTableView>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <limits>

#include "map/compare_view.h"
#include "map/difference_pictures.h"
#include "map/engine_drawing.h"
#include "map/hemicube_view.h"
#include "map/pair_table.h"
#include "solve/settings_panel.h"
#include "solved_window.h"
#include "state/breakpoints.h"
#include "test_files.h"
#include "widgets/engine_text.h"

namespace transillum::viewer::compare_test {

using namespace test;

namespace {

/// The cornell box, solved, with two engines compared.
struct ComparedWindow : SolvedWindow {
  CompareView* view;

  ComparedWindow() : SolvedWindow(QStringLiteral("cornell-box")) {
    view = window->findChild<CompareView*>();
    auto* dock = window->findChild<QDockWidget*>("compare_dock");
    dock->show();
    dock->raise();
    ready = ready && wait_for([this] { return view->up_to_date(); });
  }
};

}  // namespace

class CompareTest : public QObject {
  Q_OBJECT

 private slots:
  void shows_how_two_engines_differ() {
    const ComparedWindow shown;
    QVERIFY(shown.ready);
    CompareView* view = shown.view;
    const auto values = [&] {
      return QStringList{shown.text("first_values"), shown.text("other_values")};
    };
    const auto* picture = view->findChild<QWidget*>("difference_picture");
    for (const QString& side : values()) {
      QVERIFY2(side.contains("pairs"), qPrintable(side));
    }
    // The room is closed.
    QVERIFY2(values()[0].replace(QChar(QChar::Nbsp), ' ').contains("100 % covered"),
             qPrintable(values()[0]));
    const auto total = [&] {
      double sum = 0;
      for (PatchId i = 0; i < 27; ++i) {
        sum += static_cast<const DifferencePicture*>(picture)->fraction(i);
      }
      return sum;
    };
    const double coarse = total();
    QVERIFY(coarse > 0);

    // The difference shrinks with finer pixels and is 0 for the same engine.
    const QString before = shown.text("compare_words");
    view->findChild<QSpinBox*>("other_resolution")->setValue(1024);
    QVERIFY(!view->up_to_date());
    QVERIFY(wait_for([&] { return view->up_to_date(); }, 120000));
    QVERIFY(shown.text("compare_words") != before);
    QVERIFY(total() < coarse);
    view->findChild<QComboBox*>("other_engine")->setCurrentText(QStringLiteral("Fast"));
    QVERIFY(wait_for([&] { return view->up_to_date(); }));
    const auto without_time = [](const QString& side) { return side.section("ms", 1); };
    QCOMPARE(without_time(values()[1]), without_time(values()[0]));
    QCOMPARE(total(), 0.0);
    QVERIFY(shown.text("compare_words").contains(QStringLiteral("0 %")));
  }

  void the_worst_pair_is_one_click_away() {
    const ComparedWindow shown;
    QVERIFY(shown.ready);
    QVERIFY(shown.text("compare_words").contains("Largest difference"));
    auto* worst = shown.view->findChild<QPushButton*>("worst_pair");
    QVERIFY(worst->isVisible());
    worst->click();
    QVERIFY(wait_for([&] { return shown.window->settled(); }));
    const PatchId patch = shown.window->selection.patch();
    static const QRegularExpression pair("patches (\\d+) and (\\d+)");
    const auto named = pair.match(shown.text("compare_words"));
    QCOMPARE(patch, named.captured(1).toInt());
    const Focus& focus = shown.window->focus;
    const MapHistory& history = focus.map()->history;
    const Breakpoint meets{Breakpoint::Kind::pair, patch, named.captured(2).toInt()};
    QVERIFY(holds(meets, history, focus.position().step) ||
            history.step(focus.position().step).patch == patch);
  }

  void differences_are_listed() {
    const ComparedWindow shown;
    QVERIFY(shown.ready);
    const auto* list = shown.view->findChild<QTableView*>("pair_differences");
    const auto* table = static_cast<const PairTable*>(list->model());
    const auto* picture = shown.view->findChild<PairPicture*>();
    const int count = table->rowCount();
    QVERIFY(count > 5);
    double last = HUGE_VAL;
    for (int row = 0; row < count; ++row) {
      const PairDifference& pair = table->pair(row);
      const double size = std::abs(pair.other - pair.first);
      QVERIFY(0 < size && size <= last);
      last = size;
    }
    QVERIFY(shown.text("compare_words")
                .contains(QString("patches %1 and %2")
                              .arg(table->pair(0).receiver)
                              .arg(table->pair(0).source)));
    // Without a choice, the receiver of the largest difference is shown.
    QCOMPARE(picture->receiver(), table->pair(0).receiver);
  }

  void the_chosen_pair_is_drawn_by_polygon() {
    const ComparedWindow shown;
    QVERIFY(shown.ready);
    auto* list = shown.view->findChild<QTableView*>("pair_differences");
    const auto* table = static_cast<const PairTable*>(list->model());
    const auto* picture = shown.view->findChild<PairPicture*>();
    // A pair that both engines see: the picture shows its polygons in one color.
    int row = 0;
    while (table->pair(row).first == 0 || table->pair(row).other == 0) {
      ++row;
    }
    const PairDifference pair = table->pair(row);
    list->setCurrentIndex(table->index(row, 0));
    QCOMPARE(picture->receiver(), pair.receiver);
    QCOMPARE(shown.window->selection.patch(), pair.source);
    QCOMPARE(picture->fraction(pair.source),
             (pair.other - pair.first) / std::max(pair.other, pair.first));
    MapCanvas* canvas = picture->canvas();
    QVERIFY(wait_for([&] { return canvas->up_to_date() && canvas->polygon_count() > 0; }));
    const MapHistory& history = shown.window->focus.map()->history;
    std::size_t polygons = 0;
    double area = 0;
    for (std::int32_t k = 0; k < history.step_count(); ++k) {
      if (history.step(k).patch != pair.receiver || !history.step(k).front_facing) {
        continue;
      }
      for (const std::int32_t r : history.inside_at(k)) {
        ++polygons;
        area += history.row(r).patch == pair.source ? history.record().area(history.row(r)) : 0;
      }
    }
    QCOMPARE(canvas->polygon_count(), polygons);
    QVERIFY(std::abs(area - pair.first) < 1e-9);
    const Color8 expected =
        color_of(ColorMap::diverging,
                 0.5 + picture->fraction(pair.source) / (2 * PairPicture::full_color_at));
    shown.window->selection.select(no_patch);
    const QImage image = canvas->grab().toImage();
    int colored = 0;
    for (int y = 0; y < canvas->height(); ++y) {
      for (int x = 0; x < canvas->width(); ++x) {
        const QPoint place(x, y);
        const QColor color = image.pixelColor(place * image.devicePixelRatio());
        colored += canvas->patch_at(place) == pair.source &&
                   color == QColor(expected[0], expected[1], expected[2]);
      }
    }
    QVERIFY(colored > 0);
    save_picture(*shown.window, "compare-pairs");

    // Return goes to where the two meet.
    QTest::keyClick(list, Qt::Key_Return);
    QVERIFY(wait_for([&] { return shown.window->settled(); }));
    QCOMPARE(shown.window->selection.patch(), pair.receiver);
    QVERIFY(holds(Breakpoint{Breakpoint::Kind::pair, pair.receiver, pair.source}, history,
                  shown.window->focus.position().step));
  }

  void the_comparison_takes_most_of_the_window_and_gives_it_back() {
    const ComparedWindow shown;
    QVERIFY(shown.ready);
    auto* dock = shown.window->findChild<QDockWidget*>("compare_dock");
    const auto* action = shown.window->findChild<QAction*>("compare_large");
    const auto panels = [&] {
      QSet<QString> visible;
      for (const QDockWidget* each : shown.window->findChildren<QDockWidget*>()) {
        if (each->isVisible()) {
          visible << each->objectName();
        }
      }
      return visible;
    };
    // A small screen has room for little else.
    shown.window->resize(1280 - 16, 720 - 48);
    QCoreApplication::processEvents();
    const QSize usual = dock->size();
    const QSet<QString> others = panels();
    shown.trigger("compare_large");
    QVERIFY2(wait_for([&] {
               return dock->width() > 0.58 * shown.window->width() &&
                      dock->height() > 1.5 * usual.height();
             }),
             qPrintable(QString("%1 x %2, before %3 x %4")
                            .arg(dock->width())
                            .arg(dock->height())
                            .arg(usual.width())
                            .arg(usual.height())));
    QVERIFY(panels() == (QSet<QString>{"compare_dock", "timeline_dock"}));
    QVERIFY(wait_for([&] { return shown.window->settled(); }));
    save_picture(*shown.window, "compare-large");
    // The kept state of the layout is the state before.
    const QByteArray kept = shown.window->views().docks.state();
    shown.trigger("compare_large");
    QVERIFY2(wait_for([&] { return dock->size() == usual; }),
             qPrintable(QString("%1, not %2").arg(dock->width()).arg(usual.width())));
    QVERIFY(panels() == others && !action->isChecked());
    shown.trigger("layout_debug");
    DockLayouts& docks = shown.window->views().docks;
    QVERIFY(docks.restore(static_cast<int>(Layout::inspect), kept));
    QVERIFY(wait_for([&] { return panels() == others; }));
    // Another layout ends it too.
    shown.trigger("compare_large");
    QVERIFY(action->isChecked());
    shown.trigger("layout_inspect");
    QVERIFY(!action->isChecked() && panels().contains("settings_dock"));
    shown.trigger("compare_large");
    shown.trigger("compare_large");
    QVERIFY(panels().contains("settings_dock"));
    // The panel is a tab of the map's place, also where maps are debugged.
    const auto tabs = shown.window->tabifiedDockWidgets(dock);
    QVERIFY(tabs.contains(shown.window->findChild<QDockWidget*>("map_dock")));
    shown.trigger("layout_debug");
    docks.bring_to_front("compare");
    QVERIFY(shown.window->tabifiedDockWidgets(dock).contains(
        shown.window->findChild<QDockWidget*>("map_dock")));
  }

  // A picture of the window that is taken without a user must not show "Comparing…".
  void a_window_that_shows_a_comparison_is_settled_once_it_is_complete() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    const QString path = folder.filePath("compare.json");
    write_file(path,
               R"({"title": "Engines", "pages": [{"text": "Two.", "show": {"scene": "cornell-box",
      "options": {"directions": 16}, "layout": "inspect", "panels": ["compare"]}}]})");
    const auto* view = solved.window->findChild<CompareView*>();
    solved.window->files().open(path);
    // This is checked at each turn of the event loop, because a screenshot could be taken there.
    QVERIFY(wait_for([&] { return solved.window->settled() && view->isVisible(); }));
    QVERIFY(view->up_to_date());
    // The panel does not wait where nothing can be compared.
    view->findChild<QComboBox*>("other_engine")->setCurrentText("Hemicube");
    QVERIFY(wait_for([&] { return solved.window->settled(); }));
    QVERIFY2(solved.text("compare_words").contains("select a patch"),
             qPrintable(solved.text("compare_words")));
  }

  void shows_both_side_by_side() {
    const ComparedWindow shown;
    QVERIFY(shown.ready);
    CompareView* view = shown.view;
    const auto* first = view->findChild<MapCanvas*>("first_map");
    const auto* other = view->findChild<MapCanvas*>("other_map");
    const auto* difference = view->findChild<MapCanvas*>("difference_canvas");
    QVERIFY(!first->pixels());
    QVERIFY(other->pixels() && other->pixels()->choice.engine == Engine::zbuffer);
    QCOMPARE(other->pixels()->choice.resolution, 128);
    auto* engine = view->findChild<QComboBox*>("other_engine");
    for (const char* name : {"Painter's algorithm", "Parallel rays", "No cutting, corrected"}) {
      engine->setCurrentText(QString::fromLatin1(name));
      QVERIFY(wait_for([&] { return view->up_to_date(); }));
      QVERIFY(other->pixels() && other->pixels()->choice.engine == engine_of(*engine));
      QVERIFY(color_count(view->findChild<MapCanvas*>("other_map")->grab().toImage()) > 8);
    }
    save_picture(*shown.window, "compare-corrected");

    // They share one view, the selected patch and the probed point.
    auto* moved = view->findChild<MapCanvas*>("first_map");
    QWheelEvent wheel(QPointF(60, 60), QPointF(moved->mapToGlobal(QPoint(60, 60))), {}, {0, 480},
                      Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(moved, &wheel);
    QVERIFY(moved->view().zoom > 1.5);
    for (const MapCanvas* map : {other, difference}) {
      QCOMPARE(map->view().zoom, moved->view().zoom);
      QVERIFY((map->view().shift - moved->view().shift).manhattanLength() < 1e-9);
    }
    QVERIFY(wait_for([&] { return view->up_to_date(); }));
    const auto middle = [](const MapCanvas* map) {
      return QPointF(QPoint(map->width() / 2, map->height() / 2));
    };
    const auto at = *moved->point_at(middle(moved));
    QTest::mouseClick(moved, Qt::LeftButton, {}, middle(moved).toPoint());
    QVERIFY(shown.window->focus.probe().has_value());
    QVERIFY(std::abs(shown.window->focus.probe()->x - at.x) < 0.02);
    QCOMPARE(shown.window->selection.patch(), moved->patch_at(middle(moved)));
    save_picture(*shown.window, "compare-near");
  }

  void compares_what_a_patch_sees_with_a_hemicube() {
    const ComparedWindow shown;
    QVERIFY(shown.ready);
    CompareView* view = shown.view;
    view->findChild<QComboBox*>("other_engine")->setCurrentText(QStringLiteral("Hemicube"));
    QVERIFY(wait_for([&] { return shown.text("compare_words").contains("select a patch to"); }));
    shown.window->selection.select(14);
    QVERIFY(wait_for([&] { return shown.text("compare_words").contains("patch 14 sees"); }));
    QVERIFY(wait_for([&] { return view->up_to_date(); }));
    const auto* hemicube = view->findChildren<HemicubeView*>().last();
    QVERIFY(hemicube->isVisible() && hemicube->comparison());
    QCOMPARE(hemicube->comparison()->request.eye, 14);
    const auto* picture =
        static_cast<const DifferencePicture*>(view->findChild<QWidget*>("difference_picture"));
    const double wrong = picture->fraction(14);
    QVERIFY(wrong > 0.01 && wrong < 0.4);
    for (PatchId j = 0; j < 27; ++j) {
      QVERIFY(picture->fraction(j) >= 0 && picture->fraction(j) <= 1 + 1e-9);
    }
    save_picture(*shown.window, "compare-hemicube");
    // The same engine on both sides shows no difference, along any direction.
    view->findChild<QSpinBox*>("first_resolution")->setValue(128);
    view->findChild<QComboBox*>("first_engine")->setCurrentText(QStringLiteral("Hemicube"));
    QVERIFY(wait_for([&] { return picture->fraction(14) == 0; }));
    // Pairs have no directions either, and hemicubes differ from them.
    view->findChild<QComboBox*>("first_engine")->setCurrentText(QStringLiteral("Pairs of patches"));
    QVERIFY(wait_for([&] { return view->up_to_date() && picture->fraction(14) > 0.01; }));
    view->findChild<QComboBox*>("other_engine")->setCurrentText(QStringLiteral("Pairs of patches"));
    QVERIFY(wait_for([&] { return view->up_to_date() && picture->fraction(14) == 0; }));
  }

  void a_new_scene_clears_the_comparison() {
    SolvedWindow shown(QStringLiteral("boards"));
    QVERIFY(shown.ready);
    auto* view = shown.window->findChild<CompareView*>();
    auto* dock = shown.window->findChild<QDockWidget*>("compare_dock");
    dock->show();
    dock->raise();
    QVERIFY(wait_for([&] { return view->up_to_date(); }));
    shown.window->open(QStringLiteral("furnace"));
    QVERIFY(wait_for([&] { return !view->up_to_date(); }));
  }
};

const test::Registered registered("compare", test::run_as_viewer<CompareTest>);

}  // namespace transillum::viewer::compare_test

#include "compare_test.moc"
