// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Answers to the questions of lessons: each built-in question has a computed and plausible answer,
// values are known in the furnace, and mistakes in files are reported.
#include <algorithm>
#include <cmath>

#include "lessons/computed_values.h"
#include "lessons/lesson.h"
#include "question_page.h"
#include "registered.h"
#include "test_files.h"
#include "transillum/at.h"

namespace transillum::viewer::lesson_values_test {

using namespace test;

namespace {

Solved solved(const std::string& question) {
  const Lesson lesson = lesson_from_text(page_with(question), "q.json");
  ComputedValues computed(loaded_for(lesson.pages[0].state), {});
  return solve_question(*lesson.pages[0].question, computed);
}

double value_of(const std::string& wanted) {
  return solved(R"({"kind": "number", "ask": "?", "answer": )" + wanted + "}").value;
}

}  // namespace

class LessonValuesTest : public QObject {
  Q_OBJECT

 private slots:
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
      case Question::Kind::curve:
        QCOMPARE(solved.values.size(), question.choices.size());
        QVERIFY(std::all_of(solved.values.begin(), solved.values.end(),
                            [](double value) { return value > 1e-4 && value < 1; }));
        QVERIFY(is_right(question, solved, {.heights = solved.values}));
        QVERIFY(!is_right(question, solved,
                          {.heights = std::vector(solved.values.size(), solved.values.back())}));
        break;
      case Question::Kind::outline:
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
        QVERIFY(std::abs(compare_areas(solved.region, {low, {high.x, low.y}, high, {low.x, high.y}})
                             .overlap -
                         solved.value / solved.scale / area) < 0.02);
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
    QVERIFY(std::abs(compare_areas(halves, square).overlap - 1) < 0.01);
    QVERIFY(std::abs(compare_areas({halves[0]}, square).overlap - 0.5) < 0.01);
    const std::vector<Vec2> moved{{0.5, 0}, {1.5, 0}, {1.5, 1}, {0.5, 1}};
    QVERIFY(std::abs(compare_areas(halves, moved).overlap - 1.0 / 3) < 0.01);
    QCOMPARE(compare_areas(halves, {{2, 2}, {3, 2}, {3, 3}}).overlap, 0.0);
    QCOMPARE(compare_areas(halves, {}).overlap, 0.0);
    const AreaComparison more = compare_areas({halves[0]}, square),
                         less = compare_areas(halves, moved);
    QVERIFY(more.missed == 0 && std::abs(more.extra - 0.5) < 0.01);
    QVERIFY(std::abs(less.missed - 0.5) < 0.01 && std::abs(less.extra - 0.5) < 0.01);
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
    row("no points", R"({"kind": "curve", "ask": "?"})", "question, choices: ");
    row("a point is typed in", R"({"kind": "curve", "ask": "?", "choices":
        [{"text": "1", "value": 1}, {"text": "2", "value": {"figure": "steps"}}]})",
        "must be computed");
    row("no outline", R"({"kind": "outline", "ask": "?", "answer": {"figure": "patches"}})",
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

const test::Registered registered("lesson_values", test::run_without_widgets<LessonValuesTest>);

}  // namespace transillum::viewer::lesson_values_test

#include "lesson_values_test.moc"
