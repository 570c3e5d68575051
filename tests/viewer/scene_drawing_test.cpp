// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How the scene is drawn: hidden and cut patches, overlays, edges, shading, and its camera.
#include <QCheckBox>
#include <QComboBox>
#include <QSet>
#include <QSlider>
#include <numeric>

#include "inspected_window.h"
#include "scene/color_controls.h"
#include "scene/feature_edges.h"
#include "scene/scene_page.h"
#include "solved_snapshot.h"
#include "state/camera_views.h"

namespace transillum::viewer::scene_drawing_test {

using namespace test;

namespace {

constexpr double most = 0.9;  ///< fraction of points without a line

}  // namespace

class SceneDrawingTest : public QObject {
  Q_OBJECT

 private slots:
  void hidden_patches_are_not_drawn_or_picked() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    shown.trigger("show_direction");
    QWidget* canvas = shown.scene_view->canvas();
    // The panel of the patch becomes as wide as its numbers, and the scene keeps its place beside
    // it.
    shown.scene_view->setFixedSize(shown.scene_view->size());
    const PatchId front = shown.scene_view->patch_at(canvas->rect().center());
    QVERIFY(front != no_patch);
    const auto patches_seen = [&] {
      QSet<PatchId> seen;
      for (int y = 3; y < canvas->height(); y += 10) {
        for (int x = 3; x < canvas->width(); x += 10) {
          seen << shown.scene_view->patch_at({x, y});
        }
      }
      return seen - QSet<PatchId>{no_patch};
    };
    shown.window->selection.select(front);
    const QImage before = shown.picture();
    const QSet<PatchId> all = patches_seen();
    QVERIFY(all.contains(front) && all.size() > 5);
    shown.trigger("hide_selection");
    QVERIFY(!patches_seen().contains(front));
    QVERIFY(comes_to_rest(*shown.window) && shown.fraction_in_own_color() > most);
    shown.trigger("undo");
    QCOMPARE(shown.picture(), before);
    QCOMPARE(patches_seen(), all);
    shown.trigger("isolate_selection");
    QCOMPARE(patches_seen(), QSet<PatchId>{front});
    shown.trigger("show_smooth");  // the other mesh omits them too
    const double background = fraction_of(shown.picture(), theme::scene_background);
    shown.trigger("show_all");
    const double around = fraction_of(shown.picture(), theme::scene_background);
    QVERIFY2(background > around + 0.2, qPrintable(QString("%1, %2").arg(background).arg(around)));
    shown.trigger("show_smooth");
    QCOMPARE(shown.picture(), before);
    QVERIFY(!shown.part<QAction>("show_all")->isEnabled());
  }

  void a_plane_cuts_the_picture_open() {
    const Inspected shown("rooms");
    QVERIFY(shown.ready);
    shown.trigger("show_direction");
    const auto patches_seen = [&shown] {
      QSet<PatchId> seen;
      const QWidget* canvas = shown.scene_view->canvas();
      for (int y = 5; y < canvas->height(); y += 9) {
        for (int x = 5; x < canvas->width(); x += 9) {
          seen << shown.scene_view->patch_at({x, y});
        }
      }
      return seen;
    };
    const QSet<PatchId> whole = patches_seen();
    const Scene& scene = *shown.window->snapshot()->loaded->scene;
    const double middle = scene.bounds().center().x;
    const auto reaches = [&](PatchId patch, double side) {
      for (const PointId corner : scene.outline(patch)) {
        if (side * (scene.point(corner).x - middle) >= -1e-9) {
          return true;
        }
      }
      return patch == no_patch;
    };
    shown.trigger("clip_next");  // x
    QCOMPARE(shown.part<QComboBox>("clip_axis")->currentText(), QString("x"));
    for (const double side : {1.0, -1.0}) {
      shown.part<QCheckBox>("clip_other_side")->setChecked(side < 0);
      const QSet<PatchId> cut = patches_seen();
      QVERIFY(cut != whole);
      for (const PatchId patch : cut) {
        QVERIFY(patch == no_patch || reaches(patch, side));
      }
    }
    save_picture(*shown.window, "clipped");
    for (int k = 0; k < 3; ++k) {
      shown.trigger("clip_next");
    }
    QVERIFY(patches_seen() == whole);
  }

