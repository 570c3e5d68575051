// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Renders the pictures of the manual and of the first page. If TRANSILLUM_PICTURES names a
// folder, they are written there (viewer/pictures/make); otherwise only a few are rendered and
// checked not to be blank.
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QPainter>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>

#include "lessons/lesson_panel.h"
#include "map/compare_view.h"
#include "scene/build/patch_count.h"
#include "scene/color_controls.h"
#include "solve/study_dialog.h"
#include "solved_window.h"
#include "transillum/first_shot.h"
#include "window/base/view_state_applier.h"
#include "window/files/first_look.h"

namespace transillum::viewer::pictures_test {

using namespace test;

namespace {

constexpr QSize window_size{1440, 900};

QString folder() { return qEnvironmentVariable("TRANSILLUM_PICTURES"); }

// Checks that a picture is not blank, and writes it if folder() is set.
void keep(const QImage& picture, const QString& name, const QSize& size) {
  // A furnace has one radiosity: only its outlines differ in color; a card is small.
  const int least = name == "scene-furnace.png" ? 10 : name.startsWith("card-") ? 4 : 40;
  QVERIFY2(color_count(picture) > least, qPrintable(name));
  if (folder().isEmpty()) {
    return;
  }
  const QImage small = picture.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  QVERIFY(small.convertToFormat(QImage::Format_RGB888).save(QDir(folder()).filePath(name), "PNG"));
}

bool settles(TestWindow& window) { return comes_to_rest(window, 600000); }

/// A window with sharp pictures, as users have it.
struct PictureWindow : TestWindow {
  PictureWindow() {
    views().page.sharp()->action()->setChecked(true);
    resize(window_size);
    show();
  }
  /// Opens the cornell box, and solves it.
  bool shows_the_box() {
    set_options({.directions = 64}, {});
    // Unlike open(), this leaves the panels as the layout has them.
    scene.open("cornell-box", views().settings.options(), {Goal::Kind::finished});
    return settles(*this);
  }
};

QImage whole(TestWindow& window) { return window.grab().toImage(); }

/// The part of a picture of the scene that has something in it, in the shape of `size`; the middle
/// where it is as wide as the picture.
QRect part_in_shape(const QImage& picture, const QSize& size) {
  QRect part;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (picture.pixelColor(x, y) != theme::scene_background) {
        part |= QRect(x, y, 1, 1);
      }
    }
  }
  const bool is_wide = part.width() == picture.width();
  const QSize shape = is_wide ? size.scaled(part.size(), Qt::KeepAspectRatio)
                              : size.scaled(1.05 * part.size(), Qt::KeepAspectRatioByExpanding);
  return QRect(part.center() - QRect(QPoint(), shape).center(), shape);
}

/// A part of a picture, also beyond its edges, scaled.
QImage cropped(const QImage& picture, const QRect& part, const QSize& size) {
  QImage result(part.size(), QImage::Format_RGB888);
  result.fill(theme::scene_background);
  QPainter(&result).drawImage(-part.topLeft(), picture);
  return result.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

/// The picture of a lesson on the first page: the map of the page that enlarges it, or else the
/// scene of the last page, cropped.
void keep_card(TestWindow& window, LessonPanel& panel, int lesson) {
  const auto& pages = at(panel.lessons(), lesson).pages;
  const auto large = std::find_if(pages.begin(), pages.end(),
                                  [](const Lesson::Page& page) { return page.large == "map"; });
  const bool of_map = large != pages.end();
  panel.show_page(lesson, static_cast<int>((of_map ? large : pages.end() - 1) - pages.begin()));
  QVERIFY(settles(window));
  const QImage picture = of_map ? window.findChild<MapView*>()->canvas()->grab().toImage()
                                : window.views().page.scene_view()->picture(1);
  constexpr QSize size(192, 120);
  const QSize middle = size.scaled(picture.size(), Qt::KeepAspectRatio);
  const QRect part = of_map
                         ? QRect(picture.rect().center() - QRect(QPoint(), middle).center(), middle)
                         : part_in_shape(picture, size);
  keep(cropped(picture, part, size), QStringLiteral("card-%1.png").arg(lesson + 1), size);
}

}  // namespace

