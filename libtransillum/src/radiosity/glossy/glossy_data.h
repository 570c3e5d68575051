// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "radiosity/glossy/lobe_tables.h"
#include "transillum/glossy.h"

namespace transillum {

/// Contents of radiance by direction. Arrays by glossy patch and pass have index
/// g · passes + p. The passes of a replica follow one another. Solutions share it: the solver
/// replaces it, and changes none that may be shared.
struct GlossyLight::Data {
  std::shared_ptr<const Scene> scene;
  std::vector<Vec3> directions;        ///< omega of each pass
  std::vector<std::size_t> begin;      ///< first pass of each replica; last the number of all
  std::vector<std::int32_t> index_of;  ///< by patch: which glossy patch it is, or -1
  std::vector<Rgb> fractions;          ///< by glossy patch: k
  /// By replica; empty until they are scaled.
  std::vector<std::shared_ptr<const LobeTables>> lobes;
  /// By replica and patch: radiance without the lobe, W/(m² sr).
  std::vector<std::vector<Rgb>> lambertian;
  std::vector<Rgb> arriving;   ///< by glossy patch and pass: Phi
  std::vector<Rgb> reflected;  ///< by glossy patch and pass: radiance of the lobe
  /// The first shot with the materials in effect; null without one. `lambertian` lacks what its
  /// sources emit.
  std::shared_ptr<const DirectLight> shot;
  /// By glossy patch: the light of the first shot and of the sun; null without either.
  std::shared_ptr<const ShotRays> rays;
  std::vector<Rgb> ray_sources;  ///< by ShotRay::source: exitance, or irradiance by the sun, W/m²
  /// The part of `reflected` that comes from `rays`; null until lobes are scaled.
  std::shared_ptr<const std::vector<Rgb>> direct;

  /// Radiance that a patch emits and that was shot, W/(m² sr).
  Rgb shot_radiance(PatchId i) const;
  std::size_t passes() const { return directions.size(); }
  std::size_t replicas() const { return begin.size() - 1; }
  std::size_t passes_of(std::size_t replica) const { return begin[replica + 1] - begin[replica]; }
  std::size_t replica_of(std::size_t pass) const {
    const auto next = std::upper_bound(begin.begin(), begin.end(), pass);
    return static_cast<std::size_t>(next - begin.begin()) - 1;
  }
};

}  // namespace transillum
