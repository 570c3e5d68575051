// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// The argument SCENE and the options that say how it is read, changed and divided: one place for
// all commands, so that a new option of scenes is one more line here.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/material_changes.h"
#include "transillum/orientation.h"
#include "transillum/scene.h"

namespace transillum::cli {

/// A scene as the command line describes it.
struct SceneInput {
  std::string spec;  ///< file or built-in scene
  ReadOptions read;
  std::vector<MaterialChange> changes;
  SceneOptions options;
  std::int64_t patches = 0;  ///< about this number of patches; 0: not given
  bool orient = false;       ///< turn parts so that what is seen is lit
  bool in_rounds = false;    ///< `patches` is for rounds of refinement: faces are left whole
  const CLI::App* command = nullptr;
};

/// SCENE, required.
void add_scene_argument(CLI::App& command, SceneInput& input);
/// --default-reflectance, --max-reflectance, --scale, --units
void add_reading_options(CLI::App& command, SceneInput& input);
/// --emission, --reflectance, --lobe
void add_material_options(CLI::App& command, SceneInput& input);
/// --orient
void add_orientation_option(CLI::App& command, SceneInput& input);
/// --two-sided, --max-patch-area, --patches
void add_patch_options(CLI::App& command, SceneInput& input);
/// All of these options.
void add_scene_options(CLI::App& command, SceneInput& input);

/// Which light a command needs: none, that of faces, or that of a sky.
enum class Light { optional, required, sky };

/// The scene's faces, read and changed as the options say.
/// @throws InputError, Canceled
SceneDescription describe_input(const SceneInput& input, const Cancellation& cancellation);

/// The scene of a description. Where faces are to be divided, prints how many patches that makes
/// and their memory, before they are made.
/// @throws InputError, Canceled
std::shared_ptr<const Scene> make_input_scene(const SceneInput& input,
                                              const SceneDescription& description,
                                              const Cancellation& cancellation);

/// Whether any face has a patch on each side.
bool has_two_sided_faces(const Scene& scene);

/// One line that names --orient auto where more than a tenth of what is seen is a back; else empty.
std::string orientation_advice(const SceneInput& input, const BackShare& backs);

/// describe_input(), then make_input_scene(). Checks that no output would overwrite one of the
/// scene's files, and prints its warnings.
/// @throws InputError, also where light is required and there is none; Canceled
std::shared_ptr<const Scene> load_input_scene(const SceneInput& input,
                                              const std::vector<std::string>& outputs,
                                              const Cancellation& cancellation,
                                              Light light = Light::optional);

}  // namespace transillum::cli
