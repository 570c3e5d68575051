// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Questions of lessons: answering, revealing, counting and undoing in the window.
#include <QAction>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRadioButton>
#include <QScrollBar>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QToolButton>
#include <cmath>

#include "lessons/computed_values.h"
#include "lessons/lesson_panel.h"
#include "lessons/question_box.h"
#include "question_page.h"
#include "scene/error_view.h"
#include "solved_window.h"
#include "stepping/play_control.h"
#include "test_files.h"
#include "transillum/at.h"
#include "widgets/log_chart.h"

namespace transillum::viewer::questions_test {

using namespace test;

namespace {

/// A window that shows a lesson from a file in a folder of its own, with tallies in another.
struct Class {
  QTemporaryDir folder, data;
  std::unique_ptr<TestWindow> window = make_window();
  LessonPanel* panel = window->findChild<LessonPanel*>();
  QuestionBox* box = window->findChild<QuestionBox*>();

  Class() {
    panel->set_tally_folder(data.path() + "/tallies");
    action("tally_keep")->setChecked(true);
  }
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
      Tally tally;
      tally.keep(name);
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

  // Predict, reveal, see what is right, ask again; the tally is beside the lesson, and undone.
  void a_choice_is_predicted_revealed_and_counted() {
    Class room;
    std::string long_text;
    for (int k = 0; k < 100; ++k) {
      long_text += "A line.\\n\\n";
    }
    room.open(page_with(boards_question, long_text));
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
    const double steps_of_patch = room.box->solved()->value;
    QVERIFY(room.text("question_result")
                .contains(QString("Your choice is %1 times the computed value.")
                              .arg(QString::number(2 / steps_of_patch, 'g', 2))));
    const QScrollBar* bar =
        room.window->findChild<QTextBrowser*>("lesson_text")->verticalScrollBar();
    QVERIFY(bar->maximum() > 0 && wait_for([&] { return bar->value() == bar->maximum(); }));
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

  // The patch that a page calls "this fragment" is the patch of the step that it shows.
  void a_question_about_the_fragment_of_a_step_is_about_its_patch() {
    Class room;
    int pages = 0;
    for (std::size_t lesson = 0; lesson < room.panel->lessons().size(); ++lesson) {
      for (std::size_t k = 0; k < room.panel->lessons()[lesson].pages.size(); ++k) {
        const Lesson::Page& page = room.panel->lessons()[lesson].pages[k];
        const auto& shown = page.state.focus;
        if (!page.question || page.question->kind != Question::Kind::patch || !shown ||
            shown->step != StepChoice(StepName::exchange)) {
          continue;
        }
        const PatchId patch = page.question->wanted.patch;
        room.open_built_in(static_cast<int>(lesson) + 1, static_cast<int>(k) + 1);
        const Focus& focus = room.window->focus;
        QCOMPARE(focus.map()->history.step(focus.position().step).patch, patch);
        ++pages;
      }
    }
    QVERIFY(pages > 0);
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
    QVERIFY(room.text("question_result").contains("Your number is 0.8 times the computed value."));
    room.action("question_reveal")->trigger();
    // The number has a decimal comma.
    QTest::keyClicks(number, "104,5");
    room.reveal();
    QVERIFY(room.text("question_result").contains("Right"));
  }

  // In a closed scene, the parts that a patch sees fill its projection.
  void an_area_is_drawn_in_the_map() {
    Class room;
    room.open(page_with(R"({"kind": "area", "ask": "Draw it", "unit": "m²", "within": 0.8,
      "answer": {"figure": "visible-area", "patch": 0, "others": "all"}})"));
    const auto& page = room.panel->lessons()[0].pages[0];
    ComputedValues computed(loaded_for(page.state), {});
    LessonValue projected = page.question->wanted;
    projected.kind = LessonValueKind::projected_area;
    const std::vector<Vec2> corners = computed.region(projected).at(0);
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
    QVERIFY(result.region.size() > 1 && result.value > 0);
    save_picture(*room.window, "question-area");
    const auto hatched = [canvas](const QColor& color) {
      return fraction_of(canvas->grab().toImage(), color) > 1e-3;
    };
    QVERIFY(!hatched(theme::selection) && !hatched(theme::difference));
    // Moved by 0.3 of an edge, it lacks a strip and has one too much.
    room.action("question_reveal")->trigger();
    const Vec2 edge{corners[1].x - corners[0].x, corners[1].y - corners[0].y};
    for (const Vec2& p : corners) {
      click({p.x + 0.3 * edge.x, p.y + 0.3 * edge.y});
    }
    QTRY_COMPARE(room.box->answer().outline.size(), corners.size());
    QVERIFY(!hatched(theme::selection) && !hatched(theme::difference));
    room.reveal();
    QVERIFY(room.text("question_result").contains("Not this time"));
    QVERIFY(room.text("question_result").contains("are missing"));
    QVERIFY(hatched(theme::selection) && hatched(theme::difference));
    save_picture(*room.window, "question-area-wrong");
  }

  // The same solves give the values; a curve that is twice as high differs by a factor of two at
  // each point.
  void a_curve_is_drawn_in_a_chart() {
    Class room;
    room.open(page_with(R"({"kind": "curve", "ask": "Draw it", "choices": [
      {"text": "8", "value": {"figure": "rms-error", "with": {"directions": 8}}},
      {"text": "16", "value": {"figure": "rms-error", "with": {"directions": 16}}},
      {"text": "32", "value": {"figure": "rms-error"}}]})"));
    const Question& question = *room.panel->lessons()[0].pages[0].question;
    ComputedValues computed(loaded_for(room.panel->lessons()[0].pages[0].state), {});
    const std::vector<double> right = solve_question(question, computed).values;
    QCOMPARE(right.size(), std::size_t{3});
    auto* chart = room.window->findChild<LogChart*>("question_chart");
    QVERIFY(wait_for([&] { return chart->isVisible(); }));
    const auto draw = [&](double factor) {
      for (int x = 1; x <= 3; ++x) {
        QVERIFY(!is_given(question, room.box->answer()));
        const QPointF place = chart->position_of(x, factor * at(right, x - 1));
        QTest::mouseClick(chart, Qt::LeftButton, {}, place.toPoint());
      }
      QVERIFY(is_given(question, room.box->answer()));
    };
    draw(1);
    // A pixel is some hundredths of a decade.
    QVERIFY(mean_distance(room.box->answer().heights, right) < 0.05);
    room.reveal();
    QVERIFY(room.text("question_result").contains("Right"));
    save_picture(*room.window, "question-curve");
    room.action("question_reveal")->trigger();
    draw(4);
    const double distance = mean_distance(room.box->answer().heights, right);
    QVERIFY2(std::abs(distance - std::log10(4)) < 0.05, qPrintable(QString::number(distance)));
    room.reveal();
    QVERIFY(room.text("question_result").contains("Not this time"));
    QVERIFY(room.text("question_result").contains("by a factor of"));
    QCOMPARE(mean_distance({1, 0}, {1, 1}), HUGE_VAL);
  }

