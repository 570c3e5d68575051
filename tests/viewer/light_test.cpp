// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Imperfect scenes, in which nothing emits, faces are turned the wrong way or solids cross: offers
// of the window, changes of single faces and groups, and the scene file saved with them.
#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTemporaryDir>
#include <span>

#include "model/snapshot_values.h"
#include "patches/material_panel.h"
#include "solve/study_dialog.h"
#include "solved_window.h"
#include "test_files.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/relight.h"
#include "widgets/banner.h"
#include "window/files/export_actions.h"

namespace transillum::viewer::light_test {

using namespace test;

namespace {

/// The faces of a cube from (low, low, low) to (high, high, high).
QByteArray cube(double low, double high, bool inside_out = false, int faces = 6) {
  QByteArray text;
  for (int k = 0; k < 8; ++k) {
    const auto c = [&](int bit) { return QByteArray::number((k >> bit) % 2 == 0 ? low : high); };
    text += "v " + c(0) + ' ' + c(1) + ' ' + c(2) + '\n';
  }
  const int outward[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5},
                             {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
  for (const auto& face : std::span(outward).first(static_cast<std::size_t>(faces))) {
    text += 'f';
    for (int k = 0; k < 4; ++k) {
      text += ' ' + QByteArray::number(face[inside_out ? 3 - k : k] - 9);  // the newest points
    }
    text += '\n';
  }
  return text;
}

/// A closed room with a box in it. Faces 0 to 5: the room, seen from inside; 6 to 11: the box.
/// `turned`: all faces of the box have the wrong side out. `open`: the room has no sixth face.
QByteArray room(bool turned, bool open) {
  return "mtllib none.mtl\ng room\nusemtl white\n" + cube(0, 4, true, open ? 5 : 6) +
         "g box\nusemtl gray\n" + cube(1, 2.5, turned);
}

/// A room in a file, opened and solved.
struct Opened {
  QTemporaryDir folder;
  QString path = folder.filePath("room.obj");
  std::unique_ptr<TestWindow> window;
  bool ready = false;

  explicit Opened(bool turned = false, const QByteArray& materials = {}, bool open = false) {
    write_file(path, room(turned, open));
    write_file(folder.filePath("none.mtl"), materials.isEmpty()
                                                ? QByteArray("newmtl white\nKd .7 .7 .7\n"
                                                             "newmtl gray\nKd .4 .3 .2\n")
                                                : materials);
    window = make_window(32);
    window->open(path);
    ready = settles();
  }
  /// Waits for the end of the solve; what has no light is not solved.
  bool settles() const {
    return wait_for([this] {
      const auto snapshot = window->snapshot();
      return snapshot && (snapshot->progress.finished || !has_light(*snapshot)) &&
             window->settled();
    });
  }
  bool is_relit() const {
    return wait_for([this] { return window->snapshot()->materials && window->settled(); });
  }
  const Scene& scene() const { return *window->snapshot()->loaded->scene; }
  MaterialEdits& edits() const { return window->relighting.edits(); }
  QString light_bar() const { return window->views().page.light_bar()->text(); }
  QString orientation_bar() const { return window->views().page.orientation_bar()->text(); }
  template <class Widget>
  Widget* part(const char* name) const {
    return window->findChild<Widget*>(name);
  }
  /// The entries of the menu of the bar.
  QList<QAction*> offers() const {
    QMenu* menu = part<QPushButton>("make_emit")->menu();
    emit menu->aboutToShow();
    return menu->actions();
  }
};

double largest(const std::vector<Rgb>& values) {
  double result = 0;
  for (const Rgb& value : values) {
    result = std::max(result, max_abs(value));
  }
  return result;
}

}  // namespace

class LightTest : public QObject {
  Q_OBJECT

