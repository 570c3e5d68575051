// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Rounds of adaptive refinement. Input: a scene and options of solves; output: a scene whose
// patches are divided where their functions represent the radiosity worst.
#include "session/refinement_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "base/choice.h"
#include "base/seconds_since.h"
#include "radiosity/analysis/radiosity_jumps.h"
#include "radiosity/channel_sums.h"
#include "scene/build/patch_count.h"
#include "session/divisions.h"
#include "session/patch_errors.h"
#include "transillum/at.h"
#include "transillum/engine.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Number of patches after a round, over that before it, at most.
constexpr double growth = 2;
/// Fraction of the sum of all squares that is not worth dividing for: where a few patches have all
/// the rest, the others are left alone, though there would be room.
constexpr double negligible = 1e-3;

/// The light that jumps and errors are relative to: the integral of B², by channel, over all
/// patches that emit nothing, or of what the others reflect, where that is more; of B² over all if
/// each emits.
Rgb square_integral(const Solution& solution) {
  const Scene& scene = *solution.scene;
  Rgb passive, of_sources, all;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb square = square_integral(solution, i);
    all = all + square;
    if (max_abs(scene.exitance(i)) > 0) {
      const Rgb reflected = at(solution.radiosity, i) - scene.exitance(i);
      of_sources = of_sources + scene.patch(i).area * (reflected * reflected);
    } else {
      passive = passive + square;
    }
  }
  return max_abs(passive) > 0 ? largest_of(passive, of_sources) : all;
}

std::vector<Rgb> squares_by_jump(const Solution& solution, const Cancellation& cancellation) {
  std::vector<Rgb> result = squared_jumps(solution, cancellation);
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    at(result, i) = solution.scene->patch(i).area * at(result, i);
  }
  return result;
}

/// The worst patches, as many as make no more than `most` patches of all.
std::vector<PatchId> worst(const Scene& scene, const std::vector<double>& squares,
                           std::int64_t most) {
  std::vector<PatchId> order = all_patches(scene);
  std::stable_sort(order.begin(), order.end(),
                   [&](PatchId a, PatchId b) { return at(squares, a) > at(squares, b); });
  std::int64_t count = scene.patch_count();
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  double left = sum;
  std::vector<PatchId> chosen;
  for (const PatchId i : order) {
    const int more = division_count(scene, i) - 1;
    if (!(at(squares, i) > 0) || !(left > negligible * sum) || count + more > most) {
      break;
    }
    count += more;
    left -= at(squares, i);
    chosen.push_back(i);
  }
  return chosen;
}

/// A scene divided at its worst patches.
struct FinerScene {
  std::shared_ptr<const Scene> scene;  ///< null where nothing is left
  std::vector<PatchId> chosen;         ///< the patches, worst first
};

/// Divides the worst patches, into no more than `most` patches of all. Patches on the same points
/// are divided together: fewer are chosen where that makes too many.
FinerScene divide_worst(const Scene& scene, std::vector<double> squares, std::int64_t most,
                        const Cancellation& cancellation) {
  for (std::vector<PatchId> chosen = worst(scene, squares, most); !chosen.empty();) {
    const DividedScene divided = divide(scene, chosen, cancellation);
    const PatchId count = divided.scene->patch_count();
    if (count > most) {
      chosen.resize(chosen.size() / 2);
    } else if (count > scene.patch_count()) {
      return {divided.scene, std::move(chosen)};
    } else {  // all were too thin
      for (const PatchId i : chosen) {
        at(squares, i) = 0;
      }
      chosen = worst(scene, squares, most);
    }
  }
  return {};
}

using Clock = std::chrono::steady_clock;

}  // namespace

namespace {

constexpr std::array criteria{
    Choice{RefineBy::jump, "jump"},
    Choice{RefineBy::error, "error"},
};

}  // namespace

template <>
const Choices& choices_of<RefineBy>() {
  static const Choices choices = texts_of<criteria>("criterion of refinement");
  return choices;
}

