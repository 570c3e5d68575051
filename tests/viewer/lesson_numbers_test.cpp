// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Compares statements in the texts of the built-in lessons with the scenes and runs that their
// pages show, with data/studies and with the colors of the window, as far as this needs no window.
// Every number and every color word of a lesson has to be listed here; names of menus, buttons and
// panels in the lessons and in the user guide have to be texts of the viewer.
#include <QColor>
#include <QDirIterator>
#include <QFile>
#include <QLocale>
#include <QRegularExpression>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lesson_page.h"
#include "lessons/lesson.h"
#include "registered.h"
#include "scene/direction_glyph.h"
#include "transillum/bounds.h"
#include "transillum/engine.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/study.h"
#include "user_guide.h"
#include "visibility/embree/picking.h"
#include "widgets/theme.h"

namespace transillum::viewer::lesson_numbers_test {

using Shown = test::ShownPage;

namespace {

QString text_of(const QString& path) {
  QFile file(QStringLiteral(TRANSILLUM_SOURCE) + '/' + path);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

// All that a page says, also in its question.
QString text_of(const Lesson::Page& page) {
  const std::string asked =
      page.question ? "\n" + page.question->ask + "\n" + page.question->then : "";
  return window_text(page.text + asked);
}

// The text of a page. Lessons and pages count from 1.
QString page_text(int lesson, int page) {
  return text_of(at(at(built_in_lessons(), lesson - 1).pages, page - 1));
}

QString english(double number) {
  return QLocale(QLocale::English).toString(static_cast<qint64>(std::llround(number)));
}

// To two significant digits, without an exponent: 0.0031.
QString two_digits(double value) {
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(value))));
  return QString::number(value, 'f', decimals);
}

// The points of one series of a file in data/studies, by the number of passes.
std::vector<StudyPoint> study_points(const char* file, const QString& series) {
  std::vector<StudyPoint> points;
  for (const QString& line : text_of(QStringLiteral("data/studies/") + file).split('\n')) {
    const QStringList fields = line.split(',');
    if (fields.size() < 7 || fields[0] != series) {
      continue;
    }
    StudyPoint point;
    point.passes = fields[2].toInt();
    point.rms_error = fields[3].toDouble();
    point.seconds = fields[6].toDouble();
    points.push_back(point);
  }
  return points;
}

const StudyPoint& after_passes(const std::vector<StudyPoint>& points, int passes) {
  return *std::find_if(points.begin(), points.end(),
                       [passes](const StudyPoint& point) { return point.passes == passes; });
}

QString percent(double fraction) { return two_digits(100 * fraction) + " %"; }

/// Part of a page's text, with its numbers recomputed.
struct Statement {
  int lesson, page;
  QString text;
};

// "from A to B", the patches of the Cornell box that are parts of its blocks: those inside the
// room.
QString patches_of_the_blocks(const Scene& scene) {
  const Bounds& room = scene.bounds();
  std::vector<PatchId> blocks;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Vec3 c = scene.patch(i).center;
    const double margin = std::min({c.x - room.low.x, room.high.x - c.x, c.y - room.low.y,
                                    room.high.y - c.y, c.z - room.low.z, room.high.z - c.z});
    if (margin > 1e-6) {
      blocks.push_back(i);
    }
  }
  const bool contiguous = blocks.back() - blocks.front() + 1 == std::ssize(blocks);
  return contiguous ? QString("patches %1 to %2").arg(blocks.front()).arg(blocks.back())
                    : QString("more than one range of patches");
}

void add_first_lessons(std::vector<Statement>& all) {
  const Shown room(1, 1), sum(1, 4), again(1, 5), map(2, 5), order(4, 1);
  const SolveStatistics run = again.solution().statistics;
  const int passes = sum.page.state.options.solve.directions;
  all.push_back({1, 1, QString("%1 unknown radiosities").arg(room.scene->patch_count())});
  all.push_back({1, 3, QString("%1 directions, spread evenly").arg(passes)});
  all.push_back({1, 4, QString("*M* = %1: %2 passes").arg(run.directions).arg(run.passes)});
  all.push_back(
      {1, 5, QString("about %1 at most, the largest reflectance").arg(two_digits(run.rho_max))});
  all.push_back(
      {1, 5, QString("settles near %1").arg(two_digits(run.iteration_records.back().contraction))});
  all.push_back({1, 5, QString("After %1 iterations").arg(run.iterations)});
  all.push_back({2, 5, QString("all %1 directions and their opposites").arg(map.samples.size())});
  all.push_back({3, 6, patches_of_the_blocks(*Shown(3, 6).scene)});
  all.push_back({4, 1, QString(": %1 patches").arg(order.scene->patch_count())});
  all.push_back(
      {4, 1,
       QString("There are %1 steps")
           .arg(record_local_map(*order.scene, *order.tree, order.omega()).record.step_count())});
}