 private slots:
  void a_scene_without_light_shows_its_shape_and_offers_to_make_a_face_emit() {
    const Opened opened;
    QVERIFY(opened.ready);
    QVERIFY2(opened.light_bar().startsWith("No light"), qPrintable(opened.light_bar()));
    QCOMPARE(opened.window->snapshot()->passes_done, std::int64_t{0});
    // Walls of one material differ by their direction; nothing is black.
    const auto& colors = opened.window->colors.patch_colors();
    QSet<int> brightness;
    for (PatchId i = 0; i < 6; ++i) {
      brightness.insert(at(colors, i)[0]);
      QVERIFY(at(colors, i)[0] > 60);
    }
    QVERIFY(brightness.size() >= 4);
    save_picture(*opened.window, "no-light");

    QVERIFY(!opened.offers().front()->isEnabled());  // nothing is selected
    opened.window->selection.select(5);
    QVERIFY(opened.light_bar().contains("selected face"));
    const QList<QAction*> offers = opened.offers();
    QCOMPARE(offers[0]->text(), QString("Face 5"));
    QCOMPARE(offers[1]->text(), QString("Material \"white\""));
    QCOMPARE(offers[2]->text(), QString("Group \"room\""));
    save_picture(*opened.window, "no-light-selected");
    offers[0]->trigger();
    QVERIFY(opened.is_relit());
    QVERIFY(opened.light_bar().isEmpty());
    save_picture(*opened.window, "light-made");
    const auto snapshot = opened.window->snapshot();
    for (PatchId i = 0; i < 12; ++i) {
      QCOMPARE(max_abs(material_of(*snapshot, i).exitance) > 0, i == 5);
      QVERIFY(max_abs(at(snapshot->radiosity, i)) > 0);
    }
    // The panel shows the sliders of the face.
    QCOMPARE(opened.part<QComboBox>("material_kind")->currentText(), QString("Face"));
    QCOMPARE(opened.part<QComboBox>("material")->currentText(), QString("5"));

    opened.part<QAction>("undo")->trigger();
    QVERIFY(wait_for([&] { return !opened.window->snapshot()->materials; }));
    QVERIFY(opened.light_bar().startsWith("No light"));
    QCOMPARE(largest(opened.window->snapshot()->radiosity), 0.0);
  }

  void a_light_suggested_by_its_name_is_offered_without_a_selection() {
    const Opened opened(false, "newmtl white\nKd .7 .7 .7\nnewmtl gray\nKd .4 .3 .2\n");
    QVERIFY(opened.ready);
    const QList<QAction*> offers = opened.offers();
    QVERIFY(offers.back()->text().endsWith("(suggested)"));
    offers.back()->trigger();
    QVERIFY(opened.is_relit());
    QVERIFY(largest(opened.window->snapshot()->radiosity) > 0);
  }

  void a_closed_bar_stays_closed_until_another_scene() {
    const Opened opened;
    QVERIFY(opened.ready);
    emit opened.window->views().page.light_bar()->closed();
    opened.window->selection.select(3);
    QVERIFY(opened.light_bar().isEmpty());
    opened.window->open("furnace");
    QVERIFY(wait_for([&] { return opened.window->scene.spec() == "furnace"; }));
    QVERIFY(opened.light_bar().isEmpty());
    opened.window->open(opened.path);
    QVERIFY(wait_for([&] { return !opened.light_bar().isEmpty(); }));
  }

  /// The solve would end with B = 0 everywhere: "good enough: error at most 0 %".
  void a_solve_without_light_is_refused_and_a_light_or_a_sky_is_offered() {
    const Opened opened;
    QVERIFY(opened.ready);
    QCOMPARE(opened.part<QLabel>("phase")->text(), QString("No light: not solved"));
    QCOMPARE(opened.part<QLabel>("summary_closure")->text(), QString("–"));
    for (const char* command : {"run", "one_direction", "one_iteration"}) {
      opened.part<QAction>(command)->trigger();
      QVERIFY2(opened.light_bar().startsWith("Not solved: nothing emits light, so B would be 0"),
               command);
    }
    emit opened.window->views().page.light_bar()->closed();
    opened.window->selection.select(3);
    QVERIFY(opened.light_bar().isEmpty());
    const auto before = opened.window->snapshot();
    QSignalSpy states(&opened.window->runner, &SolveRunner::state_changed);
    opened.part<QLineEdit>("accuracy")->setText("5");
    opened.part<QPushButton>("restart")->click();
    QVERIFY2(opened.light_bar().startsWith("Not solved"), qPrintable(opened.light_bar()));
    QVERIFY(opened.window->banner_text().isEmpty());  // no failure
    QCOMPARE(opened.offers()[0]->text(), QString("Face 3"));
    save_picture(*opened.window, "not-solved");
    // The room is closed: no sky would light it.
    QVERIFY(!opened.part<QPushButton>("make_sky")->isEnabled());
    QVERIFY(!opened.light_bar().contains("sky"));
    QVERIFY(states.isEmpty());
    QVERIFY(opened.window->snapshot() == before);

    opened.offers()[0]->trigger();
    QVERIFY(opened.is_relit());
    opened.part<QPushButton>("restart")->click();
    QVERIFY(wait_for([&] { return opened.scene().has_light(); }));
    QVERIFY(opened.settles());
    QVERIFY(opened.light_bar().isEmpty());
  }

