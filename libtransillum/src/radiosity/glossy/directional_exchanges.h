// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/exchange/exchange_sums.h"
#include "transillum/cancellation.h"
#include "transillum/transfers.h"

namespace transillum {

/// The exchanges of all passes, kept within the memory limit: those of glossy patches pass by pass,
/// those between diffuse ones, which need no directions, as sums over the passes of each replica.
class DirectionalExchanges {
 public:
  /// A pass, prepared.
  struct Sorted {
    std::vector<Transfer> directional;
    ExchangeSums::Sorted diffuse;
  };

  /// @param glossy by patch
  /// @param budget limit, bytes
  DirectionalExchanges(std::vector<char> glossy, std::size_t passes, std::size_t replicas,
                       std::uint64_t budget, const Cancellation& cancellation);

  /// Splits the exchanges of a pass. Any thread may call it at any time.
  Sorted sort(const Transfers& transfers) const;
  /// Adds a pass of a replica; drops everything where that exceeds the limit. In the order of the
  /// passes.
  void add(std::size_t pass, std::size_t replica, Sorted sorted);
  /// To be called after the last pass.
  void finish();

  /// Whether all passes added so far are kept.
  bool available() const { return !dropped_; }
  /// The exchanges of a pass in which a glossy patch takes part.
  const std::vector<Transfer>& of_pass(int pass) const { return passes_[std::size_t(pass)]; }
  /// gathered_i += sum over diffuse patches j of entry_ij b_j, for diffuse patches i, entries being
  /// the sums of a replica. After finish().
  void gather_diffuse(std::size_t replica, const std::vector<Rgb>& b,
                      std::vector<Rgb>& gathered) const {
    sums_[replica].gather(b, gathered);
  }
  /// Number of exchanges and sums kept, and their memory.
  std::int64_t size() const;
  std::uint64_t bytes() const { return static_cast<std::uint64_t>(size()) * sizeof(Transfer); }

 private:
  void drop();

  std::vector<char> glossy_;
  std::uint64_t budget_;
  bool dropped_ = false;
  std::vector<std::vector<Transfer>> passes_;
  std::int64_t directional_ = 0;    ///< exchanges in passes_
  std::vector<ExchangeSums> sums_;  ///< by replica
};

}  // namespace transillum
