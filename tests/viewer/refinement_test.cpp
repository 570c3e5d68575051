// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Rounds of refinement in the viewer: the runner makes the same rounds as refine() of the library,
// the window shows the patches of each, and they are part of sessions, lessons and commands.
#include "transillum/refinement.h"

#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTemporaryDir>
#include <nlohmann/json.hpp>

#include "lessons/lesson.h"
#include "lessons/page_control.h"
#include "model/command_text.h"
#include "model/snapshot_values.h"
#include "scene/color_controls.h"
#include "solve/round_panel.h"
#include "solved_window.h"
#include "transillum/scene.h"
#include "window/base/view_state_applier.h"
#include "window/files/window_session.h"

namespace transillum::viewer::refinement_test {

using namespace test;

namespace {

const SolveOptions few{.directions = 64};

RefineChoice by(RefineBy criterion, int patches, double until = 0) {
  return {criterion, patches, until};
}

std::shared_ptr<const Scene> cornell_box() {
  return std::make_shared<const Scene>(describe_scene("cornell-box"), SceneOptions{});
}

/// Corners of all patches, in order.
std::vector<Vec3> corners_of(const Scene& scene) {
  std::vector<Vec3> corners;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      corners.push_back(scene.point(p));
    }
  }
  return corners;
}

bool same_patches(const Scene& a, const Scene& b) {
  const std::vector<Vec3> c = corners_of(a), d = corners_of(b);
  return std::equal(c.begin(), c.end(), d.begin(), d.end(), [](const Vec3& p, const Vec3& q) {
    return p.x == q.x && p.y == q.y && p.z == q.z;
  });
}

/// A runner with its newest snapshot, and the numbers of patches in the order of their appearance.
struct WatchedRounds {
  SolveRunner runner;
  std::shared_ptr<const SolverSnapshot> snapshot;
  std::vector<PatchId> patches;
  QString failure;

  WatchedRounds() {
    const auto count = [this](const std::shared_ptr<const LoadedScene>& loaded) {
      patches.push_back(loaded->scene->patch_count());
    };
    QObject::connect(&runner, &SolveRunner::snapshot_ready, &runner,
                     [this](auto newest) { snapshot = newest; });
    QObject::connect(&runner, &SolveRunner::scene_loaded, &runner, count);
    QObject::connect(&runner, &SolveRunner::patches_changed, &runner, count);
    QObject::connect(&runner, &SolveRunner::failed, &runner,
                     [this](const QString& message, bool) { failure = message; });
  }
  void open(const SolveOptions& options, const RefineChoice& refine,
            Goal then = {Goal::Kind::finished}) {
    runner.open({"cornell-box", {options, {}, {}, refine}, then});
  }
  bool reaches(const std::function<bool(const SolverSnapshot&)>& reached) {
    return wait_for([&] {
      return snapshot && runner.state() != RunState::running &&
             runner.state() != RunState::loading && reached(*snapshot);
    });
  }
  bool finishes() {
    return reaches(
        [](const SolverSnapshot& s) { return s.progress.finished && !s.refinement.left; });
  }
};

/// A window whose rounds are started with the controls of the settings panel.
struct RefinedWindow : SolvedWindow {
  RefinedWindow() : SolvedWindow("cornell-box", few) {}

  template <class Widget>
  Widget* part(const char* name) const {
    return window->findChild<Widget*>(name);
  }
  void start(const QString& criterion, int patches) const {
    part<QComboBox>("refine_by")->setCurrentText(criterion);
    part<QSpinBox>("refine_patches")->setValue(patches);
    part<QPushButton>("restart")->click();
  }
  bool finishes() const {
    return wait_for([this] {
      const auto snapshot = window->snapshot();
      return snapshot && snapshot->refine.is_set() && snapshot->progress.finished &&
             !snapshot->refinement.left && window->settled();
    });
  }
};

}  // namespace

class RefinementTest : public QObject {
  Q_OBJECT

