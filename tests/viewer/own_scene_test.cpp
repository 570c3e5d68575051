// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// How a file looks that is opened for the first time: divided faces, and its vertical.
#include <QAction>
#include <QComboBox>
#include <QPushButton>
#include <QTemporaryDir>

#include "model/command_text.h"
#include "scene/start_page.h"
#include "solved_window.h"
#include "state/vertical.h"
#include "test_files.h"
#include "transillum/files.h"
#include "widgets/banner.h"
#include "window/files/thumbnails.h"

namespace transillum::viewer::own_scene_test {

using namespace test;

namespace {

/// A room of 6 x 5 x 3 m seen from inside, with a lamp below the ceiling.
/// @param z_up  else y is up
QString room(bool z_up) {
  QString text = QStringLiteral("mtllib room.mtl\nusemtl white\n");
  const auto point = [&](double x, double depth, double height) {
    text += z_up ? QStringLiteral("v %1 %2 %3\n").arg(x).arg(depth).arg(height)
                 : QStringLiteral("v %1 %2 %3\n").arg(x).arg(height).arg(-depth);
  };
  for (const double height : {0.0, 3.0}) {
    point(0, 0, height);
    point(6, 0, height);
    point(6, 5, height);
    point(0, 5, height);
  }
  for (const double x : {2.5, 3.5}) {
    for (const double depth : {2.0, 3.0}) {
      point(x, x < 3 ? depth : 5 - depth, 2.9);
    }
  }
  return text + QStringLiteral(
                    "g floor\nf 1 2 3 4\ng ceiling\nf 8 7 6 5\ng walls\nf 2 1 5 6\nf 3 2 6 7\n"
                    "f 4 3 7 8\nf 1 4 8 5\ng lamp\nusemtl lamp\nf 9 10 11 12\n");
}

struct OwnScene {
  QTemporaryDir folder;
  std::unique_ptr<TestWindow> window;

  explicit OwnScene(bool z_up = false, bool divides = false) {
    write_file(folder.filePath("room.mtl"),
               "newmtl white\nKd 0.7 0.7 0.7\nnewmtl lamp\nKd 0 0 0\nKe 20 20 20\n");
    const QString file = write_file(folder.filePath("room.obj"), room(z_up).toLatin1());
    window = make_window(16);
    window->files().set_divides(divides);
    window->files().try_open(file);
  }
  bool ready() const {
    return wait_for([this] { return window->snapshot() && window->settled(); });
  }
  template <class Kind>
  Kind* part(const char* name) const {
    return window->findChild<Kind*>(QLatin1String(name));
  }
};

}  // namespace

class OwnSceneTest : public QObject {
  Q_OBJECT

 private slots:
  void few_faces_are_divided_until_the_user_keeps_them() {
    const OwnScene own(false, true);
    QVERIFY(own.ready());
    const auto divided = own.window->snapshot();
    QVERIFY(divided->options.basis == Basis::linear);
    const PatchId patches = divided->loaded->scene->patch_count();
    QVERIFY2(patches > 1000 && patches < 4000, qPrintable(QString::number(patches)));
    QVERIFY(!own.window->views().settings.differ_from_effect());
    auto* bar = own.part<Banner>("division_bar");
    QVERIFY(bar->isVisible());
    QVERIFY2(bar->text().startsWith("7 faces"), qPrintable(bar->text()));
    save_picture(*own.window, "own-scene");
    // The copied command has all of it.
    const std::string line = solve_command("room.obj", own.window->views().settings.options(), {});
    QVERIFY2(line.find("--basis linear") != std::string::npos &&
                 line.find("--max-patch-area") != std::string::npos,
             line.c_str());

    own.part<QPushButton>("keep_faces")->click();
    QVERIFY(wait_for([&] {
      const auto now = own.window->snapshot();
      return now && now->loaded->scene->patch_count() == 7 && own.window->settled();
    }));
    QVERIFY(own.window->snapshot()->options.basis == Basis::constant);
    QVERIFY(!bar->isVisible());
  }

