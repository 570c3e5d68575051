// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sun in the settings: its place in the sky, and the light that follows it.
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QDir>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QSlider>
#include <QTemporaryDir>
#include <QToolButton>
#include <cmath>
#include <limits>

#include "film_frames.h"
#include "model/run_options.h"
#include "model/solver/draft.h"
#include "scene/shadow_finder.h"
#include "solve/sun_controls.h"
#include "solve/sun_dome.h"
#include "solved_window.h"
#include "test_files.h"
#include "transillum/at.h"
#include "window/editing/live_scene.h"
#include "window/files/frame_recorder.h"
#include "window/sun_drag.h"

namespace transillum::viewer::sun_test {

using namespace test;

namespace {

/// A floor of 4 m x 4 m, its front up, and 1 m above its center a sheet of 1 m x 1 m.
const char* const yard = R"(v -2 -2 0
v 2 -2 0
v 2 2 0
v -2 2 0
v -0.5 -0.5 1
v 0.5 -0.5 1
v 0.5 0.5 1
v -0.5 0.5 1
g floor
f 1 2 3 4
g sheet
f 5 6 7 8
f 8 7 6 5
)";

struct Yard {
  QTemporaryDir folder;
  SolvedWindow shown;
  SunDome* dome = shown.window->findChild<SunDome*>();
  SunDrag* drag = shown.window->findChild<SunDrag*>();
  QDoubleSpinBox* irradiance = part<QDoubleSpinBox>("sun");

  Yard()
      : shown(write_file(folder.filePath("yard.obj"), yard),
              {.directions = 64, .first_shot = {}, .sky = lit()}) {
    part<QPushButton>("restart")->click();
  }
  static Sky lit() {
    Sky sky;
    sky.sun = {{100, 100, 100}, {0, 0, 1}};
    return sky;
  }
  template <class Widget>
  Widget* part(const char* name) const {
    return shown.window->findChild<Widget*>(name);
  }
  const Sun& solved_sun() const { return shown.window->snapshot()->options.sky.sun; }
  MaterialEdits& edits() const { return shown.window->relighting.edits(); }
  /// Waits until the scene is solved with the place of the sun that is shown.
  bool solves() const {
    return wait_for([this] {
             return !drag->busy() && shown.window->snapshot() &&
                    shown.window->snapshot()->progress.finished;
           }) &&
           comes_to_rest(*shown.window);
  }
  /// Mean H of the floor, W/m².
  double floor() const {
    const SolverSnapshot& snapshot = *shown.window->snapshot();
    double sum = 0, area = 0;
    for (PatchId i = 0; i < snapshot.loaded->scene->patch_count(); ++i) {
      const Patch& patch = snapshot.loaded->scene->patch(i);
      if (patch.face == 0) {
        sum += patch.area * at(snapshot.irradiance, i).r;
        area += patch.area;
      }
    }
    return sum / area;
  }
};

double mean_gray(const QImage& picture) {
  double sum = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      sum += qGray(picture.pixel(x, y));
    }
  }
  return sum / picture.width() / picture.height();
}

double angle_between(const Vec3& a, const Vec3& b) { return norm(cross(a, b)); }

}  // namespace

class SunTest : public QObject {
  Q_OBJECT

 private slots:
  void the_handle_is_where_the_sun_is() {
    SunDome dome;
    dome.resize(200, 200);
    const QPointF middle(100, 100);
    dome.set_position({0, 90});
    QVERIFY(QLineF(dome.place_of(dome.position()), middle).length() < 1e-9);
    const auto below = [&](const SolarPosition& position) {
      return dome.place_of(position) - middle;
    };
    // North is at the top, east at the right.
    QVERIFY(below({0, 30}).y() < 0 && std::abs(below({0, 30}).x()) < 1e-9);
    QVERIFY(below({90, 30}).x() > 0 && std::abs(below({90, 30}).y()) < 1e-9);
    QVERIFY(std::abs(below({90, 0}).x() - 1.5 * below({90, 30}).x()) < 1e-9);
    // A drag ends where the pointer is.
    SolarPosition moved;
    connect(&dome, &SunDome::moved, [&](const SolarPosition& position) { moved = position; });
    const QPoint place(130, 60);
    QTest::mousePress(&dome, Qt::LeftButton, {}, place);
    QVERIFY(QLineF(dome.place_of(moved), place).length() < 1e-9);
    QTest::keyClick(&dome, Qt::Key_Right);
    QTest::keyClick(&dome, Qt::Key_Down, Qt::ShiftModifier);
    QVERIFY(dome.position() == moved && moved.elevation >= 0);
  }

