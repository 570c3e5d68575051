// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// The argument SCENE, and the way from it and its options to a scene.

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments/option_arguments.h"
#include "transillum/cancellation.h"
#include "transillum/orientation.h"
#include "transillum/scene.h"

namespace transillum::cli {

/// A scene and the options of a run as a command line has them.
struct SceneInput : GivenOptions {
  std::string spec;  ///< file or built-in scene
  const CLI::App* command = nullptr;
  /// A scene of fewer than 1,000 faces makes 2,000 patches, unless other patches are asked for.
  bool divides_few_faces = false;
};

/// SCENE, required.
void add_scene_argument(CLI::App& command, SceneInput& input);
/// How it is read, changed and divided.
void add_scene_options(CLI::App& command, SceneInput& input);

/// Refuses --seed where only the sampling could use it and does not.
/// @throws InputError
void check_seed(const SceneInput& input);

/// Whether a command needs light of faces, or of the sky that it is given.
enum class Light { optional, required };

/// The scene's faces, read and changed as the options say.
/// @throws InputError, Canceled
SceneDescription describe_input(const SceneInput& input, const Cancellation& cancellation);

/// The scene of a description. Where faces are to be divided, prints how many patches that makes
/// and their memory, before they are made.
/// @throws InputError, Canceled
std::shared_ptr<const Scene> make_input_scene(const SceneInput& input,
                                              const SceneDescription& description,
                                              const Cancellation& cancellation);

/// One line that names --orient auto where more than a tenth of what is seen is a back; else empty.
std::string orientation_advice(const SceneInput& input, const BackFraction& backs);

/// describe_input(), then make_input_scene(). Checks that no output would overwrite one of the
/// scene's files, and prints its warnings.
/// @throws InputError, also where light is required and there is none; Canceled
std::shared_ptr<const Scene> load_input_scene(const SceneInput& input,
                                              const std::vector<std::string>& outputs,
                                              const Cancellation& cancellation,
                                              Light light = Light::optional);

}  // namespace transillum::cli
