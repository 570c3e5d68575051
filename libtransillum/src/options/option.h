// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <string>
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
  bool of_machine = false;                ///< concerns time and memory only, not the result
  bool reads_factors = false;             ///< a solve with given form factors reads it
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

}  // namespace transillum