 private slots:
  void the_runner_makes_the_rounds_of_the_library_data() {
    QTest::addColumn<int>("criterion");
    QTest::addColumn<int>("basis");
    QTest::newRow("jump, constant") << int(RefineBy::jump) << int(Basis::constant);
    QTest::newRow("jump, linear") << int(RefineBy::jump) << int(Basis::linear);
    QTest::newRow("error, linear") << int(RefineBy::error) << int(Basis::linear);
  }
  void the_runner_makes_the_rounds_of_the_library() {
    QFETCH(const int, criterion);
    QFETCH(const int, basis);
    SolveOptions options = few;
    options.basis = static_cast<Basis>(basis);
    const RefineChoice choice = by(static_cast<RefineBy>(criterion), 150);
    const Refinement expected = refine(cornell_box(), options, choice.options());
    const Solution solution = solve(expected.scene, options);

    WatchedRounds watched;
    watched.open(options, choice);
    QVERIFY(watched.finishes());
    const SolverSnapshot& snapshot = *watched.snapshot;
    QVERIFY(same_patches(*snapshot.loaded->scene, *expected.scene));
    QVERIFY(snapshot.radiosity == solution.radiosity);
    QCOMPARE(snapshot.linear_terms.size(), solution.linear_terms.size());
    const auto& rounds = snapshot.statistics.refinement;
    QCOMPARE(rounds.size(), expected.rounds.size());
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      QCOMPARE(rounds[k].patches, expected.rounds[k].patches);
      QCOMPARE(rounds[k].measure, expected.rounds[k].measure);
      QVERIFY(rounds[k].seconds > 0);
    }
    QCOMPARE(snapshot.refinement.patches, expected.scene->patch_count());
    // The whole scene remains, for other runs.
    QCOMPARE(whole_of(snapshot.loaded)->scene->patch_count(), 27);
    if (choice.by == RefineBy::jump) {
      std::vector<PatchId> patches;
      for (const RefinementRound& round : rounds) {
        patches.push_back(static_cast<PatchId>(round.patches));
      }
      patches.push_back(expected.scene->patch_count());
      QVERIFY(watched.patches == patches);
    }
  }

  void a_measure_to_reach_ends_the_rounds() {
    const Refinement all = refine(cornell_box(), few, {RefineBy::error, 400, 0});
    const double until = all.rounds.at(2).measure;
    WatchedRounds watched;
    watched.open(few, by(RefineBy::error, 400, until));
    QVERIFY(watched.finishes());
    const auto& rounds = watched.snapshot->statistics.refinement;
    QVERIFY(rounds.size() < all.rounds.size());
    QVERIFY(rounds.back().measure <= until);
    for (std::size_t k = 0; k + 1 < rounds.size(); ++k) {
      QVERIFY(rounds[k].measure > until);
    }
    QCOMPARE(watched.snapshot->loaded->scene->patch_count(), PatchId(rounds.back().patches));
  }

  void a_number_of_passes_counts_after_the_rounds() {
    WatchedRounds watched;
    watched.open(few, by(RefineBy::jump, 100), {Goal::Kind::passes, 20});
    QVERIFY(watched.reaches([](const SolverSnapshot& s) {
      return !s.refinement.left && s.progress.direction == 20 && s.progress.iteration == 0;
    }));
    QVERIFY(watched.snapshot->statistics.refinement.size() > 1);
  }

  void each_iteration_of_a_round_can_be_stepped() {
    WatchedRounds watched;
    watched.open(few, by(RefineBy::jump, 100), {Goal::Kind::iteration});
    QVERIFY(watched.reaches([](const SolverSnapshot& s) { return s.progress.iteration == 1; }));
    QVERIFY(watched.snapshot->refinement.left);
    QCOMPARE(watched.snapshot->loaded->scene->patch_count(), 27);
    watched.runner.run();
    QVERIFY(watched.finishes());
  }

  void other_runs_begin_with_the_whole_scene() {
    WatchedRounds watched;
    watched.open(few, by(RefineBy::jump, 60));
    QVERIFY(watched.finishes());
    const std::vector<Rgb> radiosity = watched.snapshot->radiosity;
    watched.runner.restart(few, {Goal::Kind::finished}, by(RefineBy::jump, 100));
    QVERIFY(watched.reaches([](const SolverSnapshot& s) {
      return s.refine.patches == 100 && s.progress.finished && !s.refinement.left;
    }));
    QVERIFY(watched.snapshot->loaded->scene->patch_count() > 60);
    watched.runner.restart(few, {Goal::Kind::finished}, by(RefineBy::jump, 60));
    QVERIFY(watched.reaches([](const SolverSnapshot& s) {
      return s.refine.patches == 60 && s.progress.finished && !s.refinement.left;
    }));
    QVERIFY(watched.snapshot->radiosity == radiosity);
    watched.runner.restart(few, {Goal::Kind::finished});
    QVERIFY(watched.reaches(
        [](const SolverSnapshot& s) { return !s.refine.is_set() && s.progress.finished; }));
    QCOMPARE(watched.snapshot->loaded->scene->patch_count(), 27);
    QVERIFY(watched.snapshot->statistics.refinement.empty());
  }

  void what_cannot_be_refined_is_refused() {
    WatchedRounds watched;
    SolveOptions options = few;
    options.engine = Engine::hemicube;
    watched.open(options, by(RefineBy::jump, 60));
    QVERIFY(wait_for([&] { return !watched.failure.isEmpty(); }));
    QVERIFY2(watched.failure.contains("engine hemicube"), qPrintable(watched.failure));
  }

  // The rounds are made again; the solve after them continues where it was.
  void continues_a_checkpoint_of_the_refined_scene_data() {
    QTest::addColumn<bool>("shot");
    QTest::newRow("first shot") << true;
    QTest::newRow("no first shot") << false;
  }
  void continues_a_checkpoint_of_the_refined_scene() {
    QFETCH(const bool, shot);
    const QTemporaryDir folder;
    const std::string mine = folder.filePath("mine.tck").toStdString();
    const QString left = folder.filePath("left.tck");
    SolveOptions options = few;
    if (!shot) {
      options.first_shot.reset();
    }
    const RefineChoice choice = by(RefineBy::jump, 60);
    std::vector<Rgb> radiosity;
    {
      WatchedRounds watched;
      watched.runner.save_to(mine, 0);
      watched.open(options, choice, {Goal::Kind::passes, 25});
      QVERIFY(watched.reaches([](const SolverSnapshot& s) {
        return !s.refinement.left && s.progress.direction == 25;
      }));
      QVERIFY(QFile::copy(QString::fromStdString(mine), left));
      watched.runner.run();
      QVERIFY(watched.finishes());
      radiosity = watched.snapshot->radiosity;
    }
    WatchedRounds watched;
    watched.runner.resume_from(left.toStdString());
    watched.open(options, choice, {Goal::Kind::passes, 1});
    // The solve has more than the one pass that was asked for.
    QVERIFY2(watched.reaches([](const SolverSnapshot& s) {
      return !s.refinement.left && s.progress.direction == 25;
    }),
             qPrintable(watched.failure));
    QVERIFY(!QFile::exists(left));
    watched.runner.run();
    QVERIFY(watched.finishes());
    QVERIFY(watched.snapshot->radiosity == radiosity);
  }

  // The stages before the one that was saved are not solved again.
  void continues_a_checkpoint_of_a_total_error() {
    const QTemporaryDir folder;
    const std::string mine = folder.filePath("mine.tck").toStdString();
    const QString left = folder.filePath("left.tck");
    SolveOptions options;
    options.goal.accuracy = 0.3;
    const SolveRunner::OpenRequest request{
        "cornell-box", {.solve = options, .total = true}, {Goal::Kind::finished}};
    const auto is_over = [](const SolverSnapshot& s) { return s.total && s.total->end; };
    std::vector<Rgb> radiosity;
    {
      WatchedRounds watched;
      watched.runner.save_to(mine, 0);
      watched.runner.set_refresh_interval(0);
      connect(&watched.runner, &SolveRunner::snapshot_ready, &watched.runner, [&](auto s) {
        if (!s->total->stages.empty() && !s->measured_errors && s->passes_done > 0 &&
            !QFile::exists(left)) {
          watched.runner.pause();
          QFile::copy(QString::fromStdString(mine), left);
          watched.runner.save_to({});  // saving after each pass takes long
          watched.runner.run();
        }
      });
      watched.runner.open(request);
      QVERIFY(watched.reaches(is_over));
      radiosity = watched.snapshot->radiosity;
    }
    QVERIFY(QFile::exists(left));
    WatchedRounds watched;
    std::size_t fewest = 1000;
    connect(&watched.runner, &SolveRunner::snapshot_ready, &watched.runner,
            [&](auto s) { fewest = std::min(fewest, s->total->stages.size()); });
    watched.runner.resume_from(left.toStdString());
    watched.runner.open(request);
    QVERIFY(watched.reaches(is_over));
    QVERIFY(fewest >= 1 && fewest < watched.snapshot->total->stages.size());
    QVERIFY(watched.snapshot->radiosity == radiosity);
    QVERIFY(!QFile::exists(left));
  }

  void the_window_shows_the_patches_of_each_round() {
    const RefinedWindow w;
    QVERIFY(w.ready);
    auto* panel = w.window->findChild<RoundPanel*>();
    QVERIFY(panel->isHidden());
    auto* controls = w.window->findChild<ColorControls*>();
    controls->set_outlines(false);
    w.scene_view->turn(10, 5);
    const Vec3 eye = w.scene_view->view_point().eye;
    std::vector<PatchId> patches;
    bool drawn = true;
    connect(&w.window->scene, &OpenScene::patches_changed, panel,
            [&](const std::shared_ptr<const LoadedScene>& loaded) {
              patches.push_back(loaded->scene->patch_count());
              drawn = drawn && w.scene_view->loaded() == loaded;
            });
    w.start("Jumps", 100);
    QVERIFY(w.finishes());
    QVERIFY(patches.size() >= 2 && std::is_sorted(patches.begin(), patches.end()));
    QVERIFY(patches.back() <= 100 && patches.back() > 90);
    QVERIFY(w.window->snapshot()->loaded->scene->patch_count() == patches.back());
    QVERIFY(controls->outlines());
    const Vec3 eye_now = w.scene_view->view_point().eye;
    QVERIFY(norm(eye_now - eye) < 1e-9);

    const auto* table = w.part<QTableWidget>("round_table");
    QVERIFY(!panel->isHidden() && w.part<QPushButton>("cancel_rounds")->isHidden());
    QCOMPARE(table->rowCount(), int(patches.size()) + 1);
    QCOMPARE(table->item(0, 1)->text(), QString("27"));
    QCOMPARE(table->item(1, 1)->text(), QString::number(patches[0]));
    QCOMPARE(table->item(table->rowCount() - 1, 0)->text(), QString("Solve"));
    QVERIFY(table->item(0, 2)->text().toDouble() > 0);
    QVERIFY(w.text("round_phase").startsWith(QString::number(patches.back()) + " patches"));
    QVERIFY(w.text("scene_summary").contains(QString("%1 patches").arg(patches.back())));
    save_picture(*w.window, "refined");

    // The scene is the same as by the library, with the materials, the tree and the picker of the
    // new patches.
    const Refinement expected = refine(cornell_box(), few, {RefineBy::jump, 100, 0});
    QVERIFY(w.window->snapshot()->radiosity == solve(expected.scene, few).radiosity);
    const Solution result = solution_of(*w.window->snapshot());
    QCOMPARE(result.statistics.refinement.size(), expected.rounds.size());
    QVERIFY(result.complete);
  }

  void none_returns_to_the_faces() {
    const RefinedWindow w;
    w.start("Error", 60);
    QVERIFY(w.finishes());
    QCOMPARE(w.part<QTableWidget>("round_table")->horizontalHeaderItem(2)->text(),
             QString("Error, %"));
    w.part<QComboBox>("refine_by")->setCurrentText("None");
    w.part<QPushButton>("restart")->click();
    QVERIFY(wait_for([&] {
      return w.window->snapshot() && !w.window->snapshot()->refine.is_set() && w.window->settled();
    }));
    QCOMPARE(w.window->snapshot()->loaded->scene->patch_count(), 27);
    QVERIFY(w.window->findChild<RoundPanel*>()->isHidden());
  }

  void rounds_are_canceled_at_once() {
    const RefinedWindow w;
    w.start("Jumps", 20000);
    auto* cancel = w.part<QPushButton>("cancel_rounds");
    // The rounds are advanced enough for an estimate of the time.
    QVERIFY(wait_for([&] {
      const auto snapshot = w.window->snapshot();
      return snapshot && snapshot->statistics.refinement.size() >= 4 && cancel->isVisible();
    }));
    QVERIFY2(w.text("round_phase").contains(" left"), qPrintable(w.text("round_phase")));
    QVERIFY(w.part<QProgressBar>("round_progress")->value() > 0);
    save_picture(*w.window, "rounds");
    QElapsedTimer timer;
    timer.start();
    cancel->click();
    QVERIFY(wait_for([&] {
      const auto snapshot = w.window->snapshot();
      return snapshot && w.window->runner.state() == RunState::paused &&
             snapshot->statistics.refinement.empty();
    }));
    qInfo("canceled in %lld ms", timer.elapsed());
    QCOMPARE(w.window->snapshot()->loaded->scene->patch_count(), 27);
    QVERIFY(w.window->banner_text().isEmpty());
    // The refinement can be started again.
    w.part<QSpinBox>("refine_patches")->setValue(60);
    w.part<QPushButton>("restart")->click();
    QVERIFY(w.finishes());
  }

  void rounds_can_be_paused() {
    const RefinedWindow w;
    w.start("Jumps", 20000);
    QVERIFY(wait_for([&] {
      const auto snapshot = w.window->snapshot();
      return snapshot && snapshot->statistics.refinement.size() >= 2 && snapshot->refinement.left;
    }));
    w.trigger("pause");
    QVERIFY(wait_for([&] { return w.window->runner.state() == RunState::paused; }));
    const std::size_t rounds = w.window->snapshot()->statistics.refinement.size();
    QVERIFY(rounds < 10);
    // A place within the rounds cannot be named: the session begins with them.
    const ViewState state = w.window->applier().state();
    QVERIFY(state.solve.kind == Goal::Kind::pause);
    QCOMPARE(state.options.refine.patches, 20000);
    w.trigger("run");
    QVERIFY(wait_for([&] {
      const auto snapshot = w.window->snapshot();
      return snapshot && snapshot->statistics.refinement.size() > rounds;
    }));
    w.part<QPushButton>("cancel_rounds")->click();
    QVERIFY(wait_for([&] { return w.window->scene.at_start(); }));
  }

  void changed_materials_stay_changed() {
    const RefinedWindow w;
    w.window->relighting.edits().set_reflectance("material:white", {0.2, 0.2, 0.2});
    QVERIFY(wait_for([&] { return w.window->settled(); }));
    QCOMPARE(w.window->relighting.edits().changes().size(), std::size_t{1});
    w.start("Jumps", 60);
    QVERIFY(w.finishes());
    // The changed materials now belong to the scene, which is solved and divided with them.
    QVERIFY(w.window->relighting.edits().changes().empty());
    const SolverSnapshot& snapshot = *w.window->snapshot();
    QVERIFY(!snapshot.materials);
    const Scene& scene = *snapshot.loaded->scene;
    int changed = 0;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      changed += scene.material(i).name == "white" && scene.reflectance(i) == Rgb{0.2, 0.2, 0.2};
    }
    QVERIFY(changed > 10);
  }

  void a_session_has_the_same_patches_again() {
    const QTemporaryDir folder;
    QString text;
    std::vector<Rgb> radiosity;
    {
      const RefinedWindow w;
      w.start("Jumps", 100);
      QVERIFY(w.finishes());
      w.window->selection.select(80);
      radiosity = w.window->snapshot()->radiosity;
      const WindowSession session(w.window->frame(), w.window->views().docks,
                                  w.window->views().notes, w.window->applier());
      text = QString::fromStdString(to_text(session.current(), folder.path().toStdString()));
    }
    const auto window = make_window(8);
    WindowSession session(window->frame(), window->views().docks, window->views().notes,
                          window->applier());
    session.restore(session_from_text(text.toStdString(), "session", folder.path().toStdString()));
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    QVERIFY(window->snapshot()->radiosity == radiosity);
    // There is no such patch before the last round.
    QCOMPARE(window->selection.patch(), PatchId{80});
    QVERIFY2(window->banner_text().isEmpty(), qPrintable(window->banner_text()));
    QCOMPARE(window->findChild<QComboBox*>("refine_by")->currentText(), QString("Jumps"));
    QCOMPARE(window->findChild<QSpinBox*>("refine_patches")->value(), 100);
    QVERIFY(!window->views().settings.differ_from_effect());
  }

  void settings_are_those_of_the_panel() {
    SettingsPanel panel;
    QVERIFY(!panel.refinement().is_set());
    auto* until = panel.findChild<QLineEdit*>("refine_until");
    panel.findChild<QAbstractButton*>("refine_section")->setChecked(true);
    QVERIFY(!until->isVisibleTo(&panel));
    panel.set_options(RunOptions{few, {}, {}, by(RefineBy::error, 345, 1.0 / 3)});
    QVERIFY(until->isVisibleTo(&panel));
    QVERIFY(panel.refinement() == by(RefineBy::error, 345, 1.0 / 3));
    until->setText("5");
    QVERIFY(panel.refinement() == by(RefineBy::error, 345, 0.05));
    auto snapshot = std::make_shared<SolverSnapshot>();
    snapshot->options = few;
    snapshot->refine = by(RefineBy::error, 345, 0.05);
    panel.set_in_effect(snapshot, {});
    QVERIFY(!panel.differ_from_effect());
    panel.findChild<QSpinBox*>("refine_patches")->setValue(346);
    QVERIFY(panel.differ_from_effect());
    // The panel of a result file has no rounds.
    panel.set_scene_fixed(true);
    QVERIFY(!panel.refinement().is_set());
    QVERIFY(!until->isVisibleTo(&panel));
    panel.set_scene_fixed(false);
    QVERIFY(panel.refinement().is_set());
  }

  void commands_and_files_have_the_rounds() {
    const RunOptions options{few, {}, {}, by(RefineBy::jump, 600, 0.05)};
    QCOMPARE(QString::fromStdString(solve_command("cornell-box", options, {})),
             QString("transillum solve cornell-box --directions 64 --patches 600 --refine-by jump "
                     "--refine-until 0.05"));
    QVERIFY(run_options_from_json(to_json(options), "o") == options);
    for (const char* bad : {R"({"refine-by": "edges", "patches": 9})", R"({"refine-by": "jump"})",
                            R"({"refine-by": "jump", "patches": 9, "refine-until": 1})",
                            R"({"refine-by": "jump", "patches": 9, "seconds": 2})"}) {
      QVERIFY_EXCEPTION_THROWN(run_options_from_json(nlohmann::json::parse(bad), "o"), InputError);
    }
    // Limits without a criterion are kept, for a control of a lesson, and change nothing.
    const RunOptions limits =
        run_options_from_json(nlohmann::json::parse(R"({"patches": 300})"), "o");
    QVERIFY(limits == RunOptions{.solve = {.first_shot = {}}});
    QVERIFY(with_option(limits, "refine-by", R"("error")").refine == by(RefineBy::error, 300));
  }

  // The page would not have the patches that the answer is about.
  void lessons_ask_nothing_about_refined_patches() {
    const char* question =
        R"({"title": "t", "pages": [{"title": "p", "text": "{r}",
            "controls": {"r": {"option": "refine-by", "values": ["none", "jump"]}},
            "question": {"kind": "patch", "ask": "which", "answer": {"largest": {"figure": "jump"}}},
            "show": {"scene": "cornell-box", "options": {"patches": 60}}}]})";
    QVERIFY_EXCEPTION_THROWN(lesson_from_text(question, "lesson"), InputError);
  }

  void rounds_double_the_patches() {
    const RoundsAhead ahead = rounds_ahead(27, by(RefineBy::jump, 100));
    QCOMPARE(ahead.rounds, 2);
    QCOMPARE(ahead.patches, 27.0 + 54 + 100);
    QCOMPARE(rounds_ahead(27, by(RefineBy::error, 100)).rounds, 3);
  }
};

const test::Registered registered("refinement", test::run_as_viewer<RefinementTest>);

}  // namespace transillum::viewer::refinement_test

#include "refinement_test.moc"