  /// An accuracy of B = 0 would be reached after the fewest directions.
  void the_form_factors_of_a_made_lamp_have_the_usual_directions() {
    Opened opened;
    QVERIFY(opened.ready);
    SolveRunner runner;
    std::shared_ptr<const SolverSnapshot> newest;
    connect(&runner, &SolveRunner::snapshot_ready, &runner,
            [&](auto snapshot) { newest = std::move(snapshot); });
    SolveOptions options;
    options.goal.accuracy = 0.05;
    runner.include_form_factors();
    runner.open({opened.path.toStdString(),
                 {.solve = options, .total = true},
                 {.kind = Goal::Kind::finished}});
    const auto rests_at = [&](std::int64_t passes) {
      return wait_for([&] {
        return newest && newest->passes_done == passes && runner.state() == RunState::paused;
      });
    };
    QVERIFY(rests_at(0));
    runner.set_goal({.kind = Goal::Kind::direction, .without_light = true});
    QVERIFY(rests_at(1));
    runner.set_goal({.kind = Goal::Kind::finished, .without_light = true});
    QVERIFY(wait_for([&] { return newest->progress.finished && newest->form_factors; }));
    QCOMPARE(newest->kept_passes.front(), options.directions);
    QCOMPARE(newest->options.goal.accuracy, options.goal.accuracy);
    QVERIFY(newest->total && newest->total->stages.empty());
  }

  void a_study_without_light_is_refused() {
    const Opened opened;
    QVERIFY(opened.ready);
    QUndoStack undo;
    const MaterialEdits edits(undo);
    StudyDialog dialog({}, edits);
    dialog.show_scene(opened.window->snapshot()->loaded);
    auto* run = dialog.findChild<QPushButton*>("study_run");
    run->click();
    QVERIFY(dialog.findChild<Banner*>()->text().startsWith("Not started"));
    QCOMPARE(run->text(), QString("Run the study"));
  }

  void an_open_scene_without_light_is_solved_once_it_has_a_sky() {
    const Opened opened(false, {}, true);
    QVERIFY(opened.ready);
    QVERIFY(opened.light_bar().contains("set a sky"));
    opened.part<QPushButton>("restart")->click();
    QVERIFY(opened.light_bar().startsWith("Not solved"));
    opened.part<QPushButton>("make_sky")->click();
    auto* sky = opened.part<QDoubleSpinBox>("sky");
    QVERIFY(sky->isVisible());
    save_picture(*opened.window, "sky-offered");
    sky->setValue(10);
    const auto before = opened.window->snapshot();
    opened.part<QPushButton>("restart")->click();
    QVERIFY(wait_for([&] { return opened.window->snapshot() != before; }));
    QVERIFY(opened.settles());
    QVERIFY2(opened.light_bar().isEmpty(), qPrintable(opened.light_bar()));
    QVERIFY(largest(opened.window->snapshot()->radiosity) > 0);
    const QString closure = opened.part<QLabel>("summary_closure")->text();
    QVERIFY2(closure.startsWith("open: ") && closure.endsWith("% of the light escapes"),
             qPrintable(closure));
  }

  /// The outer sides of its faces see nothing.
  void a_closed_scene_of_two_sided_faces_has_no_defect() {
    const auto window = make_window(8);
    window->scene.open("furnace", {.solve = {.directions = 8}, .scene = {.two_sided = true}},
                       {Goal::Kind::finished});
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    QCOMPARE(window->findChild<QLabel*>("summary_closure")->text(),
             QString("closed, outer sides of two-sided faces omitted"));
  }

