// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Runs in which lobes take part, in the window: radiance toward the camera, lobes of a patch,
// sliders of lobes, and the start and stop of such runs.
#include <QAbstractButton>
#include <QAction>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "directions/lobe_view.h"
#include "model/command_text.h"
#include "model/run_options.h"
#include "model/snapshot_values.h"
#include "solve/progress_line.h"
#include "solved_window.h"
#include "test_files.h"
#include "transillum/glossy.h"

namespace transillum::viewer::glossy_test {

using namespace test;

namespace {

constexpr const char* small_gallery = "gallery:tiles=1,slices=6,stacks=4";

struct GlossyWindow {
  std::unique_ptr<TestWindow> window;
  bool ready = false;

  explicit GlossyWindow(const SolveOptions& options = {.directions = 64, .tolerance = 1e-6},
                        const QString& scene = small_gallery) {
    window = make_window(options);
    window->files().open_scene(scene);
    ready = settles();
  }
  bool settles() const {
    return wait_for([this] {
      return window->snapshot() && window->snapshot()->progress.finished && window->settled();
    });
  }
  const SolverSnapshot& snapshot() const { return *window->snapshot(); }
  SceneView& view() const { return *window->findChild<SceneView*>(); }
  template <class Widget>
  Widget* part(const char* name) const {
    return window->findChild<Widget*>(name);
  }
  /// Whether the scene shows the radiance toward its camera.
  bool shows_radiance_toward_camera() const {
    return window->colors.values() == snapshot().glossy->radiance_toward(view().view_point().eye);
  }
  PatchId patch_of(const char* material) const {
    const Scene& scene = *snapshot().loaded->scene;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      if (scene.material(i).name == material) {
        return i;
      }
    }
    return no_patch;
  }
};

double largest_difference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, max_abs(a[i] - b[i]));
  }
  return largest;
}

}  // namespace

class GlossyTest : public QObject {
  Q_OBJECT

 private slots:
  void the_gallery_opens_glossy() {
    auto window = make_window(64);
    window->findChild<QAbstractButton*>("built_in_gallery")->click();
    QVERIFY(wait_for([&] {
      return window->snapshot() && window->snapshot()->progress.finished && window->settled();
    }));
    QVERIFY(window->snapshot()->glossy);
    QVERIFY(window->snapshot()->options.glossy);
    QVERIFY(window->findChild<QCheckBox*>("glossy")->isChecked());
    QVERIFY(!window->views().settings.differ_from_effect());
    QCOMPARE(window->colors.quantity(), Quantity::eye_radiance);
    QVERIFY(solution_of(*window->snapshot()).glossy != nullptr);
    save_picture(*window, "glossy-gallery");
    // The times of camera moves, for RESULTS.md.
    auto* view = window->findChild<SceneView*>();
    const GlossyLight& light = *window->snapshot()->glossy;
    QElapsedTimer timer;
    timer.start();
    for (int k = 0; k < 10; ++k) {
      (void)light.radiance_toward(view->view_point().eye);
    }
    qInfo("radiance toward an eye: %.2f ms", 0.1 * static_cast<double>(timer.elapsed()));
    timer.start();
    for (int k = 0; k < 10; ++k) {
      view->turn(5, 0);
      const auto colored = window->colors.values();
      QVERIFY(wait_for([&] { return window->colors.values() != colored; }));
    }
    qInfo("a camera move, with two pictures: %.1f ms", 0.1 * static_cast<double>(timer.elapsed()));
    QVERIFY(wait_for(
        [&] { return window->colors.values() == light.radiance_toward(view->view_point().eye); }));
    // Other scenes are diffuse, and B is shown again.
    window->files().open_scene("cornell-box");
    QVERIFY(wait_for([&] {
      return window->snapshot() && !window->snapshot()->glossy && window->settled() &&
             window->snapshot()->progress.finished;
    }));
    QVERIFY(!window->snapshot()->options.glossy);
    QCOMPARE(window->colors.quantity(), Quantity::radiosity);
  }

  // Lobes reflect at the end of an iteration: until then the scene would be black.
  void the_first_iteration_has_neutral_light_and_a_reason() {
    GlossyWindow w;
    QVERIFY(w.ready);
    w.window->runner.restart(w.window->views().settings.solve_options(), {Goal::Kind::passes, 1});
    QVERIFY(wait_for([&] {
      return w.window->snapshot()->progress.iteration == 0 &&
             w.window->snapshot()->progress.direction > 0 && w.window->settled();
    }));
    QVERIFY(!w.window->snapshot()->of_draft);
    QVERIFY2(w.window->colors.missing().startsWith("Neutral light"),
             qPrintable(w.window->colors.missing()));
    int dark = 0;
    for (const Color8& color : w.window->colors.patch_colors()) {
      dark += color[0] + color[1] + color[2] < 60;
    }
    QCOMPARE(dark, 0);
    w.window->runner.set_goal({Goal::Kind::finished});
    QVERIFY(w.settles() && w.window->colors.missing().isEmpty());
  }

