// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The panel of settings: what it keeps, shows and tells.
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QStyleOption>
#include <limits>

#include "model/solver/session_snapshot.h"
#include "scene/build/patch_count.h"
#include "solve/quality_controls.h"
#include "solve/settings_panel.h"
#include "solve/solve_cost.h"
#include "solved_window.h"
#include "support/number_text.h"
#include "widgets/count_box.h"
#include "widgets/engine_text.h"
#include "widgets/fold.h"

namespace transillum::viewer::settings_test {

using namespace test;

namespace {

std::shared_ptr<const SolverSnapshot> in_effect(const SolveOptions& options) {
  auto snapshot = std::make_shared<SolverSnapshot>();
  snapshot->options = options;
  return snapshot;
}

std::shared_ptr<const LoadedScene> loaded_of(const char* spec) {
  auto loaded = std::make_shared<LoadedScene>();
  loaded->scene = load_scene(spec);
  loaded->tree = std::make_shared<const BspTree>(*loaded->scene);
  return loaded;
}

/// Width for the text of a box, pixels.
int room_for_text(const QComboBox& box) {
  QStyleOptionComboBox look;
  look.initFrom(&box);
  return box.style()
      ->subControlRect(QStyle::CC_ComboBox, &look, QStyle::SC_ComboBoxEditField, &box)
      .width();
}

}  // namespace

class SettingsTest : public QObject {
  Q_OBJECT

 private slots:
  void keep_every_value() {
    SettingsPanel panel;
    SolveOptions solve;
    solve.seed = std::numeric_limits<std::uint64_t>::max();
    solve.tolerance = 0.1 + 0.2;
    solve.iterations = 1'000'000;
    panel.set_options(solve, {false, 1e-9});
    QVERIFY(panel.solve_options() == solve);
    QCOMPARE(panel.scene_options().max_patch_area, 1e-9);
    QCOMPARE(panel.findChild<QLineEdit*>("max_patch_area")->text(), QString("1e-09"));
    QCOMPARE(panel.findChild<QLineEdit*>("seed")->text(), QString("18446744073709551615"));
    panel.findChild<QLineEdit*>("seed")->setText("7");
    panel.findChild<QLineEdit*>("max_patch_area")->clear();
    QCOMPARE(panel.solve_options().seed, std::uint64_t{7});
    QCOMPARE(panel.scene_options().max_patch_area, 0.0);
  }

  // The accuracy chooses the directions and replicas; the ones in effect are no difference.
  void ask_for_an_accuracy() {
    SettingsPanel panel;
    auto* directions = panel.findChild<QSpinBox*>("directions");
    QVERIFY(directions->isVisibleTo(&panel));
    panel.findChild<QLineEdit*>("accuracy")->setText("0.7");
    const SolveOptions asked = panel.solve_options();
    QCOMPARE(asked.goal.accuracy, 0.7 / 100);
    QVERIFY(asked.first_shot == first_shot_where_it_pays);
    QCOMPARE(asked.replicas, 1);
    QVERIFY(!directions->isVisibleTo(&panel));
    SolveOptions stage = asked;
    stage.directions = 200;
    stage.replicas = 4;
    stage.tolerance = 1e-8;
    panel.set_in_effect(in_effect(stage), {});
    QVERIFY(!panel.differ_from_effect());
    panel.findChild<QLineEdit*>("accuracy")->setText("0.5");
    QVERIFY(panel.differ_from_effect());
    panel.findChild<QLineEdit*>("accuracy")->clear();
    QVERIFY(!panel.solve_options().goal.is_set());
    QVERIFY(directions->isVisibleTo(&panel));
  }

  void only_choices_that_apply_are_shown() {
    QualityControls controls;
    const auto shown = [&](bool takes_directions) {
      controls.show_state(takes_directions, {});
      QStringList names;
      for (const char* name : {"draft", "normal", "fine", "by_number", "draft_cost", "accuracy"}) {
        const bool visible = controls.findChild<QWidget*>(name)->isVisibleTo(&controls);
        names << (visible ? QStringList{name} : QStringList{});
      }
      return names.join(' ');
    };
    const QString all = "draft normal fine by_number draft_cost accuracy";
    QCOMPARE(shown(true), all);
    auto* accuracy = controls.findChild<QLineEdit*>("accuracy");
    accuracy->setText("1");
    QCOMPARE(shown(false), QString("accuracy"));  // to take it back
    accuracy->clear();
    QCOMPARE(shown(false), QString());
    QVERIFY(controls.findChild<QLabel*>("quality_note")->isVisibleTo(&controls));
    QCOMPARE(shown(true), all);
  }

