// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The public class of glossy solves, and what they report.
#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "radiosity/channel_sums.h"
#include "radiosity/error_bounds.h"
#include "radiosity/glossy/glossy_iteration.h"
#include "radiosity/ratio.h"
#include "scene/build/description_check.h"
#include "transillum/at.h"
#include "transillum/bounds.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using std::numbers::pi;

SolverInput checked(SolverInput input) {
  if (!input.options.glossy) {
    throw InputError("glossy: a solver of lobes requires that option");
  }
  return input;
}

}  // namespace

void GlossySolver::Impl::check_count(const std::vector<Material>& given,
                                     const std::vector<std::int32_t>& by_patch) const {
  const std::string& name = input.scene->name();
  const std::size_t expected = input.scene->materials().size();
  if (by_patch.empty() && given.size() != expected) {
    throw InputError(
        fmt::format("{}: {} materials were given, but there are {}", name, given.size(), expected));
  }
  if (!by_patch.empty() && by_patch.size() != input.patch_count()) {
    throw InputError(fmt::format("{}: materials of {} patches were given, but there are {}", name,
                                 by_patch.size(), input.patch_count()));
  }
  for (const std::int32_t m : by_patch) {
    if (m < 0 || static_cast<std::size_t>(m) >= given.size()) {
      throw InputError(fmt::format("{}: material {} was given for a patch; valid are 0 to {}", name,
                                   m, std::ssize(given) - 1));
    }
  }
}

bool GlossySolver::Impl::materials_differ() const {
  for (std::size_t i = 0; i < input.patch_count(); ++i) {
    const Material& own = input.scene->material(static_cast<PatchId>(i));
    if (!(material(i).exitance == own.exitance && material(i).reflectance == own.reflectance &&
          material(i).lobe == own.lobe)) {
      return true;
    }
  }
  return false;
}

GlossySolver::GlossySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                           SolverResources parts, const Cancellation& cancellation)
    : impl_(std::make_unique<Impl>(checked(
          SolverInput(std::move(scene), options,
                      {std::move(parts.tree), std::move(parts.shot), std::move(parts.engine), {}},
                      cancellation)))) {}
GlossySolver::~GlossySolver() = default;
GlossySolver::GlossySolver(GlossySolver&&) noexcept = default;
GlossySolver& GlossySolver::operator=(GlossySolver&&) noexcept = default;

bool GlossySolver::solve(const Observer& observer) {
  return !advance(RadiositySolver::Until::finished, observer);
}

bool GlossySolver::advance(RadiositySolver::Until until, const Observer& observer) {
  using Until = RadiositySolver::Until;
  bool going = true;
  while (going && !impl_->finished) {
    impl_->input.requested.throw_if_canceled();
    going = impl_->iterate(observer, until == Until::direction) && until == Until::finished;
  }
  return !impl_->finished;
}

void GlossySolver::set_materials(const std::vector<Material>& materials,
                                 const std::vector<std::int32_t>& of_patch, Start start) {
  Impl& s = *impl_;
  s.check_count(materials, of_patch);
  for (const Material& material : materials) {
    check_material(material, s.input.scene->name() + ": ");
  }
  std::vector<std::int32_t> indices = of_patch;
  if (indices.empty()) {
    for (const Patch& patch : s.input.scene->patches()) {
      indices.push_back(patch.material);
    }
  }
  std::vector<Material> given = materials;
  std::shared_ptr<const DirectLight> lit = s.shot_of(materials, indices);
  s.materials.swap(given);
  s.of_patch.swap(indices);
  const bool had_other_materials = std::exchange(s.has_other_materials, s.materials_differ());
  bool all_known = true;
  for (std::size_t i = 0; i < s.input.patch_count(); ++i) {
    all_known = all_known && (s.light->index_of[i] >= 0 || !used_lobe(s.material(i)).present());
  }
  if (!all_known) {
    auto data = std::make_shared<GlossyLight::Data>(*s.light);
    try {
      s.find_glossy(*data);
    } catch (...) {
      s.materials.swap(given);
      s.of_patch.swap(indices);
      s.has_other_materials = had_other_materials;
      throw;
    }
    data->lobes.clear();  // they belong to other patches
    s.light = std::move(data);
    s.forget_passes();
  }
  s.shot = std::move(lit);
  s.start(start);
}

