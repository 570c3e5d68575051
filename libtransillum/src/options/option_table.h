// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The table of options: what each is called, what it means, how it is written, when it has an
// effect, and which exclude each other. Command lines, session files, keywords of Python, settings
// in statistics, help and manual pages are loops over it.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "transillum/run_options.h"

namespace transillum {

/// One option of a run.
struct Option {
  /// How its values look in JSON. Where `unset` is not empty, null stands for it.
  enum class Json {
    flag,     ///< true or false
    number,   ///< a number, or a word
    text,     ///< a word
    numbers,  ///< a list of numbers, or one for all
  };

  std::string name;                       ///< without dashes, as in files
  std::string section;                    ///< section of help texts
  std::string argument;                   ///< such as "X,Y,Z"; empty for a flag
  std::string values;                     ///< the values it accepts, as "a number, or auto"
  std::string help;                       ///< begins in lower case, no full stop
  Json json = Json::text;                 ///< how files write it
  std::vector<std::string> choices = {};  ///< words that it accepts
  bool lists_choices = false;             ///< help_text() lists them
  std::string unset = {};                 ///< the word for nothing: none or auto
  bool zero_is_unset = false;             ///< files of former versions have 0 for `unset`
  std::string default_text = {};          ///< for help; empty: the value in RunOptions is shown
  bool common = false;                    ///< among those that most people need
  bool in_files = true;                   ///< sessions and statistics have it
  bool reads_scene = false;               ///< says how a file is read: not for results
  bool repeats = false;                   ///< may be given several times
  char letter = 0;                        ///< the m of -m; 0: the option has no short name
  /// Sets it from text. @throws InputError
  std::function<void(RunOptions&, const std::string&)> parse = {};
  /// Its value as text that parse() reads back, bit for bit.
  std::function<std::string(const RunOptions&)> print = {};

  /// Whether it has no value on a command line.
  bool is_flag() const { return argument.empty(); }
  /// The help text with choices and the default.
  std::string help_text() const;
  /// The default value as text.
  std::string default_value() const;
  /// Its value as JSON text.
  std::string to_json(const RunOptions& options) const;
  /// Sets it from JSON text.
  /// @throws InputError for a value of another type, or what parse() refuses
  void from_json(RunOptions& options, const std::string& json) const;
};

/// All options of a run.
const std::vector<Option>& options();
/// The option called `name`.
/// @throws std::out_of_range where there is none
const Option& option(const std::string& name);
/// Sets the option `key` from JSON text; former names of options are known too.
/// @returns whether there is such an option
/// @throws InputError as Option::from_json()
bool set_from_json(RunOptions& options, const std::string& key, const std::string& json);

/// Why an option changes nothing in any of these runs, as "used only with engine painter"; empty
/// if it has an effect. For front ends, to refuse options that would silently do nothing.
std::string why_unused(const std::string& name, const std::vector<RunOptions>& runs);
/// The reason why an option cannot be combined with another one in `options`, such as "lobes are
/// not available with a linear basis"; empty if all can be combined with it.
std::string conflict_of(const std::string& name, const RunOptions& options);
/// The defaults that depend on other options: of the first shot and the iterations in the mean.
/// @param given names of the options that were given
void set_dependent_defaults(RunOptions& options, const std::set<std::string>& given);
/// The name and the value, as text, of each option that must be given to get `options` from the
/// defaults, by parse() and then set_dependent_defaults(). Options without effect are omitted.
std::vector<std::pair<std::string, std::string>> differences_from_default(
    const RunOptions& options);

/// The limit of kept form factors where SolveOptions::memory is 0, bytes: a quarter of the
/// machine's memory.
std::uint64_t default_memory_limit();

}  // namespace transillum
