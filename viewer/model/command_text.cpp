// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lines for a shell. Options have the same names in session files and on the command line, so the
// line is made of what a session file would hold (run_options.h); the few that are written
// differently are named here.
#include "model/command_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace transillum::viewer {

using nlohmann::json;

namespace {

/// As one word of a shell.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string("_./:=,+-").find(c) != std::string::npos;
  });
  if (plain) {
    return word;
  }
  std::string text = "'";
  for (const char c : word) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

std::string text_of(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

class Line {
 public:
  explicit Line(const std::string& begin) : text_(begin) {}

  void add(const std::string& word) { text_ += ' ' + quoted(word); }
  void add(const std::string& option, const std::string& value) {
    add("--" + option);
    add(value);
  }
  /// Options of `given` that differ from `usual`; the caller writes those of `others`.
  void add_differences(const json& given, const json& usual,
                       const std::vector<std::string>& others) {
    for (const auto& [key, value] : given.items()) {
      if (value != usual.value(key, json()) &&
          std::find(others.begin(), others.end(), key) == others.end()) {
        add(key, text_of(value));
      }
    }
  }
  void add_changes(const std::vector<MaterialChange>& changes) {
    const auto add_value = [this](const char* option, const MaterialChange& change,
                                  const Rgb& value) {
      add(option, fmt::format("{}={},{},{}", change.target, value.r, value.g, value.b));
    };
    for (const MaterialChange& change : changes) {
      if (change.exitance) {
        add_value("emission", change, *change.exitance);
      }
      if (change.reflectance) {
        add_value("reflectance", change, *change.reflectance);
      }
      if (change.lobe && change.lobe->shape == LobeShape::phong) {
        const Rgb& k = change.lobe->reflectance;
        add("lobe",
            fmt::format("{}={},{},{},{}", change.target, k.r, k.g, k.b, change.lobe->exponent));
      }
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// How the scene is read, which the two commands have in common.
void add_scene(Line& line, const std::string& scene, const RunOptions& options,
               const std::vector<MaterialChange>& changes) {
  line.add(scene);
  const SceneInput& input = options.input;
  const json read = to_json(RunOptions{{}, {}, input}).value("read", json::object());
  const json usual = {{"default-reflectance", ReadOptions().default_reflectance},
                      {"scale", ReadOptions().scale}};
  line.add_differences(read, usual, {"changes", "turn-faces", "join", "photometric"});
  if (input.read.join) {
    line.add(*input.read.join ? "--join" : "--no-join");
  }
  if (input.read.photometric) {
    line.add("--photometric");
  }
  line.add_changes(input.changes);
  line.add_changes(changes);
  if (input.orient) {
    line.add("orient", "auto");
  }
  if (options.scene.two_sided) {
    line.add("--two-sided");
  }
  if (options.scene.max_patch_area > 0) {
    line.add("max-patch-area", fmt::format("{}", options.scene.max_patch_area));
  }
}

void add_sky(Line& line, const Sky& sky) {
  if (!sky.set()) {
    return;
  }
  const Rgb& e = sky.exitance;
  line.add("sky", e.r == e.g && e.g == e.b ? fmt::format("{}", e.r)
                                           : fmt::format("{},{},{}", e.r, e.g, e.b));
  if (sky.model != Sky().model) {
    line.add("sky-model", name_of(sky.model));
    line.add("up", fmt::format("{},{},{}", sky.up.x, sky.up.y, sky.up.z));
  }
}

}  // namespace

std::string solve_command(const std::string& scene, const RunOptions& options,
                          const std::vector<MaterialChange>& changes) {
  Line line("transillum solve");
  add_scene(line, scene, options, changes);
  const SolveOptions& solve = options.solve;
  std::vector<std::string> others{"read",      "two-way",   "two-sided",   "max-patch-area",
                                  "sky",       "sky-model", "up",          "glossy",
                                  "refine-by", "patches",   "refine-until"};
  if (solve.goal.set()) {
    // Chosen by the goal.
    others.insert(others.end(), {"directions", "replicas", "tolerance"});
  } else {
    others.insert(others.end(), {"accuracy", "accuracy-of", "seconds"});
  }
  line.add_differences(to_json(options), to_json(RunOptions{}), others);
  if (!solve.two_way) {
    line.add("--one-way");
  }
  if (solve.glossy) {
    line.add("--glossy");
  }
  add_sky(line, solve.sky);
  if (options.refine.set()) {
    line.add("refine-by", name_of(*options.refine.by));
    line.add("patches", fmt::format("{}", options.refine.patches));
    if (options.refine.until > 0) {
      line.add("refine-until", fmt::format("{}", options.refine.until));
    }
  }
  if (solve.engine_options.order != EngineOptions().order) {
    line.add("order", "newell");
  }
  return line.text();
}

std::string map_command(const std::string& scene, const RunOptions& options,
                        const std::vector<MaterialChange>& changes, const Vec3& omega,
                        std::optional<std::int32_t> steps) {
  Line line("transillum map");
  add_scene(line, scene, options, changes);
  line.add("direction", fmt::format("{},{},{}", omega.x, omega.y, omega.z));
  if (steps) {
    line.add("step", fmt::format("{}", *steps));
  }
  return line.text();
}

}  // namespace transillum::viewer
