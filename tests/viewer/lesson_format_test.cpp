// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The format of lesson files: every key, its default, and the error for each mistake.
#include <QFile>
#include <QRegularExpression>
#include <QTest>
#include <functional>
#include <nlohmann/json.hpp>

#include "lessons/lesson.h"
#include "registered.h"
#include "test_files.h"
#include "transillum/errors.h"

namespace transillum::viewer::lesson_format_test {

namespace {

// A lesson of these pages.
std::string lesson(const std::string& pages) {
  return R"({"title": "T", "pages": [)" + pages + "]}";
}

QString description() {
  return QString::fromUtf8(test::contents_of(TRANSILLUM_SOURCE "/viewer/LESSON_FORMAT.md"));
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int k = 0; k < count; ++k) {
    all += text;
  }
  return all;
}

std::string page(const std::string& show) { return R"({"text": "x", "show": {)" + show + "}}"; }

}  // namespace

class LessonFormatTest : public QObject {
  Q_OBJECT

 private slots:
  void reads_every_key_of_a_page() {
    const Lesson l = lesson_from_text(
        lesson(page(R"("scene": "boards", "options": {"directions": 16, "two-way": false,
          "sampling": "random", "seed": 7, "first-shot": "auto", "max-patch-area": 0.5},
          "solve": 12, "focus": {"iteration": 2, "direction": 3, "step": 4, "phase": "split"},
          "select": 5, "camera": {"eye": [1, 2, 3], "target": [0, 0, 1], "up": [0, 0, 1],
          "angle": 40}, "colors": {"quantity": "irradiance", "range": [0.5, 2], "show": "luminance", "map": "cividis", "logarithmic": true, "gamma": 2.5,
          "exposure": -1.5},
          "outlines": true, "direction": false, "labels": true, "layout": "debug",
          "overlays": ["cuts", "smooth"], "algorithm": "global-map",
          "panels": ["map"])")),
        "a.json");
    QCOMPARE(l.title, std::string("T"));
    QCOMPARE(l.pages.size(), std::size_t{1});
    const ViewState& s = l.pages[0].state;
    QCOMPARE(s.scene, std::string("boards"));
    QCOMPARE(s.options.solve.directions, 16);
    QVERIFY(!s.options.solve.two_way);
    QVERIFY(s.options.solve.sampling == Sampling::random);
    QCOMPARE(s.options.solve.seed, std::uint64_t{7});
    QVERIFY(s.options.solve.first_shot.has_value());
    QCOMPARE(s.options.scene.max_patch_area, 0.5);
    QVERIFY(s.solve.kind == Goal::Kind::passes);
    QCOMPARE(s.solve.passes, 12);
    QVERIFY(s.focus.has_value());
    QCOMPARE(s.focus->iteration, 1);  // the window counts from 1
    QCOMPARE(s.focus->direction, 2);
    QCOMPARE(std::get<std::int32_t>(s.focus->step), 3);
    QVERIFY(s.focus->phase == Phase::split);
    QCOMPARE(s.selection, PatchId{5});
    QVERIFY(s.camera.has_value());
    QCOMPARE(s.camera->eye.z, 3.0);
    QVERIFY(s.color_mode == ColorMode::luminance && s.color_map == ColorMap::cividis);
    QVERIFY(s.quantity == Quantity::irradiance && s.range && s.range->second == 2);
    QVERIFY(s.range_rule == RangeRule::fixed && s.gamma == 2.5 && s.exposure == -1.5);
    QVERIFY(s.overlays == (std::vector{Overlay::cuts, Overlay::smooth}));
    QVERIFY(s.algorithm == MapKind::global);
    QVERIFY(s.logarithmic == true && s.labels && !s.direction_shown && s.outlines == true);
    QVERIFY(s.layout == Layout::debug);
    QCOMPARE(s.panels, std::vector<std::string>{"map"});
    // The state is the same after it is written and read again.
    const auto written = to_json(s);
    QCOMPARE(to_json(view_state_from_json(written, "w", "")).dump(), written.dump());
  }

