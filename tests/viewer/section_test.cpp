// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The section of a direction. Oracle: in flatland, of depth 1 m, an area of the map is a length.
#include "map/section_view.h"

#include <QAction>
#include <algorithm>
#include <cmath>

#include "lessons/lesson_html.h"
#include "lessons/lesson_panel.h"
#include "solved_window.h"
#include "transillum/at.h"
#include "window/base/dock_layouts.h"

namespace transillum::viewer::section_test {

using namespace test;

namespace {

RecordedMap record(const std::string& scene, const Vec3& omega) {
  auto loaded = std::make_shared<LoadedScene>();
  loaded->scene = load_scene(scene);
  loaded->tree = std::make_shared<const BspTree>(*loaded->scene);
  RecordedMap map;
  map.history =
      MapHistory(record_local_map(*loaded->scene, *loaded->tree, normalized(omega)).record);
  map.loaded = loaded;
  return map;
}

double length_of(const Section::Segment& segment) {
  return std::hypot(segment.b.x - segment.a.x, segment.b.y - segment.a.y);
}

const Vec3 slanted{0.4, 0, 0.9};

double distance(const Vec2& a, const Vec2& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// The segment of a patch in the section that is shown now; an empty one while none is.
Section::Segment segment_of(const SectionView& view, PatchId patch) {
  if (!view.section()) {
    return {};
  }
  const auto& segments = view.section()->segments;
  const auto found = std::find_if(segments.begin(), segments.end(),
                                  [&](const auto& segment) { return segment.patch == patch; });
  return found == segments.end() ? Section::Segment{} : *found;
}

/// The top of the upper board.
PatchId top_of_board(const Scene& scene) {
  PatchId top = no_patch;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Patch& patch = scene.patch(i);
    if (patch.normal.z > 0.9 && (top == no_patch || patch.center.z > scene.patch(top).center.z)) {
      top = i;
    }
  }
  return top;
}

}  // namespace

class SectionTest : public QObject {
  Q_OBJECT

 private slots:
  void intervals_are_areas_over_the_depth_data() {
    QTest::addColumn<double>("x");
    QTest::newRow("up") << 0.0;
    QTest::newRow("to the right") << 0.4;
    QTest::newRow("nearly level") << -5.0;
  }
  void intervals_are_areas_over_the_depth() {
    QFETCH(double, x);
    const RecordedMap map = record("flatland", {x, 0, 0.9});
    const Section section = section_of(map);
    QCOMPARE(section.intervals.size(), map.record().rows.size());
    for (const Section::Interval& interval : section.intervals) {
      const double area = map.record().area(map.row(interval.row));
      QVERIFY(std::abs(interval.high - interval.low - area) < 1e-12);
    }
  }

  // All faces but the two at the ends of the room; lengths are areas, too.
  void segments_are_the_patches_that_the_plane_cuts() {
    const RecordedMap map = record("flatland", slanted);
    const Section section = section_of(map);
    QCOMPARE(section.segments.size(), std::size_t{14});
    for (const Section::Segment& segment : section.segments) {
      const Patch& patch = map.loaded->scene->patch(segment.patch);
      QVERIFY(std::abs(length_of(segment) - patch.area) < 1e-12);
      QVERIFY(std::abs(segment.front.x - patch.normal.x) < 1e-12);
      QVERIFY(std::abs(segment.front.y - patch.normal.z) < 1e-12);
    }
  }

  // A strip that begins at a receiver ends on both patches, and is as wide as its interval.
  void strips_join_the_patches_that_see_each_other() {
    for (const char* scene : {"flatland", "cornell-box", "boards:n=5"}) {
      const RecordedMap map = record(scene, {0.3, 0.2, 0.8});
      const Section section = section_of(map);
      const Vec3 normal = cross(section.up, section.right);
      QVERIFY(std::abs(dot(normal, map.record().frame.omega)) < 1e-12);
      int strips = 0;
      for (std::int32_t k = 0; k < map.history.step_count(); ++k) {
        for (const std::int32_t r : map.history.inside_at(k)) {
          const Section::Interval* interval = section.interval_of(r);
          if (!interval || !map.history.exchanges(r)) {
            continue;
          }
          const PatchId receiver = map.history.step(k).patch;
          const auto strip = strip_of(section, map, *interval, receiver);
          QVERIFY(strip);
          check_strip(section, *strip, {receiver, map.row(r).patch});
          ++strips;
        }
      }
      QVERIFY(strips > 3);
    }
  }

