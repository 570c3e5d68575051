// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The visibility map while no step is shown: both sides of a direction, and what a step shows of
// it. Oracle for who is seen at a point: the planes of all patches that cover it, by height.
#include <QAction>
#include <QHelpEvent>
#include <QToolButton>

#include "colors/pointer_label.h"
#include "map/map_sheet.h"
#include "model/snapshot_values.h"
#include "solved_window.h"
#include "transillum/at.h"
#include "window/base/dock_layouts.h"

namespace transillum::viewer::whole_map_test {

using namespace test;

namespace {

struct WholeMap : SolvedWindow {
  Focus& focus;
  MapCanvas* sources;
  MapCanvas* receivers;

  explicit WholeMap(const QString& scene)
      : SolvedWindow(scene),
        focus(window->focus),
        sources(window->findChild<MapCanvas*>("map_canvas")),
        receivers(window->findChild<MapCanvas*>("map_canvas_before")) {
    trigger("layout_debug");
    ready = ready && comes_to_rest(*window);
  }
  bool settles() const {
    return wait_for([this] { return window->settled(); });
  }
  QToolButton* button(const char* name) const { return window->findChild<QToolButton*>(name); }
};

/// The patch seen at a point of the plane, of those whose front emits toward -omega (seen from
/// below), or receives (seen from above); no_patch if there is none, or it is not clear.
PatchId seen_at(const RecordedMap& map, const Vec2& p, bool receives) {
  const PlaneFrame& frame = map.record().frame;
  PatchId seen = no_patch;
  double height = 0;
  for (const MapRecord::Row& row : map.record().rows) {
    if (row.parent != MapRecord::no_row || !map.record().covers(row, p)) {
      continue;
    }
    const Patch& patch = map.loaded->scene->patch(row.patch);
    if ((dot(patch.normal, frame.omega) > 0) != receives) {
      continue;
    }
    const double h = dot(*frame.point_on(patch, p) - frame.origin, frame.omega);
    if (seen == no_patch || (receives ? h > height : h < height)) {
      seen = row.patch;
      height = h;
    }
  }
  return seen;
}

/// The number of points of a canvas at which a patch is drawn; -1 if a wrong one is.
int points_with_the_right_patch(const MapCanvas& canvas, bool receives) {
  const auto map = canvas.map_shown();
  int right = 0;
  for (int y = 9; y < canvas.height(); y += 17) {
    for (int x = 9; x < canvas.width(); x += 17) {
      const PatchId expected = seen_at(*map, *canvas.point_at({x + 0.0, y + 0.0}), receives);
      if (canvas.patch_at({x + 0.0, y + 0.0}) != expected) {
        return -1;
      }
      right += expected != no_patch;
    }
  }
  return right;
}

}  // namespace

class WholeMapTest : public QObject {
  Q_OBJECT

 private slots:
  void shows_both_sides_of_the_direction_until_one_steps_data() {
    QTest::addColumn<QString>("scene");
    QTest::newRow("closed") << "cornell-box";
    QTest::newRow("cyclic overlap") << "boards:n=5";
  }
  void shows_both_sides_of_the_direction_until_one_steps() {
    QFETCH(QString, scene);
    const WholeMap s(scene);
    QVERIFY(s.ready);
    QVERIFY(s.focus.following() && !s.focus.at_step());
    QVERIFY(s.sources->isVisible() && s.receivers->isVisible());
    QVERIFY(points_with_the_right_patch(*s.sources, false) > 50);
    QVERIFY(points_with_the_right_patch(*s.receivers, true) > 50);
    save_picture(*s.window, "whole-" + scene.section(':', 0, 0));
    // The first step of the same direction, and what it is.
    const int direction = s.focus.position().direction;
    s.trigger("step_on");
    QVERIFY(s.settles());
    QVERIFY(s.focus.at_step() && !s.receivers->isVisible());
    QVERIFY((s.focus.position() == RunPosition{0, direction, 0}));
    QCOMPARE(s.sources->polygon_count(), s.focus.map()->record().map_after(0).size());
    QVERIFY(s.map_view->findChild<QLabel*>("map_title")->text().contains("stepped to"));
    s.button("map_whole")->click();
    QVERIFY(s.settles());
    QVERIFY(!s.focus.at_step() && s.receivers->isVisible());
    QCOMPARE(s.focus.position().direction, direction);
  }

  void another_direction_is_shown_whole_too() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    s.trigger("previous_direction");
    QVERIFY(s.settles());
    QVERIFY(!s.focus.following() && !s.focus.at_step() && s.receivers->isVisible());
    QCOMPARE(s.focus.position().step, s.focus.map()->history.step_count() - 1);
    s.focus.go_to_step(4);
    s.trigger("previous_direction");
    QVERIFY(s.settles());
    QVERIFY(s.focus.at_step());
    QCOMPARE(s.focus.position().step, 4);
  }

