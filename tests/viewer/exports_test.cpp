// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Pictures, charts and recordings that the window writes.
#include <QAction>
#include <QDir>
#include <QImageReader>
#include <QTemporaryDir>
#include <QToolButton>
#include <cmath>

#include "scene/scene_page.h"
#include "scene/show_menu.h"
#include "solved_window.h"
#include "stepping/play_control.h"
#include "test_files.h"
#include "window/base/open_scene.h"
#include "window/files/export_actions.h"
#include "window/files/file_actions.h"
#include "window/files/frame_recorder.h"

namespace transillum::viewer::exports_test {

using namespace test;

class ExportsTest : public QObject {
  Q_OBJECT

 private slots:
  void exports_pictures_charts_and_values() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const ExportActions& exports = *solved.window->findChild<ExportActions*>();
    const QTemporaryDir folder;
    exports.write_scene(folder.filePath("scene.png"), 2);
    const QImage picture(folder.filePath("scene.png"));
    const QSize canvas =
        solved.scene_view->canvas()->size() * solved.scene_view->canvas()->devicePixelRatioF();
    QCOMPARE(picture.size(), 2 * canvas);
    QVERIFY(color_count(picture) > 5);

    exports.write_map_picture(folder.filePath("map.svg"));
    QVERIFY(contents_of(folder.filePath("map.svg")).count("<path") > 3);
    exports.write_charts(folder.filePath("charts.svg"));
    const QByteArray charts = contents_of(folder.filePath("charts.svg"));
    QVERIFY(charts.contains("<polyline") || charts.contains("<path"));
    QVERIFY(!charts.contains("<image"));  // vector graphics
    exports.write_chart_values(folder.filePath("figures.csv"));
    const QByteArray values = contents_of(folder.filePath("figures.csv"));
    QVERIFY(values.startsWith("chart,x,change,quadrature_error\niteration,1,"));
    QCOMPARE(values.count("direction,"), 32);
    QVERIFY_EXCEPTION_THROWN(exports.write_scene(folder.filePath("no/such.png"), 1),
                             std::runtime_error);
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 4);
  }

  void records_a_frame_per_change() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    const auto passes = [&] { return solved.window->snapshot()->passes_done; };
    // Each command makes an iteration, whose passes are kept.
    std::int64_t before = passes();
    recorder.begin_frames(folder.path());
    solved.trigger("one_direction");
    QVERIFY(wait_for(
        [&] { return recorder.frames() >= 2 && passes() > before && solved.window->settled(); }));
    recorder.end();
    const int frames = recorder.frames();
    before = passes();
    solved.trigger("one_direction");
    QVERIFY(wait_for([&] { return passes() > before && solved.window->settled(); }));
    handle_posted();
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), frames);
    // Steps are recorded too, after the frames of the earlier recording.
    const QByteArray first = contents_of(folder.filePath("frame_00001.png"));
    recorder.begin_frames(folder.path());
    solved.window->focus.go_to({0, 0, 2});
    QVERIFY(wait_for([&] { return recorder.frames() >= frames + 2; }));
    recorder.end();
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), recorder.frames());
    QVERIFY(contents_of(folder.filePath("frame_00001.png")) == first);
    QVERIFY(color_count(QImage(folder.filePath("frame_00001.png"))) > 5);
  }

  void records_what_is_played_as_an_animation() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    const QString path = folder.filePath("played.gif");
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    auto* play = solved.window->findChild<PlayControl*>();
    play->set_speed(25);
    play->set_by(PlayControl::By::polygons);
    solved.window->findChild<QAction*>("play_turns")->setChecked(true);
    solved.window->focus.go_to({0, 0, -1});
    QVERIFY(wait_for([&] { return solved.window->settled(); }));
    recorder.begin_animation(path);
    QVERIFY(solved.window->findChild<QAction*>("export_animation")->isChecked());
    QVERIFY(solved.window->findChild<QWidget*>("recording")->isVisible());
    const QImage first = solved.scene_view->picture(1).copy();
    constexpr int steps = 12;
    play->action()->trigger();
    QVERIFY(wait_for([&] { return recorder.frames() > steps; }));
    play->action()->trigger();
    QVERIFY(!QFile::exists(path));
    QTest::mouseClick(solved.window->findChild<QToolButton*>("finish_recording"), Qt::LeftButton);
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QVERIFY(!solved.window->findChild<QWidget*>("recording")->isVisible());

    QImageReader reader(path);
    QCOMPARE(reader.imageCount(), recorder.frames());
    QCOMPARE(reader.loopCount(), -1);  // without end
    const QImage read = reader.read().convertToFormat(QImage::Format_RGB32);
    QCOMPARE(read.size(), first.size());
    // 256 colors are enough for this scene.
    double sum = 0;
    for (int y = 0; y < first.height(); ++y) {
      for (int x = 0; x < first.width(); ++x) {
        sum += std::abs(qGray(first.pixel(x, y)) - qGray(read.pixel(x, y)));
      }
    }
    QVERIFY2(sum < 2.0 * first.width() * first.height(), qPrintable(QString::number(sum)));
    QImage before = read;
    int others = 0;
    for (int frame = 1; frame < recorder.frames(); ++frame) {
      QCOMPARE(reader.nextImageDelay(), 40);
      const QImage now = reader.read().convertToFormat(QImage::Format_RGB32);
      QVERIFY(!now.isNull());
      others += now != before;
      before = now;
    }
    QVERIFY2(others >= steps / 2, qPrintable(QString::number(others)));
  }

  void a_canceled_animation_leaves_no_file() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    recorder.begin_animation(folder.filePath("thrown-away.gif"));
    solved.trigger("one_direction");
    QVERIFY(wait_for([&] { return recorder.frames() >= 2; }));
    QTest::mouseClick(solved.window->findChild<QToolButton*>("cancel_recording"), Qt::LeftButton);
    QVERIFY(!recorder.writing());
    QVERIFY(!solved.window->findChild<QAction*>("export_animation")->isChecked());
    const QDir files(folder.path());
    QVERIFY(wait_for([&] { return files.entryList(QDir::Files | QDir::Hidden).isEmpty(); }));
    // Where nothing can be written, the recording ends with one message.
    recorder.begin_animation(folder.filePath("no/such/folder.gif"));
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QVERIFY2(solved.window->banner_text().contains("folder.gif"),
             qPrintable(solved.window->banner_text()));
  }
};

const test::Registered registered("exports", test::run_as_viewer<ExportsTest>);

}  // namespace transillum::viewer::exports_test

#include "exports_test.moc"
