// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Random sets of options: the command lines of `solve` and of the viewer, a session, the copied
// command and the statistics agree, or all refuse the set for the same reason.
#include <QTemporaryDir>
#include <QTest>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "cli/arguments/option_arguments.h"
#include "model/command_text.h"
#include "model/run_options.h"
#include "registered.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/solve_session.h"
#include "window/command_line.h"

namespace transillum::viewer::options_agree_test {

namespace {

using Words = std::vector<std::string>;

/// The options that a front end makes of a set of words, or its refusal.
struct Outcome {
  std::string refusal;  ///< empty if accepted
  RunOptions options;
};

/// Parses options like the command `solve`.
Outcome by_command_line(const Words& words) {
  Outcome outcome;
  CLI::App app;
  std::string scene;
  app.add_option("SCENE", scene);
  cli::GivenOptions options;
  cli::add_sections(app, options,
                    {"Directions", "Engine", "Iteration", "Accuracy", "Scene", "Patches",
                     "Refinement", "Sky", "Machine"});
  try {
    Words reversed(words.rbegin(), words.rend());
    app.parse(std::move(reversed));
    cli::complete(options);
    outcome.options = options.run;
  } catch (const CLI::ParseError& error) {
    outcome.refusal = error.what();
  } catch (const InputError& error) {
    outcome.refusal = error.what();
  }
  return outcome;
}

Outcome by_viewer(const Words& words) {
  std::vector<const char*> arguments{"transillum-viewer"};
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  std::ostringstream out, error;
  const ParsedCommandLine parsed =
      parse_command_line(static_cast<int>(arguments.size()), arguments.data(), out, error);
  Outcome outcome{error.str(), parsed.command_line.options};
  const std::string name = "transillum-viewer: ";
  if (outcome.refusal.find(name) == 0) {
    outcome.refusal = outcome.refusal.substr(name.size());
    outcome.refusal.pop_back();
  }
  return outcome;
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  /// A value of an option; sometimes the option refuses it.
  std::string value_of(const Option& option) {
    if (below(60) == 0) {
      return "-7";
    }
    if (!option.choices.empty() && (option.json == Option::Json::text || below(3) == 0)) {
      const std::string& word = option.choices[below(option.choices.size())];
      return word == "patch:I" ? "patch:3" : word;
    }
    if (option.json == Option::Json::numbers) {
      return fmt(number(0, 2)) + "," + fmt(number(0, 2)) + "," + fmt(number(0.1, 2));
    }
    const std::string fraction = fmt(number(1e-9, 1)), real = fmt(number(0.001, 1000));
    for (const std::string& value : {fraction, real}) {
      if (below(2) == 0 && accepts(option, value)) {
        return value;
      }
    }
    const std::string whole = std::to_string(1 + below(64));
    return accepts(option, whole) ? whole : fraction;
  }
  /// Some options with values.
  Words set() {
    Words words;
    const std::size_t count = 1 + below(6);
    std::vector<const Option*> left;
    for (const Option& option : transillum::options()) {
      if (!option.repeats && option.name != "threads") {
        left.push_back(&option);
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto chosen = left.begin() + static_cast<std::ptrdiff_t>(below(left.size()));
      const Option& option = **chosen;
      left.erase(chosen);
      if (option.is_flag()) {
        words.push_back("--" + option.name);
      } else {
        const std::string value = value_of(option);
        if (value.front() == '-' || below(2) == 0) {
          words.push_back("--" + option.name + "=" + value);
        } else {
          words.insert(words.end(), {"--" + option.name, value});
        }
      }
    }
    words.insert(below(2) == 0 ? words.begin() : words.end(), "furnace");
    return words;
  }

 private:
  static bool accepts(const Option& option, const std::string& value) {
    try {
      RunOptions scratch;
      option.parse(scratch, value);
      return true;
    } catch (const InputError&) {
      return false;
    }
  }
  static std::string fmt(double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
  }

  std::mt19937_64 random_;
};

/// The words of a line without quotes.
Words words_of(const std::string& line) {
  std::istringstream text(line);
  Words words;
  for (std::string word; text >> word;) {
    words.push_back(word);
  }
  return words;
}

/// The options without the ones that a session does not store, which depend on the computer.
RunOptions stored(RunOptions options) {
  options.solve.memory = 0;
  options.solve.threads = 0;
  options.paper = false;      // a session has the options that it chose
  options.input.patches = 0;  // once the scene is loaded, the area replaces it
  return options;
}

}  // namespace

class OptionsAgreeTest : public QObject {
  Q_OBJECT

