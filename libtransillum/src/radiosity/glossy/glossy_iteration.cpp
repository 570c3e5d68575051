// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Iterations of a glossy solve: L(n+1) from what L(n) brings along each direction.
//
// Each replica is a solve of its own: what its patches send along its directions follows from what
// they receive along them. All replicas iterate together.
//
// Notation: i a patch; g a glossy patch; r a replica; H irradiance; k fraction that a lobe
// reflects; Phi what arrives by direction, cosine included.
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
#include "radiosity/glossy/shot_rays.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"
#include "radiosity/reflected_light.h"
#include "transillum/at.h"
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
  shot = shot_of(materials, of_patch);
  const PassPlan plan(input.options);
  const std::vector<Vec3> directions = plan.directions(0);
  for (std::size_t r = 0; r < static_cast<std::size_t>(plan.replicas()); ++r) {
    data->begin.push_back(data->directions.size());
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (plan.replica_of(static_cast<int>(k)) == r) {
        data->directions.push_back(directions[k]);
      }
    }
  }
  data->begin.push_back(directions.size());
  find_glossy(*data);
  light = std::move(data);
  if (input.options.replicas > 1) {
    surfaces = ErrorSurfaces(*input.scene, input.options.goal.surfaces, true);
  }
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
  data.rays = nullptr;
  if (shot || has_sun()) {
    const DirectLight& before = *input.shot;
    std::shared_ptr<const DirectLight> paired = input.shot;
    if (shot &&
        !std::includes(before.paired.begin(), before.paired.end(), found.begin(), found.end())) {
      auto made = std::make_shared<DirectLight>(before);
      made->pairs = shoot_pairs(*input.scene, made->sources, found, shot_options(input.options),
                                input.requested);
      made->paired = found;
      paired = std::move(made);
    }
    WorkerThreads workers(input.threads);
    const auto rays =
        std::make_shared<ShotRays>(*input.scene, paired->pairs, found, workers, input.requested);
    if (has_sun()) {
      rays->add_sun(*input.scene, found, input.options.sky.sun, input.sun.irradiance);
    }
    data.rays = rays;
    retired_shot.swap(input.shot);
    input.shot = std::move(paired);
  }
  glossy.swap(found);
}

std::shared_ptr<const DirectLight> GlossySolver::Impl::shot_of(
    const std::vector<Material>& given, const std::vector<std::int32_t>& by_patch) const {
  if (input.shot->sources.empty()) {
    return nullptr;
  }
  const bool is_same =
      std::all_of(input.shot->sources.begin(), input.shot->sources.end(), [&](PatchId i) {
        return at(given, at(by_patch, i)).exitance == at(input.shot->exitance, i);
      });
  return is_same ? input.shot
                 : std::make_shared<const DirectLight>(
                       with_materials(*input.shot, *input.scene, given, by_patch));
}

/// Refuses what would not fit before it is allocated.
void GlossySolver::Impl::check_radiance_memory(std::size_t patches, std::size_t directions) const {
  // Phi, its successor, the lobe's radiance, its successor, its part from rays, and areas seen.
  const std::uint64_t per_slot = (shot || has_sun() ? 5 : 4) * sizeof(Rgb) +
                                 (input.options.sky.is_set() ? 2 : 1) * sizeof(double);
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
  std::vector<char> directional(input.patch_count());
  std::vector<Rgb> fractions(input.patch_count());
  for (std::size_t i = 0; i < directional.size(); ++i) {
    directional[i] = light->index_of[i] >= 0 ? 1 : 0;
    fractions[i] = reflectance(i);
  }
  statistics = std::make_unique<PassStatistics>(*input.scene, true, *input.shot, input.owned(), 1,
                                                fractions);
  retired_shot.reset();
  kept =
      std::make_unique<DirectionalExchanges>(std::move(directional), passes(), light->replicas(),
                                             memory_limit(input.options.memory), input.requested);
  known_passes = 0;
  kept_finished = has_light = false;
  const std::size_t slots = glossy.size() * passes();
  seen.assign(slots, 0.0);
  sky_seen.assign(input.options.sky.is_set() ? slots : 0, 0.0);
  replicas.clear();
  for (std::size_t r = 0; r < light->replicas(); ++r) {
    replicas.push_back({VisibleAreaSums(input.patch_count(), 1), {}, {}, {}});
    replicas.back().sky_area.assign(input.options.sky.is_set() ? input.patch_count() : 0, 0.0);
  }
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
    irradiance = shot ? shot->irradiance : std::vector<Rgb>(input.patch_count());
    for (std::size_t i = 0; has_sun() && i < irradiance.size(); ++i) {
      irradiance[i] += input.sun.irradiance[i];
    }
    from_sky = input.sun.irradiance;
    for (Replica& replica : replicas) {
      replica.irradiance = irradiance;
    }
  }
  incoming.assign(slots, Rgb{});
  data->shot = shot;
  data->ray_sources = shot ? shot->exitance : std::vector<Rgb>(input.patch_count());
  data->ray_sources.push_back(input.options.sky.sun.irradiance);
  data->direct = nullptr;
  data->lambertian.resize(replicas.size());
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    replicas[r].gathered.assign(input.patch_count(), Rgb{});
    data->lambertian[r].resize(input.patch_count());
    for (std::size_t i = 0; i < input.patch_count(); ++i) {
      data->lambertian[r][i] = lambertian_of(i, replicas[r].irradiance[i]);
    }
  }
  light = std::move(data);
}

