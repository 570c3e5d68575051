// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Options of the program transillum-viewer.
#include "window/command_line.h"
#include "window/files/first_look.h"

#include <QTest>
#include <algorithm>
#include <sstream>

#include "registered.h"

namespace transillum::viewer::command_line_test {

namespace {

struct Outcome {
  ParsedCommandLine parsed;
  std::string out, error;
};

Outcome parse(std::vector<const char*> words) {
  words.insert(words.begin(), "transillum-viewer");
  std::ostringstream out, error;
  Outcome outcome;
  outcome.parsed = parse_command_line(static_cast<int>(words.size()), words.data(), out, error);
  outcome.out = out.str();
  outcome.error = error.str();
  return outcome;
}

}  // namespace

class CommandLineTest : public QObject {
  Q_OBJECT

 private slots:
  void defaults_are_those_of_solve() {
    const Outcome outcome = parse({});
    QVERIFY(!outcome.parsed.exit_now);
    SolveOptions solve;
    solve.goal = {.accuracy = 0.01, .passes = 16384};
    QCOMPARE(outcome.parsed.command_line.options.solve.directions, solve.directions);
    QCOMPARE(outcome.parsed.command_line.options.solve.tolerance, solve.tolerance);
    QVERIFY(outcome.parsed.command_line.options.solve.two_way);
    QVERIFY(outcome.parsed.command_line.scene.empty());
    QVERIFY(outcome.parsed.command_line.options.solve == solve);
    QVERIFY(solve.used_sampling() == Sampling::antipodal);
    const SolveOptions one_way = parse({"--one-way"}).parsed.command_line.options.solve;
    QVERIFY(one_way.used_sampling() == Sampling::fibonacci);
    const auto two_way_lattice = parse({"--sampling", "fibonacci"}).parsed.command_line;
    QVERIFY(two_way_lattice.options.solve.used_sampling() == Sampling::fibonacci);
  }

  void a_screenshot_takes_fewer_directions_unless_told() {
    const auto directions = [](std::vector<const char*> words) {
      words.insert(words.begin(), {"furnace", "--screenshot", "a.png"});
      return parse(std::move(words)).parsed.command_line.options.solve.directions;
    };
    QCOMPARE(directions({}), 128);
    QCOMPARE(directions({"-m", "1024"}), 1024);
    QCOMPARE(directions({"--after", "5"}), SolveOptions{}.directions);
  }

  void a_screenshot_of_a_coarse_scene_is_soft_unless_told() {
    const auto parsed = [](std::vector<const char*> words) {
      words.insert(words.begin(), {"--screenshot", "a.png"});
      return parse(std::move(words)).parsed.command_line;
    };
    const auto is_soft = [](const CommandLine& line) {
      return line.first_look && has_first_look(line.scene);
    };
    for (const char* scene : {"cornell-box", "rooms:rooms=2", "room.obj"}) {
      const CommandLine soft = parsed({scene, "--threads", "1"});
      QVERIFY(is_soft(soft));
      QCOMPARE(soft.options.solve.directions, 1024);
    }
    const std::vector<std::vector<const char*>> others{{"furnace"},
                                                       {"result.vtp"},
                                                       {"cornell-box", "-m", "64"},
                                                       {"cornell-box", "--max-patch-area", "1"},
                                                       {"cornell-box", "--after", "3"}};
    for (const auto& words : others) {
      QVERIFY2(!is_soft(parsed(words)), words.front());
    }
    const auto in_window = [](std::vector<const char*> words) {
      return parse(std::move(words)).parsed.command_line;
    };
    QVERIFY(is_soft(in_window({"cornell-box", "-m", "64"})));
    for (const char* choice :
         {"--patches=9", "--max-patch-area=1", "--basis=constant", "--paper"}) {
      QVERIFY2(!is_soft(in_window({"cornell-box", choice})), choice);
    }
    QVERIFY(!in_window({"room.obj"}).up);
    QVERIFY(in_window({"room.obj", "--up", "0,0,1"}).up == (Vec3{0, 0, 1}));
  }

  void options_of_scenes() {
    const Outcome outcome = parse(
        {"room.obj", "--default-reflectance", "0.25", "--max-reflectance", "0.9", "--units", "cm",
         "--orient", "auto", "--emission", "lamp=10", "--reflectance", "group:box=0.1,0.2,0.3",
         "--emission", "face:3=1,2,3", "--lobe", "floor=0.4,24", "--patches", "500"});
    QVERIFY2(!outcome.parsed.exit_now, outcome.error.c_str());
    const SceneInput& input = outcome.parsed.command_line.options.input;
    QCOMPARE(input.read.default_reflectance, 0.25);
    QCOMPARE(input.read.max_reflectance.value_or(0), 0.9);
    QCOMPARE(input.read.scale, 0.01);
    QVERIFY(input.orient);
    QCOMPARE(input.patches, std::int64_t{500});
    const auto change = [&](std::size_t k) { return input.changes.at(k); };
    QCOMPARE(input.changes.size(), std::size_t{4});
    QVERIFY(std::count(input.changes.begin(), input.changes.end(),
                       MaterialChange{"lamp", {}, Rgb{10, 10, 10}}) == 1);
    QVERIFY(std::count(input.changes.begin(), input.changes.end(),
                       MaterialChange{"group:box", Rgb{0.1, 0.2, 0.3}}) == 1);
    QVERIFY(std::count(input.changes.begin(), input.changes.end(),
                       MaterialChange{"face:3", {}, Rgb{1, 2, 3}}) == 1);
    QVERIFY(std::count(input.changes.begin(), input.changes.end(), lobe_change("floor=0.4,24")) ==
            1);
    QVERIFY(change(0).target == "lamp");
    QCOMPARE(parse({"room.obj", "--scale", "0.5"}).parsed.command_line.options.input.read.scale,
             0.5);
  }