  void shows_the_step_and_the_direction_in_focus() {
    const SolvedWindow solved("flatland");
    QVERIFY(solved.ready);
    solved.window->views().docks.bring_to_front("section");
    const auto* view = solved.window->findChild<SectionView*>("section_view");
    Focus& focus = solved.window->focus;
    QVERIFY(!focus.at_step());
    double exchanged = 0;
    for (const SectionView::Shown& one : view->shown()) {
      QVERIFY(one.receiver != no_patch);
      exchanged += one.interval.high - one.interval.low;
    }
    QVERIFY(exchanged > 0);
    for (const int direction : {2, 5}) {
      focus.go_to({0, direction, 3});
      QVERIFY(wait_for([&] { return focus.arrived() && solved.window->settled(); }));
      QCOMPARE(view->section()->omega.x,
               view->section()->in_plane(focus.map()->record().frame.omega).x);
      const std::size_t before = view->shown().size();
      solved.trigger("step_on");
      QVERIFY(wait_for([&] { return focus.arrived() && solved.window->settled(); }));
      QCOMPARE(focus.position().step, 4);
      const auto rows = focus.map()->record().map_after(4);
      const auto& intervals = *view->section();
      const auto crossed = std::count_if(rows.begin(), rows.end(), [&](std::int32_t r) {
        return intervals.interval_of(r) != nullptr;
      });
      QCOMPARE(std::ssize(view->shown()), crossed);
      QVERIFY(before > 0 && color_count(picture_of_view(*view)) > 4);
    }
  }

  void a_click_selects_the_patch_of_a_segment() {
    const SolvedWindow solved("flatland");
    QVERIFY(solved.ready);
    solved.window->views().docks.bring_to_front("section");
    auto* view = solved.window->findChild<SectionView*>("section_view");
    QVERIFY(wait_for([&] { return view->isVisible(); }));
    int found = 0;
    for (int y = 5; y < view->height() && found < 3; y += 6) {
      for (int x = 5; x < view->width(); x += 6) {
        QTest::mouseClick(view, Qt::LeftButton, {}, {x, y});
        found += solved.window->selection.patch() == 4;
      }
    }
    QVERIFY(found > 0);  // the lamp
  }

  // The board turns about the other end and is stretched; the section follows, and what is solved
  // afterwards has the board where the hand left it.
  void an_end_of_a_segment_is_dragged() {
    const SolvedWindow solved(
        "flatland", {.directions = 16, .sampling = Sampling::hammersley, .first_shot = {}});
    QVERIFY(solved.ready);
    solved.window->views().docks.bring_to_front("section");
    solved.window->focus.go_to({0, 0, 3});
    QVERIFY(wait_for([&] { return solved.window->focus.arrived() && solved.window->settled(); }));
    auto* view = solved.window->findChild<SectionView*>("section_view");
    const auto loaded = solved.window->snapshot()->loaded;
    const PatchId top = top_of_board(*loaded->scene);
    const Section::Segment before = segment_of(*view, top);
    const Vec2 goal{before.b.x + 0.4, before.b.y - 0.5};
    const auto is_dragged = [&](const Section::Segment& now) {
      return distance(now.a, before.a) + distance(now.b, goal) < 1e-9;
    };
    emit view->grabbed({top, before.b, before.a});
    emit view->dragged(goal);
    QVERIFY(wait_for([&] { return is_dragged(segment_of(*view, top)); }));
    QVERIFY(solved.window->snapshot()->loaded == loaded);
    emit view->released();
    QVERIFY(comes_to_rest(*solved.window));
    QVERIFY(solved.window->snapshot()->loaded != loaded);
    QVERIFY(is_dragged(segment_of(*view, top)));
    QCOMPARE(solved.window->undo.count(), 1);
    // The lower side, of the same board, is as long, and nothing else has moved.
    const Scene& moved = *solved.window->snapshot()->loaded->scene;
    int others = 0, stretched = 0;
    for (PatchId i = 0; i < moved.patch_count(); ++i) {
      const double ratio = moved.patch(i).area / loaded->scene->patch(i).area;
      others += ratio == 1 && norm(moved.patch(i).center - loaded->scene->patch(i).center) == 0;
      stretched += std::abs(ratio - moved.patch(top).area / loaded->scene->patch(top).area) < 1e-9;
    }
    QCOMPARE(others, moved.patch_count() - 4);
    QVERIFY(stretched >= 2);
    solved.window->undo.undo();
    QVERIFY(comes_to_rest(*solved.window));
    QVERIFY(distance(segment_of(*view, top).b, before.b) == 0);
  }

