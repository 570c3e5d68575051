// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first shot (section 5.2): computes the irradiance that sources of a Scene cause directly, by
// exact form factors.
#include "transillum/first_shot.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <set>
#include <thread>

#include "base/for_each_index.h"
#include "base/part_of_progress.h"
#include "radiosity/channel_sums.h"
#include "radiosity/error_bounds.h"
#include "radiosity/form_factors/pair_matrix.h"
#include "radiosity/linear_solution.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {
namespace {

/// One part of zeros per material of the sources; none where they would take too much memory.
std::vector<DirectLight::Contribution> empty_contributions(const Scene& scene,
                                                           const std::vector<PatchId>& sources,
                                                           Basis basis) {
  constexpr std::size_t max_bytes = std::size_t{256} << 20;
  std::set<int> materials;
  for (const PatchId j : sources) {
    materials.insert(scene.patch(j).material);
  }
  const auto patches = scene.patches().size();
  std::vector<DirectLight::Contribution> contributions;
  const bool linear = basis == Basis::linear;
  if (materials.size() * patches * sizeof(double) * (linear ? linear_unknowns : 1) > max_bytes) {
    return contributions;
  }
  for (const int m : materials) {
    contributions.push_back({m, std::vector<double>(patches),
                             std::vector<std::array<double, 2>>(linear ? patches : 0)});
  }
  return contributions;
}

auto contribution_of(std::vector<DirectLight::Contribution>& contributions, int material) {
  return std::lower_bound(contributions.begin(), contributions.end(), material,
                          [](const DirectLight::Contribution& contribution, int m) {
                            return contribution.material < m;
                          });
}

/// Counts pairs of patches, checks the cancellation and reports progress, also within a pair: one
/// may take minutes.
///
/// Threads: any thread may call it; reports come on the thread that made it.
class ShotProgress {
 public:
  ShotProgress(double pairs, const Cancellation& cancellation,
               const std::function<void(double)>& report)
      : pairs_(pairs), cancellation_(cancellation), report_(report) {}

  /// To be called often.
  /// @throws Canceled
  void check() {
    cancellation_.throw_if_canceled();
    if (report_ && std::this_thread::get_id() == owner_ && checks_++ % checks_per_report == 0) {
      report_(static_cast<double>(done_) / pairs_);
    }
  }
  void add_pair() { ++done_; }

 private:
  static constexpr std::int64_t checks_per_report = 256;

  double pairs_;
  const Cancellation& cancellation_;
  const std::function<void(double)>& report_;
  std::thread::id owner_ = std::this_thread::get_id();
  std::int64_t checks_ = 0;  ///< by the owner
  std::atomic<std::int64_t> done_{0};
};

/// Adds up errors of which it is unknown whether they are independent.
class ErrorSum {
 public:
  void add(const Rgb& error) {
    sum_ += error;
    root_ = root_of_squares(root_, error);
  }
  /// The larger of both sums, since errors of one sign add up, and others may cancel by chance.
  Rgb largest() const {
    return {std::max(std::abs(sum_.r), root_.r), std::max(std::abs(sum_.g), root_.g),
            std::max(std::abs(sum_.b), root_.b)};
  }

 private:
  Rgb sum_, root_;
};

/// Computes the linear term of the irradiance of a patch.
class LinearTermSum {
 public:
  /// @param weight exitance of the source, over the area of the patch
  void add(const PatchExchange& exchange, const Rgb& weight) {
    for (std::size_t a = 0; a < 2; ++a) {
      sums_[a] += exchange.moments[a] * weight;
      errors_[a].add(exchange.moment_errors[a] * weight);
    }
  }
  LinearTerm sum() const { return {sums_[0], sums_[1]}; }
  LinearTerm error() const { return {errors_[0].largest(), errors_[1].largest()}; }