  void quality_is_one_of_few_or_an_own_one() {
    SettingsPanel panel;
    const auto part = [&](const char* name) { return panel.findChild<QPushButton*>(name); };
    const auto checked = [&] {
      QStringList names;
      for (const char* name : {"draft", "normal", "fine", "by_number"}) {
        names << (part(name)->isChecked() ? QStringList{name} : QStringList{});
      }
      return names.join(' ');
    };
    QCOMPARE(checked(), QString("by_number"));
    part("normal")->click();
    QCOMPARE(panel.solve_options().goal.accuracy, 0.01);
    QCOMPARE(checked(), QString("normal"));
    part("normal")->click();  // stays
    QCOMPARE(checked(), QString("normal"));
    part("fine")->click();
    QCOMPARE(panel.solve_options().goal.accuracy, 0.003);
    QCOMPARE(checked(), QString("fine"));
    SolveOptions replicas;
    replicas.replicas = 4;
    panel.set_options(replicas, {});
    part("draft")->click();
    QVERIFY(panel.solve_options() == SolveOptions{.directions = 64});
    QCOMPARE(checked(), QString("draft"));
    panel.findChild<QSpinBox*>("directions")->setValue(65);
    QCOMPARE(checked(), QString("by_number"));
    auto* accuracy = panel.findChild<QLineEdit*>("accuracy");
    accuracy->setText("1");
    QCOMPARE(checked(), QString("normal"));
    accuracy->setText("0.7");
    QVERIFY(checked().isEmpty() && accuracy->property("chosen").toBool());
    part("by_number")->click();
    QVERIFY(panel.solve_options() == SolveOptions{.directions = 65});
    QVERIFY(checked() == "by_number" && !accuracy->property("chosen").toBool());
    SolveOptions timed;
    timed.goal.seconds = 30;
    panel.set_options(timed, {});
    const auto* note = panel.findChild<QLabel*>("quality_note");
    QVERIFY2(checked().isEmpty() && note->text().contains("30 s"), qPrintable(note->text()));
    part("draft")->click();
    QVERIFY(panel.solve_options() == SolveOptions{.directions = 64});
    QCOMPARE(checked(), QString("draft"));
  }

  void without_effect_are_not_shown() {
    SettingsPanel panel;
    panel.findChild<QAbstractButton*>("method_section")->setChecked(true);
    const auto shown = [&](const char* name) {
      return panel.findChild<QWidget*>(name)->isVisibleTo(&panel);
    };
    QVERIFY(!shown("seed") && !shown("resolution") && !shown("glossy") && !shown("accuracy_of"));
    QVERIFY(shown("replicas") && shown("sampling") && shown("two_sided"));
    panel.findChild<QComboBox*>("sampling")->setCurrentText("Random");
    QVERIFY(shown("seed"));
    panel.findChild<QPushButton*>("normal")->click();
    QVERIFY(shown("accuracy_of") && !shown("replicas"));
    panel.set_scene_fixed(true);
    QVERIFY(!shown("two_sided") && !shown("patches_wanted") && !shown("refine_section"));
    QCOMPARE(panel.findChild<FoldHeader*>("method_section")->state(), QString("Fast · Random"));
  }

  void follow_the_default_sampling() {
    SettingsPanel panel;
    auto* serves = panel.findChild<QComboBox*>("pass_serves");
    auto* sampling = panel.findChild<QComboBox*>("sampling");
    QVERIFY(panel.solve_options() == SolveOptions());
    QCOMPARE(sampling->currentText(), QString("Antipodal"));
    serves->setCurrentIndex(1);
    QCOMPARE(sampling->currentText(), QString("Fibonacci"));
    SolveOptions one_way;
    one_way.two_way = false;
    QVERIFY(panel.solve_options() == one_way);
    serves->setCurrentIndex(0);
    QCOMPARE(sampling->currentText(), QString("Antipodal"));
    // The choice of the user stays.
    sampling->setCurrentText(QStringLiteral("Halton"));
    serves->setCurrentIndex(1);
    QCOMPARE(sampling->currentText(), QString("Halton"));
    // Options of a file stay too, whatever the combination.
    SolveOptions given;
    given.sampling = Sampling::fibonacci;
    panel.set_options(given, {});
    QVERIFY(panel.solve_options() == given);
  }

