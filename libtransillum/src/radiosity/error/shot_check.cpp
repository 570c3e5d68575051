// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first shot against the passes. Input: the exchanges of each direction, and the shot.
//
// What a patch receives from small sources is a few rare, large terms, so their number bounds the
// error: the variance of a sum of terms of at most b is at most b times its mean. What the sources
// send is better known: along each direction, its ratio to their projected areas, which is 1 in a
// closed scene.
#include "radiosity/error/shot_check.h"

#include <algorithm>
#include <cmath>

#include "radiosity/channel_sums.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Standard deviations that are no surprise among many patches.
constexpr double deviations = 6;
/// Relative difference that is never reported: errors of the quadrature beyond their estimates.
constexpr double tolerated = 0.02;
/// A sum of terms >= 0 exceeds so many times its mean with the inverse probability (Markov's
/// inequality): no surprise among many patches.
constexpr double surprising = 1e5;
/// Share of the most light of a direction below which what is received may be seen through a narrow
/// gap, as there are many.
constexpr double negligible = 0.05;

}  // namespace

ShotCheck::ShotCheck(const Scene& scene, const DirectLight& shot, const OwnedPatches& owned)
    : scene_(scene), shot_(shot), owned_(owned) {
  if (shot.sources.empty() || shot.irradiance_error.empty()) {
    return;
  }
  rows_.resize(scene.patches().size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    exitance_.push_back(sum(at(shot.exitance, i)));
    power_ += scene.patch(i).area * exitance_.back();
    largest_exitance_ = std::max(largest_exitance_, exitance_.back());
  }
}

void ShotCheck::exchange(PatchId receiver, PatchId source, double area) {
  const double light = area * at(exitance_, source);
  if (light > 0) {
    at(rows_, receiver).receives_now += light;
    at(rows_, source).sends_now += light;
    lit_.push_back(receiver);
  }
}

/// A patch faces one of the two directions of a pass, so what it receives along one of them is all
/// that it receives along both.
void ShotCheck::add(const Transfers& transfers) {
  if (rows_.empty()) {
    return;
  }
  ++passes_;
  for (const Transfer& t : transfers.exchanges) {
    exchange(t.receiver, t.source, t.area);
    exchange(t.source, t.receiver, t.area);
  }
  for (const PatchId i : lit_) {
    Row& row = at(rows_, i);
    row.received += row.receives_now;
    row.squares += row.receives_now * row.receives_now;
    row.receives_now = 0;
  }
  lit_.clear();
  for (const PatchId j : shot_.sources) {
    const std::size_t first = owned_.first(), k = static_cast<std::size_t>(j);
    Row& row = rows_[k];
    if (k >= first && k < owned_.last()) {
      const double facing = exitance_[k] * (transfers.forward[k - first].projected +
                                            transfers.backward[k - first].projected);
      row.sent += row.sends_now;
      row.sent_squares += row.sends_now * row.sends_now;
      row.sent_facing += row.sends_now * facing;
      row.facing += facing;
      row.facing_squares += facing * facing;
    }
    row.sends_now = 0;
  }
}

void ShotCheck::complete() { owned_.complete(rows_); }

/// The most light that a patch can receive along a direction, W.
double ShotCheck::most_of(PatchId i) const {
  return std::min(power_, scene_.patch(i).area * largest_exitance_);
}

/// The error of a shot's sum over directions, W.
double ShotCheck::error_of(PatchId i) const {
  return sum(at(shot_.irradiance_error, i)) * scene_.patch(i).area * static_cast<double>(passes_) /
         2;
}

/// The part that errors explain of a difference of two sums over directions, W.
double ShotCheck::allowed_of(PatchId i, double received, double shot) const {
  const double variance = std::max(at(rows_, i).squares, shot * most_of(i));
  return deviations * std::sqrt(variance) + 2 * error_of(i) + tolerated * std::max(received, shot);
}

/// How much more than surprising it is that directions meet so much light, if the shot is right. A
/// single one tells where the shot has next to nothing, though its sum has no known error.
double ShotCheck::surprise_of(PatchId i, double received, double shot) const {
  const double least = negligible * most_of(i);
  const double mean = std::max(shot + 2 * error_of(i), least / surprising);
  return received > least ? received / (surprising * mean) : 0;
}

/// The share of the power of all sources that other patches receive.
ShotCheck::Disagreement ShotCheck::of_power() const {
  double shot = 0, error = 0, seen = 0, deviation = 0;
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    shot += scene_.patch(i).area * sum(at(shot_.irradiance, i)) / power_;
    error += scene_.patch(i).area * sum(at(shot_.irradiance_error, i)) / power_;
  }
  for (const PatchId j : shot_.sources) {
    const Row& row = at(rows_, j);
    const double weight = scene_.patch(j).area * at(exitance_, j) / power_;
    if (!(row.facing > 0)) {
      return {};
    }
    const double ratio = row.sent / row.facing;
    const double squares =
        row.sent_squares - 2 * ratio * row.sent_facing + ratio * ratio * row.facing_squares;
    // Part by gaps that no direction happens to meet.
    const auto mixed = [](double owned) { return std::max(0.0, owned * (1 - owned)); };
    const double unseen = std::max(mixed(ratio), mixed(shot)) * row.facing_squares;
    seen += weight * ratio;
    deviation += weight * std::sqrt(std::max(squares, unseen)) / row.facing;
  }
  return {std::abs(seen - shot) / (deviations * deviation + 2 * error + tolerated), -1};
}

ShotCheck::Disagreement ShotCheck::disagreement() const {
  if (rows_.empty() || passes_ == 0 || !(power_ > 0)) {
    return {};
  }
  Disagreement worst = of_power();
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    // 4 / (2 passes) times the sum over directions is A H.
    const double shot =
        scene_.patch(i).area * sum(at(shot_.irradiance, i)) * static_cast<double>(passes_) / 2;
    const double received = at(rows_, i).received;
    if (received == 0 && shot == 0) {
      continue;
    }
    const double ratio = std::max(std::abs(received - shot) / allowed_of(i, received, shot),
                                  surprise_of(i, received, shot));
    if (ratio > worst.ratio) {
      worst = {ratio, i};
    }
  }
  return worst;
}

}  // namespace transillum
