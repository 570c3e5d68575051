// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/transfer_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace transillum::testing {
namespace {

/// Uncertainty of a patch's area due to the rounding of its coordinates, m²: an edge's position is
/// known to the last bit of the scene's extent. Only for needles narrower than 1e-9 of the scene; 0
/// for all other patches.
double rounding(const Scene& scene, PatchId i) {
  double perimeter = 0;
  const auto outline = scene.outline(i);
  for (std::size_t k = 0; k < outline.size(); ++k) {
    perimeter += norm(scene.point(outline[(k + 1) % outline.size()]) - scene.point(outline[k]));
  }
  const double extent = scene.bounds().diagonal();
  return scene.patch(i).area < 1e-9 * perimeter * extent ? 0x1p-53 * perimeter * extent : 0;
}

/// Replaces `worst` if the difference of a and b, over `area`, is larger.
void update(TransferDifference& worst, double a, double b, double area, double rounding,
            const std::string& what) {
  const double found = std::max(std::abs(a - b) - rounding, 0.0) / area;
  // Also true for NaN.
  if (!(found <= worst.fraction)) {
    worst = {found, fmt::format("{}: {} and {}", what, a, b)};
  }
}

}  // namespace

TransferDifference difference(const Scene& scene, const Transfers& a, const Transfers& b) {
  TransferDifference worst;
  std::map<std::pair<PatchId, PatchId>, std::array<double, 2>> exchanges;
  for (const Transfer& t : a.exchanges) {
    exchanges[{t.receiver, t.source}][0] += t.area;
  }
  for (const Transfer& t : b.exchanges) {
    exchanges[{t.receiver, t.source}][1] += t.area;
  }
  for (const auto& [pair, areas] : exchanges) {
    const auto [i, j] = pair;
    const PatchId smaller = scene.patch(i).area < scene.patch(j).area ? i : j;
    update(worst, areas[0], areas[1], scene.patch(smaller).area, rounding(scene, smaller),
           fmt::format("A({},{})", i, j));
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto compare = [&](double in_a, double in_b, const char* what) {
      update(worst, in_a, in_b, scene.patch(i).area, rounding(scene, i),
             fmt::format("{}, {}", what, i));
    };
    compare(a.forward[k].projected, b.forward[k].projected, "projected for omega");
    compare(a.forward[k].covered, b.forward[k].covered, "covered for omega");
    compare(a.backward[k].projected, b.backward[k].projected, "projected for -omega");
    compare(a.backward[k].covered, b.backward[k].covered, "covered for -omega");
    compare(a.back_seen[k], b.back_seen[k], "back_seen");
  }
  return worst;
}

TransferDifference difference_from_both_ends(const Scene& scene, const Transfers& there,
                                             const Transfers& back) {
  Transfers reversed = back;
  for (Transfer& t : reversed.exchanges) {
    std::swap(t.receiver, t.source);
  }
  std::swap(reversed.forward, reversed.backward);
  return difference(scene, there, reversed);
}

PairMoments moments_of(const Transfers& transfers) {
  PairMoments moments;
  for (std::size_t k = 0; k < transfers.exchanges.size(); ++k) {
    const Transfer& t = transfers.exchanges[k];
    moments[{t.receiver, t.source}] = transfers.moments[k];
  }
  return moments;
}

double largest_difference(const Scene& scene, const PairMoments& one, const PairMoments& other) {
  double largest = 0;
  const auto compare = [&](const PairMoments& a, const PairMoments& b) {
    for (const auto& [pair, moments] : a) {
      const auto found = b.find(pair);
      const TransferMoments of_b = found != b.end() ? found->second : TransferMoments{};
      const double area = std::min(scene.patch(pair.first).area, scene.patch(pair.second).area);
      for (std::size_t k = 0; k < moments.value.size(); ++k) {
        largest = std::max(largest, std::abs(moments.value[k] - of_b.value[k]) / area);
      }
    }
  };
  compare(one, other);
  compare(other, one);
  return largest;
}

}  // namespace transillum::testing