  void a_page_keeps_the_state_of_the_page_before() {
    const Lesson l = lesson_from_text(
        lesson(page(R"("scene": "boards", "options": {"directions": 16}, "select": 3,
                       "layout": "teach")") +
               "," + page(R"("options": {"sampling": "random"}, "select": null)") + "," +
               page(R"("scene": "furnace")")),
        "a.json");
    const ViewState& second = l.pages[1].state;
    QCOMPARE(second.scene, std::string("boards"));
    QCOMPARE(second.options.solve.directions, 16);
    QVERIFY(second.options.solve.sampling == Sampling::random);
    QCOMPARE(second.selection, no_patch);
    // Another scene resets everything but the layout.
    const ViewState& third = l.pages[2].state;
    QCOMPARE(third.options.solve.directions, SolveOptions().directions);
    QVERIFY(third.layout == Layout::teach);
  }

  void a_text_may_be_a_list_of_lines() {
    const Lesson l =
        lesson_from_text(R"({"title": "T", "pages": [{"text": ["a", "", "b"]}]})", "a.json");
    QCOMPARE(l.pages[0].text, std::string("a\n\nb\n"));
  }

  void the_first_hour_is_five_lessons_in_order() {
    const auto& lessons = built_in_lessons();
    int places = 0;
    for (int k = 0; k < std::ssize(lessons); ++k) {
      const FirstHour hour = first_hour_of(lessons, k);
      QCOMPARE(hour.lessons, 5);
      QVERIFY2(std::abs(hour.minutes - 50) <= 2, qPrintable(QString::number(hour.minutes)));
      QVERIFY(hour.place == 0 || hour.place == ++places);
    }
    QCOMPARE(places, 5);
    QCOMPARE(first_hour_of(lessons, 0).place, 1);
    QCOMPARE(first_hour_of({}, 0).lessons, 0);
    const Lesson one = lesson_from_text(
        R"({"title": "T", "needs": "paper", "first-hour": true, "pages": [{"text": ""}]})",
        "a.json");
    QVERIFY(one.first_hour && one.needs == "paper");
  }

  void a_lesson_says_how_many_minutes_it_takes() {
    const std::string pages = R"("pages": [{"text": ""}]})";
    QCOMPARE(lesson_from_text(R"({"title": "T", "minutes": 12, )" + pages, "a.json").minutes, 12);
    QCOMPARE(lesson_from_text(R"({"title": "T", )" + pages, "a.json").minutes, 0);
    for (const Lesson& built_in : built_in_lessons()) {
      QVERIFY2(built_in.minutes >= 5 && built_in.minutes <= 30, built_in.title.c_str());
    }
  }