class PicturesTest : public QObject {
  Q_OBJECT

 private slots:
  void layouts() {
    PictureWindow window;
    QVERIFY(window.shows_the_box());
    window.selection.select(16);
    for (const char* layout : {"inspect", "debug"}) {
      window.findChild<QAction*>(QStringLiteral("layout_%1").arg(layout))->trigger();
      window.views().page.color_controls()->set_outlines(layout == QByteArray("debug"));
      if (layout == QByteArray("debug")) {
        window.focus.go_to({0, 9, -1});
        QVERIFY(settles(window));
        window.findChild<QAction*>("next_event")->trigger();
        window.focus.set_phase(Phase::split);
      }
      QVERIFY(settles(window));
      keep(whole(window), QStringLiteral("layout-%1.png").arg(layout), {960, 600});
    }
  }

  void engines() {
    PictureWindow window;
    QVERIFY(window.shows_the_box());
    window.selection.select(14);
    window.focus.go_to({0, 3, 20});
    QVERIFY(settles(window));
    // The map of each engine, side by side.
    auto* map_dock = window.findChild<QDockWidget*>("map_dock");
    map_dock->setFloating(true);
    map_dock->resize(600, 420);
    constexpr int columns = 3;
    const QSize each(320, 224);
    QImage all(columns * each.width(), 2 * each.height(), QImage::Format_RGB888);
    all.fill(Qt::white);
    QPainter painter(&all);
    int place = 0;
    auto* map = window.findChild<MapView*>();
    for (const char* action :
         {"map_exact", "map_zbuffer", "map_painter", "map_rays", "map_corrected", "map_hemicube"}) {
      window.findChild<QAction*>(action)->trigger();
      QVERIFY(settles(window));
      const QImage shown = map->grab().toImage();
      QVERIFY2(color_count(shown) > 16, action);
      painter.drawImage(QPoint(place % columns * each.width(), place / columns * each.height()),
                        shown.scaled(each, Qt::KeepAspectRatio, Qt::SmoothTransformation));
      ++place;
    }
    painter.end();
    keep(all, "map-engines.png", all.size());
    window.findChild<QAction*>("map_exact")->trigger();
    auto* compare = window.findChild<CompareView*>();
    auto* dock = window.findChild<QDockWidget*>("compare_dock");
    window.views().docks.bring_to_front("compare");
    QVERIFY(wait_for([&] { return compare->isVisible(); }));
    dock->setFloating(true);
    dock->resize(560, 760);
    compare->findChild<QComboBox*>("other_engine")->setCurrentText("Painter's algorithm");
    compare->findChild<QSpinBox*>("other_resolution")->setValue(64);
    QVERIFY(wait_for([&] { return compare->up_to_date(); }));
    QVERIFY(settles(window));
    keep(compare->grab().toImage(), "compare.png", {480, 640});
  }

  void first_pages_of_lessons_data() {
    QTest::addColumn<int>("lesson");
    const int lessons = folder().isEmpty() ? 1 : static_cast<int>(built_in_lessons().size());
    for (int lesson = 0; lesson < lessons; ++lesson) {
      QTest::newRow(std::to_string(lesson + 1).c_str()) << lesson;
    }
  }
  void first_pages_of_lessons() {
    QFETCH(int, lesson);
    PictureWindow window;
    auto* panel = window.findChild<LessonPanel*>();
    panel->show_page(lesson, 0);
    QVERIFY(settles(window));
    keep(whole(window), QStringLiteral("lesson-%1.png").arg(lesson + 1), {960, 600});
    keep_card(window, *panel, lesson);
  }

