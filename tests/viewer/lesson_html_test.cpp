// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lessons exported as HTML: the file needs no other file, and has the pages, the maps and the
// answers.
#include <QAction>
#include <QDockWidget>
#include <QFile>
#include <QProcess>
#include <QProgressDialog>
#include <QPushButton>
#include <QRegularExpression>
#include <QSet>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTextDocument>
#include <set>
#include <string>

#include "lessons/lesson_html.h"
#include "lessons/lesson_panel.h"
#include "solved_window.h"
#include "test_files.h"
#include "transillum/at.h"
#include "window/files/lesson_export.h"

namespace transillum::viewer::lesson_html_test {

using namespace test;

namespace {

// Pages of panels that are no maps.
const char* const panel_lesson_text = R"({"title": "Panels", "pages": [
  {"title": "Charts", "text": "A sphere and a chart.",
   "show": {"scene": "cornell-box", "layout": "teach", "options": {"directions": 16},
            "solve": "finished", "select": 4, "panels": ["direction", "convergence"]}},
  {"title": "Algorithm", "text": "The algorithm.", "large": "algorithm",
   "show": {"focus": {"direction": 3, "step": 4}, "panels": ["map", "algorithm"]}},
  {"title": "Errors", "text": "Two sets.", "large": "error",
   "errors": [{"label": "Random", "with": {"sampling": "random", "one-way": true}},
              {"label": "Default"}],
   "show": {"focus": null, "panels": ["error"]}}]})";

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

/// The parts of a file that are pages.
QStringList sections_of(const QByteArray& html) {
  QStringList sections = QString::fromUtf8(html).split(QStringLiteral("<section>"));
  sections.removeFirst();
  return sections;
}

/// The words of four and more letters, without markup.
QSet<QString> words_of(const QString& text) {
  static const QRegularExpression word(QStringLiteral("[A-Za-z]{4,}"));
  QSet<QString> words;
  for (auto all = word.globalMatch(text); all.hasNext();) {
    words << all.next().captured().toLower();
  }
  return words;
}

/// A window with a lesson.
struct Exported {
  QTemporaryDir folder;
  std::unique_ptr<TestWindow> window = make_window();
  LessonExport* exporter = window->findChild<LessonExport*>();
  QString path = folder.filePath("lesson.html");