  void show_the_options_of_an_engine() {
    SettingsPanel panel;
    panel.findChild<QAbstractButton*>("method_section")->setChecked(true);
    panel.show();
    auto* engine = panel.findChild<QComboBox*>("engine");
    auto* resolution = panel.findChild<QSpinBox*>("resolution");
    auto* order = panel.findChild<QComboBox*>("painters_order");
    const auto choose = [&](Engine chosen) {
      choose_engine(*engine, chosen);
      QCOMPARE(panel.solve_options().engine, chosen);
      QVERIFY(!engine->toolTip().isEmpty());
      QCOMPARE(resolution->isVisible(), traits_of(chosen).takes_resolution);
      QCOMPARE(order->isVisible(), chosen == Engine::painter);
    };
    for (const std::string& name : names_of<Engine>()) {
      if (takes_directions(from_name<Engine>(name))) {
        choose(from_name<Engine>(name));
      }
    }
    choose(Engine::painter);
    QVERIFY(resolution->text().contains(QStringLiteral("512 px")));  // the default
    resolution->setValue(256);
    order->setCurrentIndex(1);
    const SolveOptions options = panel.solve_options();
    QCOMPARE(options.engine_options.resolution, 256);
    QVERIFY(options.engine_options.order == PaintersOrder::newell);
    SettingsPanel another;
    another.set_options(options, {});
    QVERIFY(another.solve_options() == options);
  }

