// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "radiosity/error/surfaces.h"
#include "transillum/solution.h"

namespace transillum {

/// Fraction of runs in which the limits of errors hold.
inline constexpr double error_confidence = 0.95;

/// RMS of a quantity over the patches of each surface, per channel. One value per unknown.
std::vector<Rgb> rms_by_surface(const Surfaces& surfaces, const std::vector<Rgb>& values);

/// How far some values are off from `values`, known exactly, by surface: the RMS of the differences
/// as `rms` and `limit`. Lists have one value per unknown.
/// @param values the quantity that is measured, W/m²
SurfaceErrors surface_differences(const Surfaces& surfaces, const std::vector<Rgb>& values,
                                  const std::vector<Rgb>& differences);

/// The errors by surface of the mean of replicas. Lists have one value per unknown.
/// @param values the quantity that is measured, W/m²
/// @param replicas the same of each, at least two
SurfaceErrors surface_errors(const Surfaces& surfaces, const std::vector<Rgb>& values,
                             const std::vector<std::vector<Rgb>>& replicas);

/// Adds to the errors what else the values may be off by, as the root of the sum of squares.
/// @param bias W/m², one value per unknown or per patch
void include_bias(SurfaceErrors& errors, const Surfaces& surfaces, const std::vector<Rgb>& bias);

/// The relative error that none of some surfaces exceeds in 95 % of all runs. As errors of surfaces
/// have the same directions, they are not independent: the probabilities that each exceeds it are
/// added up, so that it is not too small.
/// @param names the surfaces; if empty, all
double limit_of_all(const SurfaceErrors& errors, const std::vector<std::string>& names);

/// Scalar products of the deviations of replicas from their mean.
using DeviationProducts = std::vector<std::vector<double>>;

/// The same of each channel, over some patches.
class ChannelProducts {
 public:
  explicit ChannelProducts(std::size_t replicas);
  /// Adds the deviations of one value, by replica.
  void add(const std::vector<Rgb>& deviations);
  /// @param channel a member of Rgb
  DeviationProducts of(double Rgb::*channel) const;
  /// Sum of the squares of all deviations.
  Rgb squares() const;

 private:
  std::size_t replicas_;
  std::vector<Rgb> products_;  ///< replicas r and q <= r, at r (r + 1) / 2 + q
};

/// (trace C)² / trace C², where C is the covariance of the replicas over patches: the number of
/// equal independent errors whose sum of squares varies as that sum of all. Both traces are
/// estimated without bias from differences of disjoint pairs of replicas; 1 for fewer than 4. The
/// ratio of so few is uncertain, so it is taken rather too small: at most as many as there are
/// replicas (decisions/0052-accuracy.md).
double independent_errors(const DeviationProducts& products);

}  // namespace transillum