  // At a step with an exchange.
  void the_teach_layout() {
    PictureWindow window;
    window.findChild<LessonPanel*>()->show_page(2, 1);
    QVERIFY(settles(window));
    keep(whole(window), "layout-teach.png", {960, 600});
  }

  void projector_and_dark() {
    PictureWindow window;
    window.findChild<LessonPanel*>()->show_page(3, 3);
    window.findChild<QAction*>("projector")->trigger();
    QVERIFY(settles(window));
    keep(whole(window), "projector.png", {960, 600});
    window.findChild<QAction*>("projector")->trigger();
    window.findChild<QAction*>("dark")->trigger();
    QVERIFY(settles(window));
    keep(whole(window), "dark.png", {960, 600});
    window.findChild<QAction*>("dark")->trigger();
  }

  void panels_and_the_study() {
    PictureWindow window;
    QVERIFY(window.shows_the_box());
    window.selection.select(16);
    const auto keep_panel = [&](const char* layout, const char* panel, const char* name,
                                const QSize& size) {
      window.findChild<QAction*>(layout)->trigger();
      window.views().docks.bring_to_front(panel);
      auto* dock = window.findChild<QDockWidget*>(QString(panel) + "_dock");
      dock->setFloating(true);
      dock->resize(size);
      QVERIFY(wait_for([&] { return dock->widget()->isVisible(); }));
      QVERIFY(settles(window));
      const QImage picture = dock->grab().toImage();
      keep(picture, QStringLiteral("panel-%1.png").arg(name), picture.size());
      dock->setFloating(false);
    };
    window.focus.go_to({0, 9, 11});
    keep_panel("layout_teach", "tree", "tree", {480, 424});
    if (folder().isEmpty()) {
      return;
    }
    window.findChild<QTabWidget*>("tree_tabs")->setCurrentIndex(1);
    keep_panel("layout_teach", "tree", "whole-tree", {480, 424});
    keep_panel("layout_debug", "received", "received", {600, 240});
    keep_panel("layout_inspect", "material", "materials", {340, 356});
    keep_panel("layout_inspect", "table", "patches", {560, 324});
    window.findChild<QAction*>("study")->trigger();
    auto* study = window.findChild<StudyDialog*>();
    study->findChild<QPushButton*>("study_run")->click();
    QVERIFY(wait_for([&] { return study->findChild<QLabel*>("study_phase")->text() == "Done"; },
                     100000));
    keep(study->grab().toImage(), "study.png", {860, 600});
  }

  void built_in_scenes_alone_data() {
    QTest::addColumn<QString>("name");
    for (const BuiltInScene& scene : built_in_scenes()) {
      if (!folder().isEmpty() || scene.name == "boards") {
        QTest::newRow(scene.name.c_str()) << QString::fromStdString(scene.name);
      }
    }
  }
  void built_in_scenes_alone() {
    QFETCH(QString, name);
    PictureWindow window;
    SolveOptions options;
    options.directions = name == "sphere-flake" ? 128 : 1024;
    SceneOptions refined;
    if (has_first_look(name.toStdString())) {  // like the first look
      options.basis = Basis::linear;
      refined.max_patch_area = max_patch_area_for(*load_scene(name.toStdString()), 3000);
    } else {
      options.first_shot = first_shot_where_it_pays;
    }
    options.glossy = name == "gallery";  // which opens with lobes
    window.set_options(options, refined);
    window.colors.show_lobes(options.glossy);
    window.open(name, {Goal::Kind::finished});
    QVERIFY(settles(window));
    auto* view = window.findChild<SceneView*>();
    view->set_outlines_shown(name == "furnace");
    QVERIFY(settles(window));
    const QImage picture = view->picture(1);
    constexpr QSize size(480, 300);
    keep(cropped(picture, part_in_shape(picture, size), size),
         QStringLiteral("scene-%1.png").arg(name), size);
  }
};

const test::Registered registered("pictures", test::run_as_viewer<PicturesTest>);

}  // namespace transillum::viewer::pictures_test

#include "pictures_test.moc"