void RefineOptions::validate() const {
  if (patches < 1) {
    throw InputError(fmt::format("refinement: {} patches; at least 1 is required", patches));
  }
  if (!(until >= 0 && until < 1)) {
    throw InputError(
        fmt::format("refinement: the measure to reach is {}, but must be >= 0 and < 1", until));
  }
}

RefinementPlan::RefinementPlan(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                               const RefineOptions& refine, const Cancellation& cancellation)
    : options_(options), refine_(refine), refined_(std::move(scene)) {
  refine.validate();
  options.validate();
  if (!takes_directions(options.engine)) {
    throw InputError(fmt::format("refinement: not available with engine {}, which makes no passes",
                                 name_of(options.engine)));
  }
  if (options.glossy) {
    throw InputError("refinement: not available with lobes (glossy)");
  }
  // The error is known only after a round.
  if (refined_->patch_count() < refine.patches || refine.by == RefineBy::error) {
    begin_round(cancellation);
  } else {
    finish();
  }
}

std::vector<std::string> RefinementPlan::divisions() const {
  std::vector<std::string> names = divisions_;
  if (scene_ != refined_) {
    names.emplace_back(all_patches_name);
  }
  return names;
}

void RefinementPlan::begin_round(const Cancellation& cancellation) {
  const auto start = Clock::now();
  const auto check = [this](std::int64_t patches) {
    check_memory(refined_->name(), patches, options_.replicas,
                 options_.basis == Basis::linear ? 3 : 1);
  };
  parent_.clear();
  scene_ = refined_;
  if (refine_.by == RefineBy::error) {
    check(4 * static_cast<std::int64_t>(refined_->patch_count()));
    DividedScene divided = divide(*refined_, all_patches(*refined_), cancellation);
    scene_ = std::move(divided.scene);
    parent_ = std::move(divided.parent);
  }
  check(scene_->patch_count());
  seconds_ = seconds_since(start);
}

void RefinementPlan::finish() {
  scene_ = refined_;
  finished_ = true;
}

const RefinementRound& RefinementPlan::assess(const Solution& solution, double seconds,
                                              const Cancellation& cancellation) {
  const auto start = Clock::now();
  const std::vector<Rgb> squares =
      refine_.by == RefineBy::jump
          ? squares_by_jump(solution, cancellation)
          : patch_errors(*refined_, {scene_, parent_}, solution).unrepresented;
  const Rgb units = channel_units(root(square_integral(solution)));
  squares_.clear();
  Rgb sum;
  for (const Rgb& square : squares) {
    sum = sum + square;
    double relative = 0;
    for (const auto channel : channels_of_rgb) {
      relative += ratio_or_zero(square.*channel, units.*channel * (units.*channel));
    }
    squares_.push_back(relative);
  }
  RefinementRound& round = rounds_.emplace_back();
  round.patches = refined_->patch_count();
  round.measure = largest_ratio(root(sum), units);
  round.seconds = seconds_ + seconds + seconds_since(start);
  return round;
}

bool RefinementPlan::divide_worst(const Cancellation& cancellation) {
  // Jumps and errors below the tolerance may be left over by the iteration.
  const double measure = rounds_.back().measure;
  if (!std::isfinite(measure) || measure <= std::max(refine_.until, options_.tolerance)) {
    finish();
    return false;
  }
  const auto most = std::min(
      refine_.patches, static_cast<std::int64_t>(std::ceil(growth * refined_->patch_count())) + 3);
  FinerScene finer = transillum::divide_worst(*refined_, squares_, most, cancellation);
  if (finer.scene) {
    std::sort(finer.chosen.begin(), finer.chosen.end());
    divisions_.push_back(division_by_numbers(finer.chosen));
    refined_ = finer.scene;
  }
  if (!finer.scene ||
      (refine_.by == RefineBy::jump && refined_->patch_count() >= refine_.patches)) {
    finish();
    return false;
  }
  begin_round(cancellation);
  return true;
}

}  // namespace transillum
