// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QHeaderView>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolButton>
#include <QUrl>
#include <QVBoxLayout>
#include <set>

#include "lessons/lesson_panel.h"
#include "scene/build/patch_count.h"
#include "scene/color_controls.h"
#include "solved_window.h"
#include "window/base/view_state_applier.h"

namespace transillum::viewer::window_test {

using namespace test;

namespace {

struct SolvedScene : SolvedWindow {
  using SolvedWindow::SolvedWindow;

  std::set<PatchId> patches_in_map() const {
    const Focus& focus = window->focus;
    const MapRecord& record = focus.map()->record();
    std::set<PatchId> patches;
    for (const std::int32_t row : record.map_after(focus.position().step)) {
      patches.insert(at(record.rows, row).patch);
    }
    return patches;
  }
  // A point of the 3-D view where a click hits one of `wanted`.
  QPoint place_of(const std::set<PatchId>& wanted) const {
    const QSize size = scene_view->canvas()->size();
    for (int y = 10; y < size.height(); y += 7) {
      for (int x = 10; x < size.width(); x += 7) {
        if (wanted.count(scene_view->patch_at({x, y})) > 0) {
          return {x, y};
        }
      }
    }
    return {-1, -1};
  }
};

QImage picture_of(QWidget* widget) { return widget->grab().toImage(); }

}  // namespace

class WindowTest : public QObject {
  Q_OBJECT

 private slots:
  void starts_with_the_first_page() {
    const auto window = make_window();
    auto* button = window->findChild<QAbstractButton*>("built_in_furnace");
    QVERIFY(button && button->isVisible());
    QVERIFY(color_count(picture_of(window.get())) > 8);
    QVERIFY(!window->scene.is_opening());  // nothing is solved yet
    QTest::mouseClick(button, Qt::LeftButton);
    QVERIFY(wait_for([&] { return window->snapshot() != nullptr; }));
    auto* scene_view = window->findChild<SceneView*>();
    QVERIFY(scene_view->isVisible());
    // The page can be shown again, and left, without changing the scene.
    auto* start = window->findChild<QAction*>("start");
    start->trigger();
    QVERIFY(button->isVisible() && !scene_view->isVisible() && start->isChecked());
    for (const QDockWidget* dock : window->findChildren<QDockWidget*>()) {
      QVERIFY2(!dock->isVisible(), qPrintable(dock->objectName()));
    }
    QVERIFY(window->settled() || wait_for([&] { return window->settled(); }));
    QCOMPARE(window->scene.spec(), std::string("furnace"));
    QVERIFY(color_count(scene_view->picture(1)) > 2);
    start->trigger();
    QVERIFY(scene_view->isVisible() && !start->isChecked());
    QVERIFY(window->findChild<QDockWidget*>("settings_dock")->isVisible());
    // A lesson whose scene is open shows the scene instead of the page.
    window->files().open_lesson("1", 1);
    QVERIFY(wait_for([&] { return window->findChild<ViewStateApplier*>()->arrived(); }));
    start->trigger();
    QVERIFY(!scene_view->isVisible());
    window->findChild<QAbstractButton*>("lesson_1")->click();
    QVERIFY(wait_for([&] {
      return window->findChild<ViewStateApplier*>()->arrived() && scene_view->isVisible();
    }));
    // Another scene is not shown beside the page of the lesson.
    start->trigger();
    button->click();
    QVERIFY(wait_for([&] { return window->scene.spec() == "furnace"; }));
    QVERIFY(wait_for([&] { return window->views().docks.current() == Layout::inspect; }));
  }

  void pictures_are_neither_blank_nor_uniform() {
    const SolvedScene solved("cornell-box");
    QVERIFY(solved.ready);
    const QImage scene = picture_of(solved.scene_view->canvas());
    QVERIFY2(color_count(scene) > 12, qPrintable(QString::number(color_count(scene))));
    QVERIFY(fraction_of(scene, theme::scene_background) < 0.7);
    const QImage map = picture_of(solved.map_view->canvas());
    QVERIFY2(color_count(map) > 8, qPrintable(QString::number(color_count(map))));
    QVERIFY(fraction_of(map, theme::scene_background) < 0.9);
    const QImage whole = picture_of(solved.window.get());
    QCOMPARE(whole.size(), solved.window->size() * solved.window->devicePixelRatioF());
    QVERIFY(color_count(whole) > 40);
  }

  void a_color_map_shows_its_color_bar() {
    const SolvedScene solved("cornell-box");
    QVERIFY(solved.ready);
    solved.window->findChild<QComboBox*>("color_mode")->setCurrentIndex(1);
    QVERIFY(comes_to_rest(*solved.window));
    const double fraction = fraction_in_own_color(*solved.scene_view, solved.window->colors);
    QVERIFY2(fraction > 0.9, qPrintable(QString::number(fraction)));
    const Color8 top = color_of(ColorMap::viridis, 1);
    const QImage whole = picture_of(solved.window.get());
    QVERIFY(fraction_of(whole, QColor(top[0], top[1], top[2])) > 0);
  }