void add_tree_lesson(std::vector<Statement>& all) {
  const Shown cut(5, 3);
  all.push_back({5, 3,
                 QString("The %1 patches of this scene become %2 fragments")
                     .arg(cut.scene->patch_count())
                     .arg(cut.tree->fragments().size())});
  const auto flake = load_scene("sphere-flake");
  const double patches = flake->patch_count();
  const double fragments = static_cast<double>(BspTree(*flake).fragments().size());
  all.push_back({5, 5,
                 QString("the %1 patches of the sphere-flake, the tree has only %2 more fragments")
                     .arg(english(patches), percent(fragments / patches - 1))});
  all.push_back({6, 7, QString("(%1 patches;").arg(english(patches))});
  const auto boards =
      std::find_if(built_in_scenes().begin(), built_in_scenes().end(),
                   [](const BuiltInScene& scene) { return scene.name == "boards"; });
  const QString count = QString::fromStdString(boards->parameters).mid(2);
  all.push_back({5, 2,
                 QString("Board 1 hides part of board 2, so it must come before board 2; 2 before "
                         "3, … %1 before 1. So 1 would have to come before itself")
                     .arg(count)});
}

void add_sampling_lesson(std::vector<Statement>& all) {
  const Shown random(6, 1), spiral(6, 3);
  all.push_back({6, 1, QString("%1 random directions").arg(random.samples.size())});
  const double v = at(Shown(6, 2).samples, 6).v;
  all.push_back({6, 2,
                 QString("6 = %1 becomes 0.%2")
                     .arg(QString::number(6, 2),
                          QString("%1").arg(static_cast<int>(8 * v), 3, 2, QLatin1Char('0')))});
  all.push_back({6, 3,
                 QString("%1 passes count as %2 directions")
                     .arg(spiral.samples.size())
                     .arg(2 * spiral.samples.size())});

  // The error of B on each of these pages.
  const std::vector<Rgb> reference =
      solve_reference(spiral.scene, spiral.tree, reference_options(512));
  const auto error = [&](const Shown& shown) {
    return percent(radiosity_error(*spiral.scene, shown.solution().radiosity, reference).rms);
  };
  const QString of_random = error(random);
  all.push_back({6, 1,
                 QString("RMS error of *B* is %1 (with *M* = %2)")
                     .arg(of_random)
                     .arg(random.samples.size())});
  all.push_back({6, 2, QString("falls from %1 to %2").arg(of_random, error(Shown(6, 2)))});
  all.push_back({6, 3, "RMS error of *B* is " + error(spiral)});
  all.push_back({6, 5, "RMS error of *B* is " + error(Shown(6, 5))});

  const int passes[] = {64, 256, 1024};
  QString head = "| *M* = |";
  for (const int m : passes) {
    head += QString(" %1 |").arg(m);
  }
  all.push_back({6, 7, head});
  const std::pair<const char*, const char*> series[] = {
      {"random", "random/one-way"},
      {"Hammersley", "hammersley/one-way"},
      {"Fibonacci, both directions", "fibonacci/two-way"}};
  std::vector<StudyPoint> points[3];
  for (int k = 0; k < 3; ++k) {
    points[k] = study_points("sphere-flake.csv", series[k].second);
    QString row = QString("| %1 |").arg(series[k].first);
    for (const int m : passes) {
      row += QString(" %1 |").arg(percent(after_passes(points[k], m).rms_error));
    }
    all.push_back({6, 7, row.replace(" 0.2 %", " 0.20 %")});
  }
  const auto slope = [&](int k) {
    return QString("−%1").arg(-fitted_power_law(points[k])->slope, 0, 'f', 2);
  };
  all.push_back(
      {6, 7, QString("%1 for random directions and %2 for the other two").arg(slope(0), slope(1))});
  all.push_back({6, 7, QString("and %1 for the other two").arg(slope(2))});
  const PaperTables& paper = paper_tables();
  const auto row = std::find(paper.rho.begin(), paper.rho.end(), 0.6) - paper.rho.begin();
  all.push_back({6, 7,
                 QString("an error of %1 %, the paper's Table 2 requires %2 directions; Hammersley "
                         "needed %3, Fibonacci in both directions %4")
                     .arg(100 * PaperTables::accuracy)
                     .arg(english(at(paper.if_homogeneous, row)),
                          english(cost_of(points[1], PaperTables::accuracy)->passes),
                          english(cost_of(points[2], PaperTables::accuracy)->passes))});
}

