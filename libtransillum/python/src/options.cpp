// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "options.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "arrays.h"
#include "transillum/did_you_mean.h"
#include "transillum/settings.h"

namespace transillum::python {
namespace {

using Setter = std::function<void(SolveOptions&, const py::handle&)>;

bool is_bool(const py::handle& value) {
  const std::string type = Py_TYPE(value.ptr())->tp_name;
  return PyBool_Check(value.ptr()) || type == "numpy.bool_" || type == "numpy.bool";
}

/// A number, or True or False: Python would take each for the other.
template <class T>
T number(const py::handle& value) {
  if (is_bool(value) != std::is_same_v<T, bool>) {
    throw py::cast_error();
  }
  return py::cast<T>(value);
}
std::string text(const py::handle& value) { return py::cast<std::string>(value); }
bool is_text(const py::handle& value, const char* expected) {
  return PyUnicode_Check(value.ptr()) && text(value) == expected;
}

Rgb color(const py::handle& value, const std::string& name) {
  if (is_bool(value)) {
    throw py::cast_error();
  }
  if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) {
    const auto gray = number<double>(value);
    return {gray, gray, gray};
  }
  const Vec3 channels = to_vec3(value, name);
  return {channels.x, channels.y, channels.z};
}

const std::map<std::string, Setter>& setters() {
  using Options = SolveOptions;
  using Value = const py::handle&;
  static const std::map<std::string, Setter> all{
      {"directions", [](Options& o, Value v) { o.directions = number<int>(v); }},
      {"sampling", [](Options& o, Value v) { o.sampling = sampling_from_name(text(v)); }},
      {"seed",
       [](Options& o, Value v) {
         o.seed = number<std::uint64_t>(v);
         o.engine_options.seed = o.seed;
       }},
      {"rotate", [](Options& o, Value v) { o.rotation = number<std::uint64_t>(v); }},
      {"engine", [](Options& o, Value v) { o.engine = engine_from_name(text(v)); }},
      {"resolution", [](Options& o, Value v) { o.engine_options.resolution = number<int>(v); }},
      {"points", [](Options& o, Value v) { o.engine_options.points = number<int>(v); }},
      {"lines", [](Options& o, Value v) { o.engine_options.lines_per_patch = number<double>(v); }},
      {"order",
       [](Options& o, Value v) { o.engine_options.order = painters_order_from_name(text(v)); }},
      {"random-lines", [](Options& o, Value v) { o.engine_options.gridded = !number<bool>(v); }},
      {"two-way", [](Options& o, Value v) { o.two_way = number<bool>(v); }},
      {"basis", [](Options& o, Value v) { o.basis = basis_from_name(text(v)); }},
      {"glossy", [](Options& o, Value v) { o.glossy = number<bool>(v); }},
      {"normalize", [](Options& o, Value v) { o.normalize = normalization_from_name(text(v)); }},
      {"scheme", [](Options& o, Value v) { o.scheme = scheme_from_name(text(v)); }},
      {"first-shot",
       [](Options& o, Value v) {
         o.first_shot = PyUnicode_Check(v.ptr()) ? first_shot_from_name(text(v))
                                                 : std::optional(number<double>(v));
       }},
      {"burn-in",
       [](Options& o, Value v) {
         o.burn_in = is_text(v, "auto") ? std::optional<int>() : number<int>(v);
       }},
      {"replicas", [](Options& o, Value v) { o.replicas = number<int>(v); }},
      {"accuracy",
       [](Options& o, Value v) {
         o.goal.accuracy =
             PyUnicode_Check(v.ptr()) ? accuracy_from_text(text(v)) : number<double>(v);
       }},
      {"accuracy-of",
       [](Options& o, Value v) {
         const AccuracyGoal of = accuracy_of_from_name(text(v));
         o.goal.of = of.of;
         o.goal.patch = of.patch;
       }},
      {"seconds", [](Options& o, Value v) { o.goal.seconds = number<double>(v); }},
      {"iterations", [](Options& o, Value v) { o.iterations = number<int>(v); }},
      {"tolerance", [](Options& o, Value v) { o.tolerance = number<double>(v); }},
      {"sky", [](Options& o, Value v) { o.sky.exitance = color(v, "sky"); }},
      {"sky-model", [](Options& o, Value v) { o.sky.model = sky_model_from_name(text(v)); }},
      {"up", [](Options& o, Value v) { o.sky.up = to_direction(v, "up"); }},
      {"memory", [](Options& o, Value v) { o.memory = number<std::uint64_t>(v); }},
      {"threads", [](Options& o, Value v) { o.threads = number<int>(v); }},
  };
  return all;
}

std::string with(std::string name, char from, char to) {
  std::replace(name.begin(), name.end(), from, to);
  return name;
}

/// The values that an option accepts; some differ from those on the command line.
std::string type_of(const std::string& name) {
  static const std::map<std::string, std::string> of_python{{"memory", "a number of bytes"},
                                                            {"rotate", "a number, or None"},
                                                            {"random-lines", "True or False"},
                                                            {"two-way", "True or False"},
                                                            {"glossy", "True or False"},
                                                            {"sky", "one number or three, W/m²"},
                                                            {"up", "three numbers"}};
  const auto own = of_python.find(name);
  if (own != of_python.end()) {
    return own->second;
  }
  return std::find_if(settings().begin(), settings().end(),
                      [&](const Setting& s) { return s.name == name; })
      ->type;
}

}  // namespace

