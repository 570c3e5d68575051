// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>

#include "radiosity/exchange/exchange_sums.h"
#include "transillum/transfers.h"

namespace transillum {

/// The result of one pass.
struct Pass {
  Transfers transfers;
  ExchangeSums::Run run;  ///< empty unless exchanges are to be kept
  // Figures over all patches, of a pass along a new direction:
  ClosureDefect closure;
  double projected = 0;        ///< projected area, m²
  double covered = 0;          ///< the part of it with a patch above, m²
  std::int64_t exchanges = 0;  ///< number of exchanges
};

/// Makes passes on several threads and delivers them in order.
class PassRunner {
 public:
  /// @param threads >= 1; may exceed the number of cores.
  explicit PassRunner(int threads) : threads_(threads) {}

  /// Makes passes `first` to `last` - 1. `make` is called on any thread and must not read what
  /// `add` writes. `add` receives the passes in order, on one thread at a time, and returns false
  /// to stop: passes under way, at most two per thread, are still added.
  /// An exception of either is rethrown here, after the passes before it have been added.
  void run(int first, int last, const std::function<Pass(int)>& make,
           const std::function<bool(int, Pass)>& add) const;

 private:
  int threads_;
};

}  // namespace transillum