  // The corners of the patch are clicked in the scene; it sees all of its projection: nothing is
  // missing.
  void an_outline_is_drawn_on_a_patch_in_the_scene() {
    Class room;
    std::string lesson = page_with(R"({"kind": "outline", "ask": "Draw it", "unit": "m²",
      "within": 0.8, "answer": {"figure": "visible-area", "patch": 0, "others": "all"}})");
    room.open(lesson);
    const auto& page = room.panel->lessons()[0].pages[0];
    const auto loaded = loaded_for(page.state);
    ComputedValues computed(loaded, {});
    const Solved right = solve_question(*page.question, computed);
    QVERIFY(std::abs(right.value / loaded->scene->patch(0).area - 1) < 1e-9);
    auto* view = room.window->findChild<SceneView*>();
    const Vec3 eye = view->view_point().eye;
    const auto see = [&](const Vec3& p) { emit view->ray_clicked(eye, normalized(p - eye)); };
    const auto take = [&](double shift) {
      for (const PointId p : loaded->scene->outline(0)) {
        const Vec3 edge = loaded->scene->point(loaded->scene->outline(0)[1]) -
                          loaded->scene->point(loaded->scene->outline(0)[0]);
        see(loaded->scene->point(p) + shift * edge);
      }
    };
    // The line of sight continues behind a patch in front. Points far outside are refused.
    const Patch& floor = loaded->scene->patch(0);
    see(floor.center + 9 * (loaded->scene->point(loaded->scene->outline(0)[0]) - floor.center));
    QVERIFY(room.box->answer().outline.empty());
    QVERIFY(room.text("question_given").contains("That point is not on patch 0"));
    room.window->selection.select(3);
    take(0);
    QCOMPARE(room.box->answer().outline.size(), loaded->scene->outline(0).size());
    QCOMPARE(room.window->selection.patch(), page.state.selection);
    room.reveal();
    QVERIFY2(room.text("question_result").contains("Right"),
             qPrintable(room.text("question_result")));
    room.action("question_reveal")->trigger();
    take(0.3);
    room.reveal();
    QVERIFY(room.text("question_result").contains("Not this time"));
    QVERIFY(wait_for([&] { return room.window->settled(); }));
    const QImage picture = view->picture(1);
    save_picture(*room.window, "question-outline");
    QVERIFY(fraction_of(picture, theme::selection) + fraction_of(picture, theme::difference) >
            1e-3);
  }

