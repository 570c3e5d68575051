// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "model/snapshot.h"

namespace transillum::viewer::test {

/// The snapshot of a scene after one iteration, as SolveRunner makes it, without a thread.
inline std::shared_ptr<SolverSnapshot> solved_snapshot(const char* spec, int directions = 64,
                                                       int replicas = 1) {
  auto loaded = std::make_shared<LoadedScene>();
  loaded->scene = load_scene(spec);
  loaded->tree = std::make_shared<const BspTree>(*loaded->scene);
  auto snapshot = std::make_shared<SolverSnapshot>();
  snapshot->loaded = loaded;
  snapshot->options.directions = directions;
  snapshot->options.first_shot.reset();
  snapshot->options.replicas = replicas;
  RadiositySolver solver(loaded->scene, snapshot->options, {.tree = loaded->tree});
  snapshot->kept_radiosity.push_back(std::make_shared<std::vector<Rgb>>(solver.radiosity()));
  solver.advance(RadiositySolver::Until::iteration);
  snapshot->kept_radiosity.push_back(std::make_shared<std::vector<Rgb>>(solver.radiosity()));
  snapshot->progress = solver.progress();
  snapshot->radiosity = solver.radiosity();
  snapshot->irradiance = solver.irradiance();
  snapshot->form_factor_sums = solver.form_factor_sums();
  snapshot->form_factors = std::make_shared<const FormFactors>(solver.form_factors());
  snapshot->error = solver.error_estimate();
  return snapshot;
}

}  // namespace transillum::viewer::test
