// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Pictures, charts and recordings that the window writes.
#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QImageReader>
#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>
#include <QToolButton>
#include <cmath>

#include "film/film_file.h"
#include "film_frames.h"
#include "io/drawing/line_chart.h"
#include "map/map_canvas.h"
#include "scene/scene_page.h"
#include "scene/show_menu.h"
#include "solve/convergence_view.h"
#include "solved_window.h"
#include "stepping/play_control.h"
#include "test_files.h"
#include "window/base/open_scene.h"
#include "window/files/export_actions.h"
#include "window/files/figure_dialog.h"
#include "window/files/file_actions.h"
#include "window/files/frame_recorder.h"

namespace transillum::viewer::exports_test {

using namespace test;

/// The longest of the streams of a PDF file, decompressed.
QByteArray largest_content_of(const QByteArray& pdf) {
  QByteArray largest;
  auto begin = pdf.indexOf("stream\n") + 7;
  while (begin >= 7) {
    const auto end = pdf.indexOf("endstream", begin);
    // qUncompress() expects the size first, of which it makes no more than a guess.
    const QByteArray stream = pdf.mid(begin, end - begin);
    const QByteArray content =
        stream.startsWith('x') ? qUncompress(QByteArray(4, '\1') + stream) : QByteArray();
    if (content.contains(" Tf") && content.size() > largest.size()) {
      largest = content;
    }
    const auto next = pdf.indexOf("\nstream\n", end);
    begin = next < 0 ? 0 : next + 8;
  }
  return largest;
}

class ExportsTest : public QObject {
  Q_OBJECT

