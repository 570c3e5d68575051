// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lessons exported as HTML: the file needs no other file, and has the pages, the maps and the
// answers.
#include <QAction>
#include <QFile>
#include <QProcess>
#include <QProgressDialog>
#include <QPushButton>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>

#include "lessons/lesson_html.h"
#include "lessons/lesson_panel.h"
#include "solved_window.h"
#include "test_files.h"
#include "transillum/at.h"
#include "window/files/lesson_export.h"

namespace transillum::viewer::lesson_html_test {

using namespace test;

namespace {

const char* const lesson_text = R"({"title": "Two <pages>", "pages": [
  {"title": "One", "text": "With *A*(i, j, ω) and {M} directions, *B*ᵢ: press `,`.[[ See the panel below.]]",
   "show": {"scene": "furnace", "layout": "teach", "options": {"directions": 16},
            "focus": {"direction": 3, "step": 4}},
   "controls": {"M": {"option": "directions", "values": [8, 16]}},
   "question": {"kind": "number", "ask": "How many?[[ Count here.]]", "answer": {"figure": "steps"},
                "then": "That is all."}},
  {"title": "Two", "text": "The end.", "show": {"focus": "newest"}},
  {"title": "Three", "text": ["[[Drag", "it.]]", ""]}]})";

int count(const QByteArray& text, const char* pattern) {
  int found = 0;
  auto all =
      QRegularExpression(QString::fromUtf8(pattern), QRegularExpression::DotMatchesEverythingOption)
          .globalMatch(QString::fromUtf8(text));
  for (; all.hasNext(); all.next()) {
    ++found;
  }
  return found;
}

/// A window with the lesson above.
struct Exported {
  QTemporaryDir folder;
  std::unique_ptr<TestWindow> window = make_window();
  LessonExport* exporter = window->findChild<LessonExport*>();
  QString path = folder.filePath("lesson.html");

  Exported() {
    const QString file = write_file(folder.filePath("mine.json"), lesson_text);
    window->files().try_open(file);
    QVERIFY(wait_for([this] { return window->settled(); }));
  }
  void finish() {
    exporter->export_to(path);
    QVERIFY(wait_for([this] { return !exporter->busy(); }, 60000));
  }
};

}  // namespace

class LessonHtmlTest : public QObject {
  Q_OBJECT

 private slots:
  // The polygons that a browser shows at a step are the polygons of V.
  void polygons_of_a_map_have_their_steps() {
    const auto scene = load_scene("cornell-box");
    auto loaded = std::make_shared<LoadedScene>();
    loaded->scene = scene;
    loaded->tree = std::make_shared<const BspTree>(*scene);
    RecordedMap map;
    map.history = MapHistory(
        record_local_map(*scene, *loaded->tree, normalized(Vec3{0.3, 0.8, -0.4})).record);
    const std::vector<Color8> colors(static_cast<std::size_t>(scene->patch_count()),
                                     Color8{1, 2, 3});
    const QByteArray svg = map_svg(map, {9}, colors, true);
    const QRegularExpression polygon(
        "<polygon data-made=\"(\\d+)\" data-consumed=\"(\\d+)\"[^>]*?( style=\"display:none\")?>");
    for (const std::int32_t step : {-1, 0, 5, 9, map.history.step_count() - 1}) {
      std::size_t shown = 0, visible = 0;
      for (auto all = polygon.globalMatch(QString::fromUtf8(svg)); all.hasNext();) {
        const auto one = all.next();
        shown += one.captured(1).toInt() <= step && step < one.captured(2).toInt() ? 1 : 0;
        visible += one.captured(3).isEmpty() ? 1 : 0;
      }
      QCOMPARE(shown, map.record().map_after(step).size());
      QCOMPARE(visible, map.record().map_after(9).size());  // without a script: the given step
    }
    QCOMPARE(count(map_svg(map, {9}, colors, false), "<polygon"),
             int(map.record().map_after(9).size()));
    // Before a step, V is as after the one before; the step's polygon and what it cuts are marked.
    for (const Phase phase : {Phase::before, Phase::split}) {
      const QByteArray marked = map_svg(map, {9, phase}, colors, false);
      QCOMPARE(count(marked, "<polygon data-made"), int(map.record().map_after(8).size()));
      QCOMPARE(count(marked, "<polygon class=\"step\""), 1);
      const bool split = phase == Phase::split;
      QCOMPARE(count(marked, "<polygon class=\"cut\""),
               split ? 0 : int(map.history.cut_at(9).size()));
      QCOMPARE(count(marked, "<polygon class=\"inside"),
               split ? int(map.history.inside_at(9).size()) : 0);
      QCOMPARE(count(marked, "<polygon class=\"outside"),
               split ? int(map.history.outside_at(9).size()) : 0);
    }
    QVERIFY(!map.history.inside_at(9).empty() || !map.history.cut_at(9).empty());
    const QByteArray labeled = map_svg(map, {9, Phase::after, true}, colors, false);
    QVERIFY(count(labeled, "<text class=\"label\"") > 3);
    // Only the objects that the page names are named, where they are shown.
    const PatchId shown = map.row(map.record().map_after(9).front()).patch;
    const std::vector<Callout> callouts{{"this < that", Callout::Anchor::patch, shown, {}},
                                        {"the same", Callout::Anchor::patch, shown, {}},
                                        {"nowhere", Callout::Anchor::patch, no_patch, {}}};
    const QByteArray named = map_svg(map, {9}, colors, true, callouts);
    QVERIFY(named.contains(">this &lt; that</text>") && named.contains(">the same</text>"));
    QVERIFY(!named.contains("nowhere"));
  }