void add_stars_lesson(std::vector<Statement>& all) {
  const Shown theory(7, 3), shot(7, 4);
  const PaperTables& paper = paper_tables();
  const auto row = std::find(paper.rho.begin(), paper.rho.end(), 0.6) - paper.rho.begin();
  all.push_back({7, 3,
                 QString("*R*²/*A* = %1 and ρ = %2 the paper needs %3 million directions for %4 %")
                     .arg(PaperTables::size_ratio)
                     .arg(at(paper.rho, row))
                     .arg(at(paper.if_heterogeneous, row) / 1e6)
                     .arg(100 * PaperTables::accuracy)});
  const SceneMeasures room = measure(*theory.scene);
  const double needed =
      directions_if_heterogeneous(room.rho_max, PaperTables::accuracy, room.size_ratio);
  all.push_back({7, 3,
                 QString("about %1, which would take about %2 billion")
                     .arg(english(1000 * std::round(room.size_ratio / 1000)))
                     .arg(std::round(needed / 1e9))});
  all.push_back({7, 3, QString("Here are %1 passes").arg(theory.samples.size())});
  all.push_back({7, 4, QString("the same %1 directions as on the first").arg(shot.samples.size())});

  const auto without = study_points("normalizations-stars.csv", "fibonacci/none/no-shot");
  const auto with = study_points("normalizations-stars.csv", "fibonacci/none/first-shot 1000");
  for (const int m : {64, 256, 1024}) {
    all.push_back({7, 5,
                   QString("| %1 | %2 | %3 |")
                       .arg(m)
                       .arg(percent(after_passes(without, m).rms_error),
                            percent(after_passes(with, m).rms_error))});
  }
  const double seconds = after_passes(with, 64).seconds - after_passes(without, 64).seconds;
  all.push_back({7, 5, QString("took %1 s").arg(seconds, 0, 'f', 2)});
}

// From x to x of a patch of the flatland.
QString interval(const Scene& scene, PatchId i, const char* between) {
  double low = 1e9, high = -1e9;
  for (const PointId p : scene.outline(i)) {
    low = std::min(low, scene.point(p).x);
    high = std::max(high, scene.point(p).x);
  }
  return QString("%1%2%3").arg(low).arg(between).arg(high);
}

void add_flatland_lesson(std::vector<Statement>& all) {
  const Shown room(8, 1);
  const Scene& scene = *room.scene;
  const auto from = [&](PatchId i, const char* between) { return interval(scene, i, between); };
  const Bounds& box = scene.bounds();
  all.push_back({8, 1, QString("the depth is %1 m").arg(box.high.y - box.low.y)});
  all.push_back(
      {8, 1,
       QString("the room is %1 m long. The ceiling is dark from %2, a lamp from %3, and "
               "dark again from %4. The lower board reaches from %5, the upper one from %6")
           .arg(box.high.x - box.low.x)
           .arg(from(3, " to "), from(4, " to "), from(5, " to "), from(10, " to "),
                from(6, " to "))});
  all.push_back({8, 5, QString("*A*(floor) is %1 m").arg(scene.patch(0).area)});
  all.push_back({8, 4,
                 QString("[%1] dark, [%2] lamp, [%3] dark")
                     .arg(from(3, ", "), from(4, ", "), from(5, ", "))});
}

void add_trust_lesson(std::vector<Statement>& all) {
  const Shown bars(9, 1), few(9, 3);
  all.push_back({9, 1, "*B* ± 95 % bar"});  // ErrorEstimate::quantile
  all.push_back({9, 2, "in 95 % of them it contains the truth"});
  all.push_back({9, 1, QString("in %1 passes split into eight").arg(bars.samples.size())});
  all.push_back({9, 3, QString("with %1 passes: eight for each").arg(few.samples.size())});
}