 private slots:
  void exports_pictures_charts_and_values() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const ExportActions& exports = *solved.window->findChild<ExportActions*>();
    const QTemporaryDir folder;
    exports.write_map_picture(folder.filePath("map.svg"));
    QVERIFY(contents_of(folder.filePath("map.svg")).count("<path") > 3);
    // Both sides, as in the window, until one steps.
    const bool whole = !solved.window->focus.at_step();
    QCOMPARE(contents_of(folder.filePath("map.svg")).contains(">receives, along "), whole);
    exports.write_charts(folder.filePath("charts.svg"));
    const QByteArray charts = contents_of(folder.filePath("charts.svg"));
    QVERIFY(charts.contains("<polyline") || charts.contains("<path"));
    QVERIFY(!charts.contains("<image"));  // vector graphics
    exports.write_chart_values(folder.filePath("figures.csv"));
    const QByteArray values = contents_of(folder.filePath("figures.csv"));
    QVERIFY(values.startsWith("chart,x,change,quadrature_error\niteration,1,"));
    QCOMPARE(values.count("direction,"), 32);
    QVERIFY_EXCEPTION_THROWN(exports.write_charts(folder.filePath("no/such.png")), std::exception);
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 3);
  }

  void figures_have_text_vectors_and_the_size_asked_for() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    solved.window->colors.set_mode(ColorMode::luminance);
    solved.window->focus.go_to({0, 3, 5});
    QVERIFY(comes_to_rest(*solved.window));
    const FigureViews views = solved.window->findChild<ExportActions*>()->figure_views();
    const QTemporaryDir folder;
    FigurePlan plan;
    plan.map = plan.chart = true;
    plan.title = "Light & shadow";
    plan.size = {1500, 500};
    const QImage before = solved.picture();

    write_figure(folder.filePath("row.svg"), plan, views);
    const QByteArray svg = contents_of(folder.filePath("row.svg"));
    QVERIFY(svg.contains("<title>Light &amp; shadow</title>"));
    for (const char* text : {">Light &amp; shadow</text>", ">B (W/m²)</text>", ">luminance</text>",
                             ">back side</text>", " m</text>", ">u</text>"}) {
      QVERIFY2(svg.contains(text), text);
    }
    QVERIFY(svg.count("<path") + svg.count("<polygon") + svg.count("<polyline") >
            static_cast<int>(solved.map_view->canvas()->polygon_count()));
    QCOMPARE(svg.count("<image"), 1);  // the scene
    for (const LineChart& chart : views.charts.charts()) {
      for (const std::string& text : {chart.title, chart.x.title, chart.y.ticks.back().label}) {
        QVERIFY2(svg.contains(">" + QByteArray::fromStdString(text).replace("&", "&amp;") + "<"),
                 text.c_str());
      }
    }

    write_figure(folder.filePath("row.pdf"), plan, views);
    const QByteArray pdf = contents_of(folder.filePath("row.pdf"));
    QVERIFY(pdf.startsWith("%PDF"));
    QVERIFY(pdf.contains("/MediaBox [0 0 1125"));  // points
    QVERIFY(pdf.contains("/ToUnicode"));           // text is text
    const QByteArray page = largest_content_of(pdf);
    QVERIFY(page.count(" Tj") + page.count(" TJ") > 8);
    QVERIFY(page.count(" l\n") > 50);  // lines of polygons

    plan.centimeters = true;
    plan.size = {16, 6};
    plan.background = FigurePlan::Background::transparent;
    write_figure(folder.filePath("row.png"), plan, views);
    const QImage png(folder.filePath("row.png"));
    QCOMPARE(png.size(), QSize(1890, 709));
    QCOMPARE(qRound(png.dotsPerMeterX() * 0.0254), 300);
    QCOMPARE(qAlpha(png.pixel(2, 2)), 0);
    QVERIFY(color_count(png) > 20);
    QCOMPARE(different_pixels(solved.picture(), before), 0);  // the window stays

    plan.map = plan.chart = plan.explained = false;
    plan.title.clear();
    plan.background = FigurePlan::Background::dark;
    write_figure(folder.filePath("scene.png"), plan, views);
    const QImage scene(folder.filePath("scene.png"));
    QCOMPARE(scene.pixelColor(2, 2), theme::scene_background);
    QVERIFY(color_count(scene) > 5);
    QVERIFY(fraction_of(scene, theme::processed) < 1e-4);
    plan.direction = true;
    write_figure(folder.filePath("scene.png"), plan, views);
    QVERIFY(fraction_of(QImage(folder.filePath("scene.png")), theme::processed) > 1e-3);
  }

  void a_figure_of_a_whole_direction_has_both_sides() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const FigureViews views = solved.window->findChild<ExportActions*>()->figure_views();
    const QTemporaryDir folder;
    FigurePlan plan;
    plan.scene = false;
    plan.map = true;
    plan.size = {900, 450};
    write_figure(folder.filePath("map.svg"), plan, views);
    const QByteArray svg = contents_of(folder.filePath("map.svg"));
    QVERIFY(svg.contains(">emits, along") && svg.contains(">receives, along"));
    QCOMPARE(svg.count(" m</text>"), 2);  // scale bars
    const QImage picture = solved.map_view->picture({400, 200});
    QCOMPARE(picture.size(), QSize(400, 200));
    for (const int left : {0, 201}) {
      QVERIFY(color_count(picture.copy(left, 0, 199, 200)) > 5);
    }
  }

  void a_figure_that_cannot_be_written_is_one_error() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const FigureViews views = solved.window->findChild<ExportActions*>()->figure_views();
    const QTemporaryDir folder;
    const auto message = [&](const char* name, const FigurePlan& plan) {
      try {
        write_figure(folder.filePath(name), plan, views);
      } catch (const std::exception& error) {
        return QString::fromUtf8(error.what());
      }
      return QString();
    };
    for (const double side : {0.0, 15.0, 100000.0}) {
      const QString text = message("a.png", {.size = {600, side}});
      QVERIFY2(text.contains("each side must have 16 to 16384"), qPrintable(text));
    }
    QVERIFY(message("a.png", {.scene = false}).contains("none is chosen"));
    QVERIFY(message("a.bmp", {}).contains("must end in .png, .svg or .pdf"));
    QVERIFY(message("no/such/a.pdf", {.size = {64, 48}}).contains("a.pdf"));
    QVERIFY(QDir(folder.path()).entryList(QDir::Files).isEmpty());
    // The dialog says the same.
    FigureDialog dialog({}, true);
    dialog.findChild<QDoubleSpinBox*>("figure_width")->setValue(0);
    QVERIFY(!dialog.findChild<QPushButton*>("figure_save")->isEnabled());
    QVERIFY(dialog.findChild<QLabel*>("figure_note")->text().contains("each side must have"));
    dialog.findChild<QDoubleSpinBox*>("figure_width")->setValue(1200);
    QVERIFY(dialog.findChild<QPushButton*>("figure_save")->isEnabled());
    dialog.findChild<QComboBox*>("figure_unit")->setCurrentIndex(1);
    QVERIFY(std::abs(dialog.plan().pixels().width() - 1200) <= 6);  // 0.1 cm
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

  void films_are_whole_in_all_formats_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"film.webm", "film.mp4", "film.gif"}) {
      QTest::newRow(name) << name;
    }
  }

  void films_are_whole_in_all_formats() {
    QFETCH(QString, name);
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    Focus& focus = solved.window->focus;
    focus.go_to({0, 3, 5});
    QVERIFY(comes_to_rest(*solved.window));
    const QSize size(641, 360);  // formats store even sizes only
    const FilmPlan plan{FilmPlan::Show::both, FilmPlan::Over::polygons, FilmFile::even(size), 25};
    recorder.begin_film(folder.filePath(name), plan);
    QVERIFY(solved.window->findChild<QAction*>("save_film")->isChecked());
    QVERIFY(solved.window->findChild<QWidget*>("recording")->isVisible());
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QVERIFY(!solved.window->findChild<QWidget*>("recording")->isVisible());
    QVERIFY(comes_to_rest(*solved.window));
    const RunPosition back{0, 3, 5};
    QVERIFY(focus.position() == back);

    const DecodedFilm film = decoded_film(folder.filePath(name));
    const int steps = focus.map()->history.step_count();
    QCOMPARE(static_cast<int>(film.frames.size()), steps + 1);
    QCOMPARE(film.per_second, 25.0);
    for (const int step : {-1, steps - 1}) {
      focus.go_to({0, 3, step});
      QVERIFY(comes_to_rest(*solved.window));
      const QSize half((plan.size.width() - 2) / 2, plan.size.height());
      const QImage& frame = step < 0 ? film.frames.front() : film.frames.back();
      const double of_scene = mean_difference(frame.copy(QRect(QPoint(0, 0), half)),
                                              solved.scene_view->picture({.size = half}));
      const double of_map = mean_difference(frame.copy(QRect(QPoint(half.width() + 2, 0), half)),
                                            solved.map_view->canvas()->picture(half));
      // The colors of videos have half the resolution, which blurs colored lines.
      QVERIFY2(of_scene < 3 && of_map < 3,
               qPrintable(QString("%1 %2 %3").arg(step).arg(of_scene).arg(of_map)));
    }
    QVERIFY(mean_difference(film.frames.front(), film.frames.back()) > 5);
  }

  void a_picture_in_the_size_of_the_window_is_that_of_the_window() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    solved.window->focus.go_to({0, 3, 5});
    QVERIFY(comes_to_rest(*solved.window));
    const QWidget& canvas = *solved.scene_view->canvas();
    const QSize size = canvas.size() * canvas.devicePixelRatioF();
    const QImage before = solved.picture();
    QVERIFY(mean_difference(solved.scene_view->picture({.size = size}), before) < 0.1);
    (void)solved.scene_view->picture({.size = {300, 200}});
    QVERIFY(mean_difference(solved.picture(), before) < 0.01);
    if (canvas.devicePixelRatioF() == 1) {
      MapCanvas& map = *solved.map_view->canvas();
      QVERIFY(mean_difference(map.picture(map.size()), map.grab().toImage()) < 0.1);
    }
  }

  void films_go_over_directions_and_around_the_scene() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    const ViewPoint view = solved.scene_view->view_point();
    const bool followed = solved.window->focus.following();
    const auto frames_of = [&](const FilmPlan& plan) {
      const QString path = folder.filePath("film.mp4");
      recorder.begin_film(path, plan);
      return wait_for([&] { return !recorder.writing(); }) ? decoded_film(path).frames
                                                           : std::vector<QImage>();
    };
    const std::vector<QImage> directions =
        frames_of({FilmPlan::Show::map, FilmPlan::Over::directions, {320, 240}, 10});
    QCOMPARE(static_cast<int>(directions.size()), solved.window->focus.passes_of(0));
    QVERIFY(mean_difference(directions[0], directions[1]) > 1);
    QCOMPARE(solved.window->focus.following(), followed);
    const std::vector<QImage> turn =
        frames_of({FilmPlan::Show::scene, FilmPlan::Over::turn, {320, 240}, 2});
    QCOMPARE(static_cast<int>(turn.size()), 20);
    QVERIFY(mean_difference(turn[0], turn[2]) > 1);
    QVERIFY(norm(solved.scene_view->view_point().eye - view.eye) < 1e-9 * norm(view.eye));
  }

  void records_what_is_played() {
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
    QVERIFY(comes_to_rest(*solved.window));
    const FilmPlan plan{.size = {400, 300}, .per_second = 25};
    const QImage first = solved.scene_view->picture({.size = plan.size});
    recorder.begin_film(path, plan);
    constexpr int steps = 12;
    play->action()->trigger();
    QVERIFY(wait_for([&] { return recorder.frames() > steps; }));
    play->action()->trigger();
    QVERIFY(!QFile::exists(path));
    QTest::mouseClick(solved.window->findChild<QToolButton*>("finish_recording"), Qt::LeftButton);
    QVERIFY(wait_for([&] { return !recorder.writing(); }));

    QImageReader reader(path);
    QCOMPARE(reader.imageCount(), recorder.frames());
    QCOMPARE(reader.loopCount(), -1);  // without end
    const QImage read = reader.read();
    // 256 colors are enough for this scene.
    QVERIFY2(mean_difference(first, read) < 2,
             qPrintable(QString::number(mean_difference(first, read))));
    QCOMPARE(reader.nextImageDelay(), 40);
    QVERIFY(mean_difference(decoded_film(path).frames.back(), read) > 1);
  }

  void a_canceled_film_leaves_no_file() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    recorder.begin_film(folder.filePath("thrown-away.webm"), {.size = {320, 240}});
    solved.trigger("one_direction");
    QVERIFY(wait_for([&] { return recorder.frames() >= 2; }));
    QTest::mouseClick(solved.window->findChild<QToolButton*>("cancel_recording"), Qt::LeftButton);
    QVERIFY(!recorder.writing());
    QVERIFY(!solved.window->findChild<QAction*>("save_film")->isChecked());
    const QDir files(folder.path());
    QVERIFY(wait_for([&] { return files.entryList(QDir::Files | QDir::Hidden).isEmpty(); }));
    // Where nothing can be written, the recording ends with one message.
    for (const char* name : {"no/such/folder.gif", "film.avi"}) {
      recorder.begin_film(folder.filePath(name), {.size = {320, 240}});
      QVERIFY(wait_for([&] { return !recorder.writing(); }));
      QVERIFY2(solved.window->banner_text().contains(name),
               qPrintable(solved.window->banner_text()));
    }
  }

  void a_film_ends_with_its_scene() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    const FilmPlan plan{FilmPlan::Show::scene, FilmPlan::Over::turn, {320, 240}, 60};
    recorder.begin_film(folder.filePath("film.webm"), plan);
    QVERIFY(wait_for([&] { return recorder.frames() > 3; }));
    solved.window->open("boards");
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QVERIFY(recorder.frames() < 600);
    QVERIFY(comes_to_rest(*solved.window));
    QVERIFY(QDir(folder.path()).entryList(QDir::Files).isEmpty());
    // A film of the new scene that is finished early is whole.
    const QString path = folder.filePath("film.mp4");
    recorder.begin_film(path, plan);
    QVERIFY(wait_for([&] { return recorder.frames() > 3; }));
    recorder.end();
    QVERIFY(wait_for([&] { return !recorder.writing(); }));
    QCOMPARE(static_cast<int>(decoded_film(path).frames.size()), recorder.frames());
  }

  void closing_the_window_discards_a_film() {
    const QTemporaryDir folder;
    {
      const SolvedWindow solved("furnace");
      QVERIFY(solved.ready);
      FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
      recorder.begin_film(folder.filePath("film.webm"),
                          {FilmPlan::Show::both, FilmPlan::Over::polygons, {320, 240}, 5});
      QVERIFY(wait_for([&] { return recorder.frames() > 1; }));
    }
    QVERIFY(QDir(folder.path()).entryList(QDir::Files | QDir::Hidden).isEmpty());
  }

  void a_projector_shows_that_a_film_is_recorded() {
    const SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    const QTemporaryDir folder;
    FrameRecorder& recorder = *solved.window->findChild<FrameRecorder*>();
    solved.window->findChild<QAction*>("projector")->trigger();
    QVERIFY(comes_to_rest(*solved.window));
    recorder.begin_film(folder.filePath("film.mp4"), {.size = {320, 240}});
    auto* mark = solved.window->findChild<QWidget*>("recording");
    QVERIFY(wait_for([&] { return !mark->visibleRegion().isEmpty(); }));
    QVERIFY(solved.window->rect().contains(mark->geometry()));
    handle_posted();
    QVERIFY(fraction_of(mark->grab().toImage(), QColor(0xe5, 0x48, 0x4d)) > 0.005);
    save_picture(*solved.window, "recording-projector");
    recorder.cancel();
  }
};

const test::Registered registered("exports", test::run_as_viewer<ExportsTest>);

}  // namespace transillum::viewer::exports_test

#include "exports_test.moc"