  // Both sides of a direction, all fragments that are not edge-on; omega's callout is at its
  // symbol.
  void a_whole_direction_has_both_sides() {
    const auto scene = load_scene("cornell-box");
    RecordedMap map;
    map.history = MapHistory(
        record_local_map(*scene, BspTree(*scene), normalized(Vec3{0.3, 0.8, -0.4})).record);
    const std::vector<Color8> colors(static_cast<std::size_t>(scene->patch_count()),
                                     Color8{1, 2, 3});
    int fragments = 0;
    for (std::int32_t k = 0; k < map.history.step_count(); ++k) {
      fragments += map.history.step(k).row != MapRecord::no_row;
    }
    const QByteArray emits = side_svg(map, false, colors), receives = side_svg(map, true, colors);
    QCOMPARE(count(emits, "<polygon") + count(receives, "<polygon"), fragments);
    QVERIFY(count(emits, "<polygon") > 3 && count(receives, "<polygon") > 3);
    const QByteArray named =
        map_svg(map, {3}, colors, false, {{"omega", Callout::Anchor::direction, no_patch, {}}});
    static const QRegularExpression symbol(
        "<g stroke=\"#fff\" fill=\"none\"><circle "
        "(cx=\"[^\"]*\" cy=\"[^\"]*\")");
    const QString place = symbol.match(QString::fromUtf8(named)).captured(1);
    QVERIFY(!place.isEmpty());
    QCOMPARE(named.count(place.toUtf8()), 2);  // the symbol, and the end of the callout's line
  }

