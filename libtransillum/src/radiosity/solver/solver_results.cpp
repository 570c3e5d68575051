// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "radiosity/solver/error_estimate.h"
#include "radiosity/solver/solver_state.h"
#include "transillum/at.h"
#include "transillum/bounds.h"

namespace transillum {
namespace {

double sum(const Rgb& value) { return value.r + value.g + value.b; }

}  // namespace

SolveProgress RadiositySolver::progress() const {
  const Impl& s = *impl_;
  SolveProgress progress;
  progress.iteration = static_cast<int>(s.steps.size());
  progress.direction = s.done();
  progress.passes = s.finished ? s.plan.passes(s.step() - 1) : s.wanted();
  progress.finished = s.finished;
  progress.seconds_transfers = s.seconds_transfers;
  if (s.done() > s.taken_over && s.step_seconds > 0) {
    progress.passes_per_second = (s.done() - s.taken_over) / s.step_seconds;
    progress.seconds_left = (progress.passes - s.done()) / progress.passes_per_second;
  }
  if (s.done() > 0) {
    progress.last_direction = at(s.directions, s.done() - 1);
  } else if (!s.steps.empty()) {
    progress.last_direction = at(s.directions, s.plan.passes(s.step() - 1) - 1);
  }
  return progress;
}

SolveStatistics RadiositySolver::statistics() const {
  const Impl& s = *impl_;
  SolveStatistics statistics;
  statistics.patches = s.scene->patch_count();
  statistics.fragments = static_cast<std::int64_t>(s.tree->fragments().size());
  statistics.directions = s.options.directions * s.ways();
  statistics.passes = s.options.directions;
  statistics.passes_made = s.passes_made;
  statistics.iterations = static_cast<int>(s.steps.size());
  statistics.threads = s.threads;
  statistics.transfers = s.transfer_count;
  statistics.counts = s.counts;
  statistics.kept_form_factors = s.keeps_sums();
  for (const ExchangeSums& part : s.sums) {
    statistics.form_factors += static_cast<std::int64_t>(part.size());
  }
  statistics.converged = s.converged;
  statistics.closure_defect_max = s.closure_relative;
  statistics.closure_defect_grazing = s.closure_grazing;
  statistics.escaped = share(std::max(0.0, s.seen - s.covered), s.seen);
  statistics.energy_defect = s.energy_defect;
  double absorbed = 0, emitted = 0;
  for (PatchId i = 0; i < s.scene->patch_count(); ++i) {
    const double area = s.scene->patch(i).area;
    const Rgb& rho = s.scene->reflectance(i);
    absorbed += area * sum((Rgb{1, 1, 1} - rho) * at(s.h, i));
    emitted += area * sum(s.scene->exitance(i));
    statistics.rho_max = std::max(statistics.rho_max, max_abs(rho));
  }
  statistics.energy_balance = share(absorbed, emitted);
  statistics.predicted_contraction =
      contraction_bound(statistics.rho_max, quadrature_error_bound(statistics.directions));
  statistics.iteration_records = s.steps;
  statistics.shot_sources = static_cast<std::int64_t>(s.shot->sources.size());
  statistics.shot_power_share = s.shot->power_share;
  statistics.seconds_bsp = s.seconds_bsp;
  statistics.seconds_first_shot = s.seconds_first_shot;
  statistics.seconds_transfers = s.seconds_transfers;
  statistics.seconds_iterate = s.seconds_iterate;
  statistics.seconds_total =
      s.seconds_bsp + s.seconds_first_shot + s.seconds_transfers + s.seconds_iterate;
  return statistics;
}

FormFactors RadiositySolver::form_factors() const {
  const Impl& s = *impl_;
  if (!s.wants_sums()) {
    throw std::runtime_error("the semi-iterative scheme was not to keep its form factors");
  }
  const SeenAreas& areas = s.kept_areas();
  if (s.steps.empty() || s.begun || areas.passes == 0) {
    throw std::runtime_error("there are no form factors yet");
  }
  if (!s.keeps_sums()) {
    throw std::runtime_error("the form factors take more than --memory allows");
  }
  // Several lists of sums become one.
  ExchangeSums joined(s.scene->patch_count(), s.options.two_way, ~std::uint64_t{0}, s.cancellation);
  if (s.sums.size() > 1) {
    for (const ExchangeSums& part : s.sums) {
      ExchangeSums::Run run;
      run.reserve(part.size());
      part.for_each([&](PatchId i, PatchId j, double area) { run.push_back({i, j, area}); });
      joined.add(std::move(run));
    }
    joined.finish();
  }
  const ExchangeSums& sums = s.sums.size() > 1 ? joined : s.sums.front();
  // Rows are filled in the order of the pairs, first with what lies left of the diagonal: so their
  // sources rise.
  const bool two_way = s.options.two_way;
  FormFactors result;
  result.row_begin.resize(s.b.size() + 1);
  sums.for_each([&](PatchId i, PatchId j, double) {
    ++result.row_begin[static_cast<std::size_t>(i) + 1];
    if (two_way) {
      ++result.row_begin[static_cast<std::size_t>(j) + 1];
    }
  });
  std::partial_sum(result.row_begin.begin(), result.row_begin.end(), result.row_begin.begin());
  result.source.resize(result.row_begin.back());
  result.value.resize(result.row_begin.back());
  std::vector<std::size_t> next(result.row_begin.begin(), result.row_begin.end() - 1);
  const auto put = [&](PatchId i, PatchId j, double area) {
    const std::size_t k = at(next, i)++;
    result.source[k] = j;
    result.value[k] = area * s.whole.form_factor_scale(i, j, at(areas.projected, i), areas.passes);
  };
  if (two_way) {
    sums.for_each([&](PatchId i, PatchId j, double area) { put(j, i, area); });
  }
  sums.for_each(put);
  return result;
}

std::vector<double> RadiositySolver::form_factor_sums() const {
  const Impl& s = *impl_;
  std::vector<double> form_factor_sums(s.areas.rows.size());
  if (s.areas.passes == 0) {
    return form_factor_sums;
  }
  for (std::size_t i = 0; i < form_factor_sums.size(); ++i) {
    form_factor_sums[i] = s.whole.form_factor_sum(static_cast<PatchId>(i), s.areas.rows[i],
                                                  s.areas.projected[i], s.areas.passes);
  }
  return form_factor_sums;
}

ErrorEstimate RadiositySolver::error_estimate() const {
  const Impl& s = *impl_;
  if (s.replicas.empty()) {
    return {};
  }
  // The answer of the semi-iterative scheme is a mean, and so is that of its replicas.
  const bool averaged = s.mean_b.count > 0;
  const bool under_way = s.begun && !averaged;
  std::vector<std::vector<Rgb>> b;
  for (std::size_t r = 0; r < s.replicas.size(); ++r) {
    const RadiosityIterate& replica = s.replicas[r];
    if (under_way && replica.passes() == 0) {
      return {};
    }
    b.push_back(averaged ? s.replica_means[r].mean() : replica.b());
    if (!under_way) {
      continue;
    }
    for (PatchId i = 0; i < s.scene->patch_count(); ++i) {
      at(b.back(), i) = replica.estimate(i);
    }
  }
  return estimate_error(*s.scene, under_way ? s.estimate : s.b, b);
}

std::vector<double> RadiositySolver::back_seen_shares() const {
  const Impl& s = *impl_;
  std::vector<double> shares(s.back_seen.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = share(s.back_seen[i], s.facing_area[i]);
  }
  return shares;
}

}  // namespace transillum