  void each_overlay_is_drawn_data() {
    QTest::addColumn<QString>("scene");
    QTest::addColumn<QString>("overlay");
    QTest::addColumn<QColor>("color");
    QTest::newRow("normals") << "rooms"
                             << "show_normals" << theme::processed;
    QTest::newRow("back sides") << "rooms"
                                << "show_back_faces" << QColor(0x8c, 0x3a, 0x4a);
    QTest::newRow("wireframe") << "rooms"
                               << "show_wireframe" << theme::scene_background;
    QTest::newRow("cut patches") << "boards"
                                 << "show_fragments" << theme::outside;
  }
  void each_overlay_is_drawn() {
    QFETCH(const QString, scene);
    QFETCH(const QString, overlay);
    QFETCH(const QColor, color);
    const Inspected shown(scene);
    QVERIFY(shown.ready);
    const QByteArray name = overlay.toUtf8();
    const QImage before = shown.picture();
    shown.trigger(name);
    const QImage with = shown.picture();
    // The line has at least a tenth of the width.
    const double least = 0.1 * with.width() / (with.width() * with.height());
    const double fractions[] = {fraction_of(before, color), fraction_of(with, color)};
    QVERIFY2(fractions[1] > fractions[0] + least,
             qPrintable(QString("%1, %2").arg(fractions[0]).arg(fractions[1])));
    shown.trigger(name);
    QCOMPARE(shown.picture(), before);
  }

  void smooth_shading_has_more_colors() {
    const Inspected shown("rooms");
    QVERIFY(shown.ready);
    shown.trigger("show_direction");
    const QImage before = shown.picture();
    shown.trigger("show_smooth");
    const QImage smooth = shown.picture();
    const auto colors = [](const QImage& image) {
      QSet<QRgb> found;
      for (int k = 0; k < image.width() * image.height(); ++k) {
        found.insert(image.pixel(k % image.width(), k / image.width()));
      }
      return found.size();
    };
    QVERIFY2(colors(smooth) > colors(before),
             qPrintable(QString("%1, %2").arg(colors(smooth)).arg(colors(before))));
    shown.trigger("show_smooth");
    QCOMPARE(shown.picture(), before);
  }

  void normals_and_cuts_follow_hiding_and_the_clipping_plane() {
    const Inspected shown("boards");
    QVERIFY(shown.ready);
    shown.trigger("show_direction");
    shown.part<QComboBox>("clip_axis")->setCurrentIndex(3);
    auto* place = shown.part<QSlider>("clip_place");
    // The number of pixels that an overlay draws; nothing else changes.
    const auto drawn = [&shown](const char* overlay) {
      const QImage without = shown.picture();
      shown.trigger(overlay);
      const QImage with = shown.picture();
      shown.trigger(overlay);
      return different_pixels(with, without);
    };
    for (const char* overlay : {"show_normals", "show_fragments"}) {
      place->setValue(place->minimum());
      QVERIFY2(drawn(overlay) > 100, overlay);
      place->setValue(place->maximum());
      QVERIFY2(drawn(overlay) < 10, overlay);
      place->setValue(place->minimum());
      const int patches = shown.window->snapshot()->loaded->scene->patch_count();
      std::vector<PatchId> all(static_cast<std::size_t>(patches));
      std::iota(all.begin(), all.end(), 0);
      shown.window->selection.select_all(all);
      shown.trigger("hide_selection");
      shown.window->selection.select(no_patch);
      QCOMPARE(drawn(overlay), 0);
      shown.trigger("show_all");
    }
  }