  void a_lesson_becomes_one_file() {
    Exported exported;
    exported.finish();
    const QByteArray html = contents_of(exported.path);
    const QString kept = qEnvironmentVariable("TRANSILLUM_PICTURES");
    if (!kept.isEmpty()) {
      QFile::copy(exported.path, kept + "/lesson.html");
    }
    QCOMPARE(count(html, "<section>"), 2);
    QVERIFY(html.contains("<title>Two &lt;pages&gt;</title>"));
    QCOMPARE(count(html, "<img [^>]*src=\"data:image/png;base64,"), 2);
    QCOMPARE(count(html, "class=\"stepper\""), 1);  // the second page has no direction
    // Scene and map stand side by side.
    QCOMPARE(count(html, "<div class=\"views\">\\s*<img [^>]*>\\s*<div class=\"stepper\">"), 1);
    QVERIFY(html.contains("max=\"12\" value=\"4\""));
    // Nothing is loaded from elsewhere, and no link leads into the program.
    QCOMPARE(count(html, "(src|href)=\"(?!data:)"), 0);
    QVERIFY(!html.contains("symbol:") && !html.contains("{M}") && html.contains("16"));
    QVERIFY(count(html, "vertical-align:sub") > 0);
    QVERIFY(html.contains("press <code>,</code>."));
    // Texts about the window are omitted.
    QVERIFY(!html.contains("panel below") && !html.contains("Count here"));
    QVERIFY(!html.contains("Three") && !html.contains("Drag"));
    QCOMPARE(count(html, "<details>.*computed: 12.*That is all.*</details>"), 1);
    // The pictures are of the scene.
    static const QRegularExpression png(QStringLiteral("base64,([^\"]*)\""));
    const QImage image = QImage::fromData(
        QByteArray::fromBase64(png.match(QString::fromUtf8(html)).captured(1).toLatin1()));
    QVERIFY(image.width() > 200 && color_count(image) > 3);
    // The window is back where it was.
    QCOMPARE(exported.window->findChild<LessonPanel*>()->page(), 0);
  }

  void built_in_lessons_do_not_speak_of_the_window() {
    static const QRegularExpression speaks(
        ".{0,30}(\\bpanel\\b|[Cc]lick|[Dd]rag\\b|timeline|Next page|→ (?!About)|[[\\]]{2}).{0,30}");
    for (const Lesson& lesson : built_in_lessons()) {
      for (const Lesson::Page& page : lesson.pages) {
        const std::string asked = page.question ? page.question->ask + page.question->then : "";
        const QString text = web_text(page.text + asked);
        QVERIFY2(!text.contains(speaks), qPrintable(speaks.match(text).captured()));
        QVERIFY(!window_text(page.text).contains("[["));
      }
    }
  }

  void canceling_writes_nothing() {
    Exported exported;
    exported.exporter->export_to(exported.path);
    auto* progress = exported.window->findChild<QProgressDialog*>("lesson_export_progress");
    QVERIFY(progress);
    progress->findChild<QPushButton*>()->click();
    QVERIFY(!exported.exporter->busy());
    QVERIFY(!QFile::exists(exported.path));
    exported.path = exported.folder.filePath("no/such/folder.html");
    exported.finish();
    QVERIFY(exported.window->banner_text().contains("folder.html"));
  }

  // Uses a real browser, which ./check does not install; the nightly run does it where a browser is
  // found.
  void a_browser_steps_through_the_map() {
    if (qEnvironmentVariableIsEmpty("TRANSILLUM_BROWSER")) {
      QSKIP("nightly only");
    }
    QString browser;
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      browser = browser.isEmpty() ? QStandardPaths::findExecutable(name) : browser;
    }
    if (browser.isEmpty()) {
      QSKIP("no Chromium is installed");
    }
    Exported exported;
    exported.finish();
    QByteArray html = contents_of(exported.path);
    // The script clicks, and writes the visible polygons into the title.
    html.replace("</body>", R"(<script>
      document.querySelector('.on').click();
      document.title = document.querySelector('output').textContent + ': ' +
        [...document.querySelectorAll('svg.map polygon')].filter(
          p => getComputedStyle(p).display !== 'none').length;</script></body>)");
    const QString file = write_file(exported.folder.filePath("clicked.html"), html);
    QProcess process;
    process.start(browser,
                  {"--headless", "--no-sandbox", "--disable-gpu", "--dump-dom", "file://" + file});
    QVERIFY(process.waitForFinished(60000));
    const auto map = exported.window->focus.map();
    const auto polygons = map->record().map_after(4).size();  // the fifth step
    const QByteArray title = "<title>5 / 12: " + QByteArray::number(int(polygons)) + "</title>";
    QVERIFY2(process.readAllStandardOutput().contains(title), title.constData());
  }
};

const test::Registered registered("lesson_html", test::run_as_viewer<LessonHtmlTest>);

}  // namespace transillum::viewer::lesson_html_test

#include "lesson_html_test.moc"
