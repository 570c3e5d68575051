// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Runs two engines on one direction (or on one row of form factors), times them, and compares their
// transfers. Input: an EngineRequest of the window; output: an EngineComparison.
#include "model/requests/engine_comparison.h"

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "radiosity/form_factors/hemicube_image.h"
#include "transillum/at.h"
#include "transillum/engine.h"
#include "transillum/errors.h"
#include "transillum/pair_form_factors.h"

namespace transillum::viewer {

namespace {

/// Processor time of this thread.
double thread_seconds() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs fast engines twice, because the first run includes memory allocation.
Transfers run_direction(const EngineRequest& request, EngineComparison::Side& side,
                        const TransferEngine& engine, const Cancellation& cancellation) {
  Transfers transfers;
  for (int run = 0; run < 2 && (run == 0 || side.seconds < 0.1); ++run) {
    const double start = thread_seconds();
    transfers = engine(request.direction, cancellation);
    side.seconds = thread_seconds() - start;
  }
  return transfers;
}

/// A_i F_ij of patch i = `eye` for all j, m², from all directions of the solve run.
std::vector<double> row_by_directions(const EngineRequest& request, const TransferEngine& engine,
                                      const Cancellation& cancellation) {
  std::vector<double> row(static_cast<std::size_t>(request.loaded->scene->patch_count()));
  const double directions_per_pass = request.two_way ? 2 : 1;
  const double weight = 4 / (directions_per_pass * static_cast<double>(request.directions->size()));
  for (const Vec3& omega : *request.directions) {
    for (const Transfer& t : engine(omega, cancellation).exchanges) {
      if (t.receiver == request.eye) {
        at(row, t.source) += weight * t.area;
      }
      if (t.source == request.eye && request.two_way) {
        at(row, t.receiver) += weight * t.area;
      }
    }
  }
  return row;
}

std::vector<double> row_by_hemicube(const EngineRequest& request, int resolution,
                                    const Cancellation& cancellation) {
  HemicubeOptions options;
  options.resolution = resolution;
  std::vector<double> row = hemicube_image(request.loaded->scene, request.loaded->tree, request.eye,
                                           options, cancellation)
                                .form_factors;
  for (double& factor : row) {
    factor *= request.loaded->scene->patch(request.eye).area;
  }
  return row;
}

std::vector<double> row_by_pairs(const EngineRequest& request, const Cancellation& cancellation) {
  const Scene& scene = *request.loaded->scene;
  std::vector<double> row = exact_form_factors(scene, request.eye, cancellation);
  for (double& factor : row) {
    factor *= scene.patch(request.eye).area;
  }
  return row;
}

/// A row A_i F_ij as the transfers of one direction, with A_i as the projected area.
Transfers as_transfers(const EngineRequest& request, const std::vector<double>& row) {
  Transfers transfers;
  transfers.forward.resize(row.size());
  transfers.backward.resize(row.size());
  Coverage& own = at(transfers.forward, request.eye);
  own.projected = request.loaded->scene->patch(request.eye).area;
  for (std::size_t j = 0; j < row.size(); ++j) {
    if (!(row[j] > 0)) {
      continue;
    }
    own.covered += row[j];
    transfers.exchanges.push_back({request.eye, static_cast<PatchId>(j), row[j]});
  }
  return transfers;
}

Transfers find_transfers(const EngineRequest& request, EngineComparison::Side& side,
                         const Cancellation& cancellation) {
  EngineOptions options = request.options;
  options.resolution = side.resolution;
  const auto engine = [&] {
    return make_engine(side.engine, request.loaded->scene, request.loaded->tree, options);
  };
  if (!request.compares_rows()) {
    return run_direction(request, side, engine(), cancellation);
  }
  if (request.eye == no_patch) {
    throw std::runtime_error("select a patch: its row of form factors will be compared");
  }
  const double start = thread_seconds();
  const std::vector<double> row = [&] {
    switch (traits_of(side.engine).factors) {
      case EngineTraits::Factors::hemicubes:
        return row_by_hemicube(request, side.resolution, cancellation);
      case EngineTraits::Factors::pairs:
        return row_by_pairs(request, cancellation);
      case EngineTraits::Factors::passes:
      case EngineTraits::Factors::rays:
        break;
    }
    return row_by_directions(request, engine(), cancellation);
  }();
  side.seconds = thread_seconds() - start;
  return as_transfers(request, row);
}

/// Runs one engine and fills in `side`; an engine's failure goes to side.failure.
/// @throws Canceled
Transfers run_engine(const EngineRequest& request, EngineComparison::Side& side,
                     const Cancellation& cancellation) {
  Transfers transfers;
  try {
    transfers = find_transfers(request, side, cancellation);
  } catch (const Canceled&) {
    throw;
  } catch (const std::exception& error) {
    side.failure = error.what();
  }
  side.pairs = transfers.exchanges.size();
  double projected = 0, covered = 0;
  for (const auto* sides : {&transfers.forward, &transfers.backward}) {
    for (const Coverage& coverage : *sides) {
      projected += coverage.projected;
      covered += coverage.covered;
    }
  }
  side.covered_fraction = projected > 0 ? covered / projected : 0;
  return transfers;
}

/// The areas that differences are relative to, m²: half the larger of A_i F_ij by the two engines
/// for each patch j, and A_i for the eye i. A patch that only one engine sees has the largest
/// possible difference.
std::vector<double> seen_areas(const Transfers& first, const Transfers& other, PatchId eye) {
  std::vector<double> seen(first.forward.size());
  for (const Transfers* transfers : {&first, &other}) {
    for (const Transfer& t : transfers->exchanges) {
      double& area = at(seen, t.source);
      area = std::max(area, t.area / 2);
    }
  }
  at(seen, eye) = at(first.forward, eye).projected;
  return seen;
}

EngineComparison without_results(const EngineRequest& request) {
  EngineComparison comparison;
  comparison.loaded = request.loaded;
  comparison.direction = request.direction;
  comparison.first.engine = request.first;
  comparison.first.resolution = request.first_resolution;
  comparison.other.engine = request.other;
  comparison.other.resolution = request.other_resolution;
  return comparison;
}

}  // namespace

EngineComparison compare_engines(const EngineRequest& request, const Cancellation& cancellation) {
  EngineComparison comparison = without_results(request);
  const Transfers first = run_engine(request, comparison.first, cancellation);
  const Transfers other = run_engine(request, comparison.other, cancellation);
  if (!comparison.ok()) {
    return comparison;
  }
  comparison.transfers = compare(first, other);
  if (request.compares_rows()) {
    comparison.eye = request.eye;
    comparison.projected = seen_areas(first, other, request.eye);
    return comparison;
  }
  for (std::size_t i = 0; i < first.forward.size(); ++i) {
    comparison.projected.push_back(first.forward[i].projected + first.backward[i].projected);
  }
  return comparison;
}

EngineComparison failed_comparison(const EngineRequest& request, const std::string& failure) {
  EngineComparison comparison = without_results(request);
  comparison.first.failure = failure;
  return comparison;
}

}  // namespace transillum::viewer