Rgb GlossySolver::Impl::lambertian_of(std::size_t i, const Rgb& received) const {
  const Rgb& exitance = material(i).exitance;
  return 1 / pi *
         ((shot ? exitance - shot->exitance[i] : exitance) + material(i).reflectance * received);
}

std::function<LobeReport(std::size_t)> GlossySolver::Impl::report_of(SolveProgress::Stage now,
                                                                     const Observer& observer) {
  stage = now;
  stage_fraction = stage_seconds = 0;
  const auto begin = Clock::now();
  return [this, begin, &observer](std::size_t replica) {
    return [this, begin, &observer, replica](double fraction, std::size_t lobes) {
      const auto count = static_cast<double>(replicas.size());
      stage_fraction = (static_cast<double>(replica) + fraction) / count;
      stage_lobes = replicas.size() * lobes;
      stage_seconds = seconds_since(begin);
      if (observer) {
        (void)observer(progress());  // a stage cannot be left unfinished
      }
    };
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
  data->lobes.clear();
  const auto report = report_of(SolveProgress::Stage::scaling_lobes, observer);
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    const std::vector<Vec3> directions(
        data->directions.begin() + std::ptrdiff_t(data->begin[r]),
        data->directions.begin() + std::ptrdiff_t(data->begin[r + 1]));
    data->lobes.push_back(std::make_shared<const LobeTables>(
        patches, directions, old_lobes.empty() ? nullptr : old_lobes[r].get(), workers,
        input.requested, report(r)));
  }
  if (data->rays) {
    auto direct = std::make_shared<std::vector<Rgb>>(data->reflected.size());
    for (std::size_t r = 0; r < replicas.size(); ++r) {
      data->lobes[r]->reflect(*data->rays, {data->ray_sources, data->fractions, data->passes()},
                              std::span(*direct).subspan(data->begin[r]), workers, input.requested);
    }
    data->direct = std::move(direct);
    if (!has_light) {
      data->reflected = *data->direct;
    }
  }
  for (std::size_t r = 0; has_light && r < replicas.size(); ++r) {
    const std::vector<Rgb> none(glossy.size());  // changes are of no interest
    reflect(*data, r, data->arriving, {none, none}, workers, {});
  }
  old_lobes = data->lobes;
  light = std::move(data);
  lobes_pending = false;
  stage = SolveProgress::Stage::passes;
  timing.seconds_iterate += seconds_since(begin);
}

double GlossySolver::Impl::scale(std::size_t r, std::size_t i) const {
  const double projected = replicas[r].areas.projected[i];
  if (input.options.normalize == Normalization::rows) {
    return projected > 0 ? pi / projected : 0.0;
  }
  return 2 * pi / (static_cast<double>(light->passes_of(r)) * input.scene->patches()[i].area);
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
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    const std::vector<double>& rows = replicas[r].areas.rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      received += replicas[r].gathered[i];
      sent += rows[i] * light->lambertian[r][i];
    }
  }
  for (std::size_t s = 0; s < seen.size(); ++s) {
    sent += seen[s] * light->reflected[s];
  }
  return ratio_or_zero(max_abs(received - sent), max_abs(sent));
}

GlossySolver::Impl::Next GlossySolver::Impl::next_light() const {
  Next next{std::make_shared<GlossyLight::Data>(), {}, {}};
  next.light->shot = light->shot;
  next.light->rays = light->rays;
  next.light->ray_sources = light->ray_sources;
  next.light->direct = light->direct;
  next.light->scene = light->scene;
  next.light->directions = light->directions;
  next.light->begin = light->begin;
  next.light->index_of = light->index_of;
  next.light->fractions = light->fractions;
  next.light->lobes = light->lobes;
  next.light->reflected = light->reflected;
  next.light->lambertian.resize(replicas.size());
  const bool has_sky = input.options.sky.is_set();
  const double fraction = 1 / static_cast<double>(replicas.size());
  next.from_sky.resize(has_sky ? input.patch_count() : 0);
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    std::vector<Rgb>& received = next.received.emplace_back(input.patch_count());
    for (std::size_t i = 0; i < received.size(); ++i) {
      received[i] = scale(r, i) * replicas[r].gathered[i];
      if (shot) {
        received[i] += shot->irradiance[i];
      }
      if (has_sky) {
        Rgb of_sky = scale(r, i) * replicas[r].sky_area[i] / pi * input.options.sky.exitance;
        if (has_sun()) {
          of_sky += input.sun.irradiance[i];
        }
        received[i] += of_sky;
        next.from_sky[i] += fraction * of_sky;
      }
    }
  }
  return next;
}