  void sliders_change_a_material_a_group_or_a_face() {
    const Opened opened;
    QVERIFY(opened.ready);
    auto* kind = opened.part<QComboBox>("material_kind");
    auto* slider = opened.part<QSlider>("rho_red");
    const auto choose = [&](const char* name) {
      kind->setCurrentText(name);
      emit kind->activated(kind->currentIndex());
    };
    opened.window->selection.select(7);
    choose("Face");
    slider->setValue(slider->maximum());
    QCOMPARE(opened.edits().changes().size(), std::size_t{1});
    QCOMPARE(opened.edits().changes()[0].target, std::string("face:7"));
    QVERIFY(!opened.edits().changes()[0].exitance);
    choose("Group");
    QVERIFY(opened.part<QLabel>("material_extent")->text().contains("differ"));
    slider->setValue(0);
    // The face keeps its own value.
    QVERIFY(opened.edits().materials()->of(7).reflectance.r > 0.9);
    QCOMPARE(opened.edits().materials()->of(8).reflectance.r, 0.0);
    QVERIFY(opened.edits().materials()->of(0).reflectance == opened.scene().reflectance(0));
    choose("Material");
    QCOMPARE(opened.part<QComboBox>("material")->currentText(), QString("gray"));
    opened.part<QPushButton>("restore_materials")->click();
    QVERIFY(!opened.edits().any());
    for (const std::size_t left : {2U, 1U, 0U}) {
      opened.part<QAction>("undo")->trigger();
      QCOMPARE(opened.edits().changes().size(), left);
    }
  }

  void the_saved_scene_has_the_changes() {
    const Opened opened;
    QVERIFY(opened.ready);
    opened.edits().set_exitance("face:5", {10, 20, 30});
    opened.edits().set_reflectance("group:box", {0.25, 0.5, 0.75});
    auto& exports = *opened.window->findChild<ExportActions*>();
    const QString path = opened.folder.filePath("lit.obj");
    exports.write_scene_file(path);
    QVERIFY(wait_for([&] { return !exports.writing(); }));
    QVERIFY(opened.window->banner_text().isEmpty());
    const auto saved = load_scene(path.toStdString());
    QCOMPARE(saved->patch_count(), opened.scene().patch_count());
    for (PatchId i = 0; i < saved->patch_count(); ++i) {
      const Material& expected = opened.edits().materials()->of(i);
      QVERIFY(saved->exitance(i) == expected.exitance);
      QVERIFY(saved->reflectance(i) == expected.reflectance);
      QVERIFY(saved->patch(i).normal == opened.scene().patch(i).normal);
    }
    // The scene's own files are not overwritten.
    QVERIFY_EXCEPTION_THROWN(exports.write_scene_file(opened.path), InputError);
  }

  void changes_survive_another_patch_area_and_a_reload() {
    const Opened opened;
    QVERIFY(opened.ready);
    opened.edits().set_exitance("face:5", {10, 20, 30});
    opened.part<QLineEdit>("max_patch_area")->setText("4");
    opened.part<QPushButton>("restart")->click();
    QVERIFY(wait_for([&] { return opened.window->snapshot()->loaded->scene->patch_count() > 12; }));
    QVERIFY(opened.settles());
    for (PatchId i = 0; i < opened.scene().patch_count(); ++i) {
      QCOMPARE(max_abs(material_of(*opened.window->snapshot(), i).exitance) > 0,
               opened.scene().patch(i).face == 5);
    }
  }

  /// The solve used the materials of the file: B = 0 everywhere, "good enough: error at most 0 %".
  void a_lamp_made_here_is_solved() {
    const Opened opened;
    QVERIFY(opened.ready);
    QCOMPARE(largest(opened.window->snapshot()->radiosity), 0.0);
    opened.edits().set_exitance("face:5", {10, 20, 30});
    QVERIFY(opened.is_relit());
    opened.part<QLineEdit>("accuracy")->setText("5");
    opened.part<QPushButton>("restart")->click();
    QVERIFY(wait_for([&] { return opened.scene().has_light(); }));
    QVERIFY(opened.settles());
    const SolverSnapshot& snapshot = *opened.window->snapshot();
    QVERIFY(!snapshot.materials);
    QVERIFY(largest(snapshot.radiosity) >= 30);
    QVERIFY(snapshot.error.rms_limit > 0);
    QVERIFY(opened.edits().changes().empty());
  }

