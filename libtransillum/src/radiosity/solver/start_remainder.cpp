// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/start_remainder.h"

#include <algorithm>
#include <cmath>

#include "radiosity/norms.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Fraction of the largest reflected light below which the difference of two iterates is rounding.
constexpr double negligible = 1e-13;

Rgb max_of(const Rgb& a, const Rgb& b) {
  return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}

}  // namespace

StartRemainder::StartRemainder(const SolverInput& input)
    : input_(input),
      light_(input.unknowns->light()),
      follows_(traits_of(input.options.scheme).renews_directions) {
  for (PatchId i = 0; i < input.scene->patch_count(); ++i) {
    rho_max_ = max_of(rho_max_, input.scene->reflectance(i));
  }
}

void StartRemainder::begin() {
  if (upper_) {
    upper_->begin();
  }
}

void StartRemainder::add(const Transfers& transfers) {
  if (upper_) {
    upper_->add(transfers);
  }
}

void StartRemainder::complete() {
  if (upper_) {
    upper_->complete();
  }
}

void StartRemainder::finish(const RadiosityIterate& whole) {
  if (!follows_) {
    return;
  }
  if (!upper_) {
    start(whole);
  } else {
    upper_->finish();
  }
  left_ = difference(upper_->b(), whole.b());
  largest_.push_back(max_norm(left_));
  if (largest_.back() <= negligible * max_norm(light_.of(whole.b()))) {
    std::fill(left_.begin(), left_.end(), Rgb{});
    upper_.reset();
    follows_ = false;
  }
}

/// The irradiance G gathered from the solution B obeys G = F (E + rho G), so its largest value is
/// at most that of F E, which the first iteration gathered, over 1 - rho_max. A few directions may
/// miss all light: then the mean of E over the area stands for F E.
void StartRemainder::start(const RadiosityIterate& whole) {
  const Scene& scene = *input_.scene;
  Rgb gathered, power;
  double area = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb& shot = at(input_.shot->irradiance, i);
    gathered = max_of(gathered, at(whole.h(), i) - shot);
    power += scene.patch(i).area *
             (scene.exitance(i) - at(input_.shot->exitance, i) + scene.reflectance(i) * shot);
    area += scene.patch(i).area;
  }
  gathered = max_of(gathered, (1 / area) * power + input_.options.sky.exitance +
                                  input_.options.sky.sun.irradiance);
  gathered = {gathered.r / (1 - rho_max_.r), gathered.g / (1 - rho_max_.g),
              gathered.b / (1 - rho_max_.b)};
  make_upper();
  upper_->start_from(gathered);
}

void StartRemainder::make_upper() {
  upper_.emplace(*input_.unknowns, input_.options, input_.owned());
}

double StartRemainder::contraction() const {
  const std::size_t count = largest_.size(), middle = count / 2;
  if (count < 4 || !(largest_[middle] > 0)) {
    return rho_max();
  }
  const auto iterations = static_cast<double>(count - 1 - middle);
  return std::pow(largest_.back() / largest_[middle], 1 / iterations);
}

}  // namespace transillum