void add_linear_lesson(std::vector<Statement>& all) {
  const Shown fine(10, 4), coarse(10, 5);
  all.push_back({10, 5,
                 QString("%1 patches with linear functions are better here than %2 constant ones")
                     .arg(coarse.scene->patch_count())
                     .arg(fine.scene->patch_count())});
}

void add_glossy_lesson(std::vector<Statement>& all) {
  const Shown shown(11, 4);
  const Scene& scene = *shown.scene;
  PatchId shining = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    shining += scene.material(i).lobe.present() ? 1 : 0;
  }
  const int directions = shown.page.state.options.solve.directions;
  const double kept = 1.0 * directions * shining;  // a patch faces one of two opposite directions
  all.push_back({11, 4,
                 QString("with *M* = %1, this room keeps %2 of each instead of %3")
                     .arg(directions)
                     .arg(english(1000 * std::round(kept / 1000)))
                     .arg(shining)});
  const double n = scene.material(shown.page.state.selection).lobe.exponent;
  all.push_back({11, 3, QString("with *n* = %1").arg(n)});
  all.push_back({11, 3, "until nothing of them is left at *n* = 0"});  // the end of the slider
  const MaterialChange wide = Shown(11, 3).page.question->reveal->materials.front();
  all.push_back({11, 3, QString("(*n* = %1)").arg(wide.lobe->exponent)});
  all.push_back({11, 5, QString("The floor has *n* = %1.").arg(n)});
  for (const LessonValue& value : Shown(11, 5).page.question->wanted.of) {
    all.push_back({11, 5, QString("*M* = %1").arg(value.solve.directions)});
  }
}

const std::vector<Statement>& statements() {
  static const std::vector<Statement> all = [] {
    std::vector<Statement> list;
    add_first_lessons(list);
    add_tree_lesson(list);
    add_sampling_lesson(list);
    add_stars_lesson(list);
    add_flatland_lesson(list);
    add_trust_lesson(list);
    add_linear_lesson(list);
    add_glossy_lesson(list);
    return list;
  }();
  return all;
}

// References to the paper and to lessons, and formulas, which formulas() checks.
const QRegularExpression& without_numbers() {
  static const QRegularExpression pattern(
      QStringLiteral("eq\\. [0-9]+|section [0-9](\\.[0-9])?|figure [0-9]|"
                     "[Ll]essons? [0-9]( to [0-9])?|") +
      QRegularExpression::escape("4ρᵢ / (*M* *A*ᵢ)") + '|' +
      QRegularExpression::escape("4 / (*M* *A*ᵢ)") + '|' +
      QRegularExpression::escape("4/(*M* *A*ᵢ)") + '|' +
      QRegularExpression::escape("16π ρ/(1 − ρ)") + '|' +
      QRegularExpression::escape("(log₂ *M* + 7) / (2*M*)") + '|' +
      QRegularExpression::escape("[0,*u*]×[0,*v*]") + '|' + QRegularExpression::escape("1/√*M*") +
      '|' + QRegularExpression::escape("*M*/(*n* + 1)") + "|above 0|(?<=\\n)[0-9]\\. ");
  return pattern;
}

/// A phrase with a color word, and the color that the window uses there.
struct ColorWord {
  int lesson, page;
  const char* phrase;
  QColor color;
};

// The color of the lamp that the marked tile of lesson 11 would mirror to an eye at the page's
// camera.
QColor color_of_mirrored_lamp() {
  const Shown shown(11, 1);
  const Patch& tile = shown.scene->patch(shown.page.state.selection);
  const Vec3 to_eye = normalized(shown.page.state.camera->eye - tile.center);
  const Vec3 mirrored = 2 * dot(to_eye, tile.normal) * tile.normal - to_eye;
  const auto hit = Picker(shown.scene).first_lit_hit(tile.center + 1e-6 * tile.normal, mirrored);
  const Rgb light = hit ? shown.scene->material(hit->patch).exitance : Rgb{};
  const double largest = std::max(max_abs(light), 1e-9);
  return QColor::fromRgbF(light.r / largest, light.g / largest, light.b / largest);
}