  void options_of_solve() {
    const Outcome outcome = parse({"room.obj",
                                   "-m",
                                   "77",
                                   "--sampling",
                                   "random",
                                   "--seed",
                                   "5",
                                   "--rotate",
                                   "8",
                                   "--one-way",
                                   "--normalize",
                                   "rows",
                                   "--iterations",
                                   "3",
                                   "--two-sided",
                                   "--max-patch-area",
                                   "0.5",
                                   "--memory",
                                   "2G",
                                   "--threads",
                                   "2",
                                   "--screenshot",
                                   "a.png",
                                   "--after",
                                   "9"});
    QCOMPARE(outcome.error, std::string());
    const CommandLine& line = outcome.parsed.command_line;
    QCOMPARE(line.scene, std::string("room.obj"));
    QCOMPARE(line.options.solve.directions, 77);
    QVERIFY(line.options.solve.sampling == Sampling::random);
    QCOMPARE(line.options.solve.seed, std::uint64_t{5});
    QVERIFY(line.options.solve.rotation == std::optional<std::uint64_t>(8));
    QVERIFY(!line.options.solve.two_way);
    QVERIFY(line.options.solve.normalize == Normalization::rows);
    QCOMPARE(line.options.solve.iterations, 3);
    QCOMPARE(line.options.solve.memory, std::uint64_t{2} << 30);
    QCOMPARE(line.options.solve.threads, 2);
    QVERIFY(line.options.scene.two_sided);
    QCOMPARE(line.options.scene.max_patch_area, 0.5);
    QCOMPARE(line.screenshot, std::string("a.png"));
    QCOMPARE(line.after, 9);
  }

  void wrong_calls_are_reported_in_one_line_data() {
    QTest::addColumn<QStringList>("words");
    QTest::newRow("unknown option") << QStringList{"furnace", "--color"};
    QTest::newRow("no number") << QStringList{"furnace", "-m", "many"};
    QTest::newRow("too few directions") << QStringList{"furnace", "-m", "0"};
    QTest::newRow("unknown sampling") << QStringList{"furnace", "--sampling", "fibonaci"};
    QTest::newRow("unknown normalization") << QStringList{"furnace", "--normalize", "columns"};
    QTest::newRow("two scenes") << QStringList{"furnace", "boards"};
    QTest::newRow("screenshot of nothing") << QStringList{"--screenshot", "a.png"};
    QTest::newRow("no picture") << QStringList{"furnace", "--screenshot", "a.txt"};
    QTest::newRow("no such folder") << QStringList{"furnace", "--screenshot", "no/such/a.png"};
    QTest::newRow("reflectance above 1") << QStringList{"a.obj", "--max-reflectance", "1.5"};
    QTest::newRow("default above 1") << QStringList{"a.obj", "--default-reflectance", "2"};
    QTest::newRow("unknown unit") << QStringList{"a.obj", "--units", "mile"};
    QTest::newRow("unit and scale") << QStringList{"a.obj", "--units", "mm", "--scale", "2"};
    QTest::newRow("scale 0") << QStringList{"a.obj", "--scale", "0"};
    QTest::newRow("emission of nothing") << QStringList{"a.obj", "--emission", "10"};
    QTest::newRow("emission that is no number") << QStringList{"a.obj", "--emission", "a=x"};
    QTest::newRow("orientation") << QStringList{"a.obj", "--orient", "maybe"};
    QTest::newRow("no patches") << QStringList{"a.obj", "--patches", "0"};
    QTest::newRow("emission in a result") << QStringList{"r.vtp", "--emission", "lamp=1"};
    QTest::newRow("patches and area")
        << QStringList{"a.obj", "--patches", "5", "--max-patch-area", "1"};
    QTest::newRow("no lesson to export") << QStringList{"--export-lesson", "a.html"};
    QTest::newRow("no page") << QStringList{"--lesson", "1", "--export-lesson", "a.png"};
    QTest::newRow("no folder of the page")
        << QStringList{"--lesson", "1", "--export-lesson", "no/such/a.html"};
    QTest::newRow("two files") << QStringList{"--lesson",     "1",    "--export-lesson", "a.html",
                                              "--screenshot", "a.png"};
    QTest::newRow("after without screenshot") << QStringList{"furnace", "--after", "3"};
  }
  void wrong_calls_are_reported_in_one_line() {
    QFETCH(QStringList, words);
    std::vector<std::string> kept;
    for (const QString& word : words) {
      kept.push_back(word.toStdString());
    }
    std::vector<const char*> arguments;
    for (const std::string& word : kept) {
      arguments.push_back(word.c_str());
    }
    const Outcome outcome = parse(arguments);
    QVERIFY(outcome.parsed.exit_now);
    QCOMPARE(outcome.parsed.exit_status, 2);
    QCOMPARE(std::count(outcome.error.begin(), outcome.error.end(), '\n'), std::ptrdiff_t{1});
  }

  void help_is_not_an_error() {
    const Outcome outcome = parse({"--help"});
    QVERIFY(outcome.parsed.exit_now);
    QCOMPARE(outcome.parsed.exit_status, 0);
    QVERIFY(outcome.out.find("--screenshot") != std::string::npos);
  }
};

const test::Registered registered("command_line", test::run_without_application<CommandLineTest>);

}  // namespace transillum::viewer::command_line_test

#include "command_line_test.moc"
