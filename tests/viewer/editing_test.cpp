// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Faces that are moved, copied, removed and added in the window, by typed numbers, the handles in
// the scene and the keyboard alone. Oracles: the library's solve of the saved scene, to the bit,
// and the solve before an edit that is undone.
#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QDoubleSpinBox>
#include <QMessageBox>
#include <QSignalSpy>
#include <QTemporaryDir>

#include "film_frames.h"
#include "solved_window.h"
#include "transillum/at.h"
#include "transillum/solve_session.h"
#include "window/base/dock_layouts.h"
#include "window/editing/move_handles.h"
#include "window/editing/move_panel.h"
#include "window/editing/scene_edits.h"
#include "window/files/export_actions.h"
#include "window/files/frame_recorder.h"

namespace transillum::viewer::editing_test {

using namespace test;

namespace {

const SolveOptions few{.directions = 32, .first_shot = {}};

/// A solved scene whose panel "Move" is shown, with an object of few faces as its target.
struct Edited {
  QTemporaryDir folder;
  std::unique_ptr<TestWindow> window = make_window(few);
  SceneEdits* edits = window->findChild<SceneEdits*>();
  QWidget* canvas = window->findChild<SceneView*>()->canvas();
  bool ready = false;

  explicit Edited(const QString& scene = "cornell-box") {
    window->open(scene);
    if (!solved()) {
      return;
    }
    window->views().docks.bring_to_front("move");
    window->activateWindow();
    (void)QTest::qWaitForWindowActive(window.get());
    ready = wait_for([this] { return edits->active(); }) && select_a_box() && at_rest();
  }

  bool solved() const {
    return wait_for([this] { return window->snapshot() && window->snapshot()->progress.finished; });
  }
  bool at_rest() const { return comes_to_rest(*window) && solved(); }
  /// Selects a patch of an object that is not the room.
  bool select_a_box() const {
    const LoadedScene& loaded = *window->scene.loaded();
    for (PatchId i = 0; i < loaded.scene->patch_count(); ++i) {
      const FaceList object = faces_of_object(*loaded.description, loaded.scene->patch(i).face);
      if (object.size() > 1 && object.size() < 7) {
        window->selection.select(i);
        return edits->face_count() == object.size();
      }
    }
    return false;
  }
  std::vector<Rgb> light() const { return window->snapshot()->radiosity; }
  /// The light of the saved scene, by the library.
  std::vector<Rgb> light_of_file() const {
    const QString path = folder.filePath("saved.obj");
    window->findChild<ExportActions*>()->write_scene_file(path);
    const auto scene = load_scene(path.toStdString(), window->scene.options());
    return solve(scene, window->snapshot()->options).radiosity;
  }
  void key(int key, Qt::KeyboardModifiers modifiers = {}) const {
    QTest::keyClick(canvas, static_cast<Qt::Key>(key), modifiers);
  }
  void trigger(const char* action) const { window->findChild<QAction*>(action)->trigger(); }
  QDoubleSpinBox* field(const char* name) const { return window->findChild<QDoubleSpinBox*>(name); }
  void type(const char* name, double value) const {
    QDoubleSpinBox* box = field(name);
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, QString::number(value));
    QTest::keyClick(box, Qt::Key_Return);
  }
  std::optional<MoveHandles::Handle> handle(MoveHandles::Kind kind, int axis) const {
    for (const auto& handle : window->findChild<MoveHandles*>()->handles()) {
      if (handle.kind == kind && handle.axis == axis) {
        return handle;
      }
    }
    return std::nullopt;
  }
};

/// The areas of the polygons of a map.
std::vector<double> areas_of(const MapRecord& record) {
  std::vector<double> areas;
  for (const MapRecord::Row& row : record.rows) {
    areas.push_back(record.area(row));
  }
  return areas;
}

}  // namespace

class EditingTest : public QObject {
  Q_OBJECT

 private slots:
  void typed_numbers_move_an_object_as_its_file_has_it() {
    const Edited e;
    QVERIFY(e.ready);
    const std::vector<Rgb> before = e.light();
    const double x = e.edits->center().x;
    e.type("move_center_x", x + 0.05);
    QVERIFY(std::abs(e.edits->placement().move.x - 0.05) < 1e-3);
    e.type("move_turn_y", 12);
    e.type("move_scale_z", 1.2);
    QVERIFY(e.at_rest());
    QVERIFY(e.light() != before);
    QVERIFY(e.window->scene.has_unsaved_faces());
    QVERIFY(e.light() == e.light_of_file());
    QVERIFY(!e.window->scene.has_unsaved_faces());
    while (e.window->undo.canUndo()) {
      e.window->undo.undo();
    }
    QVERIFY(e.at_rest());
    QVERIFY(e.light() == before);
    QCOMPARE(e.window->scene.spec(), std::string("cornell-box"));
  }

