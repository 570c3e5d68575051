// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/exchange/exchange_sums.h"
#include "radiosity/exchange/visible_area_sums.h"
#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/solver_input.h"
#include "transillum/form_factors.h"

namespace transillum {

/// The exchanges of all passes, summed and kept within the memory limit, so that later iterations
/// need no passes: one ExchangeSums per replica, or one. Their rows and sources are unknowns: with
/// n per patch, an exchange of two patches has n² entries.
class KeptExchanges {
 public:
  /// @param renews whether each iteration has its own directions; exchanges are then kept only
  /// after request().
  KeptExchanges(const SolverInput& input, bool renews);

  /// Keeps the exchanges from the next pass on, also where each iteration has its own directions.
  void request() { requested_ = true; }
  /// Whether exchanges are to be kept, if the memory limit allows.
  bool requested() const { return !renews_ || requested_; }
  /// Whether they are requested and have fitted into the memory limit so far.
  bool available() const;
  /// @throws MemoryLimitExceeded where the normalization or scheme requires them and they are not
  /// available.
  void check_available() const;

  /// The exchanges of a pass in the order that add() takes. Any thread may call it at any time.
  ExchangeSums::Sorted sort(const Transfers& transfers) const;
  /// Adds a pass of replica r. Where it exceeds the limit, everything is dropped.
  /// @throws MemoryLimitExceeded as check_available(), unless other processes have to know first
  void add(std::size_t r, ExchangeSums::Sorted sorted);
  /// Appends sums for one replica, which have the memory that the others leave. After finish().
  void add_replica();
  /// Adds the areas of a pass to renewed_areas(), if each iteration has its own directions and the
  /// exchanges are requested.
  void add_areas(const Transfers& transfers);
  /// Drops everything.
  void drop();
  /// To be called before saving.
  void prepare_to_save();
  /// Completes renewed_areas() and size().
  void complete();
  /// To be called after the last pass of an iteration, before sums are read.
  void finish();

  /// The sums of all replicas.
  KeptSums all() const;
  KeptSums of_replica(std::size_t r) const { return {&sums_[r]}; }
  /// Number of kept entries; of other shares as of the last complete() or finish().
  std::int64_t size() const { return static_cast<std::int64_t>(own_size()) + kept_elsewhere_; }
  /// Areas of the passes kept, over all iterations, where each has its own directions.
  const VisibleAreaSums& renewed_areas() const { return renewed_areas_; }

  /// F_ij = entry (i,j) times the scale that `iterate` gives it. After finish().
  /// Where several processes solve, the first gets all form factors, the others none.
  /// @param areas of the passes kept
  FormFactors form_factors(const RadiosityIterate& iterate, const VisibleAreaSums& areas) const;

  /// For StateOutput and StateInput; the number of replicas must be the same.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive(self.requested_);
    for (auto& part : self.sums_) {
      archive(part);
    }
    archive(self.renewed_areas_);
  }

 private:
  ExchangeSums empty_sums(std::uint64_t memory) const;
  std::size_t own_size() const;
  /// Computes what size() counts besides own_size().
  void count();
  /// Sets FormFactors::moments from the entries of unknowns.
  void add_moments(const ExchangeSums& sums, const RadiosityIterate& iterate,
                   const VisibleAreaSums& areas, FormFactors& result) const;
  /// The sum over all replicas; in a group, on member 0, over all members.
  ExchangeSums joined() const;

  PatchId patches_;
  std::size_t per_patch_;  ///< unknowns
  bool two_way_;
  OwnedPatches owned_, owned_unknowns_;
  std::int64_t kept_elsewhere_ = 0;  ///< entries of other shares less those also kept here
  bool renews_;
  bool requested_ = false;
  const char* required_by_ = nullptr;  ///< the option that cannot do without; null if there is none
  Cancellation cancellation_;
  std::uint64_t memory_;            ///< limit, bytes
  std::vector<ExchangeSums> sums_;  ///< one per replica
  VisibleAreaSums renewed_areas_;
};

}  // namespace transillum