  void faces_are_turned_after_a_preview() {
    const Opened opened(true);
    QVERIFY(opened.ready);
    QVERIFY2(opened.orientation_bar().contains("%"), qPrintable(opened.orientation_bar()));
    const Vec3 before = opened.scene().patch(8).normal;
    auto* preview = opened.part<QPushButton>("preview_turn");
    auto* turn = opened.part<QPushButton>("turn_faces");
    auto* cancel = opened.part<QPushButton>("cancel_turn");
    const SceneView& view = *opened.window->findChild<SceneView*>();
    save_picture(*opened.window, "turned");
    const auto begin = [&] {
      if (!preview->isVisible()) {  // the bar about the missing light is in front
        opened.window->views().page.light_bar()->findChild<QPushButton*>("next_message")->click();
      }
      preview->click();
      return wait_for([&] { return turn->isVisible(); });
    };
    QVERIFY(begin());
    QVERIFY(view.shows_preview());
    QVERIFY2(opened.orientation_bar().contains("6 of 12 faces"),
             qPrintable(opened.orientation_bar()));
    save_picture(*opened.window, "turn-preview");
    cancel->click();
    QVERIFY(!view.shows_preview() && preview->isVisible() && !turn->isVisible());
    QVERIFY(opened.scene().patch(8).normal == before);

    QVERIFY(begin());
    const auto old = opened.window->snapshot()->loaded;
    turn->click();
    QVERIFY(wait_for([&] { return opened.window->snapshot()->loaded != old; }));
    QVERIFY(opened.settles());
    QVERIFY(opened.scene().patch(8).normal == -1.0 * before);
    QVERIFY(opened.orientation_bar().isEmpty());
    QVERIFY(!view.shows_preview());
    save_picture(*opened.window, "turned-back");
    // Sessions keep the change.
    const QString session = opened.folder.filePath("s.json");
    opened.window->files().save_session(session);
    const auto other = make_window(16);
    other->files().open(session);
    QVERIFY(wait_for([&] { return other->snapshot() && other->settled(); }));
    QVERIFY(other->snapshot()->loaded->scene->patch(8).normal == -1.0 * before);
  }

  /// Two cubes cross; a third one is inside the first.
  void solids_are_united_after_a_preview() {
    const QTemporaryDir folder;
    write_file(folder.filePath("none.mtl"),
               "newmtl gray\nKd .4 .4 .4\n"
               "newmtl lit\nKd .4 .4 .4\nKe 1 1 1\n");
    const QString path = folder.filePath("cubes.obj");
    write_file(path, "mtllib none.mtl\nusemtl gray\n" + cube(0, 2) + "usemtl lit\n" + cube(1, 3) +
                         "usemtl gray\n" + cube(0.5, 0.8));
    const auto window = make_window(16);
    window->open(path);
    const auto text = [&] { return window->views().page.solids_bar()->text(); };
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled() && !text().isEmpty(); }));
    QVERIFY2(text().startsWith("13 %"), qPrintable(text()));
    const auto button = [&](const char* name) { return window->findChild<QPushButton*>(name); };
    const SceneView& view = *window->findChild<SceneView*>();
    const auto begin = [&] {
      // Other bars may be in front.
      for (int bar = 0; bar < 4 && !button("preview_union")->isVisible(); ++bar) {
        for (auto* next : window->findChildren<QPushButton*>("next_message")) {
          if (next->isVisible()) {
            next->click();
            break;
          }
        }
      }
      button("preview_union")->click();
      return wait_for([&] { return button("unite_solids")->isVisible(); });
    };
    QVERIFY(begin());
    QVERIFY(view.shows_preview());
    QVERIFY2(text().contains("6 faces would go") && text().contains("6 would be cut"),
             qPrintable(text()));
    save_picture(*window, "union-preview");
    button("cancel_union")->click();
    QVERIFY(!view.shows_preview() && button("preview_union")->isVisible());

    QVERIFY(begin());
    const auto old = window->snapshot()->loaded;
    button("unite_solids")->click();
    QVERIFY(wait_for([&] { return window->snapshot()->loaded != old && window->settled(); }));
    double area = 0;
    for (const Patch& patch : window->snapshot()->loaded->scene->patches()) {
      area += patch.area;
    }
    QVERIFY2(std::abs(area - 42) < 1e-9, qPrintable(QString::number(area)));
    QVERIFY(text().isEmpty() && !view.shows_preview());
    QVERIFY(window->scene.input().unite_solids);
  }

  void a_scene_in_order_has_no_bars() {
    const SolvedWindow solved("cornell-box");
    QVERIFY(solved.ready);
    QVERIFY(solved.window->views().page.light_bar()->text().isEmpty());
    QVERIFY(solved.window->views().page.orientation_bar()->text().isEmpty());
  }
};

const test::Registered registered("light", test::run_as_viewer<LightTest>);

}  // namespace transillum::viewer::light_test

#include "light_test.moc"