  void a_given_sun_keeps_its_digits() {
    SunControls controls;
    const Vec3 up{0, 0, 1};
    const Sun sun{{801.23456789, 700, 600}, normalized({0.3, -0.5, 0.7})};
    controls.set_sun(sun, up);
    QVERIFY(controls.sun(up) == sun);
    controls.show_sun(sun, {0, 1, 0});
    QVERIFY(controls.sun({0, 1, 0}) == sun);
    QVERIFY(controls.findChild<QDoubleSpinBox*>("sun_elevation")->value() < 0);
    controls.show_sun(sun, up);
    // Another place keeps the color; its direction is at the azimuth and elevation shown.
    controls.findChild<QDoubleSpinBox*>("sun_azimuth")->setValue(90);
    controls.findChild<QDoubleSpinBox*>("sun_elevation")->setValue(30);
    const Sun moved = controls.sun(up);
    QVERIFY(angle_between(moved.direction, {std::sqrt(0.75), 0, 0.5}) < 1e-12);
    QVERIFY(std::abs(moved.irradiance.g / moved.irradiance.r - 700 / 801.23456789) < 1e-12);
    controls.findChild<QDoubleSpinBox*>("sun_elevation")->setValue(-5);
    QVERIFY(!controls.sun(up).is_set() && controls.sun(up).below_horizon);
    // The irradiance of the day stays.
    const Sun night = controls.sun(up);
    controls.set_sun(moved, up);
    controls.set_sun(night, up);
    QVERIFY(controls.sun(up) == night);
    QVERIFY(std::abs(controls.findChild<QDoubleSpinBox*>("sun")->value() - 801.2) < 0.1);
    controls.findChild<QDoubleSpinBox*>("sun")->setValue(0);
    QVERIFY(controls.sun(up) == Sun());
  }

  void a_weak_sun_is_shown() {
    SunControls controls;
    const Vec3 up{0, 0, 1};
    const auto* irradiance = controls.findChild<QDoubleSpinBox*>("sun");
    for (const double weak : {0.04, 3e-7}) {
      controls.set_sun({{weak, weak, weak}, up}, up);
      QVERIFY(irradiance->text() != irradiance->specialValueText());
      QVERIFY(std::abs(irradiance->value() - weak) < 0.01 * weak);
    }
    controls.set_sun({{800, 800, 800}, up}, up);
    QCOMPARE(irradiance->text(), QString("800.0"));
  }

  void a_session_keeps_a_sun_below_the_horizon() {
    RunOptions night;
    night.solve.sky.sun = {{}, normalized({1, 2, -0.5}), false, true};
    QVERIFY(run_options_from_json(to_json(night), "x") == night);
    SunControls controls;
    controls.set_sun(night.solve.sky.sun, {0, 0, 1});
    QVERIFY(!controls.findChild<SunDome*>()->isHidden());
    QVERIFY(controls.findChild<QDoubleSpinBox*>("sun_elevation")->value() < 0);
  }