  void a_handle_moves_along_its_axis() {
    const Edited e;
    QVERIFY(e.ready);
    const std::vector<Rgb> before = e.light();
    const auto arrow = e.handle(MoveHandles::Kind::move, 0);
    QVERIFY(arrow);
    const QPointF end = arrow->shape.back(), begin = arrow->shape.front();
    const QSignalSpy shown(e.edits, &SceneEdits::moved);
    drag(*e.canvas, (0.3 * begin + 0.7 * end).toPoint(), (0.8 * (end - begin)).toPoint(), 8);
    const Vec3 move = e.edits->placement().move;
    QVERIFY(std::abs(move.x) > 0.01);
    QVERIFY(move.y == 0 && move.z == 0);
    QVERIFY(e.at_rest());
    QVERIFY(shown.count() > 0);
    QVERIFY(e.light() != before);
    QVERIFY(e.light() == e.light_of_file());
    QCOMPARE(e.window->undo.count(), 1);
    e.window->undo.undo();
    QVERIFY(e.at_rest());
    QVERIFY(e.light() == before);
  }

  void the_plate_of_a_patch_does_not_cover_a_handle() {
    const Edited e;
    QVERIFY(e.ready);
    const auto* plate = e.canvas->findChild<QWidget*>("pointer_label");
    const auto move_to = [&](const QPointF& place) {
      QMouseEvent move(QEvent::MouseMove, place, e.canvas->mapToGlobal(place.toPoint()),
                       Qt::NoButton, Qt::NoButton, Qt::NoModifier);
      QCoreApplication::sendEvent(e.canvas, &move);
    };
    const QPointF tip = e.handle(MoveHandles::Kind::move, 0)->shape.back();
    move_to(tip + QPointF(0, 60));
    QVERIFY(plate->isVisible());
    move_to(tip);
    QVERIFY(!plate->isVisible());
  }

  void handles_slide_turn_and_scale() {
    const Edited e;
    QVERIFY(e.ready);
    const auto drag_by = [&](MoveHandles::Kind kind, int axis, const QPointF& by) {
      const auto found = e.handle(kind, axis);
      const QPointF middle = kind == MoveHandles::Kind::slide
                                 ? found->shape.boundingRect().center()
                                 : found->shape[found->shape.size() / 2];
      drag(*e.canvas, middle.toPoint(), by.toPoint());
    };
    drag_by(MoveHandles::Kind::slide, 1, {12, 4});
    QVERIFY(e.edits->placement().move.y == 0 && e.edits->placement().move.x != 0);
    QVERIFY(e.at_rest());
    drag_by(MoveHandles::Kind::turn, 2, {-10, 12});
    QVERIFY(e.edits->placement().turn.z != 0);
    QVERIFY(e.at_rest());
    const auto knob = e.handle(MoveHandles::Kind::scale, 1);
    const auto arrow = e.handle(MoveHandles::Kind::move, 1);
    drag_by(MoveHandles::Kind::scale, 1, 0.3 * (knob->shape.back() - arrow->shape.front()));
    QVERIFY(e.edits->placement().scale.y > 1.1);
    QVERIFY(e.at_rest());
    QVERIFY(e.light() == e.light_of_file());
  }

