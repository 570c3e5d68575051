// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/transfers/transfer_comparison.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "transillum/at.h"

namespace transillum {

TransferComparison compare(const Transfers& first, const Transfers& other) {
  TransferComparison comparison;
  comparison.differences.resize(first.forward.size());
  double sum = 0;
  const auto add = [&](const Transfer& pair, double of_first, double of_other) {
    const double difference = of_first - of_other;
    if (difference == 0) {
      return;
    }
    comparison.pairs.push_back({pair.receiver, pair.source, of_first, of_other});
    sum += std::abs(difference);
    at(comparison.differences, pair.receiver) += std::abs(difference);
    at(comparison.differences, pair.source) += std::abs(difference);
    if (std::abs(difference) > std::abs(comparison.largest.area)) {
      comparison.largest = {pair.receiver, pair.source, difference};
    }
  };
  // Both are sorted by receiver, then source.
  const auto before = [](const Transfer& a, const Transfer& b) {
    return std::tie(a.receiver, a.source) < std::tie(b.receiver, b.source);
  };
  auto a = first.exchanges.begin(), b = other.exchanges.begin();
  while (a != first.exchanges.end() || b != other.exchanges.end()) {
    const bool only_a =
        b == other.exchanges.end() || (a != first.exchanges.end() && before(*a, *b));
    const bool only_b = !only_a && (a == first.exchanges.end() || before(*b, *a));
    if (!only_b) {
      comparison.exchanged += a->area;
    }
    if (!only_a) {
      comparison.other_exchanged += b->area;
    }
    if (only_a) {
      add(*a, a->area, 0);
      ++a;
    } else if (only_b) {
      add(*b, 0, b->area);
      ++b;
    } else {
      add(*a, a->area, b->area);
      ++a;
      ++b;
    }
  }
  std::stable_sort(comparison.pairs.begin(), comparison.pairs.end(),
                   [](const PairDifference& x, const PairDifference& y) {
                     return std::abs(x.first - x.other) > std::abs(y.first - y.other);
                   });
  if (comparison.exchanged > 0) {
    comparison.misplaced = sum / (2 * comparison.exchanged);
  }
  return comparison;
}

}  // namespace transillum