  void a_day_moves_it_from_east_to_west() {
    SunControls controls;
    const Vec3 up{0, 0, 1};
    controls.set_sun({{800, 800, 800}, {0, 0, 1}}, up);
    controls.findChild<QCheckBox*>("sun_by_time")->setChecked(true);
    auto* time = controls.findChild<QSlider*>("sun_time");
    auto* azimuth = controls.findChild<QDoubleSpinBox*>("sun_azimuth");
    auto* elevation = controls.findChild<QDoubleSpinBox*>("sun_elevation");
    // At 50° north on June 21, at noon of the zone's own meridian: 90° - 50° + 23.4° high.
    time->setValue(12 * 60);
    QVERIFY(std::abs(elevation->value() - 63.4) < 0.2 && std::abs(azimuth->value() - 180) < 3);
    time->setValue(8 * 60);
    QVERIFY(azimuth->value() > 60 && azimuth->value() < 120);
    time->setValue(16 * 60);
    QVERIFY(azimuth->value() > 240 && azimuth->value() < 300);
    time->setValue(0);
    QVERIFY(elevation->value() < 0 && !controls.sun(up).is_set());
    // A move by hand ends it.
    azimuth->setValue(10);
    QVERIFY(!controls.findChild<QCheckBox*>("sun_by_time")->isChecked());
  }

  // By hand: the sheet takes 1 m² of 16 m² from the sun, and nothing but it and the sky is around.
  // Light that floor and sheet exchange adds less than a tenth.
  void the_light_follows_and_is_then_solved() {
    const Yard yard;
    QVERIFY(yard.solves());
    const double overhead = yard.floor();
    QVERIFY(overhead >= 100 * 15.0 / 16 - 1e-9 && overhead < 100);
    int pictures = 0;
    connect(yard.drag, &SunDrag::lit, [&] { ++pictures; });
    const auto before = yard.shown.window->snapshot();
    emit yard.dome->moved({90, 45});
    QVERIFY(wait_for([&] { return pictures > 0; }));
    QVERIFY(yard.shown.window->snapshot() == before);  // other views keep the solve from before
    QVERIFY(wait_for([&] {
      emit yard.dome->moved({90, 45});  // before the hand rests
      return yard.drag->by_form_factors();
    }));
    QVERIFY(wait_for([&] { return yard.shown.window->snapshot() != before; }) && yard.solves());
    QVERIFY(angle_between(yard.solved_sun().direction, normalized({1, 0, 1})) < 1e-12);
    QVERIFY(std::abs(yard.floor() / overhead - std::sqrt(0.5)) < 0.02);
    // The same bits as a new solve.
    const auto snapshot = yard.shown.window->snapshot();
    SolveSession session({.scene = snapshot->loaded->scene,
                          .options = snapshot->options,
                          .tree = snapshot->loaded->tree});
    session.advance(SolveSession::Until::finished);
    QVERIFY(session.solution().radiosity == snapshot->radiosity);
    save_picture(*yard.shown.window, "sun");
  }

  // The same directions as of a new solve, so that only tolerances differ.
  void moved_light_from_the_form_factors_of_a_solve_is_its_light() {
    const Yard yard;
    QVERIFY(yard.solves());
    SolveRunner& runner = yard.shown.window->runner;
    runner.include_form_factors();
    QVERIFY(wait_for([&] { return yard.shown.window->snapshot()->form_factors != nullptr; }));
    const auto solved = yard.shown.window->snapshot();
    const Scene& scene = *solved->loaded->scene;
    auto changed = std::make_shared<PatchMaterials>();
    changed->materials = scene.materials();
    for (Material& material : changed->materials) {
      material.reflectance = {0.7, 0.2, 0};
    }
    for (const Patch& patch : scene.patches()) {
      changed->of_patch.push_back(patch.material);
    }
    for (const auto& [disc, materials] :
         {std::pair<bool, std::shared_ptr<const PatchMaterials>>{false, nullptr},
          {true, nullptr},
          {false, changed}}) {
      LiveLightRequest request{solved->loaded, solved->options, materials, solved};
      request.options.sky.sun = {{50, 100, 150}, normalized({1, 0.2, 0.7}), disc};
      const Solution light = live_light(request, {});
      QVERIFY(request.sun_of_solve->has_value());
      QCOMPARE(light.linear_terms.size(), light.radiosity.size());  // smooth
      SolveSession session({.scene = materials ? std::make_shared<const Scene>(
                                                     scene, changed->materials, changed->of_patch)
                                               : solved->loaded->scene,
                            .options = request.options,
                            .tree = solved->loaded->tree});
      session.advance(SolveSession::Until::finished);
      const std::vector<Rgb> expected = session.solution().radiosity;
      QCOMPARE(light.radiosity.size(), expected.size());
      double largest = 0;
      for (const Rgb& value : expected) {
        largest = std::max(largest, max_abs(value));
      }
      for (std::size_t i = 0; i < expected.size(); ++i) {
        QVERIFY(max_abs(light.radiosity[i] - expected[i]) <= 1e-5 * largest);
      }
      QVERIFY(largest > 1);
    }
  }