SolveOptions options_from(const py::dict& keywords) {
  SolveOptions options;
  std::vector<std::string> given;
  for (const auto& [key, value] : keywords) {
    const std::string keyword = text(key);
    const std::string name = with(keyword, '_', '-');
    const auto setter = setters().find(name);
    if (setter == setters().end()) {
      std::vector<std::string> known;
      for (const auto& [other, ignored] : setters()) {
        known.push_back(with(other, '-', '_'));
      }
      throw InputError("there is no option " + keyword + did_you_mean(keyword, known));
    }
    if (value.is_none()) {
      continue;
    }
    try {
      setter->second(options, value);
    } catch (const py::cast_error&) {
      throw InputError(keyword + ": expected " + type_of(name) + ", not " +
                       py::cast<std::string>(py::repr(value)));
    }
    given.push_back(name);
  }
  for (const std::string& name : given) {
    if (const std::string why = why_unused(name, {options}); !why.empty()) {
      throw InputError(with(name, '-', '_') + " is " + why);
    }
  }
  options.validate();
  // As in the programs.
  const bool shot_given = std::find(given.begin(), given.end(), "first-shot") != given.end();
  if (options.goal.set() && !shot_given && takes_directions(options.engine) &&
      options.basis == Basis::constant) {
    options.first_shot = first_shot_where_it_pays;
  }
  return options;
}

void refuse(const py::dict& keywords, const std::vector<std::string>& names,
            const std::string& function) {
  for (const auto& [key, value] : keywords) {
    if (!value.is_none() && std::find(names.begin(), names.end(), text(key)) != names.end()) {
      throw InputError(text(key) + " is not an option of " + function);
    }
  }
}

void refuse_others(const py::dict& keywords, const std::vector<std::string>& names,
                   const std::string& function) {
  for (const auto& [key, value] : keywords) {
    if (!value.is_none() && std::find(names.begin(), names.end(), text(key)) == names.end()) {
      throw InputError(text(key) + " is not an option of " + function);
    }
  }
}

py::list option_list() {
  py::list list;
  for (const Setting& setting : settings()) {
    const std::string name = setting.name;
    static const std::vector<std::string> of_scenes{"two-sided", "max-patch-area", "refine-by",
                                                    "patches", "refine-until"};
    if (std::find(of_scenes.begin(), of_scenes.end(), name) != of_scenes.end()) {
      continue;
    }
    if (setters().count(name) == 0) {
      throw std::logic_error("option " + name + " is missing in Python");
    }
    list.append(py::make_tuple(with(name, '-', '_'), type_of(name), setting.description,
                               setting.default_value));
  }
  return list;
}

}  // namespace transillum::python
