// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/exchange/owned_patches.h"
#include "transillum/first_shot.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum {

/// Counts the directions that bring a patch the light of a source (SolveStatistics::
/// light_directions). Where there are very many sources, several count as one, with the mean of
/// their colors.
class LightDirections {
 public:
  /// @param shot its sources do not count
  /// @param reflectance of each patch
  LightDirections(const Scene& scene, bool two_way, const DirectLight& shot,
                  const std::vector<Rgb>& reflectance);

  /// Adds a pass along a direction that is new.
  void add(const std::vector<Transfer>& exchanges);
  /// Completes the sums of all patches; to be called before mean().
  void complete(const OwnedPatches& owned);
  /// With n = (sum c)² / sum c² directions per pair of patch and source, the mean of n, each
  /// weighted by what the pair contributes to the variance of B, in the channel with the fewest. 0
  /// without light.
  double mean() const;

  /// For StateOutput and StateInput, between two passes.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    for (auto& light : self.lights_) {
      archive(light.sum, light.squares);
    }
  }

 private:
  /// Light from one source on one patch.
  struct Light {
    double sum = 0, squares = 0;  ///< over directions
    double along = 0;             ///< along the direction being added; else 0
  };
  void receive(PatchId receiver, PatchId source, double area);

  double mean_of(double Rgb::*channel) const;

  bool two_way_;
  std::size_t columns_ = 1;
  std::vector<Rgb> weight_;          ///< per patch: (rho / A)², 0 where errors are not measured
  std::vector<Rgb> color_;           ///< per column: channels of its light, over their mean
  std::vector<double> exitance_;     ///< per patch: sum of channels, less that of the shot
  std::vector<std::uint8_t> emits_;  ///< per patch: whether exitance_ is above 0; in few bytes
  std::vector<std::size_t> column_;  ///< per patch: of its source
  std::vector<Light> lights_;        ///< by patch, then column
  std::vector<std::size_t> lit_;     ///< pairs that the pass being added has met
};

}  // namespace transillum