  void patches_are_divided_along_the_shadow_edges_that_are_drawn() {
    const Yard scene;
    QVERIFY(scene.solves());
    const TestWindow& window = *scene.shown.window;
    const auto* finder = window.findChild<ShadowFinder*>();
    QVERIFY(!finder->edges(*window.snapshot()->loaded));
    const QImage without = scene.shown.picture();
    scene.part<QAction>("show_shadows")->setChecked(true);
    const QImage with = scene.shown.picture();
    QVERIFY(!with.isNull() && with != without);
    scene.part<QAction>("show_shadows")->setChecked(false);
    QCOMPARE(scene.shown.picture(), without);
    scene.part<QAction>("show_shadows")->setChecked(true);
    QVERIFY(comes_to_rest(window));
    const auto* edges = finder->edges(*window.snapshot()->loaded);
    QVERIFY(edges);
    double length = 0;
    for (const ShadowEdge& edge : *edges) {
      length += norm(edge.b - edge.a);
      QCOMPARE(edge.a.z, 0.0);
    }
    QVERIFY(std::abs(length - 4) < 1e-9);
    auto* divide = scene.part<QAction>("divide_shadows");
    QVERIFY(divide->isEnabled());
    // The division would be solved with the old materials.
    scene.edits().set_reflectance("face:0", {0.1, 0.1, 0.1});
    QVERIFY(!divide->isEnabled() && divide->toolTip().contains("press Solve first"));
    scene.edits().restore();
    QVERIFY(divide->isEnabled());
    divide->trigger();
    QVERIFY(wait_for(
        [&] { return window.snapshot() && window.snapshot()->loaded->scene->patch_count() == 7; }));
    QVERIFY(scene.solves());
    edges = finder->edges(*window.snapshot()->loaded);
    QVERIFY(edges && edges->empty());
    // The shadow is a patch.
    double darkest = 100;
    for (const Rgb& h : window.snapshot()->irradiance) {
      darkest = std::min(darkest, h.r);
    }
    QVERIFY(darkest < 20);
    scene.shown.trigger("copy_solve");
    QVERIFY(QApplication::clipboard()->text().contains("--divide shadows:0,0,1"));
    scene.shown.trigger("undo");
    QVERIFY(wait_for(
        [&] { return window.snapshot() && window.snapshot()->loaded->scene->patch_count() == 3; }));
  }

  void a_night_is_dark() {
    const Yard yard;
    QVERIFY(yard.solves());
    yard.part<QDoubleSpinBox>("sun_elevation")->setValue(-1);
    QVERIFY(wait_for([&] { return yard.solved_sun().below_horizon; }) && yard.solves());
    QCOMPARE(yard.floor(), 0.0);
  }

