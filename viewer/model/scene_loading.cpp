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
    RunRequest run{request.options.solve, request.options.refine};
    PreparedRun prepared = prepare(loaded, run, cancellation);
    replace_scene(request, run, std::move(prepared), cancellation);
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

/// The same scene with other patches.
std::shared_ptr<const LoadedScene> SolveRunner::divided(
    const std::shared_ptr<const LoadedScene>& whole, const std::shared_ptr<const Scene>& scene,
    const Cancellation& cancellation) {
  if (scene == whole->scene) {
    return whole;
  }
  auto loaded = std::make_shared<LoadedScene>();
  loaded->scene = scene;
  loaded->description = whole->description;
  loaded->back_share = whole->back_share;
  loaded->seconds_load = whole->seconds_load;
  loaded->whole = whole;
  loaded->picker = std::make_shared<const Picker>(scene, cancellation);
  loaded->measures = measure(*scene, cancellation);
  build_tree(*loaded, cancellation);
  return loaded;
}

void SolveRunner::replace_scene(const OpenRequest& request, const RunRequest& options,
                                PreparedRun run, const Cancellation& cancellation) {
  {
    // From here on, stop() stops the solve of the new scene.
    const std::lock_guard lock(mutex_);
    cancellation.throw_if_canceled();
    solve_cancellation_ = cancellation;
    loading_ = false;
    options_ = options;
    goal_ = request.then;
    ++goal_number_;
  }
  loaded_ = run.loaded;
  materials_ = nullptr;
  patches_to_announce_ = false;
  keeper_.begin(loaded_->scene, options.solve);
  replace_run(std::move(run), options);
  {
    const std::lock_guard lock(mutex_);
    pending_snapshot_ = nullptr;  // of the previous scene
    relight_request_.reset();
  }
  post([this, loaded = loaded_] {
    announced_ = loaded;
    emit scene_loaded(loaded);
    deliver_snapshot();
  });
  post_snapshot();
}

/// @param run without rounds, if the scene is that of a result file.
SolveRunner::PreparedRun SolveRunner::prepare(const std::shared_ptr<const LoadedScene>& whole,
                                              RunRequest& run, const Cancellation& cancellation) {
  PreparedRun prepared{whole, {}, {}};
  if (whole->stored) {
    run.refine = {};
  }
  if (run.refine.set()) {
    prepared.rounds.emplace(whole->scene, run.solve, run.refine.options(), cancellation);
    prepared.loaded = divided(whole, prepared.rounds->scene(), cancellation);
  }
  const bool last = !prepared.rounds || prepared.rounds->finished();
  prepared.solver = make_solver(*prepared.loaded, run.solve, last, cancellation);
  return prepared;
}

SolveRunner::PlannedSolver SolveRunner::make_solver(const LoadedScene& loaded,
                                                    const SolveOptions& options, bool last,
                                                    const Cancellation& cancellation) {
  if (std::optional<PlannedSolver> old = resumed(loaded, options, last, cancellation)) {
    return std::move(*old);
  }
  PlannedSolver made;
  if (options.goal.set()) {
    made.plan.emplace(options, *loaded.scene);
  }
  made.solver = RunningSolver::make(loaded, made.plan ? made.plan->stage() : options, cancellation);
  return made;
}

/// Nothing where there is no checkpoint, or none of this solve: it may be of a later round.
std::optional<SolveRunner::PlannedSolver> SolveRunner::resumed(const LoadedScene& loaded,
                                                               const SolveOptions& options,
                                                               bool last,
                                                               const Cancellation& cancellation) {
  std::string file;
  {
    const std::lock_guard lock(mutex_);
    file = std::exchange(go_on_with_, {});
  }
  if (file.empty() || options.glossy) {
    return std::nullopt;
  }
  RemovedAtEnd removed(file);
  try {
    Checkpoint::Resumed old =
        Checkpoint(file, *loaded.scene, options)
            .resume(loaded.scene, options, loaded.tree, nullptr, cancellation);
    return PlannedSolver{
        std::make_unique<RunningSolver>(std::make_unique<RadiositySolver>(std::move(old.solver))),
        std::move(old.plan), old.seconds};
  } catch (const InputError&) {
    const std::lock_guard lock(mutex_);
    if (!last && go_on_with_.empty()) {
      removed.keep();
      go_on_with_ = file;
    }
    return std::nullopt;
  }
}

}  // namespace transillum::viewer
