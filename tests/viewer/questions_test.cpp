// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Questions of lessons: that every built-in one has a computed and plausible answer, and answering,
// revealing, counting and undoing in the window.
#include <QAction>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRadioButton>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QToolButton>
#include <cmath>

#include "lessons/computed_values.h"
#include "lessons/lesson_panel.h"
#include "lessons/question_box.h"
#include "scene/error_view.h"
#include "solved_window.h"
#include "stepping/play_control.h"
#include "test_files.h"
#include "transillum/at.h"

namespace transillum::viewer::questions_test {

using namespace test;

namespace {

std::shared_ptr<const LoadedScene> loaded_for(const ViewState& page) {
  auto loaded = std::make_shared<LoadedScene>();
  const SceneDescription description = describe_scene(page.scene, page.options.input.read);
  loaded->description = std::make_shared<const SceneDescription>(description);
  loaded->scene = std::make_shared<const Scene>(description, page.options.scene);
  loaded->tree = std::make_shared<const BspTree>(*loaded->scene);
  return loaded;
}

// A page of the furnace with one question.
std::string page_with(const std::string& question) {
  return R"({"title": "T", "pages": [{"text": "x", "show": {"scene": "furnace", "layout": "teach",
    "options": {"directions": 32, "sampling": "fibonacci"}, "focus": {"direction": 8}},
    "question": )" +
         question + "}]}";
}

Solved solved(const std::string& question) {
  const Lesson lesson = lesson_from_text(page_with(question), "q.json");
  ComputedValues computed(loaded_for(lesson.pages[0].state), {});
  return solve_question(*lesson.pages[0].question, computed);
}

double value_of(const std::string& wanted) {
  return solved(R"({"kind": "number", "ask": "?", "answer": )" + wanted + "}").value;
}

/// A window that shows a lesson from a file in a folder of its own, with tallies in another.
struct Class {
  QTemporaryDir folder, data;
  std::unique_ptr<TestWindow> window = make_window();
  LessonPanel* panel = window->findChild<LessonPanel*>();
  QuestionBox* box = window->findChild<QuestionBox*>();

  Class() { panel->set_tally_folder(data.path() + "/tallies"); }
  bool settles() {
    return wait_for([this] { return window->settled(); }) &&
           wait_for([this] { return window->settled(); });
  }
  void open(const std::string& lesson) {
    const QString file = write_file(folder.filePath("mine.json"), lesson.c_str());
    window->files().try_open(file);
    QVERIFY(settles());
  }
  void open_built_in(int lesson, int page) {
    window->files().open_lesson(std::to_string(lesson), page);
    QVERIFY(settles());
  }
  QAction* action(const char* name) const { return window->findChild<QAction*>(name); }
  QString text(const char* name) const { return window->findChild<QLabel*>(name)->text(); }
  void reveal() {
    action("question_reveal")->trigger();
    QVERIFY(wait_for([this] { return box->solved() != nullptr; }));
  }
  int counted(const QString& answer) const { return counts().value(answer); }
  // The counts in the file.
  QMap<QString, int> counts() const {
    QMap<QString, int> all;
    for (const QString& name : QStringList{folder.filePath("mine.tally.json")}) {
      if (!QFile::exists(name)) {
        continue;
      }
      const Tally tally(name);
      for (const auto& [answer, count] : tally.of(0, *panel->lessons()[0].pages[0].question)) {
        all[QString::fromStdString(answer)] = count;
      }
    }
    return all;
  }
};

const char* const boards_question = R"({"kind": "choice", "ask": "Which?", "choices": [
  {"text": "few", "value": 0.5}, {"text": "as many", "value": 1}, {"text": "many", "value": 2}],
  "answer": {"nearest": {"figure": "ratio", "of": [{"figure": "steps"}, {"figure": "patches"}]}},
  "then": "That is all."})";

}  // namespace

class QuestionsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_question_about_a_direction_hides_the_values_of_its_steps() {
    Class room;
    const auto ask = [](const QString& wanted) {
      const QString lesson = R"({"title": "T", "pages": [{"text": "", "show": {"layout": "teach",
        "scene": "cornell-box", "options": {"directions": 8}, "panels": ["algorithm"],
        "focus": {"direction": 3, "step": "exchange"}},
        "question": {"kind": "number", "ask": "How many?", "answer": {"figure": "%1"}}}]})";
      return lesson.arg(wanted).toStdString();
    };
    const auto* algorithm = room.window->findChild<QWidget*>("algorithm_dock");
    const auto* value = room.window->findChild<QLabel*>("value_j");
    const auto* note = room.window->findChild<QLabel*>("values_hidden");
    const auto hidden = [&] { return note->isVisible() && !value->isVisible(); };
    const auto shown = [&] { return !note->isVisible() && value->isVisible(); };
    room.open(ask("polygons"));
    QTRY_VERIFY(algorithm->isVisible());
    QTRY_VERIFY(hidden());
    room.reveal();
    QTRY_VERIFY(shown());
    room.action("question_reveal")->trigger();  // asks again
    QTRY_VERIFY(hidden());
    room.open(ask("patches"));  // not about the direction
    QTRY_VERIFY(shown());
    room.open(ask("steps"));
    QTRY_VERIFY(hidden());
    room.window->files().open_scene("furnace");
    QTRY_VERIFY(shown());
  }

  void every_lesson_asks() {
    for (const Lesson& lesson : built_in_lessons()) {
      const auto asking = std::count_if(lesson.pages.begin(), lesson.pages.end(),
                                        [](const auto& page) { return page.question.has_value(); });
      QVERIFY2(asking >= 2, lesson.title.c_str());
    }
  }

  void every_answer_is_computed_and_plausible_data() {
    QTest::addColumn<int>("lesson");
    QTest::addColumn<int>("page");
    for (std::size_t l = 0; l < built_in_lessons().size(); ++l) {
      const auto& pages = built_in_lessons()[l].pages;
      for (std::size_t k = 0; k < pages.size(); ++k) {
        if (pages[k].question) {
          QTest::addRow("lesson %d, page %d", int(l + 1), int(k + 1)) << int(l) << int(k);
        }
      }
    }
  }
  // Something is right, something is wrong, and it does not depend on the last digit.
  void every_answer_is_computed_and_plausible() {
    QFETCH(int, lesson);
    QFETCH(int, page);
    const Lesson::Page& shown = at(at(built_in_lessons(), lesson).pages, page);
    const Question& question = *shown.question;
    const auto loaded = loaded_for(shown.state);
    ComputedValues computed(loaded, {});
    const Solved solved = solve_question(question, computed);
    QString found = QString("value %1; right").arg(solved.value);
    for (const int k : solved.right) {
      found += QString(" %1").arg(k);
    }
    for (std::size_t k = 0; k < solved.values.size(); ++k) {
      found += QString("; %1: %2").arg(k).arg(solved.values[k]);
    }
    qInfo().noquote() << found;
    switch (question.kind) {
      case Question::Kind::choice:
        QVERIFY(!solved.right.empty() && solved.right.size() < question.choices.size());
        break;
      case Question::Kind::patch: {
        QVERIFY(solved.values.size() == std::size_t(loaded->scene->patch_count()));
        QVERIFY(!solved.right.empty() && solved.right.size() <= 2);  // two walls may be alike
        std::vector<double> sorted = solved.values;
        std::sort(sorted.begin(), sorted.end());
        QVERIFY(sorted[sorted.size() - 1 - solved.right.size()] < 0.95 * sorted.back());
        break;
      }
      case Question::Kind::number:
        QVERIFY(std::isfinite(solved.value) && solved.value > 0);
        QVERIFY(is_right(question, solved, {.number = solved.value}));
        QVERIFY(!is_right(question, solved, {.number = 3 * solved.value}));
        break;
      case Question::Kind::area: {
        QVERIFY(solved.value > 0 && !solved.region.empty());
        GivenAnswer box;  // the bounding box of the region is not right, nor is an empty region
        Vec2 low = solved.region[0][0], high = low;
        for (const auto& part : solved.region) {
          for (const Vec2& p : part) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
          }
        }
        const double area = (high.x - low.x) * (high.y - low.y);
        QVERIFY(std::abs(overlap(solved.region, {low, {high.x, low.y}, high, {low.x, high.y}}) -
                         solved.value / area) < 0.02);
        break;
      }
    }
  }

  // In the furnace, the values are known: six faces of a cube inside six faces of another.
  void lesson_values_are_known() {
    QCOMPARE(value_of(R"({"figure": "patches"})"), 12.0);
    QCOMPARE(value_of(R"({"figure": "steps"})"), 12.0);
    QCOMPARE(value_of(R"({"figure": "directions"})"), 64.0);
    // The scene is closed: the areas that a patch sees add up to its projection, the form factors
    // to about 1.
    for (int i = 0; i < 12; ++i) {
      const std::string n = std::to_string(i);
      const double seen =
          value_of(R"({"figure": "visible-area", "others": "all", "patch": )" + n + "}");
      const double whole = value_of(R"({"figure": "projected-area", "patch": )" + n + "}");
      QVERIFY(seen == 0 || std::abs(seen / whole - 1) < 1e-9);
      const double sum =
          value_of(R"({"figure": "form-factor", "others": "all", "patch": )" + n + "}");
      const double sums = value_of(R"({"figure": "form-factor-sum", "patch": )" + n + "}");
      QVERIFY(std::abs(sum - sums) < 1e-9 && std::abs(sum - 1) < 0.2);
    }
    // B of the furnace is E/(1 - rho), everywhere.
    const double e = value_of(R"({"figure": "exitance", "patch": 3})");
    const double rho = value_of(R"({"figure": "reflectance", "patch": 3})");
    const double b = value_of(R"({"figure": "radiosity", "patch": 3})");
    QVERIFY2(std::abs(b * (1 - rho) / e - 1) < 0.2, qPrintable(QString::number(b)));
    QVERIFY(value_of(R"({"figure": "rms-error"})") <
            value_of(R"({"figure": "rms-error", "with": {"sampling": "random"}})"));
    QCOMPARE(value_of(R"({"figure": "ratio", "of": [3, {"figure": "patches"}]})"), 0.25);
    // Against itself, and against other patches.
    QCOMPARE(value_of(R"({"figure": "function-error", "with": {"basis": "linear"},
        "patch-area": 1, "reference-area": 1})"),
             0.0);
    // All patches of the furnace emit, so that B - E of all patches counts. B - E is uniform up to
    // the error of the directions.
    const double error = value_of(R"({"figure": "function-error", "reference-area": 1})");
    QVERIFY2(error > 0 && error < 1e-3, qPrintable(QString::number(error)));
    QVERIFY(value_of(R"({"figure": "jump", "patch": 3})") >= 0);
  }

  void overlap_is_the_common_part_over_the_union() {
    const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<std::vector<Vec2>> halves{{{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}},
                                                {{0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}}};
    QVERIFY(std::abs(overlap(halves, square) - 1) < 0.01);
    QVERIFY(std::abs(overlap({halves[0]}, square) - 0.5) < 0.01);
    const std::vector<Vec2> moved{{0.5, 0}, {1.5, 0}, {1.5, 1}, {0.5, 1}};
    QVERIFY(std::abs(overlap(halves, moved) - 1.0 / 3) < 0.01);
    QCOMPARE(overlap(halves, {{2, 2}, {3, 2}, {3, 3}}), 0.0);
    QCOMPARE(overlap(halves, {}), 0.0);
  }

  // Predict, reveal, see what is right, ask again; the tally is beside the lesson, and undone.
  void a_choice_is_predicted_revealed_and_counted() {
    Class room;
    room.open(page_with(boards_question));
    QVERIFY(room.box->isVisible());
    QVERIFY(!room.window->findChild<QTextBrowser*>("lesson_text")->toPlainText().contains("That"));
    QVERIFY(!room.action("question_count")->isEnabled());
    auto* wrong = room.window->findChild<QRadioButton*>("choice_3");
    wrong->click();
    room.action("question_count")->trigger();
    QCOMPARE(room.counted("many"), 1);
    QVERIFY(!wrong->isChecked());  // the next answer
    wrong->click();
    room.reveal();
    QVERIFY(room.text("question_result").contains("Not this time"));
    QCOMPARE(room.counted("many"), 2);
    QVERIFY(room.window->findChild<QTextBrowser*>("lesson_text")->toPlainText().contains("That"));
    QVERIFY(!wrong->isEnabled());
    room.action("question_reveal")->trigger();
    QVERIFY(room.box->solved() == nullptr && wrong->isEnabled());
    room.window->findChild<QRadioButton*>("choice_2")->click();
    room.reveal();
    QVERIFY(room.text("question_result").contains("Right"));
    QCOMPARE(room.counts(), (QMap<QString, int>{{"many", 2}, {"as many", 1}}));
    save_picture(*room.window, "question-revealed");
    room.action("dark")->trigger();
    room.window->resize(1280, 720);
    save_picture(*room.window, "question-dark-small");
    room.action("dark")->trigger();
    room.action("question_reset")->trigger();
    QVERIFY(room.counts().isEmpty() && !room.action("question_reset")->isEnabled());
    room.action("undo")->trigger();
    QCOMPARE(room.counted("many"), 2);
    room.action("undo")->trigger();
    QCOMPARE(room.counted("as many"), 0);
  }

  void a_patch_is_clicked() {
    Class room;
    std::vector<Callout> callouts;
    QObject::connect(room.panel, &LessonPanel::callouts_shown, room.panel,
                     [&](const std::vector<Callout>& shown) { callouts = shown; });
    room.open_built_in(1, 2);
    QVERIFY(!is_given(*at(room.panel->lessons(), 0).pages[1].question, room.box->answer()));
    // The lamp is drawn somewhere in the scene: found by its pixels, as a student would.
    auto* view = room.window->findChild<SceneView*>();
    const QPoint lamp = [&] {
      const QSize size = view->canvas()->size();
      for (int y = 0; y < size.height(); y += 4) {
        for (int x = 0; x < size.width(); x += 4) {
          if (view->patch_at({x, y}) == 12) {
            return QPoint(x, y);
          }
        }
      }
      return QPoint(-1, -1);
    }();
    QVERIFY2(lamp.x() >= 0, "the lamp cannot be seen");
    QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, lamp);
    QTRY_COMPARE(room.box->answer().patch, PatchId{12});
    room.reveal();
    QVERIFY(room.text("question_result").contains("Right"));
    QVERIFY(room.settles());
    QVERIFY(room.window->colors.quantity() == Quantity::radiosity);  // the page reveals it
    // Sphere and text are about the patch of the page; a callout names the answer.
    QCOMPARE(room.window->selection.patch(), PatchId{16});
    const auto marks = [&](PatchId patch) {
      return std::any_of(callouts.begin(), callouts.end(), [&](const Callout& callout) {
        return callout.text == "the answer" && callout.patch == patch;
      });
    };
    QVERIFY(marks(12));
    room.action("question_reveal")->trigger();
    QVERIFY(room.settles());
    QVERIFY(room.window->colors.quantity() == Quantity::reflectance);
    QVERIFY(!marks(12));
    room.window->selection.select(3);
    room.reveal();
    QVERIFY(room.text("question_result").contains("Not this time"));
    QVERIFY(room.text("question_result").contains("Patch 3 has 0 W/m²."));
    QCOMPARE(room.window->selection.patch(), PatchId{16});
    QVERIFY(marks(12));
  }

  void a_page_stops_the_play() {
    Class room;
    room.open_built_in(4, 3);
    PlayControl& play = *room.window->findChild<PlayControl*>();
    play.action()->trigger();
    QVERIFY(play.playing());
    room.open_built_in(4, 2);
    QVERIFY(!play.playing() && !play.action()->isChecked());
  }

  void no_board_is_first() {
    Class room;
    room.open_built_in(5, 1);
    room.window->findChild<QRadioButton*>("choice_6")->click();
    room.reveal();
    QVERIFY(room.text("question_result").contains("Right"));
    QCOMPARE(room.box->solved()->right, std::vector<int>{5});
    // A built-in lesson has its tally in the data folder.
    QCOMPARE(QDir(room.data.path() + "/tallies").entryList(QDir::Files).size(), 1);
  }

  void a_number_is_guessed() {
    Class room;
    room.open(page_with(R"({"kind": "number", "ask": "How much?", "unit": "%", "within": 0.05,
      "answer": {"figure": "ratio", "of": [{"figure": "patches"}, {"figure": "steps"}]}})"));
    auto* number = room.window->findChild<QLineEdit*>("question_number");
    QTest::keyClicks(number, "80");
    QTest::keyClick(number, Qt::Key_Return);
    QVERIFY(wait_for([&] { return room.box->solved() != nullptr; }));
    QVERIFY(room.text("question_result").contains("Not this time"));
    QVERIFY(room.text("question_result").contains("100 %"));
    QVERIFY(room.text("question_result").contains("Your number is 0.8 times this."));
    room.action("question_reveal")->trigger();
    // The number has a decimal comma.
    QTest::keyClicks(number, "104,5");
    room.reveal();
    QVERIFY(room.text("question_result").contains("Right"));
  }

  // The corners of the program's own region, clicked in the map.
  void an_area_is_drawn_in_the_map() {
    Class room;
    room.open(page_with(R"({"kind": "area", "ask": "Draw it", "unit": "m²", "within": 0.8,
      "answer": {"figure": "projected-area", "patch": 6}})"));
    const auto& page = room.panel->lessons()[0].pages[0];
    ComputedValues computed(loaded_for(page.state), {});
    const std::vector<Vec2> corners = solve_question(*page.question, computed).region.at(0);
    auto* canvas = room.window->findChild<MapCanvas*>("map_canvas");
    const auto click = [&](const Vec2& p) {
      // point_at() is linear in the position.
      const Vec2 o = *canvas->point_at({0, 0}), e = *canvas->point_at({100, 100});
      const QPointF position(100 * (p.x - o.x) / (e.x - o.x), 100 * (p.y - o.y) / (e.y - o.y));
      QTest::mouseClick(canvas, Qt::LeftButton, {}, position.toPoint());
    };
    click({0, 0});
    QTRY_COMPARE(room.box->answer().outline.size(), std::size_t{1});
    auto* drop = room.window->findChild<QToolButton*>("question_drop");
    QCOMPARE(drop->shortcut(), QKeySequence(Qt::Key_Backspace));
    drop->click();
    QTRY_VERIFY(room.box->answer().outline.empty());
    for (const Vec2& p : corners) {
      click(p);
    }
    QTRY_COMPARE(room.box->answer().outline.size(), corners.size());
    room.reveal();
    QVERIFY2(room.text("question_result").contains("Right"),
             qPrintable(room.text("question_result")));
    const Solved& result = *room.box->solved();
    QVERIFY(result.region.size() == 1 && result.value > 0);
    save_picture(*room.window, "question-area");
  }

  void another_scene_is_reported() {
    Class room;
    room.open(page_with(boards_question));
    room.window->files().open_scene("cornell-box");
    QVERIFY(wait_for([&] { return room.window->scene.spec() == "cornell-box"; }));
    QVERIFY(room.settles());
    room.action("question_reveal")->trigger();
    QVERIFY(room.window->banner_text().contains("not open"));
    QVERIFY(room.box->solved() == nullptr);
  }

  void a_damaged_tally_is_reported_and_kept() {
    Class room;
    const QByteArray damaged = "{\"tally\": 3}";
    const QString file = write_file(room.folder.filePath("mine.tally.json"), damaged);
    room.open(page_with(boards_question));
    QVERIFY(room.window->banner_text().contains("mine.tally.json"));
    room.window->findChild<QRadioButton*>("choice_1")->click();
    room.action("question_count")->trigger();
    QVERIFY(room.text("question_counts").contains("1 answer"));
    QCOMPARE(contents_of(file), damaged);
  }

  // Random, Hammersley and the default, on one scale: the pictures get darker in this order.
  void errors_are_shown_side_by_side() {
    Class room;
    const auto& pages = built_in_lessons()[5].pages;
    const auto page = std::find_if(pages.begin(), pages.end(),
                                   [](const auto& one) { return !one.errors.runs.empty(); });
    QVERIFY(page != pages.end());
    room.open_built_in(6, int(page - pages.begin()) + 1);
    auto* view = room.window->findChild<ErrorView*>();
    QTRY_VERIFY_WITH_TIMEOUT(view->result(), 60000);
    const ErrorView::Result& result = *view->result();
    QCOMPARE(result.rms.size(), std::size_t{3});
    QVERIFY(result.rms[0] > 4 * result.rms[1] && result.rms[1] > 2 * result.rms[2]);
    const auto brightness = [&](std::size_t k) {
      double sum = 0;
      const QImage& image = result.pictures[k];
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          sum += image.pixelColor(x, y).value();
        }
      }
      return sum;
    };
    QVERIFY(brightness(0) > 1.5 * brightness(1) && brightness(1) > 1.02 * brightness(2));
    save_picture(*room.window, "lesson-errors");
    // On another page, nothing is measured until the user asks; a click stops the measurement.
    room.open_built_in(1, 1);
    QVERIFY(!view->result());
    room.window->views().docks.bring_to_front("error");
    auto* button = view->findChild<QPushButton*>("measure_errors");
    QTRY_VERIFY(button->isVisible());
    button->click();
    QTRY_VERIFY_WITH_TIMEOUT(view->result(), 60000);
    QCOMPARE(view->result()->rms.size(), std::size_t{3});
    button->click();
    QCOMPARE(button->text(), QString("Stop"));
    button->click();
    QVERIFY(!view->result() && button->text() == "Measure the errors");
  }

  void errors_can_be_measured_once_there_is_a_run() {
    Class room;
    auto* button = room.window->findChild<QPushButton*>("measure_errors");
    QVERIFY(!button->isEnabled());
    room.window->open("flatland");
    QTRY_VERIFY(button->isEnabled());
  }

  void mistakes_name_the_key_data() {
    QTest::addColumn<QString>("question");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, const char* question, const char* expected) {
      QTest::newRow(name) << QString::fromUtf8(question) << QString(expected);
    };
    row("kind", R"({"kind": "riddle", "ask": "?"})", "question, kind: ");
    row("ask", R"({"kind": "number", "answer": {"figure": "patches"}})", "question, ask: ");
    row("answer", R"({"kind": "number", "ask": "?"})", "question, answer: ");
    row("typed in", R"({"kind": "number", "ask": "?", "answer": 12})", "must be computed");
    row("choices", R"({"kind": "choice", "ask": "?", "choices": [], "answer": "largest"})",
        "question, choices: ");
    row("figure", R"({"kind": "number", "ask": "?", "answer": {"figure": "luck"}})",
        "question, answer, figure: ");
    row("a patch is missing",
        R"({"kind": "number", "ask": "?", "answer": {"figure": "radiosity"}})", "one number");
    row("no patch to find", R"({"kind": "patch", "ask": "?", "answer":
        {"largest": {"figure": "radiosity", "patch": 1}}})",
        "omit the patch");
    row("no region", R"({"kind": "area", "ask": "?", "answer": {"figure": "patches"}})",
        "visible-area");
    row("option", R"({"kind": "number", "ask": "?", "answer":
        {"figure": "iterations", "with": {"directons": 3}}})",
        "answer, with");
    row("scene option", R"({"kind": "number", "ask": "?", "answer":
        {"figure": "iterations", "with": {"max-patch-area": 3}}})",
        "not of the scene");
    row("reference", R"({"kind": "number", "ask": "?", "answer": {"figure": "function-error"}})",
        "reference-area");
    row("within", R"({"kind": "number", "ask": "?", "within": 0, "answer": {"figure": "steps"}})",
        "question, within: ");
    row("show", R"({"kind": "number", "ask": "?", "answer": {"figure": "steps"},
        "show": {"scene": "stars"}})",
        "question, show: ");
    row("unknown key", R"({"kind": "number", "ask": "?", "answer": {"figure": "steps"}, "x": 1})",
        "unknown key");
  }
  void mistakes_name_the_key() {
    QFETCH(QString, question);
    QFETCH(QString, expected);
    try {
      lesson_from_text(page_with(question.toStdString()), "q.json");
      QFAIL("the question was accepted");
    } catch (const InputError& error) {
      const QString message = error.what();
      QVERIFY2(message.startsWith("q.json, page 1, question"), qPrintable(message));
      QVERIFY2(message.contains(expected), qPrintable(message));
    }
  }

  void patches_and_directions_that_do_not_exist_are_errors() {
    QVERIFY_EXCEPTION_THROWN(value_of(R"({"figure": "area", "patch": 99})"), InputError);
    QVERIFY_EXCEPTION_THROWN(value_of(R"({"figure": "steps", "direction": 99})"), InputError);
    QVERIFY_EXCEPTION_THROWN(value_of(R"({"figure": "estimated-error"})"), InputError);
  }

  void every_lesson_value_is_described() {
    const QString text = QString::fromUtf8(
        contents_of(QStringLiteral(TRANSILLUM_SOURCE "/viewer/LESSON_FORMAT.md")));
    for (const std::string& name : lesson_value_names()) {
      QVERIFY2(text.contains("`\"" + QString::fromStdString(name) + "\"`"), name.c_str());
    }
  }
};

const test::Registered registered("questions", test::run_as_viewer<QuestionsTest>);

}  // namespace transillum::viewer::questions_test

#include "questions_test.moc"
