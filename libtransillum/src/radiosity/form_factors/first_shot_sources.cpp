// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Chooses the sources of a first shot (section 5.2): those that are small and bright, or those for
// which it pays.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "base/bit_mixing.h"
#include "radiosity/light_sources.h"
#include "radiosity/norms.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/first_shot.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {
namespace {

double total_power(const std::vector<LightSource>& sources) {
  return std::accumulate(sources.begin(), sources.end(), 0.0,
                         [](double sum, const LightSource& source) { return sum + source.power; });
}

std::vector<PatchId> patches_of(const std::vector<LightSource>& sources, auto is_chosen) {
  std::vector<PatchId> patches;
  for (const LightSource& source : sources) {
    if (is_chosen(source)) {
      patches.insert(patches.end(), source.patches.begin(), source.patches.end());
    }
  }
  std::sort(patches.begin(), patches.end());
  return patches;
}

/// Estimates what the shot of a source costs and saves, in passes.
///
/// What it saves: along a direction, light from the source falls on its shadow on all surfaces. To
/// meet a patch as often as the light of all surfaces together does, which is what remains to the
/// passes, they would have to be as many times more as the source is smaller; less so for a source
/// of little of the light. Errors fall as M^(-3/4) (section 4 of the paper: jumps), so the fraction
/// counts to the power 4/3.
///
/// What it costs: the mean over some pairs of patches, by counting.
class ShotBalance {
 public:
  ShotBalance(const Scene& scene, const std::vector<LightSource>& sources, int directions,
              Basis basis, const Cancellation& cancellation)
      : scene_(scene),
        cancellation_(cancellation),
        unit_(basis == Basis::linear ? linear_unit : constant_unit),
        directions_(directions),
        power_(total_power(sources)),
        area_(total_area(scene)) {}

  bool pays(const LightSource& source) {
    const double saved = saved_passes(source);
    return saved > 0 && cost(source, saved) < saved;
  }

 private:
  /// Microseconds on one core, so that costs of pairs and passes compare. Only their ratios count.
  struct Units {
    double pass;     ///< a pass, by patch
    double pair;     ///< a pair without blockers
    double blocker;  ///< one blocker seen from one point
  };
  static constexpr Units constant_unit{1.2, 4, 0.4}, linear_unit{2.2, 18, 0.8};
  static constexpr int sampled_pairs = 48;

  double saved_passes(const LightSource& source) const {
    const double patch = std::sqrt(area_ / scene_.patch_count());
    const double met = std::pow(std::sqrt(source.area) + patch, 2) / area_;
    const double fraction = std::pow(source.power / power_, 4.0 / 3);
    return directions_ * (fraction / (3 * met) - 1);
  }

  /// In passes; stops counting above `limit`.
  double cost(const LightSource& source, double limit) {
    const double pairs = static_cast<double>(source.patches.size()) * scene_.patch_count();
    const double pass = unit_.pass * scene_.patch_count();
    const auto allowed = static_cast<std::int64_t>(
        std::min(1e6, limit * pass / pairs / unit_.blocker * sampled_pairs));
    const std::int64_t blockers = blockers_of_sample(source, allowed);
    return pairs * (unit_.pair + unit_.blocker * static_cast<double>(blockers) / sampled_pairs) /
           pass;
  }

  /// Blockers times points of sampled pairs; stops above `allowed`.
  std::int64_t blockers_of_sample(const LightSource& source, std::int64_t allowed) {
    if (!exchange_) {
      exchange_.emplace(scene_, cancellation_);
    }
    struct Enough {};
    std::int64_t count = 0;
    const auto tick = [&] {
      cancellation_.throw_if_canceled();
      if (++count > allowed) {
        throw Enough{};
      }
    };
    try {
      for (std::uint64_t k = 0; k < sampled_pairs; ++k) {
        const std::uint64_t random = mixed((k + 1) * golden_step);
        const auto i =
            static_cast<PatchId>(random % static_cast<std::uint64_t>(scene_.patch_count()));
        const PatchId j = source.patches[(random >> 32) % source.patches.size()];
        if (i != j) {
          (*exchange_)(i, j, tick);
        }
      }
    } catch (const Enough&) {
    }
    return count;
  }

  const Scene& scene_;
  Cancellation cancellation_;
  Units unit_;
  double directions_;
  double power_;
  double area_;
  std::optional<ExchangeFinder> exchange_;  ///< made for the first source that may pay
};

}  // namespace

std::optional<double> first_shot_from_name(const std::string& name) {
  if (name == "none") {
    return {};
  }
  if (name == "auto") {
    return first_shot_where_it_pays;
  }
  double ratio = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), ratio);
  if (error != std::errc() || end != name.data() + name.size() || !(ratio >= 0) ||
      !std::isfinite(ratio)) {
    throw InputError(
        fmt::format("first shot: \"{}\" is not none, auto or a number of at least 0", name));
  }
  return ratio;
}

std::string name_of_first_shot(const std::optional<double>& threshold) {
  if (!threshold) {
    return "none";
  }
  return *threshold == first_shot_where_it_pays ? "auto" : fmt::format("{}", *threshold);
}

std::vector<PatchId> find_small_sources(const Scene& scene, double ratio) {
  constexpr double min_fraction = 1e-4;
  const std::vector<LightSource> sources = light_sources(scene);
  const double least = min_fraction * total_power(sources);
  const double square = scene.bounds().diagonal() * scene.bounds().diagonal();
  return patches_of(sources, [&](const LightSource& source) {
    return square >= ratio * source.area && source.power >= least;
  });
}

std::vector<PatchId> first_shot_sources(const Scene& scene, double threshold, int directions,
                                        Basis basis, const Cancellation& cancellation) {
  if (threshold != first_shot_where_it_pays) {
    return find_small_sources(scene, threshold);
  }
  const std::vector<LightSource> sources = light_sources(scene);
  if (sources.empty()) {
    return {};
  }
  ShotBalance balance(scene, sources, directions, basis, cancellation);
  return patches_of(sources, [&](const LightSource& source) { return balance.pays(source); });
}

}  // namespace transillum