  explicit Exported(const char* text = lesson_text) {
    const QString file = write_file(folder.filePath("mine.json"), text);
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

  // Each page has its title, its words and its picture.
  void no_page_of_a_built_in_lesson_is_omitted() {
    for (const Lesson& lesson : built_in_lessons()) {
      std::vector<ShownPage> pages;
      for (const Lesson::Page& page : lesson.pages) {
        ShownPage shown;
        shown.page = page;
        shown.picture = "picture";
        shown.panels = {{"A <panel>", "its picture"}};
        pages.push_back(std::move(shown));
      }
      const QStringList sections =
          sections_of(lesson_html(QString::fromStdString(lesson.title), pages));
      QCOMPARE(sections.size(), int(lesson.pages.size()));
      for (int k = 0; k < sections.size(); ++k) {
        const Lesson::Page& page = at(lesson.pages, k);
        const QString title = QString::fromStdString(page.title);
        QVERIFY2(sections[k].startsWith("<h2>" + title.toHtmlEscaped()), qPrintable(title));
        QCOMPARE(count(sections[k].toUtf8(), "<img "), 2);
        QVERIFY(sections[k].contains("<figcaption>A &lt;panel&gt;</figcaption>"));
        QString text = web_text(page.text + (page.question ? page.question->ask : ""));
        text.remove(QRegularExpression("\\{[^}]*\\}|\\]\\([^)]*\\)"));
        const QSet<QString> words = words_of(text);
        QVERIFY2(words.size() > 5, qPrintable(title));
        QTextDocument shown;
        shown.setHtml(sections[k]);
        const QSet<QString> missing = words - words_of(shown.toPlainText());
        QVERIFY2(missing.isEmpty(), qPrintable(title + ": " + missing.values().join(' ')));
      }
    }
  }

  void exported_pages_have_what_the_window_shows() {
    const auto window = make_window();
    auto& lessons = *window->findChild<LessonPanel*>();
    constexpr int of_one_map = 3;  // "Building a visibility map"
    lessons.show_page(of_one_map, 0);
    auto* exporter = window->findChild<LessonExport*>();
    const QTemporaryDir folder;
    const QString path = folder.filePath("lesson.html");
    exporter->export_to(path);
    QVERIFY(wait_for([&] { return !exporter->busy(); }, 120000));
    const auto& pages = at(lessons.lessons(), of_one_map).pages;
    const QStringList sections = sections_of(contents_of(path));
    QCOMPARE(sections.size(), int(pages.size()));
    for (int k = 0; k < sections.size(); ++k) {
      const Lesson::Page& page = at(pages, k);
      const QByteArray section = sections[k].toUtf8();
      QVERIFY(section.contains(QByteArray::fromStdString(page.title)));
      QCOMPARE(count(section, "<img "), 1);
      QCOMPARE(count(section, "<svg class=\"map\"") > 0, page.state.focus.has_value());
      QCOMPARE(count(section, "<details>"), page.question ? 1 : 0);
    }
  }

  // All pages of all lessons have their pictures, maps and answers.
  void every_built_in_lesson_is_exported_data() {
    QTest::addColumn<int>("lesson");
    const std::vector<Lesson> lessons = built_in_lessons();
    for (int k = 0; k < static_cast<int>(lessons.size()); ++k) {
      QTest::newRow(at(lessons, k).title.c_str()) << k;
    }
  }
  void every_built_in_lesson_is_exported() {
    if (qEnvironmentVariableIsEmpty("TRANSILLUM_ALL_LESSONS")) {
      QSKIP("nightly only");
    }
    QFETCH(const int, lesson);
    const auto window = make_window();
    auto& lessons = *window->findChild<LessonPanel*>();
    lessons.show_page(lesson, 0);
    auto* exporter = window->findChild<LessonExport*>();
    const QTemporaryDir folder;
    const QString path = folder.filePath("lesson.html");
    exporter->export_to(path);
    QVERIFY(wait_for([&] { return !exporter->busy(); }, 600000));
    QCOMPARE(window->banner_text(), QString());
    const auto& pages = at(lessons.lessons(), lesson).pages;
    const QStringList sections = sections_of(contents_of(path));
    QCOMPARE(sections.size(), int(pages.size()));
    static const QRegularExpression picture("<img [^>]*base64,([^\"]*)\"");
    for (int k = 0; k < sections.size(); ++k) {
      const Lesson::Page& page = at(pages, k);
      const QByteArray section = sections[k].toUtf8();
      QVERIFY(section.contains(QString::fromStdString(page.title).toHtmlEscaped().toUtf8()));
      int pictures = 0;
      for (auto all = picture.globalMatch(sections[k]); all.hasNext(); ++pictures) {
        const QImage image =
            QImage::fromData(QByteArray::fromBase64(all.next().captured(1).toLatin1()));
        QVERIFY2(image.width() > 150 && color_count(image) > 3, page.title.c_str());
      }
      const std::set<std::string> panels(page.state.panels.begin(), page.state.panels.end());
      int expected = 1;  // the scene
      for (const char* panel : {"error", "lobe", "algorithm", "convergence", "direction", "tree"}) {
        expected += panels.contains(panel) ? 1 : 0;
      }
      QVERIFY2(pictures >= expected, page.title.c_str());
      QCOMPARE(count(section, "<svg class=\"map\"") > 0, page.state.focus.has_value());
      QCOMPARE(count(section, "<details>"), page.question ? 1 : 0);
    }
  }

  void panels_without_a_map_are_exported_as_pictures() {
    Exported exported(panel_lesson_text);
    exported.finish();
    const QByteArray html = contents_of(exported.path);
    const QString kept = qEnvironmentVariable("TRANSILLUM_PICTURES");
    if (!kept.isEmpty()) {
      QFile::copy(exported.path, kept + "/lesson-panels.html");
    }
    const QStringList sections = sections_of(html);
    QCOMPARE(sections.size(), 3);
    const std::vector<std::vector<const char*>> panels{
        {"direction", "convergence"}, {"algorithm"}, {"error"}};
    static const QRegularExpression figure(
        "<figure><img [^>]*base64,([^\"]*)\"><figcaption>([^<]*)</figcaption>");
    for (int k = 0; k < sections.size(); ++k) {
      auto figures = figure.globalMatch(sections[k]);
      for (const char* panel : at(panels, k)) {
        QVERIFY2(figures.hasNext(), panel);
        const auto one = figures.next();
        const auto* dock = exported.window->findChild<QDockWidget*>(QString(panel) + "_dock");
        QCOMPARE(one.captured(2), dock->windowTitle().toHtmlEscaped());
        const QImage image = QImage::fromData(QByteArray::fromBase64(one.captured(1).toLatin1()));
        QVERIFY2(image.width() > 150 && color_count(image) > 10, panel);
      }
      QVERIFY(!figures.hasNext());
    }
    QCOMPARE(count(sections[1].toUtf8(), "<svg class=\"map\""), 1);
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
