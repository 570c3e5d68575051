// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/first_shot.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "transillum/errors.h"
#include "visibility/patch_exchange.h"

namespace transillum {
namespace {

/// Patches shot at between two looks at the clock and the user.
constexpr PatchId batch = 64;

double sum(const Rgb& value) { return value.r + value.g + value.b; }

double power(const Scene& scene, PatchId i) { return scene.patch(i).area * sum(scene.exitance(i)); }

/// Gives every emitting patch the number of a point that all patches of its source share.
class SourceNumbers {
 public:
  explicit SourceNumbers(const Scene& scene) : parents_(scene.points().size()) {
    std::iota(parents_.begin(), parents_.end(), PointId{0});
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      if (power(scene, i) == 0) continue;
      const auto outline = scene.outline(i);
      for (const PointId p : outline) parents_[index(root(p))] = root(outline.front());
    }
  }

  PointId root(PointId p) {
    while (parents_[index(p)] != p) {
      PointId& parent = parents_[index(p)];
      p = parent = parents_[index(parent)];
    }
    return p;
  }

 private:
  static std::size_t index(PointId p) { return static_cast<std::size_t>(p); }

  std::vector<PointId> parents_;
};

/// A_i H_i of the sources' light.
Rgb received(const Scene& scene, const ExchangeFinder& exchange, PatchId i,
             const std::vector<PatchId>& sources, const Cancellation& cancellation) {
  Rgb power;
  for (const PatchId j : sources) {
    cancellation.throw_if_cancelled();
    if (j != i) power += exchange(i, j).area * scene.exitance(j);
  }
  return power;
}

}  // namespace

std::optional<double> first_shot_from_name(const std::string& name) {
  if (name == "none") return {};
  if (name == "auto") return small_source_ratio;
  double ratio = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), ratio);
  if (error != std::errc() || end != name.data() + name.size() || !(ratio >= 0) ||
      !std::isfinite(ratio)) {
    throw InputError(fmt::format("first shot: \"{}\" is not none, auto or a number from 0", name));
  }
  return ratio;
}

std::vector<PatchId> find_small_sources(const Scene& scene, double ratio) {
  constexpr double least_share = 1e-4;
  struct Source {
    double area = 0, power = 0;
  };
  SourceNumbers numbers(scene);
  std::vector<Source> by_number(scene.points().size());
  const auto source_of = [&](PatchId i) -> Source& {
    return by_number[static_cast<std::size_t>(numbers.root(scene.outline(i).front()))];
  };
  double total = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (power(scene, i) == 0) continue;
    source_of(i).area += scene.patch(i).area;
    source_of(i).power += power(scene, i);
    total += power(scene, i);
  }
  const double square = scene.bounds().diagonal() * scene.bounds().diagonal();
  std::vector<PatchId> small;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (power(scene, i) == 0) continue;
    const Source& source = source_of(i);
    if (square >= ratio * source.area && source.power >= least_share * total) small.push_back(i);
  }
  return small;
}

DirectLight shoot(const Scene& scene, const std::vector<PatchId>& sources, int threads,
                  const Cancellation& cancellation, const std::function<void(double)>& progress) {
  const auto patches = static_cast<std::size_t>(scene.patch_count());
  DirectLight light{std::vector<Rgb>(patches), std::vector<Rgb>(patches), sources, 0};
  if (sources.empty()) return light;
  const ExchangeFinder exchange(scene, cancellation);
  if (threads == 0) threads = tbb::info::default_concurrency();
  const tbb::global_control permission(tbb::global_control::max_allowed_parallelism,
                                       static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  for (PatchId first = 0; first < scene.patch_count(); first += batch * threads) {
    const PatchId end = std::min(first + batch * threads, scene.patch_count());
    arena.execute([&] {
      tbb::parallel_for(first, end, [&](PatchId i) {
        light.irradiance[static_cast<std::size_t>(i)] =
            (1 / scene.patch(i).area) * received(scene, exchange, i, sources, cancellation);
      });
    });
    if (progress) progress(static_cast<double>(end) / scene.patch_count());
  }

  double shot = 0, total = 0;
  for (const PatchId j : sources) {
    light.exitance[static_cast<std::size_t>(j)] = scene.exitance(j);
    shot += power(scene, j);
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) total += power(scene, i);
  light.power_share = shot / total;
  return light;
}

}  // namespace transillum
