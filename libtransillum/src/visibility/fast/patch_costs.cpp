// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/patch_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <unordered_map>
#include <utility>

#include "base/seconds_since.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/fast/fast_engine.h"

namespace transillum {

PatchCost PatchCosts::total() const {
  PatchCost sum;
  for (const PatchCost& cost : patches) {
    sum += cost;
  }
  return sum;
}

std::vector<Vec3> directions_to_measure(std::span<const Vec3> directions) {
  const std::size_t count = std::clamp<std::size_t>(directions.size() / 64, 1, 4);
  std::vector<Vec3> chosen;
  for (std::size_t k = 0; k < count && !directions.empty(); ++k) {
    chosen.push_back(directions[k * directions.size() / count]);
  }
  return chosen;
}

PatchCosts patch_costs(Engine engine, std::shared_ptr<const Scene> scene,
                       std::shared_ptr<const BspTree> tree, std::span<const Vec3> directions,
                       bool moments, const Cancellation& cancellation) {
  if (engine != Engine::fast) {
    throw InputError(fmt::format(
        "engine {}: it has no visibility queries of patches, whose cost could be measured; choose "
        "fast",
        name_of(engine)));
  }
  if (directions.empty()) {
    throw InputError("no passes were made, whose cost could be measured");
  }
  const auto start = std::chrono::steady_clock::now();
  PatchCosts costs{static_cast<int>(directions.size()), 0, {}};
  const auto patches = static_cast<std::size_t>(scene->patch_count());
  costs.patches.resize(patches);
  std::vector<PatchCost> run;
  const TransferEngine measured =
      measured_fast_engine(std::move(scene), std::move(tree), moments, run);
  for (const Vec3& omega : directions) {
    run.assign(patches, {});
    measured(omega, cancellation);
    const std::vector<PatchCost> first = std::exchange(run, std::vector<PatchCost>(patches));
    measured(omega, cancellation);
    for (std::size_t i = 0; i < patches; ++i) {
      run[i].seconds = std::min(run[i].seconds, first[i].seconds);
      costs.patches[i] += run[i];
    }
  }
  costs.seconds = seconds_since(start);
  return costs;
}

std::vector<FaceCost> costly_faces(const Scene& scene, const PatchCosts& costs, std::size_t most) {
  std::vector<FaceCost> faces;
  std::unordered_map<std::int32_t, std::size_t> index_of;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto [place, added] = index_of.try_emplace(scene.patch(i).face, faces.size());
    if (added) {
      faces.push_back({i, 0, {}});
    }
    FaceCost& face = faces[place->second];
    ++face.patches;
    face.cost += at(costs.patches, i);
  }
  const std::size_t count = std::min(most, faces.size());
  std::partial_sort(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(count), faces.end(),
                    [](const FaceCost& a, const FaceCost& b) {
                      return a.cost.seconds != b.cost.seconds ? a.cost.seconds > b.cost.seconds
                                                              : a.patch < b.patch;
                    });
  faces.resize(count);
  return faces;
}

}  // namespace transillum
