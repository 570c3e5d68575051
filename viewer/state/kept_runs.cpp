// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Runs that the user keeps. Only the parts of a snapshot that pictures need are stored, some
// hundred bytes per patch: form factors and the BSP tree take far more.
#include "state/kept_runs.h"

#include <algorithm>
#include <set>
#include <utility>

#include "support/has_index.h"
#include "support/list_change.h"
#include "support/number_text.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

std::shared_ptr<const SolverSnapshot> part_to_keep(const SolverSnapshot& snapshot) {
  auto loaded = std::make_shared<LoadedScene>();
  loaded->scene = snapshot.loaded->scene;
  auto kept = std::make_shared<SolverSnapshot>();
  kept->loaded = std::move(loaded);
  kept->options = snapshot.options;
  kept->progress = snapshot.progress;
  kept->statistics = snapshot.statistics;
  const SolvedLight& light = snapshot;
  static_cast<SolvedLight&>(*kept) = light;
  kept->bases = snapshot.bases;
  kept->materials = snapshot.materials;
  kept->of_file = snapshot.of_file;
  kept->error = snapshot.error;
  // The last change of B needs the newest two iterations.
  kept->kept_radiosity = snapshot.kept_radiosity;
  for (std::size_t n = 0; n + 2 < kept->kept_radiosity.size(); ++n) {
    kept->kept_radiosity[n] = nullptr;
  }
  return kept;
}

template <class T>
std::int64_t bytes_of(const std::vector<T>& list) {
  return static_cast<std::int64_t>(list.size() * sizeof(T));
}

std::int64_t bytes_of(const Scene& scene) {
  std::int64_t bytes = bytes_of(scene.patches()) + bytes_of(scene.points()) +
                       bytes_of(scene.pieces()) + bytes_of(scene.materials());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    // The corners of the patch, and about as many corners of its pieces.
    bytes += 2 * static_cast<std::int64_t>(scene.outline(i).size_bytes());
  }
  return bytes;
}

std::int64_t bytes_of(const SolverSnapshot& snapshot) {
  std::int64_t bytes = bytes_of(snapshot.radiosity) + bytes_of(snapshot.irradiance) +
                       bytes_of(snapshot.linear_terms) +
                       (snapshot.bases ? bytes_of(*snapshot.bases) : 0) +
                       bytes_of(snapshot.form_factor_sums) + bytes_of(snapshot.sky_fractions) +
                       bytes_of(snapshot.sky_irradiance) + bytes_of(snapshot.sky_linear_terms) +
                       bytes_of(snapshot.error.standard_error);
  for (const auto& radiosity : snapshot.kept_radiosity) {
    bytes += radiosity ? bytes_of(*radiosity) : 0;
  }
  if (snapshot.glossy) {
    bytes += static_cast<std::int64_t>(snapshot.statistics.glossy.radiance_bytes);
  }
  if (snapshot.materials) {
    bytes += bytes_of(snapshot.materials->of_patch) + bytes_of(snapshot.materials->materials);
  }
  return bytes;
}

std::int64_t bytes_of(const std::vector<KeptRun>& runs) {
  std::int64_t bytes = 0;
  std::set<const Scene*> scenes;
  for (const KeptRun& run : runs) {
    const Scene& scene = *run.snapshot->loaded->scene;
    bytes += bytes_of(*run.snapshot);
    bytes += scenes.insert(&scene).second ? bytes_of(scene) : 0;
  }
  return bytes;
}

bool same_patches(const Scene& a, const Scene& b) {
  if (&a == &b) {
    return true;
  }
  for (PatchId i = 0; i < a.patch_count(); ++i) {
    const auto corners = a.outline(i), others = b.outline(i);
    const bool same = std::equal(corners.begin(), corners.end(), others.begin(), others.end(),
                                 [&](PointId p, PointId q) { return a.point(p) == b.point(q); });
    if (!same) {
      return false;
    }
  }
  return true;
}