LobeTables::Change GlossySolver::Impl::reflect(GlossyLight::Data& data, std::size_t r,
                                               const std::vector<Rgb>& arriving,
                                               const Lambertian& lambertian, WorkerThreads& workers,
                                               const LobeReport& report) const {
  const auto of_replica = [&](auto& values) { return std::span(values).subspan(data.begin[r]); };
  return data.lobes[r]->reflect({of_replica(arriving), data.passes(),
                                 data.direct ? of_replica(*data.direct) : std::span<const Rgb>(),
                                 data.fractions, lambertian.before, lambertian.after},
                                of_replica(data.reflected), workers, input.requested, report);
}

LobeTables::Change GlossySolver::Impl::reflect(std::size_t r, Next& next, WorkerThreads& workers,
                                               const LobeReport& report) const {
  const std::vector<Rgb>&last = replicas[r].irradiance, &received = next.received[r];
  std::vector<Rgb>& lambertian = next.light->lambertian[r];
  lambertian.resize(received.size());
  std::vector<Rgb> before, after;
  LobeTables::Change change;
  for (std::size_t i = 0; i < received.size(); ++i) {
    lambertian[i] = lambertian_of(i, received[i]);
    if (light->index_of[i] < 0) {
      const Rgb all = reflectance(i);
      change.change = std::max(change.change, 1 / pi * max_abs(all * (received[i] - last[i])));
      change.largest = std::max(change.largest, 1 / pi * max_abs(all * received[i]));
    } else {
      before.push_back(1 / pi * (material(i).reflectance * last[i]));
      after.push_back(1 / pi * (material(i).reflectance * received[i]));
    }
  }
  const LobeTables::Change of_lobes =
      reflect(*next.light, r, incoming, {before, after}, workers, report);
  return {std::max(change.change, of_lobes.change), std::max(change.largest, of_lobes.largest)};
}

void GlossySolver::Impl::finish_iteration(WorkerThreads& workers, const Observer& observer) {
  const auto start = Clock::now();
  if (!kept_finished && kept->available()) {
    kept->finish();
    kept_finished = true;
  }
  energy_defect = defect_of_energy();
  // Nothing of the iteration before is changed until this one cannot be canceled any more.
  Next next = next_light();
  const auto report = report_of(SolveProgress::Stage::reflecting, observer);
  LobeTables::Change change;
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    const LobeTables::Change now = reflect(r, next, workers, report(r));
    change.change = std::max(change.change, now.change);
    change.largest = std::max(change.largest, now.largest);
  }
  std::vector<Rgb> received(input.patch_count());
  for (std::size_t r = 0; r < replicas.size(); ++r) {
    const double fraction = 1 / static_cast<double>(replicas.size());
    for (std::size_t i = 0; i < received.size(); ++i) {
      received[i] += fraction * next.received[r][i];
    }
    replicas[r].irradiance.swap(next.received[r]);
  }
  std::vector<Rgb> reflected(received.size()), changes(received.size());
  for (std::size_t i = 0; i < received.size(); ++i) {
    reflected[i] = reflectance(i) * received[i];
    changes[i] = reflectance(i) * (received[i] - irradiance[i]);
  }
  irradiance.swap(received);
  from_sky.swap(next.from_sky);
  next.light->arriving.swap(incoming);
  light = std::move(next.light);  // frees the previous light, unless a solution shares it
  incoming.assign(light->arriving.size(), Rgb{});
  has_light = true;
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
    largest = std::max(largest, max_abs(reflectance(i)));
  }
  return largest;
}

void GlossySolver::Impl::record(const LobeTables::Change& change, std::vector<Rgb> reflected,
                                const std::vector<Rgb>& changes) {
  std::vector<Rgb> exitance, fractions;
  std::vector<double> area;
  for (std::size_t i = 0; i < input.patch_count(); ++i) {
    exitance.push_back(material(i).exitance);
    fractions.push_back(reflectance(i));
    area.push_back(input.scene->patches()[i].area);
    reflected[i] += exitance[i];
  }
  IterationRecord now{
      .contraction = records.empty() ? 0.0 : ratio_or_zero(change.change, last_change),
      .seconds = iteration_seconds};
  const RemainderBound bound(ReflectedLight(std::move(exitance), 1), std::move(area),
                             std::move(fractions), 1);
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
