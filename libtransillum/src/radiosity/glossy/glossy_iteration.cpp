// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Iterations of a glossy solve: L(n+1) from what L(n) brings along each direction.
//
// Notation: i a patch; g a glossy patch; H irradiance; k fraction that a lobe reflects; Phi what
// arrives by direction, cosine included.
#include "radiosity/glossy/glossy_iteration.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/memory_limit.h"
#include "base/seconds_since.h"
#include "radiosity/exchange/pass_plan.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"
#include "radiosity/reflected_light.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;
using std::numbers::pi;

}  // namespace

GlossySolver::Impl::Impl(SolverInput solver_input)
    : input(std::move(solver_input)), materials(input.scene->materials()) {
  for (const Patch& patch : input.scene->patches()) {
    of_patch.push_back(patch.material);
  }
  auto data = std::make_shared<GlossyLight::Data>();
  data->scene = input.scene;
  data->directions = PassPlan(input.options).directions(0);
  find_glossy(*data);
  light = std::move(data);
  forget_passes();
  start();
}

void GlossySolver::Impl::find_glossy(GlossyLight::Data& data) {
  std::vector<PatchId> found;
  data.index_of.assign(input.patch_count(), -1);
  for (std::size_t i = 0; i < input.patch_count(); ++i) {
    if (used_lobe(material(i)).present()) {
      data.index_of[i] = static_cast<std::int32_t>(found.size());
      found.push_back(static_cast<PatchId>(i));
    }
  }
  check_radiance_memory(found.size(), data.passes());
  glossy.swap(found);
}

/// Refuses what would not fit before it is allocated.
void GlossySolver::Impl::check_radiance_memory(std::size_t patches, std::size_t directions) const {
  // Phi, its successor, the lobe's radiance, its successor, and areas seen.
  const std::uint64_t per_slot =
      4 * sizeof(Rgb) + (input.options.sky.is_set() ? 2 : 1) * sizeof(double);
  const std::uint64_t needed = patches * directions * per_slot;
  if (const std::uint64_t available = free_memory(); needed > available) {
    throw std::runtime_error(
        fmt::format("{}: the radiance of {} glossy patches along {} directions takes {:.2g} GB of "
                    "memory, but only {:.2g} GB are free",
                    input.scene->name(), patches, directions, 1e-9 * static_cast<double>(needed),
                    1e-9 * static_cast<double>(available)));
  }
}

void GlossySolver::Impl::forget_passes() {
  statistics = std::make_unique<PassStatistics>(*input.scene, true, *input.shot, input.owned(), 1);
  std::vector<char> directional(input.patch_count());
  for (std::size_t i = 0; i < directional.size(); ++i) {
    directional[i] = light->index_of[i] >= 0 ? 1 : 0;
  }
  kept =
      std::make_unique<DirectionalExchanges>(std::move(directional), static_cast<int>(passes()),
                                             memory_limit(input.options.memory), input.requested);
  known_passes = 0;
  kept_finished = has_light = false;
  const std::size_t slots = glossy.size() * passes();
  seen.assign(slots, 0.0);
  sky_seen.assign(input.options.sky.is_set() ? slots : 0, 0.0);
  sky_area.assign(input.options.sky.is_set() ? input.patch_count() : 0, 0.0);
}

void GlossySolver::Impl::start(Start from) {
  auto data = std::make_shared<GlossyLight::Data>(*light);
  data->fractions.clear();
  for (const PatchId i : glossy) {
    data->fractions.push_back(used_lobe(material(static_cast<std::size_t>(i))).reflectance);
  }
  records.clear();
  last_change = 0;
  finished = converged = false;
  pass = 0;
  stage = SolveProgress::Stage::passes;
  lobes_pending = true;
  const std::size_t slots = glossy.size() * passes();
  if (from != Start::current || !has_light) {
    has_light = false;
    data->arriving.assign(slots, Rgb{});
    data->reflected.assign(slots, Rgb{});
    irradiance.assign(input.patch_count(), Rgb{});
    from_sky.clear();
  }
  incoming.assign(slots, Rgb{});
  gathered.assign(input.patch_count(), Rgb{});
  data->lambertian.resize(input.patch_count());
  for (std::size_t i = 0; i < input.patch_count(); ++i) {
    data->lambertian[i] = lambertian_of(i, irradiance[i]);
  }
  light = std::move(data);
}

