// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lines for a shell.
#include "model/command_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "options/option_table.h"

namespace transillum::viewer {

namespace {

/// The text as one word of a shell, in quotes where it needs them.
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

class Line {
 public:
  explicit Line(const std::string& begin) : text_(begin) {}

  void add(const std::string& word) { text_ += ' ' + quoted(word); }
  /// A program that runs if the one before succeeds.
  void add_program(const std::string& begin) { text_ += " && " + begin; }
  void add(const std::string& option, const std::string& value) {
    add("--" + option);
    add(value);
  }
  /// Adds the options that differ from their defaults, if they satisfy `is_wanted`.
  template <class IsWanted>
  void add_differences(const RunOptions& options, IsWanted is_wanted) {
    for (const auto& [name, value] : differences_from_default(options)) {
      if (!is_wanted(option(name))) {
        continue;
      }
      if (option(name).is_flag()) {
        add((value == "no" ? "--no-" : "--") + name);
      } else {
        add(name, value);
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

}  // namespace

std::string solve_command(const std::string& scene, const RunOptions& options,
                          const std::vector<MaterialChange>& changes) {
  Line line("transillum solve");
  line.add(scene);
  line.add_changes(options.input.changes);
  line.add_changes(changes);
  RunOptions asked = options;
  if (asked.solve.goal.is_set()) {
    asked.solve.tolerance = SolveOptions{}.tolerance;  // chosen by the goal
  }
  line.add_differences(asked, [](const Option& option) { return option.name != "threads"; });
  return line.text();
}

std::string picture_command(const std::string& solve, const PictureCommand& picture) {
  constexpr const char* result = "scene.vtp";
  const auto text = [](const Vec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
  Line line(solve);
  line.add("out", result);
  line.add_program("transillum picture");
  line.add(result);
  const Camera& camera = picture.camera;
  line.add("eye", text(camera.eye));
  line.add("target", text(camera.target));
  if (camera.up) {
    line.add("camera-up", text(*camera.up));
  }
  if (camera.field_of_view) {
    line.add("fov", fmt::format("{}", *camera.field_of_view));
  }
  line.add("size", fmt::format("{}x{}", picture.width, picture.height));
  if (picture.false_colors) {
    line.add("--false-color");
  }
  line.add("exposure", fmt::format("{:.4g}", picture.exposure));
  line.add("out", "scene.png");
  return line.text();
}

std::string map_command(const std::string& scene, const RunOptions& options,
                        const std::vector<MaterialChange>& changes, const Vec3& omega,
                        std::optional<std::int32_t> steps, PatchId receiver) {
  Line line("transillum map");
  line.add(scene);
  line.add_changes(options.input.changes);
  line.add_changes(changes);
  line.add_differences(options, [](const Option& option) {
    return option.section == "Scene" || option.section == "Patches";
  });
  line.add("direction", fmt::format("{},{},{}", omega.x, omega.y, omega.z));
  if (steps) {
    line.add("step", fmt::format("{}", *steps));
  }
  if (receiver != no_patch) {
    line.add("receiver", fmt::format("{}", receiver));
  }
  line.add("out", "map.svg");
  return line.text();
}

}  // namespace transillum::viewer