  void the_keyboard_alone_moves_and_undoes() {
    const Edited e;
    QVERIFY(e.ready);
    const std::vector<Rgb> before = e.light();
    const double step = e.window->findChild<MovePanel*>()->step();
    e.canvas->setFocus();
    e.key(Qt::Key_Right);
    e.key(Qt::Key_Right);
    e.key(Qt::Key_PageUp);
    const FacePlacement moved = e.edits->placement();
    QVERIFY(std::abs(norm(moved.move) - std::sqrt(5.0) * step) < 1e-12);
    e.key(Qt::Key_Right, Qt::ShiftModifier);
    QVERIFY(!(e.edits->placement().turn == Vec3{}));
    e.key(Qt::Key_Plus);
    QCOMPARE(e.edits->placement().scale.x, 1.1);
    QVERIFY(e.at_rest());
    const std::vector<Rgb> after = e.light();
    QVERIFY(after != before);
    QCOMPARE(e.window->undo.count(), 1);
    QTest::keyClick(e.window.get(), Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(e.at_rest());
    QVERIFY(e.light() == before);
    QTest::keyClick(e.window.get(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QVERIFY(e.at_rest());
    QVERIFY(e.light() == after);
  }

  void the_map_of_the_direction_follows() {
    const Edited e;
    QVERIFY(e.ready);
    Focus& focus = e.window->focus;
    focus.go_to_direction(0, 3);
    QVERIFY(e.at_rest());
    const auto before = focus.map();
    e.edits->place({{0.05, 0.02, 0}});
    QVERIFY(wait_for([&] { return focus.map() != before; }));
    const LoadedScene& shown = *focus.map()->loaded;
    QVERIFY(shown.description != e.window->scene.loaded()->description);
    const Scene fresh(*shown.description, shown.scene->options());
    const MapRecord record =
        record_local_map(fresh, BspTree(fresh), before->record().frame.omega).record;
    const auto shows_whole = [&] {
      return !focus.at_step() && focus.position().step == focus.map()->record().step_count() - 1;
    };
    QVERIFY(shows_whole());
    QVERIFY(areas_of(focus.map()->record()) == areas_of(record));
    QVERIFY(areas_of(before->record()) != areas_of(record));
    QVERIFY(e.at_rest());
    QVERIFY(shows_whole());
    QCOMPARE(focus.position().direction, 3);
    QVERIFY(areas_of(focus.map()->record()) == areas_of(record));
  }

  void escape_brings_the_scene_back_during_a_drag() {
    const Edited e;
    QVERIFY(e.ready);
    const std::vector<Rgb> before = e.light();
    const auto arrow = e.handle(MoveHandles::Kind::move, 0);
    const QPoint end = arrow->shape.back().toPoint();
    QTest::mousePress(e.canvas, Qt::LeftButton, {}, end);
    QMouseEvent move(QEvent::MouseMove, end + QPoint(30, 10),
                     e.canvas->mapToGlobal(end + QPoint(30, 10)), Qt::LeftButton, Qt::LeftButton,
                     Qt::NoModifier);
    QCoreApplication::sendEvent(e.canvas, &move);
    QVERIFY(!(e.edits->placement() == FacePlacement{}));
    e.key(Qt::Key_Escape);
    QVERIFY(e.edits->placement() == FacePlacement{});
    QTest::mouseRelease(e.canvas, Qt::LeftButton, {}, end);
    QVERIFY(e.at_rest());
    QVERIFY(e.light() == before);
    QVERIFY(e.window->scene.loaded() == e.window->findChild<SceneView*>()->loaded());
    QVERIFY(!e.window->scene.has_unsaved_faces());
  }

  void copies_and_new_faces_come_last() {
    const Edited e;
    QVERIFY(e.ready);
    const std::vector<Rgb> before = e.light();
    const auto faces = [&] { return e.window->scene.loaded()->description->face_count(); };
    const std::size_t at_first = faces(), of_box = e.edits->face_count();
    e.trigger("copy_faces");
    QVERIFY(e.at_rest());
    QCOMPARE(faces(), at_first + of_box);
    QVERIFY(e.light() == e.light_of_file());
    e.trigger("add_lamp");
    QVERIFY(e.at_rest());
    QCOMPARE(faces(), at_first + of_box + 1);
    QCOMPARE(e.edits->face_count(), std::size_t{1});
    e.trigger("remove_faces");
    QVERIFY(e.at_rest());
    QCOMPARE(faces(), at_first + of_box);
    for (const char* name : {"add_box", "add_board", "add_room"}) {
      e.trigger(name);
      QVERIFY(e.at_rest());
    }
    QCOMPARE(faces(), at_first + of_box + 13);
    QVERIFY(e.light() == e.light_of_file());
    while (e.window->undo.canUndo()) {
      e.window->undo.undo();
    }
    QVERIFY(e.at_rest());
    QVERIFY(e.light() == before);
  }

  void a_command_names_the_saved_scene() {
    const Edited e;
    QVERIFY(e.ready);
    e.edits->place({{0.03, 0, 0}});
    e.edits->finish();
    QVERIFY(e.at_rest());
    QApplication::clipboard()->setText("nothing");
    bool asked = false;
    QTimer::singleShot(0, e.window.get(), [&] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      asked = box && box->objectName() == "unsaved_faces";
      if (box) {
        box->reject();
      }
    });
    e.trigger("copy_solve");
    QVERIFY(asked);
    QCOMPARE(QApplication::clipboard()->text(), QString("nothing"));
    (void)e.light_of_file();
    e.trigger("copy_solve");
    QVERIFY(QApplication::clipboard()->text().startsWith("transillum solve " +
                                                         e.folder.filePath("saved.obj")));
  }

  void edits_that_no_file_has_are_not_lost_unasked() {
    const Edited e;
    QVERIFY(e.ready);
    const WorkGuard& guard = e.window->work_guard();
    const auto asks = [&](WorkGuard::Lost lost) {
      bool asked = false;
      QTimer::singleShot(0, e.window.get(), [&] {
        if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
          asked = true;
          box->reject();
        }
      });
      return guard.may_lose(e.window.get(), "Open", lost) != asked && asked;
    };
    QVERIFY(!asks(WorkGuard::Lost::scene));
    e.edits->place({{0.03, 0, 0}});
    e.edits->finish();
    QVERIFY(e.at_rest());
    QVERIFY(asks(WorkGuard::Lost::scene));
    QVERIFY(!asks(WorkGuard::Lost::solve));
    (void)e.light_of_file();
    QVERIFY(!asks(WorkGuard::Lost::scene));
  }

  // In the window, as in the library: crossing and coinciding faces stop nothing.
  void a_box_is_dragged_through_a_wall() {
    const Edited e;
    QVERIFY(e.ready);
    const QSignalSpy failures(e.edits, &SceneEdits::failed);
    QSignalSpy shown(e.edits, &SceneEdits::moved);
    for (int k = 1; k <= 8; ++k) {
      e.edits->place({{0.1 * k, 0, 0}});
      QVERIFY(shown.wait(60000));
    }
    e.edits->finish();
    QVERIFY(e.at_rest());
    QCOMPARE(failures.count(), 0);
    QVERIFY(e.light() == e.light_of_file());
  }

  void a_film_shows_the_last_move() {
    const Edited e;
    QVERIFY(e.ready);
    FrameRecorder& recorder = *e.window->findChild<FrameRecorder*>();
    const QString path = e.folder.filePath("move.mp4");
    const FilmPlan plan{FilmPlan::Show::scene, FilmPlan::Over::move, {480, 360}, 0.5};
    recorder.begin_film(path, plan);
    QVERIFY(!recorder.writing());  // nothing was moved
    auto* view = e.window->findChild<SceneView*>();
    const QImage unmoved = view->picture({.size = plan.size});
    e.edits->place({{-0.1, 0.1, 0.1}, {0, 30, 0}});
    QVERIFY(e.at_rest());
    const QImage moved = view->picture({.size = plan.size});
    const auto solved = e.window->snapshot();
    const FacePlacement placement = e.edits->placement();
    recorder.begin_film(path, plan);
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    const std::vector<QImage> film = decoded_film(path).frames;
    QCOMPARE(static_cast<int>(film.size()), 5);
    if (const QString pictures = qEnvironmentVariable("TRANSILLUM_PICTURES"); !pictures.isEmpty()) {
      film.front().save(pictures + "/move-0.png");
      film[2].save(pictures + "/move-2.png");
      film.back().save(pictures + "/move-4.png");
    }
    // The light of a draft differs from the light of the solve.
    QVERIFY(mean_difference(film.front(), unmoved) < mean_difference(film.front(), moved));
    QVERIFY(mean_difference(film.back(), moved) < mean_difference(film.back(), unmoved));
    QVERIFY(mean_difference(film.front(), film.back()) > 1);
    QVERIFY(e.window->snapshot() == solved && e.edits->placement() == placement);
    QVERIFY(e.at_rest() && e.window->snapshot() == solved);
    QCOMPARE(different_pixels(view->picture({.size = plan.size}), moved), 0);
    // A further move ends a film.
    recorder.begin_film(path, plan);
    QVERIFY(wait_for([&] { return recorder.frames() >= 2; }));
    e.edits->place({{0.08, 0, 0}});
    QVERIFY(!recorder.writing() && e.window->banner_text().contains("The faces were moved"));
    QVERIFY(e.at_rest() && e.window->snapshot() != solved);
  }

  void solving_again_keeps_the_edited_faces() {
    const Edited e;
    QVERIFY(e.ready);
    e.edits->place({{0.03, 0, 0}});
    e.edits->finish();
    QVERIFY(e.at_rest());
    e.window->set_options(few, {.max_patch_area = 0.05});
    const auto moved = e.window->scene.loaded()->description;
    QTest::mouseClick(e.window->findChild<QAbstractButton*>("restart"), Qt::LeftButton);
    QVERIFY(wait_for([&] { return e.window->scene.options().max_patch_area == 0.05; }));
    QVERIFY(e.at_rest());
    QVERIFY(e.window->scene.loaded()->description->points == moved->points);
    QVERIFY(e.light() == e.light_of_file());
  }
};

const Registered registered("editing", &run_as_viewer<EditingTest>);

}  // namespace transillum::viewer::editing_test

#include "editing_test.moc"
