// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "radiosity/solver/exchange_sums.h"
#include "transillum/first_shot.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum {

/// Lists of sums that are to be added up.
using KeptSums = std::vector<const ExchangeSums*>;

/// The radiosity that one set of directions makes, step by step (eq. 11): that of all passes, or
/// that of one replica's.
class RadiosityIterate {
 public:
  /// Keeps references. `shot`: light that goes on top, and what of B then need not be gathered,
  ///   B_i = E_i + rho_i (H_i of the shot + sum_j F_ij (B_j - E_j shot)).
  RadiosityIterate(const Scene& scene, const SolveOptions& options, const DirectLight& shot);

  const std::vector<Rgb>& b() const { return b_; }  ///< of the last finished step, W/m²
  const std::vector<Rgb>& h() const { return h_; }  ///< the irradiance that made it
  const std::vector<Rgb>& gathered() const { return gathered_; }
  int passes() const { return passes_; }  ///< that the step under way rests on

  /// Begins a step with nothing gathered.
  void begin();
  /// Begins a step with what the passes gather that `sums` were kept of.
  void begin(const KeptSums& sums);
  /// Gathers along one direction.
  void add(const Transfers& transfers);
  /// From now on `sums` stand for the passes so far: of the same directions, finished. Finds the
  /// scales of a symmetric normalization, and gathers anew with them.
  void keep(const KeptSums& sums);

  /// B of the step under way, from the passes so far.
  Rgb estimate(PatchId i) const;
  /// What turns an entry (i, j) of kept sums into F_ij, given how many passes they are of and what
  /// those have seen of i.
  double form_factor_scale(PatchId i, PatchId j, double projected, int passes) const;
  /// sum_j F_ij, given the same, and the sum of the row's entries unscaled.
  double form_factor_sum(PatchId i, double row_areas, double projected, int passes) const;
  /// Power sent by what is gathered of B, in the units of gathered(), given the unscaled sums of
  /// columns' areas.
  Rgb sent(const std::vector<double>& column_areas) const;
  /// Ends the step: h and b are what was gathered. Returns the largest change of B.
  double finish();
  /// Goes on from B as it would be after infinitely many steps, by conjugate gradients.
  /// @throws Canceled, std::runtime_error where B grows without bound
  void leap(const KeptSums& sums, double tolerance, const Cancellation& cancellation);

 private:
  /// H and B of a patch, given what directions bring.
  Rgb irradiance(PatchId i, const Rgb& brought) const;
  Rgb radiosity(PatchId i, const Rgb& irradiance) const;
  void set_radiosity(PatchId i, const Rgb& b);
  void gather(const KeptSums& sums);
  void find_scales(const KeptSums& sums);
  double row_scale(std::size_t i, double projected, int passes) const;
  double row_scale(std::size_t i) const { return row_scale(i, projected_[i], passes_); }

  const Scene& scene_;
  const DirectLight& shot_;
  bool two_way_;
  Normalization normalization_;
  std::vector<Rgb> b_, h_;
  std::vector<Rgb> unshot_;        ///< b less what was shot: what directions carry
  std::vector<Rgb> gathered_;      ///< sum_d sum_j A(i,j,omega_d) unshot_j, scaled where symmetric
  std::vector<double> projected_;  ///< sum_d A_i max(n_i·omega_d, 0)
  int passes_ = 0;
  std::vector<double> kept_projected_;
  int kept_passes_ = 0;
  std::vector<double> scales_;    ///< of rows and columns, where symmetric; else empty
  std::vector<double> row_sums_;  ///< of the kept sums, scaled; where symmetric
};

}  // namespace transillum