  void typing_after_choosing_from_a_list_does_not_change_it() {
    const SolvedScene solved("furnace");
    QVERIFY(solved.ready);
    QApplication::setActiveWindow(solved.window.get());
    auto* quantity = solved.window->findChild<QComboBox*>("quantity");
    quantity->setFocus();
    quantity->showPopup();
    QVERIFY(wait_for([&] { return quantity->view()->isVisible(); }));
    QTest::keyClick(quantity->view(), Qt::Key_Down);
    QTest::keyClick(quantity->view(), Qt::Key_Return);
    QVERIFY(wait_for([&] { return !quantity->view()->isVisible(); }));
    QVERIFY(solved.window->colors.quantity() == Quantity::eye_radiance);
    QVERIFY(wait_for([&] { return solved.scene_view->canvas()->hasFocus(); }));
    QTest::keyClicks(QApplication::focusWidget(), "see");
    QVERIFY(solved.window->colors.quantity() == Quantity::eye_radiance);
  }

  // For a quantity of the selection, the bar keeps its place, so that selecting moves no picture.
  void a_color_bar_that_does_not_apply_takes_no_space() {
    const SolvedScene solved("furnace");
    QVERIFY(solved.ready);
    solved.window->selection.select(no_patch);
    const int whole = solved.scene_view->width();
    solved.window->colors.set_quantity(Quantity::form_factor_from);
    QVERIFY(comes_to_rest(*solved.window));
    const int beside_bar = solved.scene_view->width();
    QVERIFY(beside_bar < whole);
    solved.window->selection.select(0);
    QVERIFY(comes_to_rest(*solved.window));
    QCOMPARE(solved.scene_view->width(), beside_bar);
    solved.window->colors.set_quantity(Quantity::radiosity);
    QVERIFY(wait_for([&] { return solved.scene_view->width() == whole; }));
  }

  void exporting_a_picture_does_not_change_the_screen() {
    const SolvedScene solved("cornell-box");
    QVERIFY(solved.ready);
    const QImage before = picture_of(solved.scene_view->canvas());
    const QImage large = solved.scene_view->picture(2);
    QCOMPARE(large.size(), 2 * before.size());
    handle_posted();
    QVERIFY(picture_of(solved.scene_view->canvas()) == before);
  }

  void an_outline_has_the_same_color_from_all_sides() {
    const SolvedScene solved("rooms");
    QVERIFY(solved.ready);
    const PatchId lamp = 176;  // in a ceiling
    const Patch& patch = solved.window->snapshot()->loaded->scene->patch(lamp);
    ViewPoint view = solved.scene_view->view_point();
    view.target = patch.center;
    solved.window->selection.select(lamp);
    QVERIFY(comes_to_rest(*solved.window));
    // From the front, at a grazing angle, and through the culled back side.
    for (const double below : {2.0, 0.2, -0.2, -2.0}) {
      view.eye = patch.center + Vec3{-1, -8, 0} + below * patch.normal;
      solved.scene_view->set_view_point(view);
      QVERIFY(wait_for([&] { return solved.scene_view->drawn(); }));
      save_picture(*solved.window, QString("outline-%1").arg(below));
      const double pink = fraction_of(picture_of(solved.scene_view->canvas()), theme::selection);
      QVERIFY2(pink > 4e-4, qPrintable(QString("%1: %2").arg(below).arg(pink)));
    }
  }

  void a_click_in_the_scene_selects_the_patch_in_all_views() {
    const SolvedScene solved("furnace");
    QVERIFY(solved.ready);
    const QPoint place = solved.place_of(solved.patches_in_map());
    QVERIFY(place.x() >= 0);
    const PatchId patch = solved.scene_view->patch_at(place);
    QCOMPARE(fraction_of(picture_of(solved.scene_view->canvas()), theme::selection), 0.0);
    QCOMPARE(fraction_of(picture_of(solved.map_view->canvas()), theme::selection), 0.0);

    QTest::mouseClick(solved.scene_view->canvas(), Qt::LeftButton, {}, place);
    QCOMPARE(solved.window->selection.patch(), patch);
    QCOMPARE(solved.text("patch_id"), QString::number(patch));
    QVERIFY(!solved.text("patch_radiosity").isEmpty());
    // The patch emits along the newest direction, or receives: it is in one of the two maps.
    auto* receiving = solved.window->findChild<MapCanvas*>("map_canvas_before");
    QVERIFY(wait_for([&] {
      return fraction_of(picture_of(solved.map_view->canvas()), theme::selection) +
                 fraction_of(picture_of(receiving), theme::selection) >
             0;
    }));
    QVERIFY(fraction_of(picture_of(solved.scene_view->canvas()), theme::selection) > 0);
  }