const std::vector<ColorWord>& color_words() {
  static const QColor direction =
      QColor::fromRgbF(direction_color[0], direction_color[1], direction_color[2]);
  static const std::vector<ColorWord> all = {
      {1, 2, "outlined in pink", theme::selection},
      {1, 2, "from the gray points it receives nothing", theme::on_dark_dim},
      {1, 2, "The pink cross is the normal", theme::selection},
      {1, 3, "is still black", Qt::black},
      {2, 1, "the square with the orange border", direction},
      {3, 1, "highlighted in yellow", theme::processed},
      {3, 1, "a yellow outline", theme::processed},
      {3, 2, "**inside** (orange)", theme::inside},
      {3, 2, "**outside** (blue)", theme::outside},
      {3, 2, "the orange parts", theme::inside},
      {3, 3, "the orange areas", theme::inside},
      {3, 3, "all orange areas", theme::inside},
      {3, 6, "its outline is yellow", theme::processed},
      {3, 8, "The orange lines", theme::inside},
      {4, 3, "The yellow outline", theme::processed},
      {4, 4, "**inside** (orange)", theme::inside},
      {4, 4, "**outside** (blue)", theme::outside},
      {4, 4, "Each orange part", theme::inside},
      {4, 4, "the orange parts", theme::inside},
      {5, 3, "The blue lines in the scene", theme::outside},
      {7, 2, "outlined in pink", theme::selection},
      {10, 6, "draws them as black", Qt::black},
      {11, 1, "mirrors the red lamp", color_of_mirrored_lamp()},
  };
  return all;
}

QString name_of_color(const QColor& color) {
  if (color.value() < 32) {
    return QStringLiteral("black");
  }
  if (color.saturation() < 48) {
    return QStringLiteral("gray");
  }
  const int hue = color.hue();
  return hue < 15    ? QStringLiteral("red")
         : hue < 44  ? QStringLiteral("orange")
         : hue < 70  ? QStringLiteral("yellow")
         : hue < 170 ? QStringLiteral("green")
         : hue < 260 ? QStringLiteral("blue")
         : hue < 310 ? QStringLiteral("purple")
                     : QStringLiteral("pink");
}

// All string literals of the viewer's sources, without the marks of menu keys.
/// Labels of engines are in the library's table.
QStringList texts_of_the_viewer() {
  QStringList texts,
      names{QStringLiteral(TRANSILLUM_SOURCE
                           "/libtransillum/src/visibility/engines/engine_table.cpp")};
  for (QDirIterator files(QStringLiteral(TRANSILLUM_SOURCE "/viewer"), {"*.cpp"}, QDir::Files,
                          QDirIterator::Subdirectories);
       files.hasNext();) {
    names << files.next();
  }
  static const QRegularExpression literal(QStringLiteral("\"((?:[^\"\\\\\n]|\\\\.)*)\""));
  for (const QString& name : names) {
    QFile file(name);
    if (!file.open(QIODevice::ReadOnly)) {
      continue;
    }
    auto found = literal.globalMatch(QString::fromUtf8(file.readAll()));
    while (found.hasNext()) {
      texts << found.next().captured(1).remove('&').remove("<b>").remove("</b>");
    }
  }
  return texts;
}

// Names in italics that begin with a capital letter; "A → B" is two names.
QStringList names_in(const QString& markdown) {
  static const QRegularExpression italics(
      QStringLiteral("(?<![*\\w\\\\])\\*(?![*\\s])([^*\n|]+?)\\*(?!\\*)"));
  QStringList names;
  auto found = italics.globalMatch(markdown);
  while (found.hasNext()) {
    for (const QString& name : found.next().captured(1).split(QStringLiteral(" → "))) {
      if (name.size() > 2 && name[0].isUpper()) {
        names << name;
      }
    }
  }
  return names;
}

/// Where a lesson first has what a pattern finds, as a sentence; an empty string if none has.
/// @param remove takes what is checked out of the text of a page: remove(lesson, page, text)
template <class Remove>
QString first_unchecked(const QRegularExpression& pattern, Remove remove) {
  int lesson = 0;
  for (const Lesson& one : built_in_lessons()) {
    ++lesson;
    for (int page = 1; page <= static_cast<int>(one.pages.size()); ++page) {
      QString rest = page_text(lesson, page);
      remove(lesson, page, rest);
      if (const auto left = pattern.match(rest); left.hasMatch()) {
        return QString("%1, page %2: \"%3\" is not checked")
            .arg(lesson)
            .arg(page)
            .arg(left.captured());
      }
    }
  }
  return {};
}

}  // namespace

class LessonNumbersTest : public QObject {
  Q_OBJECT