Rgb GlossySolver::Impl::lambertian_of(std::size_t i, const Rgb& received) const {
  return 1 / pi * (material(i).exitance + material(i).reflectance * received);
}

LobeReport GlossySolver::Impl::report_of(SolveProgress::Stage now, const Observer& observer) {
  stage = now;
  stage_fraction = stage_seconds = 0;
  const auto begin = Clock::now();
  return [this, begin, &observer](double fraction, std::size_t lobes) {
    stage_fraction = fraction;
    stage_lobes = lobes;
    stage_seconds = seconds_since(begin);
    if (observer) {
      (void)observer(progress());  // a stage cannot be left unfinished
    }
  };
}

void GlossySolver::Impl::make_lobes(WorkerThreads& workers, const Observer& observer) {
  if (!lobes_pending) {
    return;
  }
  const auto begin = Clock::now();
  std::vector<LobePatch> patches;
  for (const PatchId i : glossy) {
    patches.push_back(
        {used_lobe(material(static_cast<std::size_t>(i))), input.scene->patch(i).normal});
  }
  auto data = std::make_shared<GlossyLight::Data>(*light);
  data->lobes = std::make_shared<const LobeTables>(
      patches, data->directions, old_lobes.get(), workers, input.requested,
      report_of(SolveProgress::Stage::scaling_lobes, observer));
  if (has_light) {
    const std::vector<Rgb> none(glossy.size());  // changes are of no interest
    data->lobes->reflect({data->arriving, data->fractions, none, none}, data->reflected, workers,
                         input.requested, {});
  }
  old_lobes = data->lobes;
  light = std::move(data);
  lobes_pending = false;
  stage = SolveProgress::Stage::passes;
  timing.seconds_iterate += seconds_since(begin);
}

double GlossySolver::Impl::scale(std::size_t i) const {
  const double projected = statistics->areas().projected[i];
  if (input.options.normalize == Normalization::rows) {
    return projected > 0 ? pi / projected : 0.0;
  }
  return 2 * pi / (static_cast<double>(passes()) * input.scene->patches()[i].area);
}

bool GlossySolver::Impl::iterate(const Observer& observer, bool one_pass) {
  struct StageEnd {
    SolveProgress::Stage& stage;
    ~StageEnd() { stage = SolveProgress::Stage::passes; }
  };
  const StageEnd canceled{stage};
  WorkerThreads workers(input.threads);
  make_lobes(workers, observer);
  iteration_seconds = pass > 0 ? iteration_seconds : 0.0;
  if (!gather_passes(workers, observer, one_pass)) {
    return false;
  }
  finish_iteration(workers, observer);
  return !observer || observer(progress());
}

/// Power received against power sent, by what was gathered.
double GlossySolver::Impl::defect_of_energy() const {
  Rgb received, sent;
  const std::vector<double>& rows = statistics->areas().rows;
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    received += gathered[i];
    sent += rows[i] * light->lambertian[i];
  }
  for (std::size_t s = 0; s < seen.size(); ++s) {
    sent += seen[s] * light->reflected[s];
  }
  return ratio_or_zero(max_abs(received - sent), max_abs(sent));
}

