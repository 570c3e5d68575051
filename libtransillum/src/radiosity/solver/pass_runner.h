// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

#include "radiosity/solver/exchange_sums.h"
#include "transillum/transfers.h"

namespace transillum {

/// What a worker makes of one direction.
struct Pass {
  Transfers transfers;
  ExchangeSums::Run run;  ///< where the pass is to be kept
  ClosureDefect closure;
};

/// Makes passes on several threads and hands them over in their order.
class PassRunner {
 public:
  /// @param threads >= 1; more than the machine has are used as well.
  explicit PassRunner(int threads) : threads_(threads) {}

  /// Makes passes `first` to `last` - 1. `make` is called on any thread, and must not read what
  /// `absorb` writes; `absorb` gets them in order, on one thread at a time, and returns false to
  /// ask for no more: those under way, two a thread at most, still come.
  /// An exception of either is thrown here, after what came before it was absorbed.
  void run(int first, int last, const std::function<Pass(int)>& make,
           const std::function<bool(int, Pass)>& absorb) const;

 private:
  int threads_;
};

}  // namespace transillum
