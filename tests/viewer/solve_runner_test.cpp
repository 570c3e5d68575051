// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// SolveRunner: goals, pausing, restarting, and loading one scene while another is solved.
#include "model/solver/solve_runner.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include "registered.h"
#include "support/stopping.h"
#include "support/wait_until.h"
#include "test_files.h"
#include "transillum/at.h"

namespace transillum::viewer::solve_runner_test {

namespace {

// The solver's thread has a low priority: on a busy machine it waits long for a processor.
constexpr int longest_ms = 120000;

// A runner with its newest snapshot, scene and failure.
struct Watched {
  SolveRunner runner;
  std::shared_ptr<const SolverSnapshot> snapshot;
  std::shared_ptr<const LoadedScene> loaded;
  QString failure;
  int snapshots = 0;

  Watched() {
    QObject::connect(&runner, &SolveRunner::snapshot_ready, &runner, [this](auto newest) {
      snapshot = newest;
      ++snapshots;
    });
    QObject::connect(&runner, &SolveRunner::scene_loaded, &runner,
                     [this](auto newest) { loaded = newest; });
    QObject::connect(&runner, &SolveRunner::failed, &runner,
                     [this](const QString& message, bool) { failure = message; });
  }
  void open(const char* scene, int directions, Goal then = {}) {
    SolveOptions options;
    options.directions = directions;
    runner.open({scene, {options}, then});
  }
  bool reaches(RunState state) {
    return QTest::qWaitFor([&] { return runner.state() == state; }, longest_ms);
  }
  bool pauses_after_opening() {
    return QTest::qWaitFor([&] { return loaded && runner.state() == RunState::paused; },
                           longest_ms);
  }
  // Whether all commands so far are done, and nothing else is: a load that fails leaves the goal as
  // it is, and a state other than loading follows when the runner has no goal any more.
  bool handles_all() {
    failure.clear();
    open("/no/such/scene.obj", 16);
    return QTest::qWaitFor(
        [&] {
          return !failure.isEmpty() && runner.state() != RunState::loading &&
                 runner.state() != RunState::running;
        },
        longest_ms);
  }
  // Commands run on another thread: wait until the command has begun and is done.
  bool advances(const std::function<bool(const SolveProgress&)>& reached) {
    return QTest::qWaitFor(
        [&] {
          return runner.state() != RunState::running && snapshot && reached(snapshot->progress);
        },
        longest_ms);
  }
};

}  // namespace

class SolveRunnerTest : public QObject {
  Q_OBJECT

 private slots:
  // With its lamp of 5 mm as the measure, the run ended after one iteration, 64 % too dark.
  void a_small_lamp_is_no_measure() {
    Watched watched;
    watched.open(TRANSILLUM_SOURCE "/data/corpus/small-lamp.obj", 256);
    QVERIFY(watched.pauses_after_opening());
    watched.runner.run();
    QVERIFY(watched.advances([](const SolveProgress& p) { return p.finished; }));
    QVERIFY(watched.snapshot->statistics.converged);
    double power = 0, area = 0;
    const Scene& scene = *watched.loaded->scene;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      power += scene.patch(i).area * at(watched.snapshot->radiosity, i).r;
      area += scene.patch(i).area;
    }
    // 10 W / 94 m², and four times as much that walls of reflectance 0.8 reflect.
    QVERIFY(std::abs(power / area / (5 * 10.0 / 94) - 1) < 0.01);
  }