void GlossySolver::Impl::finish_iteration(WorkerThreads& workers, const Observer& observer) {
  const auto start = Clock::now();
  if (!kept_finished && kept->available()) {
    kept->finish();
    kept_finished = true;
  }
  energy_defect = defect_of_energy();
  // Nothing of the iteration before is changed until this one cannot be canceled any more.
  auto next = std::make_shared<GlossyLight::Data>();
  next->scene = light->scene;
  next->directions = light->directions;
  next->index_of = light->index_of;
  next->fractions = light->fractions;
  next->lobes = light->lobes;
  next->reflected = light->reflected;
  next->lambertian.resize(input.patch_count());
  std::vector<Rgb> before, after, received(input.patch_count());
  std::vector<Rgb> reflected(input.patch_count()), changes(input.patch_count());
  LobeTables::Change change;
  const bool has_sky = input.options.sky.is_set();
  std::vector<Rgb> sky_light(has_sky ? input.patch_count() : 0);
  for (std::size_t i = 0; i < input.patch_count(); ++i) {
    received[i] = scale(i) * gathered[i];
    if (has_sky) {
      sky_light[i] = scale(i) * sky_area[i] / pi * input.options.sky.exitance;
      received[i] += sky_light[i];
    }
    next->lambertian[i] = lambertian_of(i, received[i]);
    const Rgb rho = material(i).reflectance, all = rho + used_lobe(material(i)).reflectance;
    reflected[i] = all * received[i];
    changes[i] = all * (received[i] - irradiance[i]);
    if (light->index_of[i] < 0) {
      change.change = std::max(change.change, 1 / pi * max_abs(changes[i]));
      change.largest = std::max(change.largest, 1 / pi * max_abs(reflected[i]));
    } else {
      before.push_back(1 / pi * (rho * irradiance[i]));
      after.push_back(1 / pi * (rho * received[i]));
    }
  }
  const LobeTables::Change of_lobes =
      next->lobes->reflect({incoming, next->fractions, before, after}, next->reflected, workers,
                           input.requested, report_of(SolveProgress::Stage::reflecting, observer));
  irradiance.swap(received);
  from_sky.swap(sky_light);
  next->arriving.swap(incoming);
  light = std::move(next);  // frees the previous light, unless a solution shares it
  incoming.assign(light->arriving.size(), Rgb{});
  has_light = true;
  change.change = std::max(change.change, of_lobes.change);
  change.largest = std::max(change.largest, of_lobes.largest);
  const double seconds = seconds_since(start);
  timing.seconds_iterate += seconds;
  iteration_seconds += seconds;
  reflection_seconds = seconds;
  stage = SolveProgress::Stage::passes;
  record(change, reflected, changes);
}

double GlossySolver::Impl::rho_max() const {
  double largest = 0;
  for (std::size_t i = 0; i < input.patch_count(); ++i) {
    largest =
        std::max(largest, max_abs(material(i).reflectance + used_lobe(material(i)).reflectance));
  }
  return largest;
}

void GlossySolver::Impl::record(const LobeTables::Change& change, std::vector<Rgb> reflected,
                                const std::vector<Rgb>& changes) {
  std::vector<Rgb> exitance, reflectance;
  std::vector<double> area;
  for (std::size_t i = 0; i < input.patch_count(); ++i) {
    exitance.push_back(material(i).exitance);
    reflectance.push_back(material(i).reflectance + used_lobe(material(i)).reflectance);
    area.push_back(input.scene->patches()[i].area);
    reflected[i] += exitance[i];
  }
  IterationRecord now{
      .contraction = records.empty() ? 0.0 : ratio_or_zero(change.change, last_change),
      .seconds = iteration_seconds};
  const RemainderBound bound(ReflectedLight(std::move(exitance), 1), std::move(area),
                             std::move(reflectance), 1);
  bound.describe(now, reflected, changes, std::max(now.contraction, rho_max()), pi * change.change);
  now.change = ratio_or_zero(change.change, change.largest);
  if (!std::isfinite(change.change) || !std::isfinite(change.largest)) {
    throw NotConvergent(
        fmt::format("the iteration does not converge for M = {}: radiance exceeds the range of "
                    "numbers",
                    passes()),
        Remedy::directions_or_row_normalization);
  }
  last_change = change.change;
  records.push_back(now);
  const int asked = input.options.iterations;
  converged =
      std::max(now.remainder, now.remainder_dimmest) <= input.options.tolerance || is_rounding(now);
  finished = asked > 0 ? std::ssize(records) >= asked : converged;
  pass = 0;
}

}  // namespace transillum
