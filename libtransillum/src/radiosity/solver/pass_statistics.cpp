// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/pass_statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "radiosity/ratio.h"
#include "scene/build/two_sided.h"
#include "transillum/at.h"

namespace transillum {

PassStatistics::PassStatistics(const Scene& scene, bool two_way, const DirectLight& shot,
                               const OwnedPatches& owned, std::size_t per_patch,
                               const std::vector<Rgb>& reflectance)
    : scene_(scene),
      two_way_(two_way),
      owned_(owned),
      areas_(scene.patches().size(), per_patch),
      facing_area_(scene.patches().size()),
      back_seen_(scene.patches().size()),
      uncovered_(scene.patches().size()),
      light_(scene, two_way, shot, reflectance),
      shot_(scene, shot, owned) {}

void PassStatistics::begin_set() {
  areas_ = VisibleAreaSums(facing_area_.size(), areas_.per_patch);
  quadrature_errors_.clear();
  complete_errors_ = 0;
}

void PassStatistics::add(const Pass& pass) {
  const Transfers& transfers = pass.transfers;
  areas_.add(transfers, two_way_, owned_);
  const int directions_per_pass = two_way_ ? 2 : 1;
  double worst = 0;
  const std::size_t first = owned_.first();
  for (std::size_t i = first; i < owned_.last(); ++i) {
    const double exact = areas_.passes * directions_per_pass * scene_.patches()[i].area / 4;
    worst = std::max(worst, std::abs(areas_.projected[i] / exact - 1));
    const Coverage& forward = transfers.forward[i - first];
    const Coverage& backward = transfers.backward[i - first];
    facing_area_[i] += forward.projected + backward.projected;
    back_seen_[i] += transfers.back_seen[i - first];
    uncovered_[i] += forward.projected - forward.covered + backward.projected - backward.covered;
  }
  quadrature_errors_.push_back(std::numbers::pi * worst);
  projected_ += pass.projected;
  covered_ += pass.covered;
  closure_relative_ = std::max(closure_relative_, pass.closure.relative);
  closure_grazing_ = std::max(closure_grazing_, pass.closure.grazing);
  closure_moments_ = std::max(closure_moments_, pass.closure.moments);
  light_.add(transfers.exchanges);
  shot_.add(transfers);
  counts_ += transfers.counts;
  transfer_count_ += pass.exchanges;
}

void PassStatistics::complete_errors() {
  owned_.sums->maxima(std::span(quadrature_errors_).subspan(complete_errors_));
  complete_errors_ = quadrature_errors_.size();
}

void PassStatistics::complete() {
  areas_.complete(owned_);
  for (std::vector<double>* values : {&facing_area_, &back_seen_, &uncovered_}) {
    owned_.complete(*values);
  }
  light_.complete(owned_);
  shot_.complete();
}

std::vector<double> PassStatistics::back_seen_fractions() const {
  std::vector<double> shares(back_seen_.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = ratio_or_zero(back_seen_[i], facing_area_[i]);
  }
  return shares;
}

void PassStatistics::write_to(SolveStatistics& statistics) const {
  statistics.transfers = transfer_count_;
  statistics.counts = counts_;
  statistics.light_directions = light_.mean();
  const ShotCheck::Disagreement disagreement = shot_.disagreement();
  statistics.shot_disagreement = disagreement.ratio;
  statistics.shot_disagreement_patch = disagreement.patch;
  statistics.closure_defect_max = closure_relative_;
  statistics.closure_defect_grazing = closure_grazing_;
  statistics.closure_defect_moments = closure_moments_;
  // The side of a two-sided face counts from which less escapes: not the outside of a sealed room.
  double outside = 0;
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    if (are_two_sides(scene_, i)) {
      outside += std::abs(at(uncovered_, i) - at(uncovered_, i + 1));
    }
  }
  statistics.escaped = ratio_or_zero(std::max(0.0, projected_ - covered_ - outside), projected_);
}

}  // namespace transillum
