// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "radiosity/exchange/exchange_sums.h"
#include "radiosity/exchange/owned_patches.h"
#include "radiosity/exchange/unknowns.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"
#include "transillum/transfers.h"

namespace transillum {

/// Kept sums whose total is meant.
using KeptSums = std::vector<const ExchangeSums*>;

/// B and H of one set of directions, iteration by iteration (eq. 11): of all passes, or of one
/// replica's passes. Areas as in VisibleAreaSums. All lists and indices refer to unknowns,
/// which are patches but with a linear basis.
class RadiosityIterate {
 public:
  /// Keeps a reference to `unknowns`. The light of the first shot is added to H, and the exitance
  /// that it covers is not gathered again:
  ///   B_i = E_i + rho_i (H_i of the shot + H_i of sky and sun + sum_j F_ij (B_j - E_j shot)).
  /// @param share passes are gathered for its patches; after them complete() must be called
  RadiosityIterate(const Unknowns& unknowns, const SolveOptions& options,
                   const OwnedPatches& owned);

  /// Memory that an iterate takes, with its mean over iterations.
  static constexpr std::uint64_t bytes_per_unknown = 8 * sizeof(Rgb);

  const std::vector<Rgb>& b() const { return b_; }  ///< B of the last finished iteration, W/m²
  const std::vector<Rgb>& h() const { return h_; }  ///< irradiance, W/m²: B = E + rho H
  /// sum_d sum_j A(i,j,omega_d) (B_j - E_j shot) of the iteration under way, W
  const std::vector<Rgb>& gathered() const { return gathered_; }
  int passes() const { return passes_; }  ///< passes of the iteration under way

  /// Sets B to what follows if every patch gathers the irradiance `gathered`, in addition to the
  /// irradiance of the first shot and the sun, W/m².
  void start_from(const Rgb& gathered);
  /// Sets B to the B of `other`.
  void start_from(const RadiosityIterate& other);
  /// Begins an iteration with nothing gathered.
  void begin();
  /// Begins an iteration with what the passes of `sums` gather; nothing before keep().
  void begin(const KeptSums& sums);
  /// Gathers along the directions of one pass.
  /// @param transfers their coverages are those of the share's patches
  void add(const Transfers& transfers);
  /// Completes what passes have gathered. Before it only the values of the share's own
  /// patches are right.
  void complete();
  /// From now on `sums`, finished and of the same directions, stand for the passes so far. For the
  /// symmetric normalization it computes the scales and gathers again with them.
  void keep(const KeptSums& sums);

  /// B of the iteration under way, estimated from the passes so far, W/m².
  Rgb estimate(std::size_t u) const;
  /// The factor from entry (u, v) of kept sums to F, before scale_moments().
  /// @param projected, passes of the kept sums, as in VisibleAreaSums
  double form_factor_scale(std::size_t u, std::size_t v, double projected, int passes) const;
  /// Scales the moments of a pair, T^ab times form_factor_scale(), if the normalization is
  /// symmetric.
  void scale_moments(PatchId i, PatchId j, TransferMoments& moments) const;
  /// Whether scale_moments() changes them.
  bool has_scaled_moments() const { return !scales_.empty() && unknowns_.per_patch > 1; }
  /// sum_j F_ij.
  /// @param row_areas, projected, passes of the kept sums, as in VisibleAreaSums
  double form_factor_sum(std::size_t u, double row_areas, double projected, int passes) const;
  /// The share of what leaves the patch of u that escapes.
  /// @param uncovered, projected, passes as in VisibleAreaSums
  double sky_fraction(std::size_t u, double uncovered, double projected, int passes) const;
  /// Irradiance of u from the sky in the passes so far, and from the sun, W/m².
  Rgb sky_irradiance(std::size_t u) const;
  /// Power sent by the part of B that is gathered, in the unit of gathered().
  /// @param column_areas as in VisibleAreaSums, unscaled
  Rgb sent(const std::vector<double>& column_areas) const;
  /// Ends the iteration: computes H and B from gathered(). Returns the changes of B, W/m².
  std::vector<Rgb> finish();
  /// Sets B to the limit of the iteration, by conjugate gradients on the symmetric form.
  /// @param tolerance of the residual, relative
  /// @throws Canceled, NotConvergent
  void set_to_limit(const KeptSums& sums, double tolerance, const Cancellation& cancellation);

  /// For StateOutput and StateInput.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    const std::size_t unknowns = self.b_.size();
    archive.fixed(self.b_, self.h_, self.unshot_, self.gathered_, self.projected_, self.sky_areas_);
    archive.empty_or(unknowns, self.kept_projected_, self.scales_, self.row_sums_);
    archive.empty_or(self.sky_areas_.size(), self.kept_sky_areas_);
    archive(self.passes_, self.kept_passes_);
    archive.require(self.passes_ >= 0 && self.kept_passes_ >= 0 &&
                    self.row_sums_.size() == self.scales_.size());
    archive.require(self.kept_passes_ == 0 ||
                    (self.kept_projected_.size() == unknowns &&
                     self.kept_sky_areas_.size() == self.sky_areas_.size()));
  }

 private:
  /// H from what is gathered, the sky included, and B from H.
  Rgb irradiance(std::size_t u, const Rgb& gathered) const;
  /// Irradiance of u from the sky without the sun in the passes so far, W/m².
  Rgb gathered_sky(std::size_t u) const;
  /// Irradiance of u from patches and sky, without the sun, W/m².
  Rgb gathered_irradiance(std::size_t u) const;
  Rgb radiosity(std::size_t u, const Rgb& irradiance) const;
  void set_radiosity(std::size_t u, const Rgb& b);
  void gather(const KeptSums& sums);
  /// image += S values, where S is the total of `sums`, a symmetric matrix.
  void add_symmetric_product(const KeptSums& sums, const std::vector<double>& values,
                             std::vector<double>& image) const;
  void find_scales(const KeptSums& sums);
  double row_scale(std::size_t i, double projected, int passes) const;
  /// The factor from uncovered area in `passes` passes to a share of the hemisphere.
  double sky_scale(std::size_t i, double projected, int passes) const;
  /// Adds what one of the directions of a pass leaves uncovered.
  /// @param moments empty if each patch has one unknown
  void add_sky(const Vec3& omega, const std::vector<Coverage>& coverages,
               const std::vector<CoverageMoments>& moments);
  double row_scale(std::size_t i) const { return row_scale(i, projected_[i], passes_); }

  const Unknowns& unknowns_;
  OwnedPatches owned_;
  bool two_way_;
  Normalization normalization_;
  Sky sky_;
  std::vector<Rgb> b_, h_;
  std::vector<Rgb> unshot_;        ///< B - E shot: what passes gather
  std::vector<Rgb> gathered_;      ///< sum_d sum_j A(i,j,omega_d) unshot_j, scaled if symmetric
  std::vector<double> projected_;  ///< sum_d A_i max(n_i·omega_d, 0)
  std::vector<double> sky_areas_;  ///< uncovered area times relative radiance; empty without a sky
  int passes_ = 0;
  std::vector<double> kept_projected_, kept_sky_areas_;
  int kept_passes_ = 0;
  std::vector<double> scales_;    ///< scales of rows and columns (symmetric_scales.h), if symmetric
  std::vector<double> row_sums_;  ///< row sums of the kept sums, scaled; if symmetric
};

}  // namespace transillum