  void a_film_shows_a_day() {
    const Yard yard;
    QVERIFY(yard.solves());
    FrameRecorder& recorder = *yard.shown.window->findChild<FrameRecorder*>();
    const QTemporaryDir folder;
    const QString path = folder.filePath("day.mp4");
    const FilmPlan plan{FilmPlan::Show::scene, FilmPlan::Over::day, {480, 360}, 1};
    recorder.begin_film(path, plan);
    QVERIFY(!recorder.writing());  // the sun is not placed by time
    yard.part<QCheckBox>("sun_by_time")->setChecked(true);
    yard.part<QSlider>("sun_time")->setValue(9 * 60);
    QVERIFY(yard.solves());
    const auto solved = yard.shown.window->snapshot();
    const QImage shown = yard.shown.picture();
    const auto* settings = yard.shown.window->findChild<SettingsPanel*>();
    const Sun sun = settings->solve_options().sky.sun;
    const auto is_as_before = [&] {
      return !yard.drag->busy() && yard.shown.window->snapshot() == solved &&
             settings->solve_options().sky.sun == sun &&
             different_pixels(yard.shown.picture(), shown) == 0;
    };

    recorder.begin_film(path, plan);
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QVERIFY(is_as_before());
    const std::vector<QImage> day = decoded_film(path).frames;
    QCOMPARE(static_cast<int>(day.size()), 10);
    const double noon = mean_gray(day[5]);
    QVERIFY2(
        noon > mean_gray(day.front()) + 10 && noon > mean_gray(day.back()) + 10,
        qPrintable(
            QString("%1 %2 %3").arg(mean_gray(day.front())).arg(noon).arg(mean_gray(day.back()))));
    if (const QString pictures = qEnvironmentVariable("TRANSILLUM_PICTURES"); !pictures.isEmpty()) {
      for (const std::size_t k : {0U, 2U, 5U, 9U}) {
        day[k].save(pictures + QString("/day-%1.png").arg(k));
      }
    }

    const QString canceled = folder.filePath("canceled.webm");
    recorder.begin_film(canceled, plan);
    QVERIFY(wait_for([&] { return recorder.frames() >= 3; }));
    QTest::mouseClick(yard.part<QToolButton>("cancel_recording"), Qt::LeftButton);
    QVERIFY(!recorder.writing() && is_as_before());
    QVERIFY(wait_for([&] {
      return QDir(folder.path()).entryList({"*canceled*"}, QDir::Files | QDir::Hidden).isEmpty();
    }));
    recorder.begin_film(canceled, plan);  // before the light of noon
    QTest::mouseClick(yard.part<QToolButton>("cancel_recording"), Qt::LeftButton);
    QVERIFY(wait_for(is_as_before));
    // A sun that is moved by hand ends the film, and is solved.
    recorder.begin_film(canceled, plan);
    QVERIFY(wait_for([&] { return recorder.frames() >= 1; }));
    emit yard.dome->moved({90, 45});
    QVERIFY(!recorder.writing());
    QVERIFY(yard.shown.window->banner_text().contains("The sun was moved"));
    QVERIFY(yard.solves() && yard.shown.window->snapshot() != solved);
    QVERIFY(angle_between(yard.solved_sun().direction, normalized({1, 0, 1})) < 1e-12);
  }

  void a_day_goes_from_sunrise_to_sunset() {
    SunControls controls;
    const Vec3 up{0, 0, 1};
    controls.set_sun({{800, 800, 800}, {0, 0, 1}}, up);
    QVERIFY(controls.day(up, 9).empty());
    controls.findChild<QCheckBox*>("sun_by_time")->setChecked(true);
    const std::vector<SunOfDay> day = controls.day(up, 9);
    QCOMPARE(static_cast<int>(day.size()), 9);
    // 16.2 h of sun at 50° north on June 21.
    QCOMPARE(day.front().time.left(9), QString("21 Jun 03"));
    QCOMPARE(day.back().time.left(9), QString("21 Jun 20"));
    QVERIFY(day.front().sun.direction.x > 0.7 && day.back().sun.direction.x < -0.7);
    QVERIFY(day.front().sun.is_set() && std::abs(day.front().sun.direction.z) < 0.01);
    QVERIFY(day[4].sun.direction.z > 0.89);
    // There is no night in the north, and no day in the south.
    auto* latitude = controls.findChild<QDoubleSpinBox*>("sun_latitude");
    latitude->setValue(80);
    const std::vector<SunOfDay> polar = controls.day(up, 9);
    QVERIFY(norm(polar.front().sun.direction - polar.back().sun.direction) < 0.01);
    latitude->setValue(-80);
    QVERIFY(controls.day(up, 9).empty());
  }
};

const test::Registered registered("sun", test::run_as_viewer<SunTest>);

}  // namespace transillum::viewer::sun_test

#include "sun_test.moc"
