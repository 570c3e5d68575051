// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sunlit fractions and fractions of the sky, by exact passes. Input: a scene and its BSP tree.
#include "transillum/shading.h"

#include <algorithm>

#include "base/for_each_index.h"
#include "transillum/at.h"
#include "transillum/directions.h"
#include "transillum/engine.h"

namespace transillum {
namespace {

/// The fraction of a projection that nothing covers.
double open_fraction(const Coverage& coverage) {
  return coverage.projected > 0 ? std::min(1.0, coverage.uncovered() / coverage.projected) : 0.0;
}

/// Uncovered area from above the horizon, and all projected area, by patch.
struct SkyAreas {
  std::vector<double> open, projected;

  void add(const std::vector<Coverage>& coverages, bool is_above) {
    for (std::size_t i = 0; i < open.size(); ++i) {
      open[i] += is_above ? coverages[i].uncovered() : 0.0;
      projected[i] += coverages[i].projected;
    }
  }
};

/// Calls take(k, make(k)) for k from 0 to `count` - 1 in order, on the calling thread; make() runs
/// in parallel, in blocks.
template <class Make, class Take>
void in_blocks(std::size_t count, int threads, const Make& make, const Take& take) {
  constexpr std::size_t per_thread = 16;
  const int used = thread_count(threads);
  WorkerThreads workers(used);
  const std::size_t block = per_thread * static_cast<std::size_t>(used);
  std::vector<decltype(make(std::size_t{0}))> made(block);
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t last = std::min(first + block, count);
    for_each_index(workers, first, last, [&](std::size_t k) { made[k - first] = make(k); });
    for (std::size_t k = first; k < last; ++k) {
      take(k, made[k - first]);
    }
  }
}

}  // namespace

void sunlit_fractions(const std::shared_ptr<const Scene>& scene,
                      const std::shared_ptr<const BspTree>& tree, std::span<const Vec3> directions,
                      const std::function<void(std::size_t, const std::vector<double>&)>& take,
                      int threads, const Cancellation& cancellation) {
  const TransferEngine engine = make_engine(Engine::fast, scene, tree);
  const auto make = [&](std::size_t k) {
    const Transfers transfers = engine(directions[k], cancellation);
    std::vector<double> fractions;
    fractions.reserve(transfers.forward.size());
    for (const Coverage& coverage : transfers.forward) {
      fractions.push_back(open_fraction(coverage));
    }
    return fractions;
  };
  in_blocks(directions.size(), threads, make, take);
}

std::vector<double> seen_sky_fractions(const std::shared_ptr<const Scene>& scene,
                                       const std::shared_ptr<const BspTree>& tree, const Vec3& up,
                                       int directions, int threads,
                                       const Cancellation& cancellation) {
  const TransferEngine engine = make_engine(Engine::fast, scene, tree);
  const auto passes = make_directions(default_sampling(true), directions, 1);
  SkyAreas areas{std::vector<double>(scene->patches().size()),
                 std::vector<double>(scene->patches().size())};
  in_blocks(
      passes.size(), threads,
      [&](std::size_t k) { return engine(passes[k].direction, cancellation); },
      [&](std::size_t k, const Transfers& transfers) {
        const double height = dot(passes[k].direction, up);
        areas.add(transfers.forward, height > 0);
        areas.add(transfers.backward, height < 0);
      });
  std::vector<double> fractions;
  for (std::size_t i = 0; i < areas.open.size(); ++i) {
    fractions.push_back(areas.projected[i] > 0 ? std::min(1.0, areas.open[i] / areas.projected[i])
                                               : 0.0);
  }
  return fractions;
}

}  // namespace transillum