SolveProgress GlossySolver::Impl::progress() const {
  SolveProgress now;
  now.iteration = static_cast<int>(records.size());
  now.direction = pass;
  now.passes = static_cast<int>(passes());
  now.finished = finished;
  now.change = records.empty() ? 0.0 : records.back().change;
  now.seconds_transfers = timing.seconds_transfers;
  if (pass > 0 && iteration_seconds > 0) {
    now.passes_per_second = pass / iteration_seconds;
    now.seconds_left = (now.passes - pass) / now.passes_per_second;
    now.last_direction = at(light->directions, pass - 1);
  }
  if (stage == SolveProgress::Stage::passes) {
    now.seconds_left += pass > 0 ? reflection_seconds : 0.0;
    return now;
  }
  now.stage = stage;
  now.stage_fraction = stage_fraction;
  now.passes_per_second = now.seconds_left = 0;
  if (stage_fraction > 0 && stage_seconds > 0) {
    now.lobes_per_second = stage_fraction * static_cast<double>(stage_lobes) / stage_seconds;
    now.seconds_left = stage_seconds * (1 - stage_fraction) / stage_fraction;
  }
  return now;
}

SolveStatistics GlossySolver::Impl::solve_statistics() const {
  SolveStatistics result;
  const Scene& scene = *input.scene;
  result.patches = scene.patch_count();
  result.fragments = std::ssize(input.tree->fragments());
  result.passes = static_cast<int>(passes());
  result.directions = 2 * result.passes;
  result.passes_made = timing.passes_made;
  result.threads = input.threads;
  result.kept_form_factors = kept_finished;
  result.form_factors = kept->size();
  statistics->write_to(result);
  // Other engines are wrong by more than the number of directions tells.
  if (traits_of(input.options.engine).error != EngineTraits::Error::none) {
    result.shot_disagreement = 0;
    result.shot_disagreement_patch = -1;
  }
  result.iterations = static_cast<int>(records.size());
  result.iteration_records = records;
  result.converged = converged;
  result.energy_defect = energy_defect;
  double absorbed = 0, emitted = 0;
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const double area = scene.patches()[i].area;
    const Rgb kept_fraction =
        Rgb{1, 1, 1} - material(i).reflectance - used_lobe(material(i)).reflectance;
    absorbed += area * sum(kept_fraction * irradiance[i]);
    emitted +=
        area * sum(from_sky.empty() ? material(i).exitance : material(i).exitance + from_sky[i]);
  }
  result.energy_balance = ratio_or_zero(absorbed, emitted);
  result.rho_max = rho_max();
  const int directions_each = result.directions / static_cast<int>(replicas.size());
  result.predicted_contraction =
      contraction_bound(result.rho_max, quadrature_error_bound(directions_each));
  GlossyStatistics& counted = result.glossy;
  counted.patches = std::ssize(glossy);
  for (const auto& lobes : light->lobes) {
    lobes->write_to(counted);
  }
  counted.radiance_bytes =
      3 * light->arriving.size() * sizeof(Rgb) + (seen.size() + sky_seen.size()) * sizeof(double);
  if (light->direct) {
    counted.radiance_bytes += light->direct->size() * sizeof(Rgb) + light->rays->bytes();
  }
  counted.transfer_bytes = kept_finished ? kept->bytes() : 0;
  result.shot_sources = std::ssize(input.shot->sources);
  result.shot_power_fraction = shot ? shot->power_fraction : 0.0;
  result.integrated_pairs = input.shot->integrated_pairs;
  result.seconds_bsp = input.seconds_bsp;
  result.seconds_first_shot = input.seconds_first_shot;
  result.seconds_transfers = timing.seconds_transfers;
  result.seconds_iterate = timing.seconds_iterate;
  result.seconds_total = result.seconds_bsp + result.seconds_first_shot + result.seconds_transfers +
                         result.seconds_iterate;
  return result;
}