  // By the mouse: the middle of a board moves the board, the middle of a wall this wall alone.
  void a_segment_is_dragged_by_its_middle_data() {
    QTest::addColumn<bool>("wall");
    QTest::newRow("board") << false;
    QTest::newRow("wall") << true;
  }
  void a_segment_is_dragged_by_its_middle() {
    QFETCH(const bool, wall);
    const SolvedWindow solved("flatland");
    QVERIFY(solved.ready);
    solved.window->views().docks.bring_to_front("section");
    auto* view = solved.window->findChild<SectionView*>("section_view");
    QVERIFY(wait_for([&] { return view->isVisible(); }));
    const auto loaded = solved.window->snapshot()->loaded;
    const PatchId patch = wall ? 0 : top_of_board(*loaded->scene);
    const Section::Segment before = segment_of(*view, patch);
    const QPointF a = view->pixel_of(before.a), b = view->pixel_of(before.b);
    const QPoint from = (0.6 * a + 0.4 * b).toPoint(), to = from - QPoint(0, 20);
    const double pixel = distance(before.a, before.b) / std::hypot(b.x() - a.x(), b.y() - a.y());
    QTest::mousePress(view, Qt::LeftButton, {}, from);
    QTest::mouseMove(view, from - QPoint(0, 10));
    QTest::mouseMove(view, to);
    QTest::mouseRelease(view, Qt::LeftButton, {}, to);
    QVERIFY(comes_to_rest(*solved.window));
    const Scene& moved = *solved.window->snapshot()->loaded->scene;
    int others = 0;
    for (PatchId i = 0; i < moved.patch_count(); ++i) {
      const Vec3 move = moved.patch(i).center - loaded->scene->patch(i).center;
      others += norm(move) > 0;
      QVERIFY(norm(move) == 0 || std::abs(move.z - 20 * pixel) < 1.5 * pixel);
    }
    QCOMPARE(others, wall ? 1 : 4);
  }

  // A browser shows, at a step, the intervals of V and the segments.
  void a_page_in_html_has_its_section() {
    const RecordedMap map = record("flatland", slanted);
    const std::vector<Color8> colors(static_cast<std::size_t>(map.loaded->scene->patch_count()),
                                     Color8{1, 2, 3});
    const QByteArray svg = section_svg(map, {3}, colors, true);
    QCOMPARE(svg.count("<line "), 14);
    QCOMPARE(svg.count("data-made="), 2 * static_cast<int>(map.record().rows.size()));
    QCOMPARE(svg.count("data-made=") - svg.count("display:none"),
             2 * static_cast<int>(map.record().map_after(3).size()));
    const Lesson& lesson = at(built_in_lessons(), 7);
    ShownPage page;
    page.page = lesson.pages.front();
    page.map = std::make_shared<const RecordedMap>(map);
    page.patch_colors = colors;
    const QByteArray html = lesson_html("t", {page});
    QCOMPARE(html.count("<svg class=\"map\""), 1);
    QVERIFY(html.contains("<line "));
  }

 private:
  static QImage picture_of_view(const QWidget& view) {
    return const_cast<QWidget&>(view).grab().toImage();
  }
  static void check_strip(const Section& section, const SectionStrip& strip,
                          const std::array<PatchId, 2>& patches) {
    for (const bool source : {false, true}) {
      for (const std::size_t corner :
           source ? std::array<std::size_t, 2>{1, 2} : std::array<std::size_t, 2>{0, 3}) {
        const Vec2& p = strip.at(corner);
        QVERIFY(
            std::any_of(section.segments.begin(), section.segments.end(), [&](const auto& segment) {
              const Vec2 d{p.x - segment.a.x, p.y - segment.a.y};
              return segment.patch == patches.at(source ? 1 : 0) &&
                     std::abs(d.x * segment.front.x + d.y * segment.front.y) < 1e-9;
            }));
      }
    }
  }
};

const test::Registered registered("section", test::run_as_viewer<SectionTest>);

}  // namespace transillum::viewer::section_test

#include "section_test.moc"
