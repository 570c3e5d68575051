// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The steps from the argument SCENE and its options to a Scene: reading, changes of materials, the
// limit of patch areas, checks and warnings.
#include "cli/arguments/scene_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

#include "cli/arguments/option_values.h"
#include "cli/messages.h"
#include "cli/progress_display.h"
#include "cli/reports/report_text.h"
#include "scene/build/patch_count.h"
#include "session/divisions.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/solids.h"
#include "visibility/bsp/coplanar_overlap.h"

namespace transillum::cli {
namespace {

/// "12345 patches of at most 0.01 m2; about 24 MB of memory", before they are made.
std::string patches_text(std::int64_t count, double max_area, bool keeps_factors) {
  return fmt::format("{} patches of at most {:.4g} m2; about {:.3g} MB of memory{}", count,
                     max_area, 1e-6 * static_cast<double>(expected_memory(count)),
                     keeps_factors ? " without form factors, which --memory limits" : "");
}

bool has_option(const CLI::App& command, const std::string& name) {
  return command.get_option_no_throw(name) != nullptr;
}

bool is_quiet(const CLI::App& command) {
  const CLI::Option* quiet = command.get_option_no_throw("--quiet");
  return quiet != nullptr && quiet->count() > 0;
}

/// The group or material that most of the backs are of, for a message.
std::string most_backs(const BackFraction& backs) {
  const bool by_group = !backs.groups.empty();
  const std::vector<BackCount>& counts = by_group ? backs.groups : backs.materials;
  return counts.empty() ? std::string()
                        : fmt::format(" ({} of {} \"{}\")", fraction_text(counts.front().of_all),
                                      by_group ? "group" : "material", counts.front().name);
}

/// Turns parts of the scene and prints what was done, and what is still seen from behind.
void orient_input(const SceneInput& input, SceneDescription& description,
                  const Cancellation& cancellation) {
  ProgressDisplay display(is_quiet(*input.command));
  display.begin("turning faces");
  const OrientationReport report =
      orient(description, input.run.solve.threads, cancellation,
             [&](double fraction) { display.show("turning faces", fraction); });
  display.clear();
  if (!is_quiet(*input.command)) {
    for (const std::string& sentence : report.sentences) {
      print_message("orientation: " + sentence);
    }
  }
  if (input.run.scene.two_sided) {
    return;
  }
  const BackFraction backs =
      back_fraction(Scene(description, {}, cancellation), input.run.solve.threads, cancellation);
  if (backs.fraction > BackFraction::worth_a_warning) {
    print_message(
        fmt::format("warning: {} of what light meets are backs of faces, which absorb it, also "
                    "after turning faces{} (try --two-sided)",
                    fraction_text(backs.fraction), most_backs(backs)));
  }
}

/// "face 3 (lamp)", by group if the scene has groups, else by material.
std::string face_text(const Scene& scene, PatchId patch) {
  const std::int32_t group = scene.patch(patch).group;
  return fmt::format("face {} ({})", scene.patch(patch).face,
                     group == no_group ? scene.material(patch).name : at(scene.groups(), group));
}

/// Largest number of overlaps to search for.
constexpr std::size_t max_overlaps = 10000;
/// Losses of a smaller fraction of a face's light are not mentioned.
constexpr double least_loss = 1e-3;

/// One line about faces of which others of their plane cover parts of patches; else empty. A patch
/// receives only where it is not covered, but its B is the mean over all of it. Patches that are
/// covered as a whole lose nothing.
std::string overlap_advice(const Scene& scene, const Cancellation& cancellation) {
  const auto overlaps = coplanar_overlaps(scene, max_overlaps, cancellation);
  std::map<PatchId, double> covered;
  for (const CoplanarOverlap& overlap : overlaps) {
    covered[overlap.lower] += overlap.area;
  }
  std::map<std::int32_t, double> areas;
  for (const Patch& patch : scene.patches()) {
    areas[patch.face] += patch.area;
  }
  struct Loss {
    PatchId upper, lower;
    double fraction = 0;  // lost fraction of the light of the lower face
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Loss> losses;
  for (const auto& [upper, lower, area] : overlaps) {
    const Patch& patch = scene.patch(lower);
    const double visible = std::max(0.0, 1 - covered[lower] / patch.area);
    losses.try_emplace({scene.patch(upper).face, patch.face}, Loss{upper, lower})
        .first->second.fraction += area * visible / areas[patch.face];
  }
  std::erase_if(losses, [](const auto& loss) { return loss.second.fraction < least_loss; });
  if (losses.empty()) {
    return {};
  }
  const Loss& worst = std::max_element(losses.begin(), losses.end(), [](const auto& a, auto& b) {
                        return a.second.fraction < b.second.fraction;
                      })->second;
  return fmt::format(
      "{} loses {} of its light, because {} in the same plane covers parts of its patches{}: cut "
      "the covered part out, move one of them, or make smaller patches",
      face_text(scene, worst.lower), fraction_text(worst.fraction), face_text(scene, worst.upper),
      losses.size() == 1
          ? ""
          : fmt::format(" ({} more such pairs, listed by `info`)", losses.size() - 1));
}

/// Says which face:N of a change has no patch: a face without area, or inside a solid.
void warn_of_lost_changes(const SceneInput& input, const Scene& scene) {
  constexpr std::string_view prefix = "face:";
  for (const MaterialChange& change : input.run.input.changes) {
    std::int32_t face = -1;
    if (change.target.starts_with(prefix)) {
      std::from_chars(change.target.data() + prefix.size(),
                      change.target.data() + change.target.size(), face);
    }
    const auto& patches = scene.patches();
    if (face >= 0 && std::none_of(patches.begin(), patches.end(),
                                  [&](const Patch& patch) { return patch.face == face; })) {
      print_message(fmt::format(
          "warning: {} is changed, but removed: it has no area, or is inside a united solid",
          change.target));
    }
  }
}

/// The options of the scene with the limit of patch areas that --patches asks for. Prints what the
/// division will make.
SceneOptions division(const SceneInput& input, const SceneDescription& description,
                      const Cancellation& cancellation) {
  SceneOptions options = input.run.scene;
  std::int64_t patches = input.run.input.patches;
  const bool is_asked = patches > 0 || options.max_patch_area > 0;
  if (input.divides_few_faces && !is_asked) {
    patches = usual_patches(description.face_count());
  }
  if (input.run.refine.is_set() || input.run.total ||
      (patches == 0 && options.max_patch_area == 0)) {
    return options;
  }
  options.max_patch_area = 0;
  const Scene whole(description, options, cancellation);
  options.max_patch_area = patches > 0 ? max_patch_area_for(whole, patches, cancellation)
                                       : input.run.scene.max_patch_area;
  if (whole.patch_count() > patches && patches > 0) {
    print_message(fmt::format("warning: --patches: the faces make {} patches already, more than {}",
                              whole.patch_count(), patches));
  } else if (options.max_patch_area > 0) {
    const std::int64_t count = count_patches(whole, options.max_patch_area);
    if (is_asked && !is_quiet(*input.command)) {
      print_message(
          patches_text(count, options.max_patch_area, has_option(*input.command, "--memory")));
    }
    check_memory(whole.name(), count);
  }
  return options;
}

/// ".obj, .gltf, …", all formats of scenes.
std::string scene_endings() {
  std::vector<std::string> endings;
  for (const SceneFormat& format : scene_formats()) {
    endings.push_back(format.ending);
  }
  return fmt::format("{}", fmt::join(endings, ", "));
}

}  // namespace

void add_scene_argument(CLI::App& command, SceneInput& input) {
  input.command = &command;
  command
      .add_option("SCENE", input.spec,
                  fmt::format("a scene file ({}; OBJ: in its .mtl, Kd = reflectance, Ke = exitance "
                              "in W/m2), or a built-in scene with parameters, such as "
                              "sphere-flake:levels=1",
                              scene_endings()))
      ->required()
      ->type_name("");
}

void add_scene_options(CLI::App& command, SceneInput& input) {
  add_sections(command, input, {"Scene", "Patches"});
}

void check_seed(const SceneInput& input) {
  refuse_unless(is_seeded(input.run.solve.used_sampling()), *input.command, "--seed",
                "used only with sampling random, sobol or scrambled-hammersley");
}

SceneDescription describe_input(const SceneInput& input, const Cancellation& cancellation) {
  SceneDescription description = describe_scene(input.spec, input.run.input.read, cancellation);
  change_materials(description, input.run.input.changes);
  if (input.run.input.orient) {
    orient_input(input, description, cancellation);
  }
  if (input.run.input.unite_solids) {
    const SolidsReport report = unite_solids(description, cancellation);
    for (const std::string& sentence : report.sentences) {
      if (!is_quiet(*input.command)) {
        print_message("solids: " + sentence);
      }
    }
  }
  return description;
}

std::shared_ptr<const Scene> make_input_scene(const SceneInput& input,
                                              const SceneDescription& description,
                                              const Cancellation& cancellation) {
  auto scene = std::make_shared<const Scene>(
      description, division(input, description, cancellation), cancellation);
  return divided_scene(std::move(scene), input.run.input.divided, cancellation);
}

std::string orientation_advice(const SceneInput& input, const BackFraction& backs) {
  if (backs.fraction <= BackFraction::worth_a_warning || input.run.input.orient) {
    return {};
  }
  return fmt::format(
      "{} of what light meets are backs of faces, which absorb it (try --orient "
      "auto)",
      fraction_text(backs.fraction));
}

std::shared_ptr<const Scene> load_input_scene(const SceneInput& input,
                                              const std::vector<std::string>& outputs,
                                              const Cancellation& cancellation, Light light) {
  const SceneDescription description = describe_input(input, cancellation);
  check_distinct(outputs, description.files);
  check_memory(description.name, static_cast<std::int64_t>(description.face_count()));
  auto scene = make_input_scene(input, description, cancellation);
  print_warnings(*scene);
  warn_of_lost_changes(input, *scene);
  if (light == Light::optional) {
    return scene;
  }
  const SolveOptions& solve = input.run.solve;
  if (const std::string why = solve.why_dark(scene->has_light()); !why.empty()) {
    throw InputError(fmt::format(
        "{}: {}; give a material, a group or a face an exitance in W/m2, such as --emission "
        "'{}=10'",
        scene->name(), why, suggested_light(description)));
  }
  if (const std::string advice = overlap_advice(*scene, cancellation); !advice.empty()) {
    print_message("warning: " + advice);
  }
  if (!solve.sky.is_set() && !input.run.input.orient) {
    const std::string advice =
        orientation_advice(input, back_fraction(*scene, solve.threads, cancellation));
    if (!advice.empty()) {
      print_message("warning: " + advice);
    }
  }
  return scene;
}

}  // namespace transillum::cli