  // Until the solve is finished, the light is whole, without blocks, and never less accurate than
  // the draft: stages of few directions are not shown. Afterwards it is what it is without a draft.
  void a_draft_comes_before_a_long_solve() {
    SolveOptions options;
    options.goal.accuracy = 0.01;
    const auto solved = [&options](Watched& watched) {
      watched.runner.open({"cornell-box", {options, {false, 0.02}}, {Goal::Kind::finished}});
      return watched.reaches(RunState::finished) ? watched.snapshot->radiosity : std::vector<Rgb>();
    };
    Watched plain;
    const std::vector<Rgb> expected = solved(plain);
    QVERIFY(!expected.empty());
    const auto error = [&expected](const SolverSnapshot& snapshot) {
      double errors = 0, sum = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        errors += std::pow(max_abs(snapshot.radiosity[i] - expected[i]), 2);
        sum += std::pow(max_abs(expected[i]), 2);
      }
      return std::sqrt(errors / sum);
    };
    Watched watched;
    watched.runner.set_drafts(true);
    watched.runner.set_refresh_interval(0);
    double worst = 0, of_draft = 0;
    int drafts = 0;
    QObject::connect(&watched.runner, &SolveRunner::snapshot_ready, &watched.runner,
                     [&](const std::shared_ptr<const SolverSnapshot>& snapshot) {
                       drafts += snapshot->of_draft ? 1 : 0;
                       const bool before = drafts == 0 && snapshot->passes_done == 0;
                       worst = before ? worst : std::max(worst, error(*snapshot));
                       of_draft = snapshot->of_draft && drafts == 1 ? error(*snapshot) : of_draft;
                       QCOMPARE(snapshot->linear_terms.empty(), !snapshot->of_draft);
                     });
    QVERIFY(solved(watched) == expected);
    QVERIFY(drafts > 0 && !watched.snapshot->of_draft);
    QVERIFY(watched.snapshot->fitted &&
            watched.snapshot->fitted->terms.size() == watched.snapshot->radiosity.size());
    QVERIFY2(worst < 0.05, qPrintable(QString::number(worst)));
    QVERIFY2(worst <= of_draft, qPrintable(QString("%1 of %2").arg(worst).arg(of_draft)));
  }

  // Lobes take part from the first iteration on; until then they reflect diffusely.
  void a_draft_comes_before_a_glossy_solve() {
    SolveOptions options;
    options.directions = 256;
    options.glossy = true;
    Watched plain;
    plain.runner.open({"gallery", {options, {}}, {Goal::Kind::finished}});
    QVERIFY(plain.reaches(RunState::finished) && plain.snapshot->glossy);
    const auto power = [](const SolverSnapshot& snapshot) {
      double sum = 0;
      for (PatchId i = 0; i < snapshot.loaded->scene->patch_count(); ++i) {
        sum += snapshot.loaded->scene->patch(i).area * max_abs(at(snapshot.irradiance, i));
      }
      return sum;
    };
    Watched watched;
    watched.runner.set_drafts(true);
    double least = HUGE_VAL;
    int drafts = 0;
    QObject::connect(&watched.runner, &SolveRunner::snapshot_ready, &watched.runner,
                     [&](const std::shared_ptr<const SolverSnapshot>& snapshot) {
                       drafts += snapshot->of_draft ? 1 : 0;
                       least = drafts > 0 ? std::min(least, power(*snapshot)) : least;
                     });
    watched.runner.open({"gallery", {options, {}}, {Goal::Kind::finished}});
    QVERIFY(watched.reaches(RunState::finished) && drafts > 0);
    QVERIFY(watched.snapshot->radiosity == plain.snapshot->radiosity);
    // That changes where light goes, not how much is reflected.
    QVERIFY2(least > 0.9 * power(*plain.snapshot),
             qPrintable(QString("%1 of %2").arg(least).arg(power(*plain.snapshot))));
  }

  // The draft has constant functions; linear ones are fitted to them.
  void a_draft_of_linear_functions_is_smooth() {
    Watched watched;
    watched.runner.set_drafts(true);
    std::shared_ptr<const SolverSnapshot> draft;
    QObject::connect(&watched.runner, &SolveRunner::snapshot_ready, &watched.runner,
                     [&](const std::shared_ptr<const SolverSnapshot>& snapshot) {
                       draft = draft || !snapshot->of_draft ? draft : snapshot;
                     });
    watched.runner.open({"cornell-box",
                         {{.directions = 2048, .basis = Basis::linear}, {false, 0.005}},
                         {Goal::Kind::finished}});
    QVERIFY(watched.reaches(RunState::finished) && draft);
    const auto& terms = draft->linear_terms;
    const auto& expected = watched.snapshot->linear_terms;
    QVERIFY(draft->bases && terms.size() == expected.size() && !terms.empty());
    double errors = 0, all = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      errors += std::pow(max_abs(terms[i].first - expected[i].first), 2) +
                std::pow(max_abs(terms[i].second - expected[i].second), 2);
      all += std::pow(max_abs(expected[i].first), 2) + std::pow(max_abs(expected[i].second), 2);
    }
    QVERIFY2(errors < 0.25 * all, qPrintable(QString::number(std::sqrt(errors / all))));
    // A black corner shows: patches that a shadow's edge crosses are nowhere below 0 either.
    const Scene& scene = *draft->loaded->scene;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      for (const PointId corner : scene.outline(i)) {
        const auto [u, v] = at(*draft->bases, i).at(scene.point(corner));
        const Rgb b = at(draft->radiosity, i) + u * at(terms, i).first + v * at(terms, i).second;
        QVERIFY(std::min({b.r, b.g, b.b}) > -1e-12);
      }
    }
  }

  // A killed program leaves its checkpoint. The next one continues from there.
  void goes_on_with_the_checkpoint_of_another_program() {
    const QTemporaryDir folder;
    const std::string mine = folder.filePath("mine.tck").toStdString();
    const std::string left = folder.filePath("left.tck").toStdString();
    std::vector<Rgb> radiosity;
    {
      Watched watched;
      watched.runner.save_to(mine, 0);
      watched.open("cornell-box", 60, {Goal::Kind::passes, 25});
      QVERIFY(watched.advances([](const SolveProgress& p) { return p.direction == 25; }));
      QVERIFY(QFile::copy(QString::fromStdString(mine), QString::fromStdString(left)));
      watched.runner.run();
      QVERIFY(watched.advances([](const SolveProgress& p) { return p.finished; }));
      radiosity = watched.snapshot->radiosity;
    }
    QVERIFY(!QFile::exists(QString::fromStdString(mine)));

    Watched watched;
    watched.runner.resume_from(left);
    watched.open("cornell-box", 60);
    QVERIFY(watched.pauses_after_opening());
    QVERIFY(QTest::qWaitFor([&] { return watched.snapshot != nullptr; }));
    QCOMPARE(watched.snapshot->progress.direction, 25);
    QVERIFY(!QFile::exists(QString::fromStdString(left)));
    watched.runner.run();
    QVERIFY(watched.advances([](const SolveProgress& p) { return p.finished; }));
    QVERIFY(watched.snapshot->radiosity == radiosity);
  }

  // The checkpoint is of other options, or damaged: the solve starts from the beginning.
  void a_checkpoint_that_does_not_fit_is_left_out() {
    const QTemporaryDir folder;
    const QString left = folder.filePath("left.tck");
    test::write_file(left, "transillum checkpoint 1\n{}\n00000000");
    Watched watched;
    watched.runner.resume_from(left.toStdString());
    watched.open("cornell-box", 60);
    QVERIFY(watched.pauses_after_opening());
    QCOMPARE(watched.failure, QString());
    QVERIFY(!QFile::exists(left));
  }

  void a_scene_opens_paused() {
    Watched w;
    w.open("furnace", 16);
    QVERIFY(w.pauses_after_opening());
    QVERIFY(w.snapshot);
    QCOMPARE(w.snapshot->progress.direction, 0);
    QCOMPARE(w.snapshot->radiosity.size(), std::size_t(w.loaded->scene->patch_count()));
  }

  // While this thread handles no events, one scene is solved and another is opened and solved.
  void a_scene_is_announced_before_its_snapshots() {
    const QTemporaryDir folder;
    Watched w;
    QObject::connect(&w.runner, &SolveRunner::snapshot_ready, &w.runner,
                     [&w](const auto& newest) { QVERIFY(newest->loaded == w.loaded); });
    // Saved after each pass, and thus after the first snapshot.
    const QString checkpoint = folder.filePath("run.tck");
    w.runner.save_to(checkpoint.toStdString(), 0);
    for (const char* scene : {"cornell-box", "furnace"}) {
      w.open(scene, 16, {Goal::Kind::finished});
      QVERIFY(testing::wait_until([&] {
        QFile file(checkpoint);
        return file.open(QIODevice::ReadOnly) && file.readAll().contains(scene);
      }));
    }
    QVERIFY(!w.snapshot && !w.loaded);
    QVERIFY(w.reaches(RunState::finished));
    QTRY_VERIFY(w.snapshot && w.snapshot->loaded == w.loaded);
    QVERIFY(w.snapshot->progress.finished);
  }

  void one_direction_is_exactly_one() {
    Watched w;
    w.open("furnace", 16);
    QVERIFY(w.pauses_after_opening());
    for (int expected = 1; expected <= 3; ++expected) {
      w.runner.advance_one_direction();
      QVERIFY(w.advances([&](const SolveProgress& p) { return p.direction == expected; }));
      QVERIFY(w.handles_all());
      QCOMPARE(w.snapshot->progress.direction, expected);
    }
  }

  void one_iteration_is_exactly_one() {
    Watched w;
    w.open("furnace", 16);
    QVERIFY(w.pauses_after_opening());
    for (int expected = 1; expected <= 2; ++expected) {
      w.runner.advance_one_iteration();
      QVERIFY(w.advances([&](const SolveProgress& p) { return p.iteration == expected; }));
      QVERIFY(w.handles_all());
      QCOMPARE(w.snapshot->progress.iteration, expected);
      QCOMPARE(w.snapshot->progress.direction, 0);
      QCOMPARE(w.snapshot->statistics.iteration_records.size(), std::size_t(expected));
    }
  }

  // Stages follow one another without a pause; the last is the result.
  void an_accuracy_is_reached_in_stages() {
    Watched w;
    SolveOptions options;
    options.goal.accuracy = 0.02;
    w.runner.open({"rooms", {options}, {Goal::Kind::finished}});
    QVERIFY(w.reaches(RunState::finished));
    QTRY_VERIFY(w.snapshot && w.snapshot->accuracy && w.snapshot->accuracy->reached);
    const SolverSnapshot& last = *w.snapshot;
    QVERIFY(last.accuracy->stages.size() >= 2);
    QCOMPARE(last.options.directions, last.accuracy->stages.back().directions);
    QCOMPARE(last.errors.size(), last.statistics.iteration_records.size());
    const ErrorBand& error = last.errors.back();
    QVERIFY(error.lowest <= error.estimate && error.estimate <= error.limit);
    QVERIFY(error.limit <= 0.02);
    QCOMPARE(last.error.surfaces.limit, last.accuracy->error);
  }

  // The time most likely ends in the middle of a stage: the previous stage is the result.
  void a_limit_of_time_ends_with_a_finished_stage() {
    Watched w;
    SolveOptions options;
    options.goal.seconds = 0.5;
    w.runner.open({"cornell-box", {options}, {Goal::Kind::finished}});
    QVERIFY(w.reaches(RunState::finished));
    QTRY_VERIFY(w.snapshot && w.snapshot->accuracy && w.snapshot->progress.finished);
    const SolverSnapshot& last = *w.snapshot;
    QCOMPARE(last.options.directions, last.accuracy->stages.back().directions);
    QCOMPARE(static_cast<int>(last.directions->size()), last.options.directions);
    QCOMPARE(last.error.surfaces.limit, last.accuracy->error);
    QCOMPARE(last.statistics.passes, last.options.directions);
    QCOMPARE(last.errors.size(), last.statistics.iteration_records.size());
  }

  void a_goal_of_passes_is_reached_exactly() {
    Watched w;
    w.open("furnace", 64, {Goal::Kind::passes, 23});
    QVERIFY(w.advances([](const SolveProgress& p) { return p.direction == 23; }));
    QVERIFY(w.handles_all());
    QCOMPARE(w.snapshot->progress.direction, 23);
    QCOMPARE(w.snapshot->estimate_changes.size(), std::size_t{23});
  }

  void run_pause_run_finishes() {
    Watched w;
    w.open("cornell-box", 100000, {Goal::Kind::finished});
    QVERIFY(QTest::qWaitFor([&] { return w.snapshot && w.snapshot->progress.direction > 10; },
                            longest_ms));
    QCOMPARE(w.runner.state(), RunState::running);
    w.runner.pause();
    QVERIFY(w.reaches(RunState::paused));
    const int paused_at = w.snapshot->progress.direction;
    QVERIFY(w.handles_all());
    QCOMPARE(w.snapshot->progress.direction, paused_at);  // no pass after the pause
    w.runner.run();
    QVERIFY(
        QTest::qWaitFor([&] { return w.snapshot->progress.direction > paused_at; }, longest_ms));
  }

  void a_solve_converges_to_the_exact_solution() {
    Watched w;
    SolveOptions options;
    options.directions = 64;
    options.normalize = Normalization::rows;
    w.runner.open({"furnace", {options}, {Goal::Kind::finished}});
    QVERIFY(w.reaches(RunState::finished));
    QVERIFY(w.snapshot->statistics.converged);
    QCOMPARE(w.snapshot->estimate_changes.size(), std::size_t{64});  // one per pass
    for (const Rgb& b : w.snapshot->radiosity) {
      QVERIFY(std::abs(b.g - 2) < 1e-5);
    }
  }

  void stop_returns_to_the_start() {
    Watched w;
    w.open("cornell-box", 100000, {Goal::Kind::finished});
    QVERIFY(QTest::qWaitFor([&] { return w.snapshot && w.snapshot->progress.direction > 3; },
                            longest_ms));
    w.runner.stop();
    QVERIFY(w.advances([](const SolveProgress& p) { return p.direction == 0; }));
    QCOMPARE(w.runner.state(), RunState::paused);
  }

  void restart_uses_new_options() {
    Watched w;
    w.open("furnace", 16);
    QVERIFY(w.pauses_after_opening());
    SolveOptions options;
    options.directions = 24;
    w.runner.restart(options, {Goal::Kind::iteration});
    QVERIFY(w.advances([](const SolveProgress& p) { return p.iteration == 1; }));
    QCOMPARE(w.snapshot->progress.passes, 24);
  }

  void passes_are_counted_in_every_scheme_data() {
    QTest::addColumn<int>("scheme");
    QTest::addColumn<int>("passes");
    QTest::addColumn<int>("iteration");
    QTest::addColumn<int>("direction");
    // The growing scheme has 16, 32 and then 64 passes per iteration, half of them reused.
    QTest::newRow("growing, iteration 1") << static_cast<int>(Scheme::growing) << 7 << 0 << 7;
    QTest::newRow("growing, iteration 2") << static_cast<int>(Scheme::growing) << 40 << 1 << 24;
    QTest::newRow("growing, iteration 3") << static_cast<int>(Scheme::growing) << 100 << 2 << 52;
    QTest::newRow("semi-iterative") << static_cast<int>(Scheme::semi_iterative) << 150 << 2 << 22;
    QTest::newRow("fixed") << static_cast<int>(Scheme::fixed) << 5 * 64 << 5 << 0;
  }

  void passes_are_counted_in_every_scheme() {
    QFETCH(const int, scheme);
    QFETCH(const int, passes);
    QFETCH(const int, iteration);
    QFETCH(const int, direction);
    Watched w;
    SolveOptions options;
    options.directions = 64;
    options.scheme = static_cast<Scheme>(scheme);
    w.runner.open({"cornell-box", {options}, {Goal::Kind::passes, passes}});
    QVERIFY(w.advances([&](const SolveProgress& p) {
      return p.iteration == iteration && p.direction == direction;
    }));
    QCOMPARE(w.snapshot->passes_done, std::int64_t{passes});
    // The solve stays paused: the goal is already reached.
    w.runner.set_goal({Goal::Kind::passes, passes});
    QVERIFY(w.handles_all());
    QCOMPARE(w.snapshot->progress.direction, direction);
    QCOMPARE(w.snapshot->progress.iteration, iteration);
  }

  void after_a_bad_scene_the_old_one_continues() {
    Watched w;
    w.open("cornell-box", 100000, {Goal::Kind::finished});
    QVERIFY(QTest::qWaitFor([&] { return w.snapshot && w.snapshot->progress.direction > 3; },
                            longest_ms));
    const auto old_scene = w.loaded;
    w.open("/no/such/scene.obj", 16);
    QVERIFY(QTest::qWaitFor([&] { return !w.failure.isEmpty(); }, longest_ms));
    QVERIFY2(w.failure.contains("scene.obj"), qPrintable(w.failure));
    QVERIFY(w.loaded == old_scene);
    const int direction_before = w.snapshot->progress.direction;
    QVERIFY(QTest::qWaitFor([&] { return w.snapshot->progress.direction > direction_before; },
                            longest_ms));
  }

  void a_new_scene_replaces_one_being_solved() {
    Watched w;
    w.open("cornell-box", 100000, {Goal::Kind::finished});
    QVERIFY(QTest::qWaitFor([&] { return w.snapshot && w.snapshot->progress.direction > 3; },
                            longest_ms));
    w.open("furnace", 16, {Goal::Kind::iteration});
    QVERIFY(w.advances([](const SolveProgress& p) { return p.iteration == 1; }));
    QCOMPARE(QString::fromStdString(w.loaded->scene->name()), QString("furnace"));
  }

  // Before the first pass: a shot of many patches takes seconds.
  void a_long_shot_is_left_at_once_data() {
    QTest::addColumn<bool>("in_draft");
    QTest::addColumn<bool>("stops");
    QTest::newRow("of a draft, for another scene") << true << false;
    QTest::newRow("of a draft, by Stop") << true << true;
    QTest::newRow("for another scene") << false << false;
    QTest::newRow("by Stop") << false << true;
  }
  void a_long_shot_is_left_at_once() {
    QFETCH(const bool, in_draft);
    QFETCH(const bool, stops);
    Watched w;
    QVERIFY(begins_a_long_shot(w, in_draft));
    const auto scene = w.loaded;
    const double begin = worked();
    if (stops) {
      w.runner.stop();
      QVERIFY(w.reaches(RunState::paused));
    } else {
      w.open("furnace", 16);
      QVERIFY(QTest::qWaitFor([&] { return w.loaded != scene; }, longest_ms));
    }
    const double took = worked() - begin;
    QVERIFY2(took < longest_stop, qPrintable(QString::number(took)));
    if (stops) {
      // The scene is shown without the shot, or with the light of the draft.
      QTRY_VERIFY(w.snapshot && w.snapshot->loaded == scene);
      QCOMPARE(w.snapshot->progress.direction, 0);
      QCOMPARE(w.snapshot->of_draft, !in_draft);
    }
  }

  void after_a_bad_scene_the_shot_begins_again() {
    Watched w;
    QVERIFY(begins_a_long_shot(w, true));
    w.open("/no/such/scene.obj", 16);
    QVERIFY(QTest::qWaitFor([&] { return !w.failure.isEmpty(); }, longest_ms));
    QVERIFY(QTest::qWaitFor([&] { return w.snapshot && w.snapshot->of_draft; }, longest_ms));
  }

  void run_continues_a_solve_that_was_stopped_before_its_first_pass() {
    Watched w;
    QVERIFY(begins_a_long_shot(w, true));
    w.runner.stop();
    QVERIFY(w.reaches(RunState::paused));
    w.runner.advance_one_direction();
    QVERIFY(w.advances([](const SolveProgress& p) { return p.direction == 1; }));
  }

  // The solve that was to begin again is not of the scene that was opened afterwards.
  void a_scene_opened_after_stop_is_solved_as_asked() {
    Watched w;
    w.open("cornell-box", 100000, {Goal::Kind::finished});
    QVERIFY(QTest::qWaitFor([&] { return w.snapshot && w.snapshot->progress.direction > 3; },
                            longest_ms));
    w.runner.stop();
    w.open("furnace", 16, {Goal::Kind::iteration});
    QVERIFY(w.advances([](const SolveProgress& p) { return p.iteration == 1; }));
    QVERIFY(w.handles_all());
    QCOMPARE(w.snapshot->options.directions, 16);
    QCOMPARE(w.snapshot->progress.iteration, 1);
  }

  void ending_while_solving_is_quick() {
    auto w = std::make_unique<Watched>();
    w->open("sphere-flake:levels=1", 100000, {Goal::Kind::finished});
    QVERIFY(QTest::qWaitFor([&] { return w->snapshot && w->snapshot->progress.direction > 1; },
                            longest_ms));
    QElapsedTimer timer;
    timer.start();
    w.reset();
    QVERIFY2(timer.elapsed() < 2000, qPrintable(QString::number(timer.elapsed())));
  }

  void ending_while_loading_is_quick() {
    auto w = std::make_unique<Watched>();
    const double begin = worked();
    w->open("sphere-flake:levels=3", 16);
    QVERIFY(QTest::qWaitFor([&] { return worked() > begin + 0.2; }, longest_ms));
    QVERIFY(!w->loaded);
    // CPU time: on a busy machine, the thread of a low priority waits long for a processor.
    const double ended = worked();
    w.reset();
    QVERIFY2(worked() - ended < 1, qPrintable(QString::number(worked() - ended)));
  }

 private:
  // CPU time: on a busy machine, the solver's thread waits long for a processor.
  static double worked() { return testing::cpu_seconds(CLOCK_PROCESS_CPUTIME_ID); }
  static constexpr double longest_stop = 0.5;  // s, of which furnace takes a part

  /// Opens a scene whose first shot takes seconds.
  /// @returns whether the shot of its draft, or of the solve itself, has begun
  static bool begins_a_long_shot(Watched& w, bool in_draft) {
    SolveOptions options;
    options.basis = Basis::linear;
    options.goal.accuracy = 0.01;
    w.runner.set_drafts(true);
    w.runner.open({"cornell-box", {options, {false, 6e-4}}, {Goal::Kind::finished}});
    if (!in_draft) {
      return QTest::qWaitFor([&w] { return w.snapshot != nullptr; }, longest_ms);
    }
    if (!QTest::qWaitFor([&w] { return w.loaded != nullptr; }, longest_ms)) {
      return false;
    }
    const double begin = worked();
    return QTest::qWaitFor([&] { return worked() > begin + 0.1; }, longest_ms) && !w.snapshot;
  }
};

const test::Registered registered("solve_runner", test::run_without_widgets<SolveRunnerTest>);

}  // namespace transillum::viewer::solve_runner_test

#include "solve_runner_test.moc"
