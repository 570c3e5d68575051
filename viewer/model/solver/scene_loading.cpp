// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/scene_loading.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <utility>

#include "scene/build/patch_count.h"
#include "session/divisions.h"
#include "transillum/files.h"
#include "transillum/material_changes.h"
#include "transillum/orientation.h"
#include "transillum/solids.h"

namespace transillum::viewer {

namespace {

/// Wall time since the timer was started, s.
double seconds(const QElapsedTimer& timer) {
  return 1e-9 * static_cast<double>(timer.nsecsElapsed());
}

QString tr(const char* text) { return QCoreApplication::translate("SceneLoading", text); }

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
  return divided_scene(std::make_shared<const Scene>(description, scene_options, cancellation),
                       options.input.divided, cancellation);
}

SceneDescription describe(const std::string& spec, const SceneInput& input,
                          const LoadProgress& progress, const Cancellation& cancellation,
                          const SceneDescription* faces) {
  SceneDescription description =
      faces != nullptr ? *faces : describe_scene(spec, input.read, cancellation);
  change_materials(description, input.changes);
  if (input.orient) {
    const OrientationReport report = orient(description, 0, cancellation, [&](double fraction) {
      progress(tr("Turning faces"), fraction);
    });
    for (const std::string& sentence : report.sentences) {
      description.notes.push_back("orientation: " + sentence);
    }
  }
  if (input.unite_solids) {
    progress(tr("Uniting solids"), 0);
    for (const std::string& sentence : unite_solids(description, cancellation).sentences) {
      description.notes.push_back("solids: " + sentence);
    }
  }
  return description;
}

/// Sets what the bars about backs and the sky ask for. They never ask for it where a built-in scene
/// has light, whose draft would come later by a tenth of its time.
void measure_backs(LoadedScene& loaded, const Cancellation& cancellation) {
  const Scene& scene = *loaded.scene;
  const bool from_file = !loaded.description || !loaded.description->files.empty();
  if (from_file || !scene.has_light()) {
    const BackFraction backs = back_fraction(scene, 0, cancellation);
    loaded.back_fraction = backs.fraction;
    loaded.open_fraction = has_two_sided_faces(scene) ? 1 : backs.open;
  }
}

/// Sets the members that follow from the patches.
void examine(LoadedScene& loaded, const Cancellation& cancellation) {
  loaded.picker = std::make_shared<const Picker>(loaded.scene, cancellation);
  loaded.measures = measure(*loaded.scene, cancellation);
}

}  // namespace

std::function<void(Preparation, double)> phase_reporter(LoadProgress progress) {
  // Without a GPU, whatever changes in the window takes as long as a picture of all of it.
  constexpr qint64 report_interval_ms = 250;
  return [progress = std::move(progress), since_report = QElapsedTimer()](Preparation what,
                                                                          double fraction) mutable {
    if (fraction > 0 && since_report.isValid() && since_report.elapsed() < report_interval_ms) {
      return;
    }
    since_report.start();
    progress(
        what == Preparation::tree ? tr("Building the BSP tree") : tr("Computing the first shot"),
        fraction);
  };
}

std::shared_ptr<const LoadedScene> loaded_scene(
    const std::string& spec, RunOptions& options, bool first_look, const LoadProgress& progress,
    const Cancellation& cancellation, const std::shared_ptr<const SceneDescription>& faces) {
  QElapsedTimer timer;
  timer.start();
  auto loaded = std::make_shared<LoadedScene>();
  loaded->origin = std::make_shared<const int>(0);
  progress(tr("Loading %1").arg(QString::fromStdString(spec)), -1);
  if (!faces && is_result_file(spec)) {
    loaded->stored = std::make_shared<const Solution>(read_result(spec, cancellation));
    loaded->scene = loaded->stored->scene;
    loaded->file = spec;
  } else {
    loaded->description = std::make_shared<const SceneDescription>(
        describe(spec, options.input, progress, cancellation, faces.get()));
    const std::size_t count = loaded->description->face_count();
    if (first_look && set_window_defaults(options, usual_patches(count))) {
      loaded->divided_faces = count;
    }
    loaded->scene = make_scene(*loaded->description, options, cancellation);
  }
  measure_backs(*loaded, cancellation);
  examine(*loaded, cancellation);
  loaded->seconds_load = seconds(timer);
  timer.start();
  const auto preparing = phase_reporter(progress);
  loaded->tree = std::make_shared<BspTree>(*loaded->scene, cancellation, [&](double fraction) {
    preparing(Preparation::tree, fraction);
  });
  loaded->seconds_bsp = seconds(timer);
  return loaded;
}

std::shared_ptr<LoadedScene> edited_scene(const LoadedScene& before,
                                          std::shared_ptr<const SceneDescription> description,
                                          const std::vector<std::string>& divided,
                                          const Cancellation& cancellation) {
  QElapsedTimer timer;
  timer.start();
  auto loaded = std::make_shared<LoadedScene>();
  loaded->origin = before.origin;
  RunOptions options;
  options.scene = before.scene->options();
  options.input.divided = divided;
  loaded->scene = make_scene(*description, options, cancellation);
  loaded->description = std::move(description);
  loaded->back_fraction = before.back_fraction;
  loaded->open_fraction = before.open_fraction;
  loaded->measures = before.measures;
  loaded->picker = loaded->scene->patch_count() == before.scene->patch_count()
                       ? before.picker
                       : std::make_shared<const Picker>(loaded->scene, cancellation);
  loaded->seconds_load = seconds(timer);
  timer.start();
  loaded->tree = std::make_shared<const BspTree>(*loaded->scene, cancellation);
  loaded->seconds_bsp = seconds(timer);
  return loaded;
}

void complete(LoadedScene& edited, const Cancellation& cancellation) {
  measure_backs(edited, cancellation);
  examine(edited, cancellation);
}

std::shared_ptr<const LoadedScene> with_patches_of(const SolveSession& session,
                                                   const std::vector<std::string>& divisions,
                                                   const std::shared_ptr<const LoadedScene>& start,
                                                   const Cancellation& cancellation) {
  if (session.scene() == start->scene) {
    return start;
  }
  auto loaded = std::make_shared<LoadedScene>();
  loaded->scene = session.scene();
  loaded->description = start->description;
  loaded->tree = session.tree();
  loaded->back_fraction = start->back_fraction;
  loaded->open_fraction = start->open_fraction;
  loaded->seconds_load = start->seconds_load;
  loaded->seconds_bsp = session.statistics().seconds_bsp;
  loaded->whole = whole_of(start);
  loaded->origin = start->origin;
  loaded->divided = start->divided;
  loaded->divided.insert(loaded->divided.end(), divisions.begin(), divisions.end());
  examine(*loaded, cancellation);
  return loaded;
}

}  // namespace transillum::viewer
