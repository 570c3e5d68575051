// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// SolveRunner's worker: from a request to a scene, its BSP tree and a solver, new or of a
// checkpoint.
#include <utility>

#include "model/solve_runner.h"
#include "support/elapsed.h"
#include "transillum/checkpoint.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/material_changes.h"
#include "transillum/orientation.h"
#include "transillum/patch_count.h"

namespace transillum::viewer {

namespace {

/// @throws InputError, Canceled
std::shared_ptr<const Scene> make_scene(const SceneDescription& description,
                                        const RunOptions& options,
                                        const Cancellation& cancellation) {
  SceneOptions scene_options = options.scene;
  const int unknowns = options.solve.basis == Basis::linear ? 3 : 1;
  check_memory(description.name, static_cast<std::int64_t>(description.face_count()),
               options.solve.replicas, unknowns);
  if (options.input.patches > 0 || scene_options.max_patch_area > 0) {
    SceneOptions undivided = scene_options;
    undivided.max_patch_area = 0;
    const Scene whole(description, undivided, cancellation);
    if (options.input.patches > 0) {
      scene_options.max_patch_area = max_patch_area_for(whole, options.input.patches, cancellation);
    }
    if (scene_options.max_patch_area > 0) {
      check_memory(description.name, count_patches(whole, scene_options.max_patch_area),
                   options.solve.replicas, unknowns);
    }
  }
  return std::make_shared<const Scene>(description, scene_options, cancellation);
}

}  // namespace

void SolveRunner::load(const OpenRequest& request) {
  post_state(RunState::loading);
  const QString name = QString::fromStdString(request.spec);
  try {
    request.options.solve.validate();
    const Cancellation cancellation = load_cancellation_;
    auto loaded = std::make_shared<LoadedScene>();
    post_load_progress(tr("Loading %1").arg(name), -1);
    read_scene(request, *loaded, cancellation);
    build_tree(*loaded, cancellation);
    if (request.options.solve.first_shot) {
      post_load_progress(tr("Computing the first shot"), -1);
    }
    replace_scene(request, loaded, make_solver(*loaded, request.options.solve, cancellation),
                  cancellation);
  } catch (...) {
    post_current_failure(tr("%1 does not fit into memory").arg(name));
  }
}

void SolveRunner::read_scene(const OpenRequest& request, LoadedScene& loaded,
                             const Cancellation& cancellation) {
  QElapsedTimer timer;
  timer.start();
  if (is_result_file(request.spec)) {
    loaded.stored = std::make_shared<const Solution>(read_result(request.spec, cancellation));
    loaded.scene = loaded.stored->scene;
    loaded.file = request.spec;
  } else {
    loaded.description = std::make_shared<const SceneDescription>(describe(request, cancellation));
    loaded.scene = make_scene(*loaded.description, request.options, cancellation);
  }
  loaded.back_share = back_share(*loaded.scene, 0, cancellation).share;
  loaded.picker = std::make_shared<const Picker>(loaded.scene, cancellation);
  loaded.measures = measure(*loaded.scene, cancellation);
  loaded.seconds_load = seconds(timer);
}

SceneDescription SolveRunner::describe(const OpenRequest& request,
                                       const Cancellation& cancellation) {
  const SceneInput& input = request.options.input;
  SceneDescription description = describe_scene(request.spec, input.read, cancellation);
  change_materials(description, input.changes);
  if (input.orient) {
    const OrientationReport report = orient(description, 0, cancellation, [this](double share) {
      post_load_progress(tr("Turning faces"), share);
    });
    for (const std::string& sentence : report.sentences) {
      description.notes.push_back("orientation: " + sentence);
    }
  }
  return description;
}

void SolveRunner::build_tree(LoadedScene& loaded, const Cancellation& cancellation) {
  constexpr qint64 report_interval_ms = 50;
  QElapsedTimer timer, since_report;
  timer.start();
  since_report.start();
  const auto report = [this, &since_report](double share) {
    if (since_report.elapsed() < report_interval_ms) {
      return;
    }
    since_report.start();
    post_load_progress(tr("Building the BSP tree"), share);
  };
  loaded.tree = std::make_shared<BspTree>(*loaded.scene, cancellation, report);
  loaded.seconds_bsp = seconds(timer);
}

void SolveRunner::replace_scene(const OpenRequest& request,
                                const std::shared_ptr<const LoadedScene>& loaded,
                                PlannedSolver solver, const Cancellation& cancellation) {
  {
    // From here on, stop() stops the solve of the new scene.
    const std::lock_guard lock(mutex_);
    cancellation.throw_if_canceled();
    solve_cancellation_ = cancellation;
    loading_ = false;
    options_ = request.options.solve;
    goal_ = request.then;
    ++goal_number_;
  }
  loaded_ = loaded;
  keeper_.begin(loaded->scene, request.options.solve);
  replace_solver(std::move(solver));
  {
    const std::lock_guard lock(mutex_);
    pending_snapshot_ = nullptr;  // of the previous scene
  }
  post([this, loaded] {
    announced_ = loaded;
    emit scene_loaded(loaded);
    deliver_snapshot();
  });
  post_snapshot();
}

SolveRunner::PlannedSolver SolveRunner::make_solver(const LoadedScene& loaded,
                                                    const SolveOptions& options,
                                                    const Cancellation& cancellation) {
  if (std::optional<PlannedSolver> old = resumed(loaded, options, cancellation)) {
    return std::move(*old);
  }
  PlannedSolver made;
  if (options.goal.set()) {
    made.plan.emplace(options, *loaded.scene);
  }
  made.solver = std::make_unique<RadiositySolver>(
      loaded.scene, made.plan ? made.plan->stage() : options, loaded.tree, cancellation);
  return made;
}

/// Nothing where there is no checkpoint, or none of this solve.
std::optional<SolveRunner::PlannedSolver> SolveRunner::resumed(const LoadedScene& loaded,
                                                               const SolveOptions& options,
                                                               const Cancellation& cancellation) {
  std::string file;
  {
    const std::lock_guard lock(mutex_);
    file = std::exchange(go_on_with_, {});
  }
  if (file.empty()) {
    return std::nullopt;
  }
  const RemovedAtEnd removed(file);
  try {
    Checkpoint::Resumed old =
        Checkpoint(file, *loaded.scene, options)
            .resume(loaded.scene, options, loaded.tree, nullptr, cancellation);
    return PlannedSolver{std::make_unique<RadiositySolver>(std::move(old.solver)),
                         std::move(old.plan), old.seconds};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace transillum::viewer