  void a_drag_rotates_the_scene_and_selects_nothing() {
    const SolvedScene solved("furnace");
    QVERIFY(solved.ready);
    QWidget* canvas = solved.scene_view->canvas();
    solved.trigger("show_direction");
    const ViewPoint before = solved.scene_view->view_point();
    drag(*canvas, canvas->rect().center(), {90, 40}, 10);
    const ViewPoint after = solved.scene_view->view_point();
    QVERIFY(after.target == before.target);
    QVERIFY(norm(after.eye - before.eye) > 0.1 * norm(before.eye - before.target));
    // The picture belongs to the new camera.
    QVERIFY(comes_to_rest(*solved.window));
    const double fraction = fraction_in_own_color(*solved.scene_view, solved.window->colors);
    QVERIFY2(fraction > 0.9, qPrintable(QString::number(fraction)));
    QCOMPARE(solved.window->selection.patch(), no_patch);
  }

  void a_click_hits_front_sides_only() {
    const SolvedScene solved("furnace");
    QVERIFY(solved.ready);
    // The box is closed: behind its culled near walls there is a patch everywhere.
    const QPoint middle = solved.scene_view->canvas()->rect().center();
    const PatchId patch = solved.scene_view->patch_at(middle);
    QVERIFY(patch != no_patch);
  }

  void a_click_in_the_map_selects_the_patch() {
    const SolvedScene solved("furnace");
    QVERIFY(solved.ready);
    MapCanvas* canvas = solved.map_view->canvas();
    const QPoint middle(canvas->width() / 2, canvas->height() / 2 - 12);
    const PatchId patch = canvas->patch_at(middle);
    QVERIFY(patch != no_patch);
    QTest::mouseClick(canvas, Qt::LeftButton, {}, middle);
    QCOMPARE(solved.window->selection.patch(), patch);
    QCOMPARE(solved.text("patch_id"), QString::number(patch));
  }

  void fits_the_screen_of_a_projector() {
    const SolvedWindow solved("boards");
    const auto& window = solved.window;
    const auto fits = [&](const QSize& size) {
      for (const char* layout : {"layout_teach", "layout_inspect", "layout_debug"}) {
        window->findChild<QAction*>(layout)->trigger();
        window->resize(size);
        handle_posted();
        if (window->size() != size) {
          return qInfo() << layout << window->size(), false;
        }
      }
      return true;
    };
    const QSize small(1280, 720);
    QVERIFY(fits(small));
    window->views().lessons.show_page(3, 0);
    window->findChild<QAction*>("projector")->trigger();
    const QSize least = window->minimumSizeHint();
    window->findChild<QAction*>("projector")->trigger();
    QVERIFY2(least.width() <= small.width() && least.height() <= small.height(),
             qPrintable(QString("%1 x %2").arg(least.width()).arg(least.height())));
  }

  // 1280 x 720, or 2560 x 1440 at doubled scale, less the frame of a window.
  void no_layout_needs_more_than_a_small_screen_data() {
    QTest::addColumn<QString>("layout");
    for (const char* layout : {"layout_teach", "layout_inspect", "layout_debug"}) {
      QTest::newRow(layout) << layout;
    }
  }
  void no_layout_needs_more_than_a_small_screen() {
    QFETCH(QString, layout);
    const QSize screen(1280 - 16, 720 - 48);
    const auto window = make_window();
    QStringList too_large;
    const auto check = [&](const QString& what) {
      QCoreApplication::processEvents();
      const QSize least = window->minimumSizeHint();
      if (least.width() > screen.width() || least.height() > screen.height()) {
        too_large << QString("%1: %2 x %3").arg(what).arg(least.width()).arg(least.height());
      }
    };
    window->findChild<QAction*>(layout)->trigger();
    check("the start page");
    window->open("cornell-box", {Goal::Kind::iteration});
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    window->colors.set_mode(ColorMode::luminance);
    check("a scene");
    window->watches.add({Watch::Kind::map_size});
    check("a watch");
    window->hide();  // nothing has to be painted
    window->views().lessons.show_page(3, 0);
    window->findChild<QAction*>(layout)->trigger();
    check("a lesson");
    for (const std::string& panel : window->views().docks.panels()) {
      window->views().docks.bring_to_front(panel);
      check(QString::fromStdString(panel));
    }
    QVERIFY2(too_large.isEmpty(), qPrintable(too_large.join("; ")));
  }

