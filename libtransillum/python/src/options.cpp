// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "bindings.h"

#include <algorithm>
#include <set>
#include <string>

#include "base/did_you_mean.h"
#include "options/option_table.h"
#include "transillum/errors.h"

namespace py = pybind11;

namespace transillum::python {
namespace {

std::string text(const py::handle& value) { return py::cast<std::string>(value); }

std::string with(std::string name, char from, char to) {
  std::replace(name.begin(), name.end(), from, to);
  return name;
}

/// Whether an option belongs to a solve. Options that say how a scene is made belong to Scene.
bool is_of_solve(const Option& option) {
  return !option.reads_scene && option.section != "Patches" && option.section != "Refinement";
}

/// A value as JSON. Numbers of NumPy are numbers, its arrays lists.
std::string json_of(const py::handle& value) {
  py::object plain = py::reinterpret_borrow<py::object>(value);
  if (py::hasattr(plain, "tolist")) {
    plain = plain.attr("tolist")();
  }
  return text(py::module_::import("json").attr("dumps")(plain));
}

/// The values that an option accepts, in the words of Python.
std::string values_of(const Option& option) {
  const std::size_t none = option.values.rfind(", or none");
  return option.json == Option::Json::flag ? "True or False"
         : none != std::string::npos       ? option.values.substr(0, none) + ", or None"
                                           : option.values;
}

void set(RunOptions& options, const Option& option, const std::string& keyword,
         const py::handle& value) {
  std::string json;
  try {
    json = json_of(value);
    // Not numbers to JSON.
    if (json.find("NaN") == std::string::npos && json.find("Infinity") == std::string::npos) {
      option.from_json(options, json);
      return;
    }
  } catch (const py::error_already_set&) {
    // an object that JSON does not have
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.find("expected") != 0) {
      throw InputError(message.find('"') == 0 ? keyword + ": " + message : message);
    }
  }
  throw InputError(keyword + ": expected " + values_of(option) + ", not " +
                   py::cast<std::string>(py::repr(value)));
}

}  // namespace

SolveOptions options_from(const py::dict& keywords, Goal goal) {
  RunOptions options;
  std::set<std::string> given;
  for (const auto& [key, value] : keywords) {
    const std::string keyword = text(key);
    const std::string name = with(keyword, '_', '-');
    const auto found = std::find_if(
        transillum::options().begin(), transillum::options().end(),
        [&](const Option& option) { return option.name == name && is_of_solve(option); });
    if (found == transillum::options().end()) {
      std::vector<std::string> known;
      for (const Option& option : transillum::options()) {
        if (is_of_solve(option)) {
          known.push_back(with(option.name, '-', '_'));
        }
      }
      throw InputError("there is no option " + keyword + did_you_mean(keyword, known));
    }
    if (value.is_none()) {
      continue;
    }
    set(options, *found, keyword, value);
    given.insert(name);
  }
  std::set<std::string> decided = given;
  if (goal == Goal::none) {
    decided.insert("accuracy");
  }
  set_dependent_defaults(options, decided);
  options.validate();
  for (const std::string& name : given) {
    if (const std::string why = why_unused(name, {options}); !why.empty()) {
      throw InputError(with(name, '-', '_') + " is " + why);
    }
  }
  return options.solve;
}

void refuse(const py::dict& keywords, const std::vector<std::string>& names, bool listed,
            const std::string& function) {
  for (const auto& [key, value] : keywords) {
    const bool is_listed = std::find(names.begin(), names.end(), text(key)) != names.end();
    if (!value.is_none() && is_listed == listed) {
      throw InputError(text(key) + " is not an option of " + function);
    }
  }
}

py::list option_list() {
  py::list list;
  for (const Option& option : transillum::options()) {
    if (is_of_solve(option)) {
      list.append(py::make_tuple(with(option.name, '-', '_'), values_of(option), option.help,
                                 option.default_value()));
    }
  }
  return list;
}

}  // namespace transillum::python
