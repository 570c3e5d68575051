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
#include "radiosity/channel_sums.h"
#include "scene/build/division.h"
#include "scene/build/patch_count.h"
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

/// Integral of |B|² over patch i.
double square_integral(const Solution& solution, PatchId i) {
  double sum = sum_of_squares(at(solution.radiosity, i));
  if (!solution.linear_terms.empty()) {
    const LinearTerm& term = at(solution.linear_terms, i);
    sum += sum_of_squares(term.first) + sum_of_squares(term.second);
  }
  return solution.scene->patch(i).area * sum;
}

/// Integral of |B|² over all patches that emit nothing; over all if each emits.
double square_integral(const Solution& solution) {
  double passive = 0, all = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const double square = square_integral(solution, i);
    all += square;
    passive += max_abs(solution.scene->exitance(i)) > 0 ? 0 : square;
  }
  return passive > 0 ? passive : all;
}

/// Integrals of B over a patch, times its functions, from the patches that it is divided into.
struct Projection {
  double square = 0;                ///< integral of |B|²
  std::array<Rgb, 3> coefficients;  ///< integrals of B phi_a, over the area
};

/// Adds what patch k of the divided scene contributes to the projection onto patch i.
void add_to(Projection& projection, const Solution& fine, PatchId k, const LinearBasis* own,
            const LinearBasis* basis, double whole_area) {
  const Patch& patch = fine.scene->patch(k);
  const double fraction = patch.area / whole_area;
  const Rgb& mean = at(fine.radiosity, k);
  projection.square += square_integral(fine, k);
  projection.coefficients[0] += fraction * mean;
  if (basis == nullptr) {
    return;
  }
  const auto at_center = basis->at(own->center);
  const LinearTerm& term = at(fine.linear_terms, k);
  for (std::size_t a = 0; a < 2; ++a) {
    // The function of the whole in terms of those of the part: phi = value + s1 psi_1 + s2 psi_2.
    // Their gradients need not be orthogonal: psi_1 is constant across the longest edge.
    const Vec3 &g = basis->gradient[a], &h1 = own->gradient[0], &h2 = own->gradient[1];
    const double h11 = dot(h1, h1), h12 = dot(h1, h2), h22 = dot(h2, h2);
    const double g1 = dot(g, h1), g2 = dot(g, h2);
    const double determinant = h11 * h22 - h12 * h12;
    const double s1 = (g1 * h22 - g2 * h12) / determinant;
    const double s2 = (g2 * h11 - g1 * h12) / determinant;
    projection.coefficients[a + 1] +=
        fraction * (at_center[a] * mean + s1 * term.first + s2 * term.second);
  }
}

/// Per patch of `whole`: integral of the square of what its functions cannot represent of B.
std::vector<double> squares_by_error(const Scene& whole, const DividedScene& divided,
                                     const Solution& fine) {
  const bool linear = !fine.linear_terms.empty();
  const std::vector<LinearBasis> own = linear ? linear_bases(*divided.scene)
                                              : std::vector<LinearBasis>(),
                                 bases = linear ? linear_bases(whole) : std::vector<LinearBasis>();
  std::vector<Projection> projections(whole.patches().size());
  for (PatchId k = 0; k < divided.scene->patch_count(); ++k) {
    const PatchId i = at(divided.parent, k);
    add_to(at(projections, i), fine, k, linear ? &at(own, k) : nullptr,
           linear ? &at(bases, i) : nullptr, whole.patch(i).area);
  }
  std::vector<double> errors;
  for (PatchId i = 0; i < whole.patch_count(); ++i) {
    const Projection& p = at(projections, i);
    double represented = 0;
    for (const Rgb& c : p.coefficients) {
      represented += sum_of_squares(c);
    }
    errors.push_back(std::max(0.0, p.square - whole.patch(i).area * represented));
  }
  return errors;
}

std::vector<double> squares_by_jump(const Solution& solution, const Cancellation& cancellation) {
  std::vector<double> result = radiosity_jumps(solution, cancellation);
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    double& jump = at(result, i);
    jump *= jump * solution.scene->patch(i).area;
  }
  return result;
}

std::vector<PatchId> all_patches(const Scene& scene) {
  std::vector<PatchId> patches(scene.patches().size());
  std::iota(patches.begin(), patches.end(), PatchId{0});
  return patches;
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

/// The scene divided at its worst patches, with no more than `most`; null where nothing is left.
/// Patches on the same points are divided together: fewer are chosen where that makes too many.
std::shared_ptr<const Scene> divide_worst(const Scene& scene, std::vector<double> squares,
                                          std::int64_t most, const Cancellation& cancellation) {
  for (std::vector<PatchId> chosen = worst(scene, squares, most); !chosen.empty();) {
    const DividedScene divided = divide(scene, chosen, cancellation);
    const PatchId count = divided.scene->patch_count();
    if (count > most) {
      chosen.resize(chosen.size() / 2);
    } else if (count > scene.patch_count()) {
      return divided.scene;
    } else {  // all were too thin
      for (const PatchId i : chosen) {
        at(squares, i) = 0;
      }
      chosen = worst(scene, squares, most);
    }
  }
  return nullptr;
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
  squares_ = refine_.by == RefineBy::jump
                 ? squares_by_jump(solution, cancellation)
                 : squares_by_error(*refined_, {scene_, parent_}, solution);
  const double sum = std::accumulate(squares_.begin(), squares_.end(), 0.0);
  RefinementRound& round = rounds_.emplace_back();
  round.patches = refined_->patch_count();
  round.measure = sum > 0 ? std::sqrt(sum / square_integral(solution)) : 0;
  round.seconds = seconds_ + seconds + seconds_since(start);
  return round;
}

bool RefinementPlan::divide_worst(const Cancellation& cancellation) {
  // Jumps and errors below the tolerance may be left over by the iteration.
  if (rounds_.back().measure <= std::max(refine_.until, options_.tolerance)) {
    finish();
    return false;
  }
  const auto most = std::min(
      refine_.patches, static_cast<std::int64_t>(std::ceil(growth * refined_->patch_count())) + 3);
  const auto finer = transillum::divide_worst(*refined_, squares_, most, cancellation);
  if (finer) {
    refined_ = finer;
  }
  if (!finer || (refine_.by == RefineBy::jump && refined_->patch_count() >= refine_.patches)) {
    finish();
    return false;
  }
  begin_round(cancellation);
  return true;
}

}  // namespace transillum