std::vector<Rgb> GlossySolver::Impl::radiosity(const std::vector<Rgb>& received) const {
  std::vector<Rgb> b(received.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    b[i] = material(i).exitance + reflectance(i) * received[i];
  }
  return b;
}

std::vector<Rgb> GlossySolver::Impl::left() const {
  // H is off by at most pi times the error of radiance before the last iteration.
  const double contraction = std::max(records.back().contraction, rho_max());
  const double error = pi * distance_to_limit(last_change, contraction);
  std::vector<Rgb> left(input.patch_count());
  for (std::size_t i = 0; i < left.size() && error > 0; ++i) {
    const auto fraction = [error](double r) { return r > 0 ? r * error : 0.0; };
    const Rgb all = reflectance(i);
    left[i] = {fraction(all.r), fraction(all.g), fraction(all.b)};
  }
  return left;
}

ErrorEstimate GlossySolver::Impl::error_estimate() const {
  if (replicas.size() < 2 || records.empty() || has_other_materials) {
    return {};
  }
  std::vector<std::vector<Rgb>> radiosities, irradiances;
  for (const Replica& replica : replicas) {
    radiosities.push_back(radiosity(replica.irradiance));
    irradiances.push_back(replica.irradiance);
  }
  const std::vector<Rgb> b = radiosity(irradiance);
  ErrorEstimate error = estimate_error(*input.scene, surfaces, b, radiosities);
  error.irradiance = surface_errors(surfaces.receiving, irradiance, irradiances);
  include_bias(error, *input.scene, surfaces, b, left());
  include_bias(error, *input.scene, surfaces, b, bias_of_shot(*input.scene, surfaces, *input.shot));
  return error;
}

const SolveOptions& GlossySolver::options() const { return impl_->input.options; }
std::shared_ptr<const Scene> GlossySolver::shared_scene() const { return impl_->input.scene; }
std::shared_ptr<const DirectLight> GlossySolver::direct_light() const { return impl_->input.shot; }
ErrorEstimate GlossySolver::error_estimate() const { return impl_->error_estimate(); }
SolveProgress GlossySolver::progress() const { return impl_->progress(); }
const std::vector<Vec3>& GlossySolver::directions() const { return impl_->light->directions; }

/// Means over the replicas that have passes.
void GlossySolver::Impl::add_form_factor_sums(Solution& solution) const {
  const bool rows = input.options.normalize == Normalization::rows;
  const std::size_t begun = light->replica_of(static_cast<std::size_t>(known_passes) - 1) + 1;
  const double fraction = 1 / static_cast<double>(begun);
  solution.form_factor_sums.resize(input.patch_count());
  solution.sky_fractions.resize(input.patch_count());
  for (std::size_t r = 0; r < begun; ++r) {
    const VisibleAreaSums& areas = replicas[r].areas;
    for (std::size_t i = 0; i < input.patch_count(); ++i) {
      const double exact = areas.passes * input.scene->patches()[i].area / 2;
      const double whole = rows ? areas.projected[i] : exact;
      solution.form_factor_sums[i] += fraction * ratio_or_zero(areas.rows[i], whole);
      solution.sky_fractions[i] += fraction * ratio_or_zero(areas.uncovered[i], whole);
    }
  }
}

Solution GlossySolver::solution() const {
  const Impl& s = *impl_;
  Solution solution;
  solution.scene = s.input.scene;
  solution.sky = s.input.options.sky;
  solution.irradiance = s.irradiance;
  solution.radiosity = s.radiosity(s.irradiance);
  if (s.known_passes > 0) {
    s.add_form_factor_sums(solution);
    solution.sky_irradiance = s.from_sky;
  }
  solution.error = s.error_estimate();
  solution.statistics = s.solve_statistics();
  solution.complete = s.finished;
  solution.glossy = std::make_shared<const GlossyLight>(s.light);
  return solution;
}

}  // namespace transillum