 private:
  std::array<Rgb, 2> sums_;
  std::array<ErrorSum, 2> errors_;
};

int points_of(const ShotOptions& options) {
  return options.points > 0 ? options.points : ShotOptions::default_points;
}

/// Computes the irradiance of patch i from all sources.
void receive(const Scene& scene, const ExchangeFinder& exchange, PatchId i, ShotProgress& progress,
             IntegratedPairs& integrated, DirectLight& light) {
  const auto row = static_cast<std::size_t>(i);
  const double unit = 1 / scene.patch(i).area;
  for (DirectLight::Contribution& contribution : light.contributions) {
    contribution.irradiance[row] = 0;
    if (!contribution.linear_terms.empty()) {
      contribution.linear_terms[row] = {};
    }
  }
  const bool linear = !light.linear_terms.empty();
  const LinearBasis basis = linear ? linear_basis(scene, i) : LinearBasis();
  Rgb power;
  ErrorSum errors;
  LinearTermSum linear_term;
  for (const PatchId j : light.sources) {
    progress.check();
    progress.add_pair();
    if (j == i) {
      continue;
    }
    const PatchExchange found = exchange(
        i, j, [&] { progress.check(); }, linear ? &basis : nullptr);
    const double area = found.area;
    power += area * scene.exitance(j);
    integrated += found.integrated ? 1 : 0;
    errors.add(unit * found.error * scene.exitance(j));
    const auto contribution = contribution_of(light.contributions, scene.patch(j).material);
    if (contribution != light.contributions.end()) {
      contribution->irradiance[row] += unit * area;
      for (std::size_t a = 0; linear && a < 2; ++a) {
        contribution->linear_terms[row][a] += unit * found.moments[a];
      }
    }
    if (linear) {
      linear_term.add(found, unit * scene.exitance(j));
    }
  }
  light.irradiance[row] = unit * power;
  light.irradiance_error[row] = errors.largest();
  if (linear) {
    light.linear_terms[row] = linear_term.sum();
    light.linear_term_errors[row] = linear_term.error();
  }
}

/// Computes the irradiance of some patches from all sources.
void receive(const Scene& scene, const std::vector<PatchId>& receivers, const ShotOptions& options,
             const Cancellation& cancellation, const std::function<void(double)>& progress,
             IntegratedPairs& integrated, DirectLight& light) {
  const ExchangeFinder exchange(scene, cancellation, points_of(options));
  WorkerThreads workers(thread_count(options.threads));
  ShotProgress shot(
      static_cast<double>(receivers.size()) * static_cast<double>(light.sources.size()),
      cancellation, progress);
  for_each_index(workers, std::size_t{0}, receivers.size(), [&](std::size_t k) {
    receive(scene, exchange, receivers[k], shot, integrated, light);
  });
}

/// Sets the exitance of the sources and their fraction of all emitted power.
/// @param exitance of a patch
template <class Exitance>
void count_power(const Scene& scene, Exitance exitance, DirectLight& light) {
  double shot = 0, total = 0;
  for (const PatchId j : light.sources) {
    at(light.exitance, j) = exitance(j);
    shot += scene.patch(j).area * sum(exitance(j));
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    total += scene.patch(i).area * sum(exitance(i));
  }
  light.power_fraction = total > 0 ? shot / total : 0;
}

/// E of the sources of a part, which has one irradiance for all of them.
template <class Exitance>
Rgb exitance_of_contribution(const DirectLight::Contribution& contribution,
                             const std::vector<PatchId>& sources, const Scene& scene,
                             Exitance exitance) {
  std::optional<Rgb> common;
  for (const PatchId i : sources) {
    if (scene.patch(i).material != contribution.material) {
      continue;
    }
    if (common && !(*common == exitance(i))) {
      throw InputError(
          "the first shot is stored per material, and faces of one of its materials now differ in "
          "E");
    }
    common = exitance(i);
  }
  return common.value_or(Rgb{});
}

/// The contributions of all sources to patch i.
std::vector<DirectLight::Pair> pairs_of(const Scene& scene, const ExchangeFinder& exchange,
                                        PatchId i, const std::vector<PatchId>& sources,
                                        ShotProgress& progress) {
  std::vector<DirectLight::Pair> pairs;
  for (const PatchId j : sources) {
    progress.check();
    progress.add_pair();
    const double area = j == i ? 0.0 : exchange(i, j, [&] { progress.check(); }).area;
    if (area > 0) {
      pairs.push_back({i, j, 1 / scene.patch(i).area * area});
    }
  }
  return pairs;
}

}  // namespace

ShotOptions shot_options(const SolveOptions& options) {
  return {
      .threads = options.threads, .basis = options.basis, .points = options.engine_options.points};
}

DirectLight shoot(const Scene& scene, const std::vector<PatchId>& sources,
                  const ShotOptions& options, const Cancellation& cancellation,
                  const std::function<void(double)>& progress) {
  const Basis basis = options.basis;
  const auto patches = scene.patches().size();
  DirectLight light{.irradiance = std::vector<Rgb>(patches),
                    .exitance = std::vector<Rgb>(patches),
                    .sources = sources,
                    .contributions = empty_contributions(scene, sources, basis),
                    .irradiance_error = std::vector<Rgb>(patches),
                    .points = std::vector<int>(patches, points_of(options))};
  if (basis == Basis::linear) {
    light.linear_terms.resize(patches);
    light.linear_term_errors.resize(patches);
  }
  if (sources.empty()) {
    return light;
  }
  std::vector<PatchId> all(patches);
  std::iota(all.begin(), all.end(), 0);
  IntegratedPairs integrated{0};
  receive(scene, all, options, cancellation, progress, integrated, light);
  light.integrated_pairs = integrated;
  if (progress) {
    progress(1);
  }
  count_power(
      scene, [&](PatchId i) { return scene.exitance(i); }, light);
  return light;
}