  void the_plane_does_not_tint_mapped_colors() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    shown.window->colors.set_automatic_exposure(false);
    shown.scene_view->set_direction_followed(true);
    // The number of pixels that the direction changes.
    const auto changed = [&shown] {
      const QImage with = shown.picture();
      shown.trigger("show_direction");
      const QImage without = shown.picture();
      shown.trigger("show_direction");
      return different_pixels(with, without);
    };
    const int filled = changed();
    shown.window->colors.set_mode(ColorMode::luminance);
    const int outlined = changed();
    QVERIFY2(outlined > 0 && 3 * outlined < filled,
             qPrintable(QString("%1 of %2").arg(outlined).arg(filled)));
  }

  void in_inspect_the_direction_is_shown_while_stepping() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    Callout direction;
    direction.anchor = Callout::Anchor::direction;
    QVERIFY(!shown.scene_view->anchor_of(direction));
    shown.window->focus.go_to({0, 3, 5});
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(shown.scene_view->anchor_of(direction).has_value());
    shown.window->focus.set_following(true);
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(!shown.scene_view->anchor_of(direction));
    shown.trigger("layout_debug");
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(shown.scene_view->anchor_of(direction).has_value());
  }

  void a_narrow_picture_shows_what_a_square_one_does() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    SceneView& view = *shown.scene_view;
    drag(*view.canvas(), view.canvas()->rect().center(), {60, 20});
    const ViewPoint square = view.square_view(), before = view.view_point();
    const QSize size = shown.window->size();
    shown.window->resize(shown.window->minimumSizeHint());
    QVERIFY(wait_for([&] { return shown.window->size() != size; }));
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(std::abs(view.square_view().view_angle - square.view_angle) < 1e-9);
    QVERIFY(view.view_point().eye == before.eye);
    const double aspect = 1.0 * view.canvas()->width() / view.canvas()->height();
    QCOMPARE(view.view_point().view_angle > square.view_angle, aspect < 1);
    shown.window->resize(size);
    QVERIFY(wait_for([&] { return shown.window->size() == size; }));
    QVERIFY(comes_to_rest(*shown.window));
    QVERIFY(std::abs(view.view_point().view_angle - before.view_angle) < 1e-9);
    // A view of the whole scene is fitted again.
    shown.trigger("view_fit");
    shown.window->resize(shown.window->minimumSizeHint());
    QVERIFY(wait_for([&] { return shown.window->size() != size; }));
    QVERIFY(comes_to_rest(*shown.window));
    const ViewPoint fitted = view.view_point();
    view.fit_all();
    QVERIFY(distance_of(view.view_point(), fitted) < 1e-9);
  }

  void a_turntable_keeps_the_scene_upright() {
    const Inspected shown("rooms");
    QVERIFY(shown.ready);
    QWidget* canvas = shown.scene_view->canvas();
    const QPoint middle = canvas->rect().center();
    const auto drag = [&](const QPoint& by) {
      test::drag(*canvas, middle, by);
      return shown.scene_view->view_point();
    };
    const auto tilt = [](const ViewPoint& view) {  // tilt of the horizon in the picture
      const Vec3 right = normalized(cross(view.target - view.eye, view.up));
      return std::abs(right.z);
    };
    const Vec3 vertical = shown.scene_view->view_point().up;
    QVERIFY(vertical == (Vec3{0, 0, 1}));
    QVERIFY(tilt(drag({120, 60})) > 1e-3 || tilt(drag({80, -70})) > 1e-3);
    shown.trigger("turntable");
    const ViewPoint before = shown.scene_view->view_point();
    QVERIFY(tilt(before) < 1e-12);
    for (const QPoint& by : {QPoint(130, 20), QPoint(-40, 70), QPoint(10, -400), QPoint(0, 380)}) {
      const ViewPoint after = drag(by);
      QVERIFY(distance_of(after, before) > 0.01);
      QVERIFY(tilt(after) < 1e-12);
      QVERIFY(dot(after.up, vertical) > 0.99);
      QVERIFY(after.target == before.target);
      QVERIFY(std::abs(norm(after.eye - after.target) - norm(before.eye - before.target)) < 1e-9);
      const double height = dot(normalized(after.eye - after.target), vertical);
      QVERIFY(std::abs(height) < 0.99985);  // 89 degrees
    }
  }

  void feature_edges_are_the_edges_of_the_shape() {
    const auto snapshot = solved_snapshot("furnace", 8);  // a box inside a box
    const Scene& scene = *snapshot->loaded->scene;
    const std::vector<FeatureEdge> edges = feature_edges(*snapshot->loaded);
    QCOMPARE(edges.size(), std::size_t{24});
    for (const FeatureEdge& edge : edges) {
      const Vec3 normals[] = {scene.patch(edge.first).normal, scene.patch(edge.second).normal};
      QVERIFY(std::abs(dot(normals[0], normals[1])) < 1e-9);
    }
  }

  void edges_show_the_shape_under_flat_quantities() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    shown.trigger("show_direction");
    shown.window->views().page.color_controls()->set_outlines(false);
    QVERIFY(shown.scene_view->feature_edges().edges().empty());  // light
    shown.window->colors.set_quantity(Quantity::reflectance);
    const auto& colors = shown.window->colors.patch_colors();
    const auto& edges = shown.scene_view->feature_edges().edges();
    QVERIFY(!edges.empty());
    for (const FeatureEdge& edge : edges) {
      QVERIFY(edge.second == no_patch ||
              colors[std::size_t(edge.first)] == colors[std::size_t(edge.second)]);
    }
    const auto flat = edges.size();
    shown.window->colors.set_quantity(Quantity::form_factor_sum);
    QVERIFY(!edges.empty() && edges.size() != flat);
    shown.window->views().page.color_controls()->set_outlines(true);
    QVERIFY(edges.empty());  // the outlines include them
  }

  void standard_views_show_the_whole_scene_from_their_side() {
    for (const char* spec : {"cornell-box", "rooms"}) {
      const auto scene = load_scene(spec);
      const Vec3 middle = scene->bounds().center();
      const Vec3 up = initial_view(*scene, 1.5).up;
      Vec3 sum;
      for (const Side side :
           {Side::front, Side::back, Side::left, Side::right, Side::top, Side::bottom}) {
        const ViewPoint view = standard_view(*scene, side, 1.5);
        const Vec3 toward_eye = normalized(view.eye - middle);
        sum = sum + toward_eye;
        QVERIFY(std::abs(dot(toward_eye, normalized(view.up))) < 1e-12);
        QCOMPARE(dot(toward_eye, up) > 0.5, side == Side::top);
        for (const Vec3& p : scene->points()) {
          // Within the vertical field of view.
          const double depth = dot(view.eye - p, toward_eye);
          QVERIFY(std::abs(dot(p - view.eye, view.up)) <=
                  depth * std::tan(0.5 * view.view_angle * 0.017453292519943295));
        }
      }
      QVERIFY(norm(sum) < 1e-12);  // opposite sides
    }
  }

  void a_wall_is_first_seen_from_its_front() {
    for (const Vec3& normal : {Vec3{0, 0, -1}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}}) {
      const Vec3 across{normal.y, normal.z, normal.x}, along = cross(normal, across);
      SceneDescription description;
      description.name = "wall";
      description.materials = {{"white", {0.5, 0.5, 0.5}, {}}};
      description.points = {-across - along, across - along, across + along, along - across};
      description.add_face(std::vector<PointId>{0, 1, 2, 3}, 0);
      const Scene wall(description);
      QVERIFY(dot(normal, wall.patch(0).normal) > 0.99);
      QVERIFY(dot(normal, initial_view(wall, 1.5).eye) > 0.3);
      QVERIFY(dot(normal, initial_view(wall, 1.5, Vec3{0, 0, 1}).eye) > 0.3);
    }
  }

  void saved_views_restore_the_camera() {
    const Inspected shown("rooms");
    QVERIFY(shown.ready);
    const ViewPoint first = shown.scene_view->view_point();
    shown.trigger("keep_view");
    shown.trigger("view_top");
    QVERIFY(distance_of(shown.scene_view->view_point(), first) > 0.1);
    const auto& saved = shown.window->views().page.bookmarks().all();
    QCOMPARE(saved.size(), std::size_t{1});
    shown.scene_view->set_view_point(saved[0].view);
    QVERIFY(distance_of(shown.scene_view->view_point(), first) < 1e-9);
    shown.window->selection.select(5);
    shown.trigger("view_patch");
    const ViewPoint near = shown.scene_view->view_point();
    QVERIFY(norm(near.target - shown.window->snapshot()->loaded->scene->patch(5).center) < 1e-9);
  }
};

const test::Registered registered("scene_drawing", test::run_as_viewer<SceneDrawingTest>);

}  // namespace transillum::viewer::scene_drawing_test

#include "scene_drawing_test.moc"
