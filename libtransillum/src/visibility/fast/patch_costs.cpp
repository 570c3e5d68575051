// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/patch_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "base/choice.h"
#include "base/seconds_since.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/fast/fast_engine.h"

namespace transillum {
namespace {

constexpr std::array failures{
    Choice{QueryFailure::none, "candidates", "Candidates", "no query was repeated"},
    Choice{QueryFailure::thin, "thin", "Too thin", "the face is too thin, or too nearly edge-on"},
    Choice{QueryFailure::cut_needle, "cut-needle", "Cut to needles",
           "the BSP tree has cut the face to needles"},
    Choice{QueryFailure::flat, "flat", "Flat", "rounding leaves needles of the face no area"},
    Choice{QueryFailure::candidate, "candidate", "Flat candidate",
           "rounding leaves a needle in front of the face no area"},
    Choice{QueryFailure::inconsistent, "inconsistent", "Edges too near",
           "edges in front of the face are nearer to each other than rounding"},
    Choice{QueryFailure::crowded, "crowded", "Too many edges",
           "too many edges bound what the face sees"},
};
static_assert(failures.size() == query_failures);

std::int64_t sum_of(const FailureCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

}  // namespace

template <>
const Choices& choices_of<QueryFailure>() {
  return texts_of<failures>("reason");
}

std::int64_t PatchCost::exact_queries() const { return sum_of(exact); }

QueryFailure PatchCost::main_reason() const {
  const FailureCounts& counts = exact_queries() > 0 ? exact : repeated;
  return static_cast<QueryFailure>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

PatchCost& PatchCost::operator+=(const PatchCost& other) {
  seconds += other.seconds;
  queries += other.queries;
  candidates += other.candidates;
  for (std::size_t k = 0; k < query_failures; ++k) {
    repeated[k] += other.repeated[k];
    exact[k] += other.exact[k];
  }
  return *this;
}

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
  std::partial_sort(
      faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(count), faces.end(),
      [](const FaceCost& a, const FaceCost& b) { return a.cost.seconds > b.cost.seconds; });
  faces.resize(count);
  return faces;
}

}  // namespace transillum
