// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// From the name of a scene to what the window needs of it.
#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <string>

#include "model/snapshot.h"
#include "options/option_table.h"
#include "transillum/cancellation.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

/// Called on any thread, one at a time, with the name of the present task and its finished
/// fraction, 0 to 1; negative if unknown.
using LoadProgress = std::function<void(const QString& phase, double fraction)>;

/// Passes preparations of a solve on to `progress`, not too often.
std::function<void(Preparation, double)> phase_reporter(LoadProgress progress);

/// Reads a scene and builds its tree.
/// @param spec file or built-in
/// @param options  they get linear functions where faces are divided for a first look
/// @param first_look  whether the faces of a scene of few are divided, unless `options` say
/// otherwise
/// @param faces  the description that is used instead of reading `spec`; null to read it
/// @throws InputError, Canceled
std::shared_ptr<const LoadedScene> loaded_scene(
    const std::string& spec, RunOptions& options, bool first_look, const LoadProgress& progress,
    const Cancellation& cancellation,
    const std::shared_ptr<const SceneDescription>& faces = nullptr);

/// The scene of a description whose faces were edited, without a picker and measures of its own: it
/// keeps the ones of `before` if both have as many patches.
/// @param divided  SceneInput::divided
/// @throws InputError, Canceled
std::shared_ptr<LoadedScene> edited_scene(const LoadedScene& before,
                                          std::shared_ptr<const SceneDescription> description,
                                          const std::vector<std::string>& divided,
                                          const Cancellation& cancellation);
/// Sets the picker and the measures of an edited scene.
/// @throws Canceled
void complete(LoadedScene& edited, const Cancellation& cancellation);

/// The scene of a session with its tree, which must be prepared.
/// @param divisions the divisions that make the session's patches from the patches of `start`, as
/// in SceneInput::divided
/// @param start  the scene before patches were divided; it is returned if none were
/// @throws Canceled
std::shared_ptr<const LoadedScene> with_patches_of(const SolveSession& session,
                                                   const std::vector<std::string>& divisions,
                                                   const std::shared_ptr<const LoadedScene>& start,
                                                   const Cancellation& cancellation);

}  // namespace transillum::viewer