  void the_radiance_follows_the_camera() {
    GlossyWindow w;
    QVERIFY(w.ready);
    QVERIFY(w.shows_radiance_toward_camera());
    const auto before = w.window->colors.values();
    const double exposure = w.window->colors.scale().exposure;
    w.view().turn(40, 10);
    QVERIFY(wait_for([&] { return w.shows_radiance_toward_camera(); }));
    QVERIFY(w.window->colors.values() != before);
    QCOMPARE(w.window->colors.scale().exposure, exposure);
    // A range is widened while the camera moves, not fitted again.
    w.window->colors.set_mode(ColorMode::luminance);
    const double low = w.window->colors.scale().low, high = w.window->colors.scale().high;
    for (int k = 0; k < 5; ++k) {
      w.view().turn(30, 0);
      QVERIFY(wait_for([&] { return w.shows_radiance_toward_camera(); }));
      QVERIFY(w.window->colors.scale().low <= low && w.window->colors.scale().high >= high);
    }
    // Without lobes, L is B/pi from everywhere.
    w.part<QCheckBox>("glossy")->setChecked(false);
    w.window->runner.restart(w.window->views().settings.solve_options(), {Goal::Kind::finished});
    QVERIFY(wait_for([&] { return !w.window->snapshot()->glossy && w.settles(); }));
    w.window->colors.set_quantity(Quantity::eye_radiance);
    QCOMPARE(w.window->colors.values().size(), w.snapshot().radiosity.size());
    QVERIFY(max_abs(w.window->colors.values()[3] -
                    0.31830988618379067 * w.snapshot().radiosity[3]) < 1e-12);
  }

  void a_run_advances_pauses_and_stops() {
    auto window = make_window(SolveOptions{.directions = 1024, .glossy = true});
    window->open(small_gallery, {});
    QVERIFY(
        wait_for([&] { return window->snapshot() && window->runner.state() == RunState::paused; }));
    window->runner.advance_one_direction();
    QVERIFY(wait_for([&] { return window->snapshot()->progress.direction == 1; }));
    window->runner.set_goal({Goal::Kind::passes, 77});
    QVERIFY(wait_for([&] {
      return window->snapshot()->progress.direction == 77 &&
             window->runner.state() == RunState::paused;
    }));
    window->runner.run();
    QVERIFY(wait_for([&] { return window->snapshot()->progress.direction > 200; }));
    QElapsedTimer timer;
    timer.start();
    window->runner.stop();
    QVERIFY(wait_for([&] {
      return window->runner.state() == RunState::paused &&
             window->snapshot()->progress.direction == 0;
    }));
    qInfo("stopped after %lld ms", static_cast<long long>(timer.elapsed()));
  }

  void the_progress_tells_of_stages_of_lobes() {
    GlossyWindow w;
    QVERIFY(w.ready);
    auto now = std::make_shared<SolverSnapshot>(w.snapshot());
    now->progress.iteration = 2;
    now->progress.stage = SolveProgress::Stage::reflecting;
    now->progress.stage_fraction = 0.25;
    now->progress.lobes_per_second = 8.5;
    now->progress.seconds_left = 3;
    ProgressLine line;
    line.show_state(RunState::running);
    line.show_snapshot(now);
    const auto text = [&](const char* name) { return line.findChild<QLabel*>(name)->text(); };
    QCOMPARE(text("phase"), QStringLiteral("Iteration 3, reflecting"));
    QCOMPARE(text("rate"), QStringLiteral("8.5 lobes/s"));
    QVERIFY(text("time").endsWith("left"));
    const auto* bar = line.findChild<QProgressBar*>();
    QCOMPARE(4 * bar->value(), bar->maximum());
    now = std::make_shared<SolverSnapshot>(*now);
    now->progress.stage = SolveProgress::Stage::scaling_lobes;
    line.show_snapshot(now);
    QCOMPARE(text("phase"), QStringLiteral("Scaling lobes"));
    // Afterward, and where the run pauses, the line is the same as in any run.
    line.show_state(RunState::finished);
    QVERIFY(text("phase").startsWith("Converged"));
  }

  void settings_say_what_goes_with_lobes() {
    GlossyWindow w;
    QVERIFY(w.ready);
    auto* note = w.part<QLabel>("glossy_note");
    // n = 24 of the floor takes some 240 directions.
    QCOMPARE(note->text(), QStringLiteral("n = 24 needs M = 240"));
    QVERIFY(w.part<QLabel>("summary_lobes")->text().endsWith("n = 24 needs M = 240"));
    w.part<QSpinBox>("directions")->setValue(240);
    QVERIFY(note->isHidden());
    // Each replica needs as many.
    w.part<QSpinBox>("replicas")->setValue(4);
    QCOMPARE(note->text(), QStringLiteral("n = 24 needs M = 960"));
    w.part<QSpinBox>("replicas")->setValue(1);
    w.part<QCheckBox>("glossy")->setChecked(false);
    QCOMPARE(note->text(), QStringLiteral("the scene has lobes"));
    RunOptions options{{.directions = 64, .glossy = true}};
    QVERIFY(run_options_from_json(to_json(options), "x") == options);
    QVERIFY(solve_command("gallery", options, {}).find("--glossy") != std::string::npos);
  }

