// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sorting and passes of the fast engine on scenes as files have them: rounded, turned, touching,
// interpenetrating, long and thin. All times are given relative to the sphere flake in the same
// run; the counters are the largest of these ratios.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "measure.h"
#include "support/imperfect_scenes.h"
#include "transillum/engine.h"
#include "transillum/solids.h"

namespace transillum::benchmarks {
namespace {

struct Measured {
  double patches = 0, fragments = 0;
  double sort = 0;       ///< microseconds a patch, on one core
  double pass = 0;       ///< microseconds a patch
  double transfers = 0;  ///< a patch and pass
  double pairs = 0;      ///< candidates a transfer
  double exact = 0;      ///< queries in extended precision, a patch and pass
  double closure = 0;
};

Measured measure(const std::shared_ptr<const Scene>& scene) {
  Measured m;
  m.patches = scene->patch_count();
  std::shared_ptr<const BspTree> tree;
  m.sort = 1e6 / m.patches * seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
             tree = std::make_shared<const BspTree>(*scene, Cancellation{},
                                                    std::function<void(double)>{}, 1);
           });
  m.fragments = static_cast<double>(tree->fragments().size()) / m.patches;
  const TransferEngine engine = make_engine(Engine::fast, scene, tree);
  const auto directions = some_directions(16);
  const double per = m.patches * static_cast<double>(directions.size());
  double seconds = 0;
  for (const Vec3& omega : directions) {
    Transfers transfers;
    seconds += seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] { transfers = engine(omega, {}); });
    m.transfers += static_cast<double>(transfers.exchanges.size()) / per;
    m.pairs += static_cast<double>(transfers.counts.pairs) / per;
    m.exact += static_cast<double>(transfers.counts.exact_queries) / per;
    m.closure = std::max(m.closure, closure_defect(transfers, *scene).relative);
  }
  m.pass = 1e6 * seconds / per;
  m.pairs /= m.transfers;
  return m;
}

/// Times, with the flake as the unit.
struct Ratios {
  double sort = 0;      ///< a patch
  double transfer = 0;  ///< a transfer
  /// The time of a pass, over 4 times the flake's time a transfer and 1.6 times its time a patch.
  double of_target = 0;
};

Ratios ratios_of(const Measured& m, const Measured& flake) {
  return {m.sort / flake.sort, m.pass / m.transfers / (flake.pass / flake.transfers),
          m.pass / (flake.pass / flake.transfers * (4 * m.transfers + 1.6))};
}

void print(const std::string& name, const Measured& m, const Ratios& ratios) {
  fmt::print(
      "{:<34} {:>6.0f} patches, {:5.2f} fragments, sort {:6.1f} us ({:5.1f} flakes), pass {:7.2f} "
      "us, {:5.2f} transfers ({:5.1f} flakes each), {:5.1f} pairs/transfer, {:6.4f} exact, "
      "closure {:.0e}, share of target {:.2f}\n",
      name, m.patches, m.fragments, m.sort, ratios.sort, m.pass, m.transfers, ratios.transfer,
      m.pairs, m.exact, m.closure, ratios.of_target);
  std::fflush(stdout);
}

void Wild(benchmark::State& state) {
  using testing::ImperfectScene;
  using Kind = testing::Imperfect;
  const std::vector<std::pair<std::string, ImperfectScene>> scenes{
      {"rails", {.kind = Kind::rails, .count = 60, .gap = -0.05, .turned = true}},
      {"rails, 6 digits",
       {.kind = Kind::rails, .count = 60, .gap = -0.05, .digits = 6, .turned = true}},
      {"rails, 6 digits, quadrilaterals",
       {.kind = Kind::rails,
        .count = 60,
        .gap = -0.05,
        .digits = 6,
        .turned = true,
        .quads = true}},
      {"beams", {.kind = Kind::beams, .count = 400}},
      {"beams, 6 digits", {.kind = Kind::beams, .count = 400, .digits = 6, .turned = true}},
      {"truss", {.kind = Kind::truss, .count = 1000, .aspect = 1e8}},
      {"truss, 6 digits", {.kind = Kind::truss, .count = 1000, .aspect = 1e8, .digits = 6}},
      {"clutter", {.kind = Kind::clutter, .count = 400}},
      {"clutter, 6 digits", {.kind = Kind::clutter, .count = 400, .digits = 6, .turned = true}},
      {"ball", {.kind = Kind::ball, .count = 60}},
      {"ball, 6 digits, quadrilaterals",
       {.kind = Kind::ball, .count = 60, .digits = 6, .turned = true, .quads = true}},
      {"terrain", {.kind = Kind::terrain, .count = 60}},
      {"terrain, 6 digits", {.kind = Kind::terrain, .count = 60, .digits = 6, .turned = true}}};
  for (auto _ : state) {
    const Measured flake = measure(load_scene("sphere-flake"));
    print("sphere-flake", flake, ratios_of(flake, flake));
    Ratios largest;
    const auto add = [&](const std::string& name, const SceneDescription& description) {
      const Measured m = measure(std::make_shared<const Scene>(description));
      const Ratios ratios = ratios_of(m, flake);
      print(name, m, ratios);
      largest = {std::max(largest.sort, ratios.sort), std::max(largest.transfer, ratios.transfer),
                 std::max(largest.of_target, ratios.of_target)};
    };
    for (const auto& [name, scene] : scenes) {
      add(name, testing::describe(scene));
    }
    SceneDescription united = testing::describe({.kind = Kind::clutter, .count = 100});
    unite_solids(united);
    add("clutter of 100, united", united);
    state.counters["sort"] = largest.sort;
    state.counters["transfer"] = largest.transfer;
    state.counters["of target"] = largest.of_target;
  }
}
BENCHMARK(Wild)->Name("Wild")->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace transillum::benchmarks