QString why_other(const Scene& kept, const Scene& open) {
  const QString name = QString::fromStdString(kept.name());
  if (kept.name() != open.name()) {
    return KeptRuns::tr("This is a run of another scene: %1.").arg(name);
  }
  return kept.patch_count() == open.patch_count()
             ? KeptRuns::tr(
                   "The patches of this run have other corners than the patches of the open scene.")
             : KeptRuns::tr("This run has %1 patches, the open scene has %2.")
                   .arg(count_text(kept.patch_count()), count_text(open.patch_count()));
}

QString why_not_comparable(const Scene& kept, const Scene* open) {
  if (!open) {
    return KeptRuns::tr("No scene is open.");
  }
  const bool same = kept.patch_count() == open->patch_count() && same_patches(kept, *open);
  return same ? QString() : why_other(kept, *open);
}

}  // namespace

bool KeptRuns::keep(const SolverSnapshot& snapshot, std::int64_t bytes) {
  auto runs = runs_;
  const QString name = tr("Run %1").arg(kept_ + 1);
  runs.push_back({name, QDateTime::currentDateTime(), part_to_keep(snapshot)});
  if (bytes_of(runs) > bytes) {
    return false;
  }
  ++kept_;
  first_ = runs.back().snapshot;
  change(tr("keep %1").arg(name), std::move(runs));
  return true;
}

void KeptRuns::rename(std::size_t k, const QString& name) {
  if (name.isEmpty() || name == runs_[k].name) {
    return;
  }
  auto runs = runs_;
  runs[k].name = name;
  change(tr("rename run: %1").arg(runs_[k].name), std::move(runs));
}

void KeptRuns::remove(std::size_t k) {
  auto runs = runs_;
  runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(k));
  change(tr("remove run: %1").arg(runs_[k].name), std::move(runs));
}

void KeptRuns::change(const QString& what, std::vector<KeptRun> runs) {
  change_list(undo_, what, runs_, std::move(runs),
              [this](const std::vector<KeptRun>& other) { set(other); });
}

void KeptRuns::set(std::vector<KeptRun> runs) {
  runs_ = std::move(runs);
  find_reasons();
  emit changed();
  emit compared_changed();
}

void KeptRuns::find_reasons() {
  reasons_.clear();
  for (const KeptRun& run : runs_) {
    reasons_.push_back(why_not_comparable(*run.snapshot->loaded->scene, scene_.get()));
  }
}

void KeptRuns::set_scene(std::shared_ptr<const Scene> scene) {
  if (scene == scene_) {
    return;
  }
  scene_ = std::move(scene);
  find_reasons();
  emit changed();
}

const QString& KeptRuns::reason_against(std::size_t k) const { return reasons_[k]; }

int KeptRuns::comparable_index(const std::shared_ptr<const SolverSnapshot>& run) const {
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    if (runs_[k].snapshot == run && reasons_[k].isEmpty()) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

int KeptRuns::first() const {
  if (const int chosen = comparable_index(first_); chosen >= 0) {
    return chosen;
  }
  const auto last = std::find(reasons_.rbegin(), reasons_.rend(), QString());
  return static_cast<int>(reasons_.rend() - last) - 1;
}

int KeptRuns::second() const { return comparable_index(second_); }

void KeptRuns::set_first(int k) {
  if (k != first() && has_index(runs_, k) && at(reasons_, k).isEmpty()) {
    first_ = at(runs_, k).snapshot;
    emit compared_changed();
  }
}

void KeptRuns::set_second(int k) {
  if (k != second() && (k < 0 || (has_index(runs_, k) && at(reasons_, k).isEmpty()))) {
    second_ = run(k);
    emit compared_changed();
  }
}

std::shared_ptr<const SolverSnapshot> KeptRuns::run(int k) const {
  return has_index(runs_, k) ? at(runs_, k).snapshot : nullptr;
}

}  // namespace transillum::viewer