  /// A map of an older direction does not pass for the newest.
  void the_title_names_a_newer_direction_that_is_still_recorded() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    const auto* title = s.map_view->findChild<QLabel*>("map_title");
    QVERIFY(title->text().startsWith("Direction 32 of 32, complete"));
    s.focus.follow(0, 4);
    QVERIFY(title->text().startsWith("Direction 32 of 32, complete · direction 5 follows"));
    QVERIFY(s.settles());
    QVERIFY(title->text().startsWith("Direction 5 of 32, complete"));
    QVERIFY(!title->text().contains("follows"));
  }

  void a_choice_of_the_toolbar_is_shown_alone() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    s.button("map_receivers")->click();
    QVERIFY(s.settles());
    QVERIFY(!s.receivers->isVisible());
    QVERIFY(points_with_the_right_patch(*s.sources, true) > 50);
    // A patch sees the inside lists of its steps.
    QVERIFY(!s.button("map_seen")->isEnabled());
    const MapHistory& history = s.focus.map()->history;
    std::int32_t step = history.step_count() - 1;
    while (!history.step(step).front_facing) {
      --step;
    }
    const PatchId patch = history.step(step).patch;
    std::size_t parts = 0;
    for (const std::int32_t k : history.steps_of(patch)) {
      parts += history.step(k).patch == patch ? history.inside_at(k).size() : 0;
    }
    s.window->selection.select(patch);
    QVERIFY(s.button("map_seen")->isEnabled());
    s.button("map_seen")->click();
    QVERIFY(s.settles());
    QCOMPARE(s.sources->polygon_count(), parts);
    save_picture(*s.window, "seen-by-patch");
    s.button("map_complete")->click();
    QVERIFY(s.settles());
    QVERIFY(s.receivers->isVisible());
  }

  /// The hidden part of a selected patch has no outline.
  void the_selection_is_outlined_where_it_is_seen() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    const QImage before = s.sources->grab().toImage();
    const PatchId patch = s.sources->patch_at(s.sources->rect().center());
    QVERIFY(patch != no_patch);
    s.window->selection.select(patch);
    QVERIFY(s.settles());
    const QImage after = s.sources->grab().toImage();
    const auto near_patch = [&](int x, int y) {
      for (const int dy : {-4, 0, 4}) {
        for (const int dx : {-4, 0, 4}) {
          if (s.sources->patch_at(QPointF(x + dx, y + dy)) == patch) {
            return true;
          }
        }
      }
      return false;
    };
    int changed = 0;
    for (int y = 0; y < before.height(); ++y) {
      for (int x = 0; x < before.width(); ++x) {
        if (before.pixel(x, y) != after.pixel(x, y)) {
          ++changed;
          QVERIFY2(near_patch(x, y), qPrintable(QString("%1, %2").arg(x).arg(y)));
        }
      }
    }
    QVERIFY(changed > 50);
  }

  void scale_bar_and_legend_lie_below_the_map() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    s.focus.go_to_step(12);
    s.sources->set_view({6, {}});
    QVERIFY(s.settles());
    const QImage picture = s.sources->grab().toImage();
    const int strip = static_cast<int>(scale_bar_room(s.sources->height()));
    QVERIFY(strip > 0);
    const int inside = picture.height() - strip + 1, above = picture.height() - strip - 2;
    QVERIFY(picture.pixelColor(picture.width() / 2, above) != theme::scene_background);
    for (int x = 0; x < picture.width(); ++x) {
      QCOMPARE(picture.pixelColor(x, inside), theme::scene_background);
    }
  }

  void a_callout_of_omega_points_at_its_sign() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    const QImage before = s.sources->grab().toImage();
    s.sources->show_callouts({{"omega", Callout::Anchor::direction, no_patch, {}}});
    const QImage after = s.sources->grab().toImage();
    // The dot of the callout fills the sign's circle.
    const QPoint sign = axes_origin(s.sources->size()).toPoint() - QPoint(2, 0);
    QVERIFY(before.pixel(sign) != after.pixel(sign));
    for (int y = 0; y < after.height() / 2; ++y) {
      for (int x = 0; x < after.width() / 2; ++x) {
        QCOMPARE(before.pixel(x, y), after.pixel(x, y));
      }
    }
  }

  /// One tip at a time, beside what it explains.
  void the_plate_leaves_its_polygon_visible() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    QVERIFY(s.sources->toolTip().isEmpty());
    s.focus.go_to_step(12);
    s.sources->set_view({0.4, {}});
    QVERIFY(s.settles());
    const QPoint place = s.sources->map_shown() ? s.sources->rect().center() : QPoint();
    QVERIFY(s.sources->row_at(place) != MapRecord::no_row);
    auto* plate = s.sources->findChild<PointerLabel*>();
    QMouseEvent move(QEvent::MouseMove, place, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(s.sources, &move);
    QVERIFY(wait_for([&] { return plate->text().count('\n') > 2; }));
    QVERIFY(plate->isVisible() && s.sources->rect().contains(plate->geometry()));
    QVERIFY(!plate->geometry().intersects(s.sources->box_of_row(s.sources->row_at(place))));
    save_picture(*s.window, "plate");
  }

  void scene_and_map_change_places() {
    const WholeMap s("cornell-box");
    QVERIFY(s.ready);
    const auto widths = [&] { return std::pair(s.scene_view->width(), s.map_view->width()); };
    const auto before = widths();
    QVERIFY(before.first < before.second);
    s.trigger("swap_views");
    QVERIFY(comes_to_rest(*s.window));
    save_picture(*s.window, "swapped");
    QVERIFY(widths().first > widths().second);
    s.trigger("swap_views");
    QVERIFY(comes_to_rest(*s.window));
    QVERIFY(widths() == before);
    s.trigger("layout_inspect");
    QVERIFY(!s.window->findChild<QAction*>("swap_views")->isEnabled());
  }
};

const test::Registered registered("whole_map", test::run_as_viewer<WholeMapTest>);

}  // namespace transillum::viewer::whole_map_test

#include "whole_map_test.moc"