 private slots:
  void numbers_are_those_of_the_program() {
    for (const Statement& statement : statements()) {
      QVERIFY2(page_text(statement.lesson, statement.page).contains(statement.text),
               qPrintable(QString("%1, page %2 does not state: %3")
                              .arg(statement.lesson)
                              .arg(statement.page)
                              .arg(statement.text)));
    }
  }

  void every_number_is_checked() {
    static const QRegularExpression number(QStringLiteral(".{0,20}[0-9].{0,20}"));
    const auto remove = [](int lesson, int page, QString& rest) {
      for (const Statement& statement : statements()) {
        if (statement.lesson == lesson && statement.page == page) {
          rest.remove(statement.text);
        }
      }
      rest.remove(without_numbers());
    };
    QCOMPARE(first_unchecked(number, remove), QString());
  }

  void formulas_are_those_of_the_program() {
    const double pi = std::numbers::pi, rho = 0.6, ratio = 150, discrepancy = 0.003;
    QCOMPARE(star_discrepancy_bound(64), (std::log2(64.0) + 7) / (2 * 64));
    QCOMPARE(heterogeneous_error_bound(rho, ratio, discrepancy),
             16 * pi * rho / (1 - rho) * ratio * discrepancy);
    // F_ij = 4 / (M A_i) sum of A(i, j, omega) over the directions, for i of lesson 3.
    const Shown shown(3, 4);
    const PatchId i = shown.page.state.selection;
    RadiositySolver solver(shown.scene, shown.page.state.options.solve, {.tree = shown.tree});
    solver.advance(RadiositySolver::Until::finished);
    const auto engine = make_engine(Engine::fast, shown.scene, shown.tree);
    std::vector<double> areas(static_cast<std::size_t>(shown.scene->patch_count()));
    for (const Vec3& omega : solver.directions()) {
      for (const Transfer& transfer : engine(omega, {}).exchanges) {
        if (transfer.receiver == i) {
          at(areas, transfer.source) += transfer.area;
        }
        if (transfer.source == i) {  // along -omega
          at(areas, transfer.receiver) += transfer.area;
        }
      }
    }
    const double factor = 4 / (solver.statistics().directions * shown.scene->patch(i).area);
    const FormFactors factors = solver.form_factors();
    QVERIFY(at(factors.row_begin, i + 1) - at(factors.row_begin, i) > 5);
    for (std::size_t k = at(factors.row_begin, i); k < at(factors.row_begin, i + 1); ++k) {
      QVERIFY(std::abs(factor * at(areas, factors.source[k]) - factors.value[k]) < 1e-12);
    }
  }

  void colors_are_those_of_the_window() {
    for (const ColorWord& word : color_words()) {
      const QString phrase = QString::fromUtf8(word.phrase);
      QVERIFY2(page_text(word.lesson, word.page).contains(phrase), word.phrase);
      QVERIFY2(phrase.contains(name_of_color(word.color)),
               qPrintable(phrase + ": " + name_of_color(word.color)));
    }
  }

  void every_color_word_is_checked() {
    static const QRegularExpression names(QStringLiteral(
        "\\b(red|orange|yellow|amber|green|blue|cyan|purple|pink|black|white|gr[ae]y)"
        "\\b"));
    const auto remove = [](int lesson, int page, QString& rest) {
      for (const ColorWord& word : color_words()) {
        if (word.lesson == lesson && word.page == page) {
          rest.remove(QString::fromUtf8(word.phrase));
        }
      }
    };
    QCOMPARE(first_unchecked(names, remove), QString());
  }

  void names_are_those_of_the_window() {
    const QStringList texts = texts_of_the_viewer();
    QVERIFY(texts.size() > 500);
    QString all = test::user_guide().join('\n') + text_of("viewer/LESSON_FORMAT.md");
    QVERIFY(names_in(all).size() > 60);
    for (const Lesson& lesson : built_in_lessons()) {
      for (const Lesson::Page& page : lesson.pages) {
        all += '\n' + text_of(page);
      }
    }
    for (const QString& name : names_in(all)) {
      const bool found = std::any_of(texts.begin(), texts.end(), [&](const QString& text) {
        return text.startsWith(name) &&
               (text.size() == name.size() || !text[name.size()].isLetter());
      });
      QVERIFY2(found, qPrintable(name));
    }
  }
};

const test::Registered registered("lesson_numbers", test::run_without_widgets<LessonNumbersTest>);

}  // namespace transillum::viewer::lesson_numbers_test

#include "lesson_numbers_test.moc"