std::vector<DirectLight::Pair> shoot_pairs(const Scene& scene, const std::vector<PatchId>& sources,
                                           const std::vector<PatchId>& receivers,
                                           const ShotOptions& options,
                                           const Cancellation& cancellation,
                                           const std::function<void(double)>& progress) {
  std::vector<DirectLight::Pair> pairs;
  if (sources.empty() || receivers.empty()) {
    return pairs;
  }
  const ExchangeFinder exchange(scene, cancellation, points_of(options));
  WorkerThreads workers(thread_count(options.threads));
  ShotProgress shot(static_cast<double>(receivers.size()) * static_cast<double>(sources.size()),
                    cancellation, progress);
  std::vector<std::vector<DirectLight::Pair>> by_receiver(receivers.size());
  for_each_index(workers, std::size_t{0}, receivers.size(), [&](std::size_t k) {
    by_receiver[k] = pairs_of(scene, exchange, receivers[k], sources, shot);
  });
  for (const std::vector<DirectLight::Pair>& of_receiver : by_receiver) {
    pairs.insert(pairs.end(), of_receiver.begin(), of_receiver.end());
  }
  return pairs;
}

void shoot_again(const Scene& scene, const std::vector<PatchId>& receivers,
                 const ShotOptions& options, DirectLight& light, const Cancellation& cancellation,
                 const std::function<void(double)>& progress) {
  const auto is_received = [&](PatchId i) {
    return std::binary_search(receivers.begin(), receivers.end(), i);
  };
  std::vector<PatchId> paired;
  std::copy_if(light.paired.begin(), light.paired.end(), std::back_inserter(paired), is_received);
  const auto rows = static_cast<double>(receivers.size());
  const double first = rows / (rows + static_cast<double>(paired.size()));
  IntegratedPairs counted{0};  // whole pairs, which `light` has counted
  receive(scene, receivers, options, cancellation, part_of_progress(progress, 0, first), counted,
          light);
  light.points.resize(light.irradiance.size());
  for (const PatchId i : receivers) {
    at(light.points, i) = points_of(options);
  }
  std::vector<DirectLight::Pair> kept, again;
  std::copy_if(light.pairs.begin(), light.pairs.end(), std::back_inserter(kept),
               [&](const DirectLight::Pair& pair) { return !is_received(pair.receiver); });
  again = shoot_pairs(scene, light.sources, paired, options, cancellation,
                      part_of_progress(progress, first, 1 - first));
  light.pairs.clear();
  std::merge(kept.begin(), kept.end(), again.begin(), again.end(), std::back_inserter(light.pairs),
             [](const DirectLight::Pair& a, const DirectLight::Pair& b) {
               return a.receiver < b.receiver;
             });
  if (progress) {
    progress(1);
  }
}

DirectLight with_materials(const DirectLight& light, const Scene& scene,
                           const std::vector<Material>& materials,
                           std::span<const std::int32_t> patch_materials) {
  const auto patches = scene.patches().size();
  if (light.irradiance.size() != patches || light.exitance.size() != patches) {
    throw InputError("the first shot belongs to another scene: the number of patches differs");
  }
  if (patch_materials.empty() && materials.size() != scene.materials().size()) {
    throw InputError("the materials belong to another scene: their number differs");
  }
  if (light.contributions.empty() && !light.sources.empty()) {
    throw InputError("the first shot is not stored per material: that would take too much memory");
  }
  DirectLight other{.irradiance = std::vector<Rgb>(patches),
                    .exitance = std::vector<Rgb>(patches),
                    .sources = light.sources,
                    .contributions = {},
                    .linear_terms = std::vector<LinearTerm>(light.linear_terms.size())};
  const auto exitance_of = [&](PatchId i) {
    return at(materials, patch_materials.empty() ? scene.patch(i).material : at(patch_materials, i))
        .exitance;
  };
  for (const DirectLight::Contribution& contribution : light.contributions) {
    const Rgb exitance = exitance_of_contribution(contribution, light.sources, scene, exitance_of);
    for (std::size_t i = 0; i < patches; ++i) {
      other.irradiance[i] += contribution.irradiance[i] * exitance;
    }
    for (std::size_t i = 0; i < other.linear_terms.size(); ++i) {
      other.linear_terms[i].first += contribution.linear_terms[i][0] * exitance;
      other.linear_terms[i].second += contribution.linear_terms[i][1] * exitance;
    }
  }
  count_power(scene, exitance_of, other);
  other.paired = light.paired;
  other.pairs = light.pairs;
  return other;
}

}  // namespace transillum