 private slots:
  void of_a_thousand_random_sets() {
    constexpr std::uint64_t seed = 42;
    Draw draw(seed);
    const QTemporaryDir folder;
    const Solution solution = solve(load_scene("furnace"), {.directions = 2});
    int accepted = 0;
    for (int k = 0; k < 1000; ++k) {
      const Words words = draw.set();
      std::string text;
      for (const std::string& word : words) {
        text += word + ' ';
      }
      const Outcome solve = by_command_line(words), viewer = by_viewer(words);
      QVERIFY2(solve.refusal == viewer.refusal,
               (text + "\n" + solve.refusal + "\n" + viewer.refusal).c_str());
      if (!solve.refusal.empty()) {
        continue;
      }
      ++accepted;
      QVERIFY2(solve.options == viewer.options, text.c_str());
      const nlohmann::json session = to_json(solve.options);
      QVERIFY2(run_options_from_json(session, "session") == stored(solve.options), text.c_str());
      check_copied_command(solve.options, text);
      check_statistics(solve.options, solution, folder.filePath("s.json").toStdString(), text);
    }
    QVERIFY2(accepted > 250, std::to_string(accepted).c_str());
  }

  void former_names_in_files_are_read() {
    const RunOptions options = run_options_from_json(
        nlohmann::json::parse(R"({"two-way": false, "resolution": 0, "iterations": 0,
                                  "rotate": null, "read": {"turn-faces": true}})"),
        "session");
    QVERIFY(!options.solve.two_way);
    QVERIFY(options.input.orient);
    QVERIFY(options.solve == (SolveOptions{.two_way = false, .first_shot = {}}));
  }

 private:
  static void check_copied_command(const RunOptions& options, const std::string& text) {
    const std::string line = solve_command("furnace", options, {});
    Words copied = words_of(line);
    copied.erase(copied.begin(), copied.begin() + 2);
    Outcome again = by_command_line(copied);
    QVERIFY2(again.refusal.empty(), (text + "\n" + line + "\n" + again.refusal).c_str());
    RunOptions expected = options;
    if (options.solve.goal.is_set()) {
      expected.solve.tolerance = SolveOptions{}.tolerance;  // chosen by the goal
    }
    QVERIFY2(again.options == expected, (text + "\n" + line).c_str());
  }

  static void check_statistics(const RunOptions& options, const Solution& solution,
                               const std::string& file, const std::string& text) {
    write_statistics(file, options, solution);
    std::ifstream stream(file);
    const nlohmann::json json = nlohmann::json::parse(stream).at("options");
    for (const Option& option : transillum::options()) {
      if (!option.in_files || option.reads_scene || option.section == "Patches") {
        continue;
      }
      RunOptions read;
      if (why_unused(option.name, {options}).empty()) {
        option.from_json(read, json.at(option.name).dump());
        read.refine.by = options.refine.by;
        QVERIFY2(option.print(read) == option.print(options),
                 (text + "\n" + option.name + " " + json.at(option.name).dump()).c_str());
      } else {
        QVERIFY2(json.at(option.name).is_null(), (text + "\n" + option.name).c_str());
      }
    }
  }
};

const test::Registered registered("options_agree", test::run_without_application<OptionsAgreeTest>);

}  // namespace transillum::viewer::options_agree_test

#include "options_agree_test.moc"