  void lobes_of_the_selected_patch_are_drawn() {
    GlossyWindow w;
    QVERIFY(w.ready);
    auto* lobes = w.window->findChild<LobeView*>();
    QVERIFY(lobes->message().contains("Click a patch"));
    const PatchId floor = w.patch_of("floor");
    w.window->selection.select(floor);
    QVERIFY(lobes->message().isEmpty());
    QCOMPARE(lobes->arriving().size(), std::size_t{64});
    // In the patch's frame, the sum of what arrives is the irradiance.
    Rgb sum;
    for (const LobeView::Ray& ray : lobes->arriving()) {
      QVERIFY(ray.direction.z >= 0);
      sum += 2 * 3.14159265358979 / 64 * ray.light;
    }
    QVERIFY(max_abs(sum - w.snapshot().irradiance[std::size_t(floor)]) < 1e-9);
    QCOMPARE(lobes->leaving().size(), std::size_t((LobeView::rings + 1) * LobeView::sectors));
    w.window->selection.select(w.patch_of("white"));
    QVERIFY(lobes->arriving().empty());
    const auto& leaving = lobes->leaving();
    QVERIFY(max_abs(leaving.front().light - leaving.back().light) == 0);
  }

  // The sun comes from one direction, so it is no line among the densities of the others.
  void the_sun_is_marked_with_its_irradiance() {
    const QTemporaryDir folder;
    write_file(folder.filePath("yard.mtl"),
               "newmtl shiny\nKd .3 .3 .3\nKs .4 .4 .4\nNs 8\nnewmtl plain\nKd .5 .5 .5\n");
    SolveOptions options{.directions = 64, .first_shot = {}, .glossy = true};
    options.sky.sun = {{100, 50, 25}, normalized({1, 0, 1})};
    GlossyWindow w(options, write_file(folder.filePath("yard.obj"),
                                       "mtllib yard.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                       "v 9 0 0\nv 10 0 0\nv 10 1 0\nv 9 1 0\n"
                                       "usemtl shiny\nf 1 2 3 4\nusemtl plain\nf 5 6 7 8\n"));
    QVERIFY(w.ready);
    auto* lobes = w.window->findChild<LobeView*>();
    w.window->selection.select(w.patch_of("shiny"));
    const LobeView::Ray sun = lobes->sun();
    QVERIFY(max_abs(sun.light - std::sqrt(0.5) * Rgb{100, 50, 25}) < 1e-9);
    QVERIFY(std::abs(sun.direction.z - std::sqrt(0.5)) < 1e-9);
    // All light of the patch comes from the sun, and leaves most strongly about its mirror.
    const auto brightest = std::max_element(lobes->leaving().begin(), lobes->leaving().end(),
                                            [](const LobeView::Ray& a, const LobeView::Ray& b) {
                                              return luminance(a.light) < luminance(b.light);
                                            });
    const Vec3 mirror{-sun.direction.x, -sun.direction.y, sun.direction.z};
    QVERIFY(dot(brightest->direction, mirror) > 0.9);
    w.window->selection.select(w.patch_of("plain"));
    QVERIFY(max_abs(lobes->sun().light) == 0);
  }

  void gloss_is_changed_without_a_pass() {
    GlossyWindow w;
    QVERIFY(w.ready);
    w.window->selection.select(w.patch_of("floor"));
    auto* gloss = w.part<QDoubleSpinBox>("gloss_value");
    QCOMPARE(gloss->value(), 24.0);
    const std::int64_t passes = w.snapshot().statistics.passes_made;
    const std::vector<Rgb> first = w.snapshot().radiosity;
    gloss->setValue(6);
    QVERIFY(wait_for([&] {
      return w.snapshot().materials && w.snapshot().progress.finished && w.window->settled();
    }));
    QCOMPARE(w.snapshot().statistics.passes_made, passes);
    QVERIFY(w.shows_radiance_toward_camera());
    // The light is the same as in a run with these materials.
    auto scene = load_scene(small_gallery);
    GlossySolver solver(scene, w.snapshot().options);
    solver.set_materials(w.snapshot().materials->materials, w.snapshot().materials->of_patch);
    solver.solve();
    QVERIFY(largest_difference(solver.solution().radiosity, w.snapshot().radiosity) < 1e-3);
    QVERIFY(largest_difference(first, w.snapshot().radiosity) > 1e-3);
    // Changes of lobes are saved, and can be undone.
    const auto changes = w.window->relighting.edits().changes();
    QCOMPARE(changes.size(), std::size_t{1});
    nlohmann::json json{{"materials", to_json(changes)}};
    JsonObject object(json, "x");
    QVERIFY(material_changes_from_json(object, "materials") == changes);
    w.window->undo.undo();
    QVERIFY(wait_for([&] {
      return !w.snapshot().materials && w.snapshot().progress.finished && w.window->settled();
    }));
    QVERIFY(largest_difference(first, w.snapshot().radiosity) < 1e-3);
  }
};

const test::Registered registered("glossy", test::run_as_viewer<GlossyTest>);

}  // namespace transillum::viewer::glossy_test

#include "glossy_test.moc"