  void divides_into_about_as_many_patches_as_asked_for() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    const Scene& faces = *solved.window->snapshot()->loaded->scene;
    const double area = max_patch_area_for(faces, 300);
    const std::int64_t count = count_patches(faces, area);
    solved.window->findChild<QSpinBox*>("patches_wanted")->setValue(300);
    // The button may be pressed before the patches are counted.
    solved.window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] {
      const auto snapshot = solved.window->snapshot();
      return snapshot && static_cast<std::int64_t>(snapshot->radiosity.size()) == count;
    }));
    QCOMPARE(solved.window->views().settings.scene_options().max_patch_area, area);
  }

  void tells_the_cost_of_other_settings() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    QVERIFY(solved.ready);
    const auto* cost = solved.window->findChild<QLabel*>("patch_forecast");
    QVERIFY2(cost->text().contains("less than 1 s"), qPrintable(cost->text()));
    constexpr int directions = 1 << 24;
    solved.window->findChild<QSpinBox*>("directions")->setValue(directions);
    const SolverSnapshot& done = *solved.window->snapshot();
    const SolveCost wanted = cost_of(&done, solved.window->views().settings.options().solve,
                                     done.loaded->scene->patch_count());
    const SolveStatistics& spent = done.statistics;
    QVERIFY(spent.seconds_transfers > 0 && spent.passes_made == 8);
    QVERIFY(wanted.seconds >= directions * spent.seconds_transfers / 8);
    QVERIFY(wanted.seconds < directions * spent.seconds_transfers / 8 + 60);
    QCOMPARE(cost->text(), cost_text(wanted));
  }

  // The forecast of the settings in effect, and the time that the solve itself says is left.
  void the_forecast_agrees_with_the_solve_under_way() {
    const auto loaded = loaded_of("sphere-flake:levels=1");
    constexpr int passes = 64;
    SolveOptions options{.directions = passes};
    options.first_shot.reset();
    SolveSession session({.scene = loaded->scene, .options = options, .tree = loaded->tree});
    session.prepare();
    int told = 0;
    session.advance(SolveSession::Until::iteration, [&](const SolveSession& now) {
      const SolverSnapshot snapshot = snapshot_of(now, loaded);
      const SolveProgress& progress = snapshot.progress;
      if (progress.direction < passes / 4 || progress.direction == passes) {
        return true;
      }
      const SolveCost cost = cost_of(&snapshot, options, loaded->scene->patch_count());
      const double own = passes / progress.passes_per_second;
      told += cost.seconds && *cost.seconds > 0.5 * own && *cost.seconds < 2 * own;
      return true;
    });
    QCOMPARE(told, passes - passes / 4);
  }

  // Lobes reflect after the passes of an iteration: their time is not known before.
  void the_time_of_lobes_is_told_once_they_have_reflected() {
    const auto loaded = loaded_of("gallery");
    SolveOptions options{.directions = 16};
    options.glossy = true;
    SolveSession session({.scene = loaded->scene, .options = options, .tree = loaded->tree});
    session.prepare();
    std::vector<double> seconds;
    while (!session.finished()) {
      session.advance(SolveSession::Until::iteration);
      const SolverSnapshot snapshot = snapshot_of(session, loaded);
      const SolveCost cost = cost_of(&snapshot, options, loaded->scene->patch_count());
      QCOMPARE(cost.seconds.has_value(), snapshot.progress.iteration >= 2);
      seconds.push_back(cost.seconds.value_or(0));
    }
    // More passes make more light that is reflected in each iteration.
    const SolverSnapshot done = snapshot_of(session, loaded);
    QVERIFY(seconds.back() >= done.statistics.seconds_transfers + done.statistics.seconds_iterate);
    options.directions *= 4;
    const SolveCost cost = cost_of(&done, options, loaded->scene->patch_count());
    QVERIFY(*cost.seconds > 3.9 * (seconds.back() - done.statistics.seconds_bsp -
                                   done.statistics.seconds_first_shot));
  }

  // A solve for an accuracy takes the passes that it took.
  void a_solve_that_has_reached_its_accuracy_costs_what_it_took() {
    const auto loaded = loaded_of("cornell-box");
    SolveOptions options;
    options.goal.accuracy = 0.05;
    SolveSession session({.scene = loaded->scene, .options = options, .tree = loaded->tree});
    session.prepare();
    session.advance(SolveSession::Until::finished);
    const SolverSnapshot done = snapshot_of(session, loaded);
    QVERIFY(done.accuracy && done.accuracy->reached && done.accuracy->error < 0.05);
    const SolveStatistics& s = done.statistics;
    const double more =
        static_cast<double>(done.accuracy->passes_made) / static_cast<double>(s.passes_made);
    const SolveCost cost = cost_of(&done, done.options, s.patches);
    QVERIFY(*cost.seconds >= more * s.seconds_transfers);
    QCOMPARE(*cost.seconds, *cost.most_seconds);
  }

  void all_counts_are_written_alike() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    QVERIFY(solved.ready);
    auto* directions = solved.window->findChild<QSpinBox*>("directions");
    directions->setValue(19'720);
    QCOMPARE(directions->text(), count_text(19'720));
    QCOMPARE(number_text(19'720), count_text(19'720));
    QCOMPARE(number_text(2013), count_text(2013));
    QCOMPARE(number_text(999.5), QString("999.5"));
    QCOMPARE(number_text(999.96), count_text(1000));
    // Typed numbers may have spaces or none, as may a number that is pasted.
    CountBox box;
    box.setRange(0, 100'000);
    box.setPrefix("about ");
    box.setSuffix(" px");
    for (const QString& typed :
         {QString("2013"), QString("2 013"), QString("2,013"), QString("2") + QChar(0xa0) + "013",
          count_text(2013), "about " + count_text(2013) + " px"}) {
      box.setValue(500);
      auto* line = box.findChild<QLineEdit*>();
      line->selectAll();
      line->insert(typed);
      QTest::keyClick(&box, Qt::Key_Return);
      QCOMPARE(box.value(), 2013);
      QCOMPARE(box.text(), "about " + count_text(2013) + " px");
    }
    box.setPrefix({});
    box.setValue(500);
    box.findChild<QLineEdit*>()->selectAll();
    QTest::keyClicks(&box, "2 01");
    QTest::keyClicks(&box, "3");
    QTest::keyClick(&box, Qt::Key_Return);
    QCOMPARE(box.value(), 2013);
  }

  // No control above the sections, and no section above the sky, moves during a solve.
  void controls_keep_their_places() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    QVERIFY(solved.ready);
    auto& panel = solved.window->views().settings;
    auto* how_wrong = panel.findChild<QPushButton*>("how_wrong");
    const auto places = [&panel] {
      std::vector<int> all;
      for (const char* name : {"how_wrong", "method_section", "refine_section", "limits_section"}) {
        const auto* widget = panel.findChild<QWidget*>(name);
        all.push_back(widget->mapTo(&panel, QPoint()).y());
      }
      return all;
    };
    const auto unfinished = solved.window->snapshot();
    auto finished = std::make_shared<SolverSnapshot>(*unfinished);
    finished->progress.finished = true;
    panel.set_in_effect(finished, panel.scene_options());
    handle_posted();
    QVERIFY(how_wrong->isVisible() && how_wrong->isEnabled());
    const std::vector<int> before = places();
    panel.set_in_effect(unfinished, panel.scene_options());
    for (const double escape : {0.0, 0.5}) {
      panel.show_escape(escape);
      handle_posted();
      QVERIFY(how_wrong->isVisible() && !how_wrong->isEnabled());
      QVERIFY(how_wrong->toolTip().contains("ended"));
      QVERIFY(places() == before);
    }
    const auto* sky = panel.findChild<QWidget*>("sky_section");
    QVERIFY(sky->mapTo(&panel, QPoint()).y() > before.back());
  }

  void a_state_that_does_not_fit_loses_whole_parts() {
    FoldHeader header("Method", nullptr);
    header.set_state("Fast · Antipodal · Linear · Conjugate gradients · lobes");
    const QFontMetrics metrics = header.fontMetrics();
    QString last;
    for (int width = 900; width > 60; --width) {
      header.resize(width, 30);
      const QString shown = header.shown_state();
      QString whole = shown;
      whole.remove(" …");
      const bool is_start = shown.endsWith("…") && QString("Fast").startsWith(shown.chopped(1));
      QVERIFY2(shown.isEmpty() || is_start || (header.state() + " · ").startsWith(whole + " · "),
               qPrintable(shown));
      QVERIFY(metrics.horizontalAdvance(shown) < width);
      QVERIFY(last.isNull() || shown.size() <= last.size());
      last = shown;
    }
    QCOMPARE(last, QString());
    header.set_state({});
    QCOMPARE(header.shown_state(), QString());
  }

  void headings_of_materials_are_on_one_line() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    QVERIFY(solved.ready);
    solved.window->resize(1280, 720);
    solved.window->views().docks.bring_to_front("material");
    const auto* heading = solved.window->findChild<QLabel*>("exitance_heading");
    QVERIFY(wait_for([&] { return heading->isVisible(); }));
    QCOMPARE(heading->text(), QString("Exitance E, W/m²"));
    QVERIFY2(heading->width() >= heading->sizeHint().width() &&
                 heading->height() < 1.7 * heading->fontMetrics().height(),
             qPrintable(QString("%1 x %2").arg(heading->width()).arg(heading->height())));
  }

  // A draft has no error that would tell how many passes an accuracy needs: a range is shown.
  void the_choices_of_quality_tell_their_time() {
    const SolvedWindow solved("cornell-box", {.directions = 64});
    QVERIFY(solved.ready);
    const auto text = [&](const char* choice) {
      return solved.window->findChild<QLabel*>(QString(choice) + "_cost")->text();
    };
    for (const char* choice : {"draft", "normal", "fine"}) {
      QVERIFY2(QRegularExpression("[0-9] (s|min)$").match(text(choice)).hasMatch(),
               qPrintable(text(choice)));
    }
    const SolverSnapshot& done = *solved.window->snapshot();
    const std::int64_t patches = done.loaded->scene->patch_count();
    const auto* quality = solved.window->findChild<QualityControls*>();
    double before = 0;
    for (const auto choice : {QualityControls::Choice::draft, QualityControls::Choice::normal,
                              QualityControls::Choice::fine}) {
      const SolveCost cost = cost_of(&done, quality->with(done.options, choice), patches);
      QVERIFY(cost.seconds && *cost.seconds > before && *cost.most_seconds >= *cost.seconds);
      QCOMPARE(*cost.most_seconds > *cost.seconds, choice != QualityControls::Choice::draft);
      before = *cost.seconds;
    }
    // With an estimate of the error, the time is one number, and grows with the accuracy.
    const SolvedWindow estimated("cornell-box", {.directions = 64, .replicas = 8});
    QVERIFY(estimated.ready);
    const SolverSnapshot& known = *estimated.window->snapshot();
    SolveOptions wanted = known.options;
    wanted.replicas = 1;
    wanted.goal.accuracy = 0.01;
    const SolveCost normal = cost_of(&known, wanted, patches);
    wanted.goal.accuracy = 0.003;
    const SolveCost fine = cost_of(&known, wanted, patches);
    QVERIFY(normal.seconds && fine.seconds && *fine.seconds > *normal.seconds);
    QVERIFY(*normal.most_seconds == *normal.seconds);
    QCOMPARE(short_time_text({patches, 2.2, 8.5, 0}), QString("3–9 s"));
    QCOMPARE(short_time_text({patches, 8.1, 8.5, 0}), QString("9 s"));
    QCOMPARE(short_time_text({patches, 40, 240, 0}), QString("≤ 4 min"));
    QCOMPARE(short_time_text({patches, {}, {}, 0}), QString());
  }

  // At the size of a projector, with all sections open, in both themes.
  void the_button_is_always_seen_and_no_text_is_cut() {
    const SolvedWindow solved("gallery", {.directions = 16});
    QVERIFY(solved.ready);
    TestWindow& window = *solved.window;
    auto* panel = window.findChild<SettingsPanel*>();
    auto* restart = window.findChild<QPushButton*>("restart");
    window.resize(1280, 720);
    for (auto* header : panel->findChildren<FoldHeader*>()) {
      header->setChecked(true);
    }
    window.findChild<QComboBox*>("engine")->setCurrentText("Painter's algorithm");
    window.findChild<QPushButton*>("normal")->click();
    for (const bool dark : {false, true}) {
      theme::apply(*qApp, {.dark = dark});
      handle_posted();
      QVERIFY(restart->visibleRegion().boundingRect() == restart->rect());
      for (const auto* label : panel->findChildren<QLabel*>()) {
        if (label->isVisibleTo(panel) && !label->wordWrap()) {
          QVERIFY2(label->width() >= label->sizeHint().width(), qPrintable(label->text()));
        }
      }
      const auto& stop_at = *panel->findChild<QComboBox*>("stop_at");
      for (int k = 0; k < stop_at.count(); ++k) {
        QVERIFY2(
            room_for_text(stop_at) >= stop_at.fontMetrics().horizontalAdvance(stop_at.itemText(k)),
            qPrintable(stop_at.itemText(k)));
      }
      save_picture(window, dark ? "settings-dark" : "settings-light");
      save_picture(*panel, dark ? "settings-panel-dark" : "settings-panel-light");
    }
    theme::apply(*qApp);
  }

  void undo_brings_the_solve_before_back() {
    const SolvedWindow solved("cornell-box", {.directions = 8});
    TestWindow& window = *solved.window;
    const auto finished = [&window] {
      return wait_for([&] {
        return window.runner.state() == RunState::finished && window.snapshot() &&
               window.snapshot()->progress.finished && window.settled();
      });
    };
    window.runner.run();
    QVERIFY(finished());
    const auto before = window.snapshot();
    for (const bool divides : {false, true}) {
      window.findChild<QSpinBox*>("directions")->setValue(16);
      if (divides) {
        window.findChild<QLineEdit*>("max_patch_area")->setText("0.05");
      }
      window.findChild<QPushButton*>("restart")->click();
      QVERIFY(wait_for([&] { return window.snapshot()->options.directions == 16; }));
      QVERIFY(finished());
      const auto after = window.snapshot();
      QVERIFY(after->radiosity != before->radiosity);
      auto* undo = window.findChild<QAction*>("undo");
      QVERIFY2(undo->isEnabled() && undo->text().contains("solving again"),
               qPrintable(undo->text()));
      undo->trigger();
      QVERIFY(wait_for([&] {
        const auto now = window.snapshot();
        return now && now->of_file && now->radiosity == before->radiosity && window.settled();
      }));
      QVERIFY(window.views().settings.solve_options() == before->options);
      QVERIFY(!window.views().settings.differ_from_effect());
      QVERIFY(!undo->isEnabled());
      // Redo brings the later one back, and Undo this one again.
      auto* redo = window.findChild<QAction*>("redo");
      QVERIFY2(redo->isEnabled() && redo->text().contains("solving again"),
               qPrintable(redo->text()));
      redo->trigger();
      QVERIFY(wait_for([&] {
        const auto now = window.snapshot();
        return now && now->of_file && now->radiosity == after->radiosity && window.settled();
      }));
      QVERIFY(window.views().settings.solve_options() == after->options);
      QVERIFY(!redo->isEnabled() && undo->isEnabled());
      undo->trigger();
      QVERIFY(wait_for([&] {
        const auto now = window.snapshot();
        return now && now->of_file && now->radiosity == before->radiosity && window.settled();
      }));
      // The same solve can be made again, with its form factors.
      window.findChild<QAction*>("run")->trigger();
      QVERIFY(finished());
      QVERIFY(window.snapshot()->radiosity == before->radiosity);
    }
  }
};

const test::Registered registered("settings", test::run_as_viewer<SettingsTest>);

}  // namespace transillum::viewer::settings_test

#include "settings_test.moc"