  void errors_name_file_page_and_key_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, const std::string& text, const char* expected) {
      QTest::newRow(name) << QString::fromStdString(text) << QString(expected);
    };
    row("no JSON", "{\n\"title\": \"T\"\n\"pages\": []}", "bad.json, line 3, column 7: ");
    row("empty", "", "bad.json: an empty file");
    row("deep", lesson(page("\"panels\": " + repeated("[", 2'000'000) + repeated("]", 2'000'000))),
        "more than 64 lists and objects inside each other");
    row("number", lesson(page(R"("select": 1e999)")), "the number `1e999` is out of range");
    row("twice", lesson(page(R"("select": 1, "select": 2)")), "the key `select` occurs twice");
    row("long key", lesson(page("\"" + repeated("k", 1000) + "\\n\": 1")), "unknown key \"kkkk");
    row("much",
        lesson(page("\"panels\": [\"" + repeated("p", 100'000) + "\"]") +
               repeated(", {\"text\": \"\"}", 200)),
        "too much: the pages up to here set more than 16 MiB together");
    row("many pages", lesson(page("") + repeated(",{\"text\":\"\"}", 300'000)), "too much: ");
    row("no object", "[]", "bad.json: must be an object");
    row("no title", R"({"pages": []})", "bad.json, title: is missing");
    row("no pages", R"({"title": "T"})", "bad.json, pages: ");
    row("minutes", R"({"title": "T", "minutes": 0, "pages": [{"text": ""}]})",
        "bad.json, minutes: ");
    row("empty pages", R"({"title": "T", "pages": []})", "bad.json, pages: ");
    row("unknown key", R"({"title": "T", "page": 3, "pages": [{"text": ""}]})", "\"page\"");
    row("page no object", lesson("3"), "bad.json, page 1: must be an object");
    row("no text", lesson("{}"), "bad.json, page 1, text: is missing");
    row("text a number", lesson(R"({"text": 3})"), "bad.json, page 1, text: ");
    row("line a number", lesson(R"({"text": ["a", 3]})"), "bad.json, page 1, text: ");
    // Qt took 40 s to lay out such a text.
    row("long text", lesson("{\"text\": \"" + repeated("a *b* ", 300'000) + "\"}"),
        "page 1, text: must have at most 65536 bytes; it has 1800000");
    row("marks", lesson(R"({"text": "a [[b [[c]]"})"),
        "page 1, text: must have one ]] after each [[");
    row("end mark", lesson(R"({"text": "a ]] b"})"), "must have one ]] after each [[");
    row("show a list", lesson(R"({"text": "", "show": []})"), "bad.json, page 1, show: ");
    row("second page", lesson(page("") + "," + page(R"("selct": 3)")),
        "page 2: unknown key \"selct\"");
    row("type", lesson(page(R"("scene": 3)")), "page 1, scene: must be a string");
    row("directions", lesson(page(R"("options": {"directions": 0})")),
        "page 1, options, directions: ");
    row("half", lesson(page(R"("options": {"directions": 1.5})")), "options, directions: ");
    row("huge", lesson(page(R"("options": {"directions": 1e99})")), "options, directions: ");
    row("seed", lesson(page(R"("options": {"seed": -1})")), "options, seed: ");
    row("sampling", lesson(page(R"("options": {"sampling": "fibonaci"})")), "options, sampling: ");
    row("option", lesson(page(R"("options": {"direction": 3})")),
        "options: unknown key \"direction\"");
    row("area", lesson(page(R"("options": {"max-patch-area": -1})")), "max-patch-area: ");
    row("tolerance", lesson(page(R"("options": {"tolerance": -1})")), "options, tolerance: ");
    row("solve", lesson(page(R"("solve": "now")")), "page 1, solve: ");
    row("solve half", lesson(page(R"("solve": 0.5)")), "page 1, solve: ");
    row("focus", lesson(page(R"("focus": {"direction": 0})")), "page 1, focus, direction: ");
    row("step", lesson(page(R"("focus": {"step": "third"})")), "page 1, focus, step: ");
    row("phase", lesson(page(R"("focus": {"phase": 1})")), "page 1, focus, phase: ");
    row("select", lesson(page(R"("select": -1)")), "page 1, select: ");
    row("eye", lesson(page(R"("camera": {"eye": [1, 2]})")), "page 1, camera, eye: ");
    row("same", lesson(page(R"("camera": {"eye": [1, 2, 3], "target": [1, 2, 3]})")), "camera: ");
    row("angle", lesson(page(R"("camera": {"angle": 0})")), "page 1, camera, angle: ");
    row("quantity", lesson(page(R"("colors": {"quantity": "light"})")), "colors, quantity: ");
    row("range", lesson(page(R"("colors": {"range": [1]})")), "colors, range: ");
    row("rule", lesson(page(R"("colors": {"range-rule": "wide"})")), "colors, range-rule: ");
    row("no range", lesson(page(R"("colors": {"range-rule": "fixed"})")), "colors, range-rule: ");
    row("no rule", lesson(page(R"("colors": {"range-rule": "automatic", "range": [1, 2]})")),
        "colors, range-rule: ");
    row("gamma", lesson(page(R"("colors": {"gamma": 0})")), "colors, gamma: ");
    row("exposure", lesson(page(R"("colors": {"exposure": 1e9})")), "colors, exposure: ");
    row("overlays", lesson(page(R"("overlays": "cuts")")), "page 1, overlays: ");
    row("overlay", lesson(page(R"("overlays": ["cut"])")), "page 1, overlays: ");
    row("algorithm", lesson(page(R"("algorithm": "local")")), "page 1, algorithm: ");
    row("layout", lesson(page(R"("layout": "debugging")")), "page 1, layout: ");
    row("panels", lesson(page(R"("panels": "map")")), "page 1, panels: ");
    const auto control = [](const std::string& one) {
      return lesson(R"({"text": "{a}", "controls": {"a": )" + one + "}}");
    };
    row("control", control("{}"), "page 1, controls, a: needs one of");
    row("no such option", control(R"({"option": "mass", "values": [1, 2]})"),
        "controls, a, values");
    row("one value", control(R"({"option": "directions", "values": [1]})"), "controls, a, values");
    row("option of the scene", control(R"({"option": "max-patch-area", "values": [1, 2]})"),
        "controls, a, option: ");
    row("labels", control(R"({"option": "directions", "values": [1, 2], "labels": ["a"]})"),
        "controls, a, labels: ");
    row("range", control(R"({"reflectance": "white", "to": 2})"), "controls, a, to: ");
    row("callout", R"({"title": "T", "pages": [{"text": "", "callouts": [{"text": "a"}]}]})",
        "page 1, callouts: needs one of");
    row("callout without text",
        R"({"title": "T", "pages": [{"text": "", "callouts": [{"patch": 1}]}]})",
        "page 1, callouts, text: ");
    row("errors", R"({"title": "T", "pages": [{"text": "", "errors": []}]})", "page 1, errors: ");
    row("focus of control", control(R"({"focus": "phase"})"), "controls, a, focus: ");
    row("not in the text", lesson(R"({"text": "a", "controls": {"a": {"focus": "step"}}})"),
        "controls, a: \"{a}\" must be in the text once");
  }
  void errors_name_file_page_and_key() {
    QFETCH(QString, text);
    QFETCH(QString, expected);
    try {
      lesson_from_text(text.toStdString(), "bad.json");
      QFAIL("the lesson was accepted");
    } catch (const InputError& error) {
      const QString message = error.what();
      QVERIFY2(message.startsWith("bad.json") && message.contains(expected), qPrintable(message));
      QVERIFY2(!message.contains('\n'), qPrintable(message));
    }
  }

  void a_missing_file_is_an_error() {
    QVERIFY_EXCEPTION_THROWN(read_lesson("/no/such/lesson.json"), InputError);
  }

  void files_have_every_option_of_the_run() {
    const nlohmann::json defaults = to_json(RunOptions{});
    for (const Option& option : options()) {
      const bool stored = option.in_files && !option.reads_scene && option.section != "Machine";
      QCOMPARE(defaults.contains(option.name), stored);
    }
    QVERIFY(run_options_from_json(defaults, "d") == RunOptions{});
  }

  void the_example_in_the_description_is_a_lesson() {
    static const QRegularExpression block(QStringLiteral("```json\n(.*?)```"),
                                          QRegularExpression::DotMatchesEverythingOption);
    const auto example = block.match(description());
    QVERIFY(example.hasMatch());
    int others = 0;
    for (auto all = block.globalMatch(description()); all.hasNext(); ++others) {
      const QString text = all.next().captured(1);
      QVERIFY(!lesson_from_text(text.toStdString(), "example").pages.empty());
    }
    QVERIFY(others >= 3);
    const Lesson l = lesson_from_text(example.captured(1).toStdString(), "example");
    QCOMPARE(l.pages.size(), std::size_t{2});
    QCOMPARE(l.pages[1].state.selection, PatchId{16});
    QVERIFY(l.pages[1].state.focus && l.pages[1].state.focus->phase == Phase::split);
  }

  // Every key that the program writes; each value of a list in the file is an example.
  void every_key_is_described() {
    ViewState state;
    state.options.solve.rotation = 1;
    state.focus = FocusChoice();
    state.selection = 1;
    state.camera = ViewPoint();
    state.range = {0, 1};
    state.exposure = 0;
    state.outlines = true;
    state.overlays = {Overlay::normals};
    state.materials = {{"lamp", Rgb{0.5, 0.5, 0.5}, Rgb{1, 1, 1}}};
    state.options.input.changes = state.materials;
    state.layout = Layout::teach;
    state.panels = {"map"};
    const QString text = description();
    int keys = 0;
    const std::function<void(const nlohmann::json&)> check = [&](const nlohmann::json& value) {
      for (const auto& [key, inner] : value.items()) {
        if (value.is_object()) {
          ++keys;
          const QString name = QString::fromStdString(key);
          QVERIFY2(text.contains('`' + name + '`') || text.contains('"' + name + '"'), key.c_str());
        }
        if (inner.is_structured()) {
          check(inner);
        }
      }
    };
    check(to_json(state));
    QVERIFY(keys > 45);
  }

  void unknown_panels_are_errors() {
    const Lesson l = lesson_from_text(lesson(page(R"("panels": ["map", "mop"])")), "a.json");
    QVERIFY_EXCEPTION_THROWN(check_panels(l, "a.json", {"map"}), InputError);
    check_panels(l, "a.json", {"map", "mop"});
  }
};

const test::Registered registered("lesson_format", test::run_without_widgets<LessonFormatTest>);

}  // namespace transillum::viewer::lesson_format_test

#include "lesson_format_test.moc"
