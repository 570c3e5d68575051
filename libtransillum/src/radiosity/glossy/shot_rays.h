// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_threads.h"
#include "transillum/cancellation.h"
#include "transillum/first_shot.h"
#include "transillum/scene.h"
#include "transillum/sun.h"

namespace transillum {

/// Light of a first shot, or of the sun, that comes to a patch from one direction.
struct ShotRay {
  Vec3 direction;             ///< unit, from the patch toward the source
  PatchId source = no_patch;  ///< an emitting patch; the number of patches for the sun
  double irradiance = 0;      ///< H of the patch for an exitance, or irradiance of the sun, of 1
};

/// The light of a first shot and of the sun at patches with lobes, by the directions from which it
/// comes. They do not depend on materials.
///
/// A pair of patches near each other has many directions, between parts of both that are small
/// compared with their distance. The parts share the exact form factor of the pair in proportion to
/// their own without blockers: what is between the patches changes how much light comes, but not
/// from where within the pair.
class ShotRays {
 public:
  /// @param pairs of `receivers`: DirectLight::pairs
  /// @param receivers ascending
  /// @throws Canceled
  ShotRays(const Scene& scene, const std::vector<DirectLight::Pair>& pairs,
           const std::vector<PatchId>& receivers, WorkerThreads& workers,
           const Cancellation& cancellation);
  /// Adds a ray from the middle of the sun to each receiver that it lights.
  /// @param receivers of the constructor
  /// @param irradiance by the sun, by patch
  void add_sun(const Scene& scene, const std::vector<PatchId>& receivers, const Sun& sun,
               const std::vector<Rgb>& irradiance);

  /// The rays to receiver number g.
  std::span<const ShotRay> of(std::size_t g) const { return rays_[g]; }
  std::uint64_t bytes() const;

 private:
  std::vector<std::vector<ShotRay>> rays_;
};

}  // namespace transillum