  void color_controls_do_not_overlap_in_a_narrow_view_data() {
    QTest::addColumn<bool>("projects");
    QTest::newRow("usual type") << false;
    QTest::newRow("projector") << true;
  }
  void color_controls_do_not_overlap_in_a_narrow_view() {
    QFETCH(bool, projects);
    const auto window = make_window();
    if (projects) {
      window->findChild<QAction*>("projector")->trigger();
    }
    ColorControls controls(window->colors);
    auto* tool = new QToolButton;
    tool->setText("Camera ");
    controls.add_tool(tool);
    controls.show();
    for (const ColorMode mode : {ColorMode::true_color, ColorMode::luminance}) {
      window->colors.set_mode(mode);
      QCoreApplication::processEvents();
      const int least = controls.minimumSizeHint().width();
      QVERIFY2(least <= 480, qPrintable(QString::number(least)));
      for (int width = least; width < 900; width += 15) {
        controls.resize(width, controls.sizeHint().height());
        QCoreApplication::processEvents();
        std::vector<QRect> places;
        for (const QWidget* part : controls.findChildren<QWidget*>()) {
          const bool is_control = qobject_cast<const QComboBox*>(part) ||
                                  qobject_cast<const QAbstractSpinBox*>(part) ||
                                  qobject_cast<const QAbstractButton*>(part);
          // The controls of the color scale are in a menu.
          if (!is_control || !part->isVisible() || part->window() != &controls) {
            continue;
          }
          const QRect place(part->mapTo(&controls, QPoint()), part->size());
          QVERIFY2(controls.rect().contains(place),
                   qPrintable(part->objectName() + " at " + QString::number(width)));
          for (const QRect& other : places) {
            QVERIFY2(!other.intersects(place),
                     qPrintable(part->objectName() + " at " + QString::number(width)));
          }
          places.push_back(place);
        }
        QVERIFY(places.size() >= 4);
      }
    }
    if (projects) {
      window->findChild<QAction*>("projector")->trigger();
    }
  }

  void a_panel_behind_others_does_no_work() {
    const auto window = make_window();
    window->views().docks.cover(false);
    auto* dock = window->findChild<QDockWidget*>("received_dock");
    QVERIFY(!dock->isHidden());
    QVERIFY(!dock->widget()->isVisible());
    window->views().docks.bring_to_front("received");
    QVERIFY(wait_for([&] { return dock->widget()->isVisible(); }, 5000));
    window->views().docks.bring_to_front("convergence");
    QVERIFY(wait_for([&] { return !dock->widget()->isVisible(); }, 5000));
  }

  void a_layout_sets_the_sizes_of_its_docks() {
    const auto window = make_window();
    window->resize(1440, 900);
    for (const char* panel : {"tree", "algorithm", "event"}) {
      window->findChild<QAction*>("layout_teach")->trigger();
      window->views().docks.bring_to_front(panel);
      const auto* dock = window->findChild<QDockWidget*>(QString(panel) + "_dock");
      QVERIFY(wait_for([&] { return dock->width() >= 400 && dock->height() >= 240; }, 5000));
    }
  }

  void tables_grow_with_the_font() {
    const auto window = make_window();
    auto* table = window->findChild<QTableView*>("received_light");
    const auto header_fits = [&] {
      const QFontMetrics type(table->horizontalHeader()->font());
      for (int k = 0; k + 1 < table->model()->columnCount(); ++k) {
        const QString name = table->model()->headerData(k, Qt::Horizontal).toString();
        if (table->columnWidth(k) < type.horizontalAdvance(name)) {
          return false;
        }
      }
      return table->verticalHeader()->defaultSectionSize() >= table->fontMetrics().height();
    };
    QVERIFY(header_fits());
    const int width = table->columnWidth(0);
    window->findChild<QAction*>("projector")->trigger();
    const bool wider = wait_for([&] { return table->columnWidth(0) > width; }, 5000);
    const bool fits = header_fits();
    window->findChild<QAction*>("projector")->trigger();
    QVERIFY(wider);
    QVERIFY(fits);
  }

  void panels_can_be_closed_and_reopened() {
    const auto window = make_window();
    window->open("furnace");
    auto* settings = window->findChild<QDockWidget*>("settings_dock");
    settings->close();
    QVERIFY(!settings->isVisible());
    window->findChild<QAction*>("layout_reset")->trigger();
    QVERIFY(settings->isVisible());
    window->findChild<QAction*>("layout_debug")->trigger();
    QVERIFY(window->findChild<QDockWidget*>("map_dock")->isVisible());
    QVERIFY(window->findChild<QDockWidget*>("algorithm_dock")->isVisible());
    QVERIFY(!settings->isVisible());
  }
};

const test::Registered registered("window", test::run_as_viewer<WindowTest>);

}  // namespace transillum::viewer::window_test

#include "window_test.moc"