  // The first page shows it beside the name of the file.
  void a_file_that_was_open_has_a_picture() {
    const QTemporaryDir pictures;
    const OwnScene own;
    bool in_lesson = true;
    const Thumbnails thumbnails(own.window->frame(), pictures.filePath("small"),
                                [&in_lesson] { return in_lesson; });
    const QString file = own.folder.filePath("room.obj");
    QVERIFY(own.ready() && comes_to_rest(*own.window));
    QVERIFY(thumbnails.picture_of(file).isNull());
    in_lesson = false;
    own.window->files().open_scene("furnace");  // the room is left
    QVERIFY(own.ready() && comes_to_rest(*own.window));
    const QImage picture = thumbnails.picture_of(file).toImage();
    QVERIFY(picture.width() >= 150 && picture.height() >= 100);
    QVERIFY(color_count(picture) > 3);
    QVERIFY(thumbnails.picture_of(own.folder.filePath("other.obj")).isNull());

    StartPage& start = *own.window->views().page.start();
    own.window->findChild<QAction*>("start")->trigger();
    start.set_recent({{file, thumbnails.picture_of(file)}});
    auto* card = start.findChild<QAbstractButton*>("recent_room.obj");
    QVERIFY(card && wait_for([card] { return card->isVisible(); }));
    save_picture(*own.window, "recent");
    QTest::mouseClick(card, Qt::LeftButton);
    QVERIFY(own.ready());
    QVERIFY(wait_for([&] { return own.window->windowTitle().startsWith("room.obj"); }));
  }

  void a_limit_of_the_user_is_kept() {
    const OwnScene own;
    QVERIFY(own.ready());
    QCOMPARE(own.window->snapshot()->loaded->scene->patch_count(), PatchId{7});
    own.window->files().set_divides(true);
    own.window->files().open_scene("boards");
    QVERIFY(wait_for([&] {
      return own.window->windowTitle().startsWith("boards") && own.window->snapshot() &&
             own.window->settled();
    }));
    QCOMPARE(own.window->snapshot()->loaded->scene->patch_count(),
             load_scene("boards")->patch_count());
  }

  void a_room_stands_whatever_its_vertical() {
    for (const bool z_up : {false, true}) {
      const OwnScene own(z_up);
      QVERIFY(own.ready());
      const Vec3 up = z_up ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
      QVERIFY(own.window->vertical.up() == up);
      const ViewPoint view = own.window->findChild<SceneView*>()->view_point();
      QVERIFY(dot(view.up, up) > 0.99);
      QVERIFY(dot(view.eye - view.target, up) > 0);
      QCOMPARE(own.part<QComboBox>("sky_up")->currentText(), QString(z_up ? "+z" : "+y"));
      QCOMPARE(own.part<Banner>("vertical_bar")->isVisible(), z_up);
    }
  }

  // A bust has no level surfaces, so that it may lie on its side at first.
  void a_model_without_level_surfaces_is_turned_by_one_button() {
    const OwnScene own;
    QVERIFY(own.ready());
    own.window->files().try_open(write_file(own.folder.filePath("bust.obj"),
                                            "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 2\n"
                                            "v 0 0 -2\nf 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\n"
                                            "f 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n"));
    QVERIFY(wait_for(
        [&] { return own.window->windowTitle().startsWith("bust.obj") && own.window->settled(); }));
    const auto* bar = own.part<Banner>("vertical_bar");
    QVERIFY2(bar->text().startsWith("Shown with +y up"), qPrintable(bar->text()));
    const auto* view = own.window->findChild<SceneView*>();
    QVERIFY(view->view_point().up == (Vec3{0, 1, 0}));
    auto* turn = own.part<QPushButton>("turn_upright");
    QCOMPARE(turn->text(), QString("Turn upright"));
    turn->click();
    QVERIFY(view->view_point().up == (Vec3{0, 0, 1}));
    QVERIFY(bar->text().isEmpty());
  }

  void one_choice_turns_camera_and_sky() {
    const OwnScene own(true);
    QVERIFY(own.ready());
    own.part<QPushButton>("turn_upright")->click();
    const auto* view = own.window->findChild<SceneView*>();
    QVERIFY(view->view_point().up == (Vec3{0, 1, 0}));
    QVERIFY(!own.part<Banner>("vertical_bar")->isVisible());
    own.part<QAction>("vertical_+x")->trigger();
    QVERIFY(view->view_point().up == (Vec3{1, 0, 0}));
    auto* zenith = own.part<QComboBox>("sky_up");
    QCOMPARE(zenith->currentText(), QString("+x"));
    zenith->setCurrentIndex(0);
    emit zenith->activated(0);  // the signal of a click
    QVERIFY(own.window->vertical.up() == (Vec3{0, 0, 1}));
    QVERIFY(view->view_point().up == (Vec3{0, 0, 1}));
    // A scene that is read again keeps it.
    own.part<QAction>("vertical_+y")->trigger();
    own.part<QAction>("reload")->trigger();
    QVERIFY(own.ready());
    QVERIFY(own.window->vertical.up() == (Vec3{0, 1, 0}));
  }
};

const test::Registered registered("own_scene", test::run_as_viewer<OwnSceneTest>);

}  // namespace transillum::viewer::own_scene_test

#include "own_scene_test.moc"