  // This one takes thousands of passes.
  void an_answer_is_computed_while_the_page_is_read() {
    Class room;
    room.open_built_in(6, 5);
    const auto* bar = room.window->findChild<QProgressBar*>("question_progress");
    QVERIFY(wait_for([&] { return room.box->ready(); }));
    QVERIFY(room.box->solved() == nullptr && !bar->isVisible());
    room.action("question_reveal")->trigger();
    QVERIFY(room.box->solved() != nullptr && !bar->isVisible());
    room.action("question_reveal")->trigger();  // asks again
    room.action("question_reveal")->trigger();
    QVERIFY(room.box->solved() != nullptr);
  }

  void an_answer_that_is_not_ready_shows_progress_until_the_page_is_left() {
    Class room;
    room.open_built_in(6, 5);
    QVERIFY(!room.box->ready());
    const auto* bar = room.window->findChild<QProgressBar*>("question_progress");
    const auto* reveal = room.action("question_reveal");
    room.action("question_reveal")->trigger();
    QVERIFY(bar->isVisible() && reveal->text() == "Stop");
    QVERIFY(wait_for([&] { return bar->value() > 0.1 * bar->maximum(); }));
    QVERIFY(!room.box->ready() && bar->value() < bar->maximum());
    QVERIFY(room.text("question_result").contains(" s left"));
    save_picture(*room.window, "question-progress");
    room.action("question_reveal")->trigger();
    QVERIFY(!bar->isVisible() && reveal->text() == "Reveal the answer");
    room.action("question_reveal")->trigger();
    QVERIFY(bar->isVisible() && bar->value() > 0.1 * bar->maximum());  // the computation continued
    room.open_built_in(6, 4);
    QVERIFY(!bar->isVisible() && room.box->solved() == nullptr);
    room.open_built_in(6, 5);
    QVERIFY(!room.box->ready());  // the computation was canceled
  }

  void a_wrong_answer_gets_its_reason() {
    Class room;
    room.open(page_with(R"({"kind": "choice", "ask": "?", "choices": [
      {"text": "one", "value": 1, "reason": "This belongs to < one >."}, {"value": 5},
      {"text": "none"}], "answer": {"equals": {"figure": "steps"}}})"));
    const auto reveal = [&](const char* choice) {
      room.window->findChild<QRadioButton*>(choice)->click();
      room.reveal();
      const QString text = room.text("question_result");
      room.action("question_reveal")->trigger();  // asks again
      return text;
    };
    QVERIFY(reveal("choice_1").contains("This belongs to &lt; one &gt;."));
    QVERIFY(!reveal("choice_2").contains("belongs"));
    QVERIFY(reveal("choice_3").contains("Right"));
    room.open(page_with(R"({"kind": "number", "ask": "?", "answer": {"figure": "steps"},
      "within": 0.01, "mistakes": [{"value": {"figure": "ratio", "of": [{"figure": "area",
      "patch": 0}, {"figure": "area", "patch": 0}]}, "reason": "This is the area over itself."},
      {"value": 1.02, "reason": "This is more."}]})"));
    auto* number = room.window->findChild<QLineEdit*>("question_number");
    const auto guess = [&](const char* text) {
      number->setText(text);
      room.reveal();
      const QString result = room.text("question_result");
      room.action("question_reveal")->trigger();
      return result;
    };
    QVERIFY(guess("1.001").contains("times the computed value. This is the area over itself."));
    QVERIFY(guess("1.015").endsWith("This is more."));
    QVERIFY(guess("3").endsWith("times the computed value."));
  }

  void a_failure_is_told_by_reveal() {
    Class room;
    room.open(page_with(R"({"kind": "number", "ask": "?",
      "answer": {"figure": "area", "patch": 99}})"));
    QVERIFY(room.settles());
    QCOMPARE(room.window->banner_text(), QString());
    room.action("question_reveal")->trigger();
    QTRY_VERIFY(room.window->banner_text().contains("no patch 99"));
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

  void a_tally_is_kept_only_if_asked_for() {
    Class room;
    room.action("tally_keep")->setChecked(false);
    room.open(page_with(boards_question));
    const auto answer = [&room] {
      room.window->findChild<QRadioButton*>("choice_1")->click();
      room.action("question_count")->trigger();
    };
    answer();
    QVERIFY(room.counts().isEmpty() && room.text("question_counts").contains("1 answer"));
    room.action("tally_keep")->setChecked(true);
    answer();
    QCOMPARE(room.counted("few"), 2);
    // The next class begins without answers; Keep the tally adds its answers to those of the file.
    Class next;
    next.action("tally_keep")->setChecked(false);
    next.window->files().try_open(room.folder.filePath("mine.json"));
    QVERIFY(next.settles());
    QVERIFY(!next.window->findChild<QLabel*>("question_counts")->isVisible());
    next.action("tally_keep")->setChecked(true);
    QVERIFY(next.text("question_counts").contains("2 answers"));
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
};

const test::Registered registered("questions", test::run_as_viewer<QuestionsTest>);

}  // namespace transillum::viewer::questions_test

#include "questions_test.moc"
