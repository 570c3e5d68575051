// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/run_comparison.h"

namespace transillum::viewer {

namespace {

PatchLight light_of(const SolverSnapshot& snapshot) {
  PatchLight light{{}, snapshot.radiosity};
  light.exitance.reserve(light.radiosity.size());
  for (PatchId i = 0; i < snapshot.loaded->scene->patch_count(); ++i) {
    light.exitance.push_back(material_of(snapshot, i).exitance);
  }
  return light;
}

}  // namespace

ResultComparison compare_runs(const SolverSnapshot& a, const SolverSnapshot& b) {
  return compare_light(*a.loaded->scene, light_of(a), light_of(b));
}

}  // namespace transillum::viewer
