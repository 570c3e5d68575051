// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/kept.h"
#include "pictures/gathered_light.h"
#include "pictures/lamp_light.h"
#include "pictures/plane_points.h"
#include "transillum/picture.h"

namespace transillum {

/// Gathered light, interpolated between points of a patch: bilinearly in quadrilaterals, which are
/// divided where what their middle gathers differs from the mean of their corners, or points around
/// it do. Where that does not help, the point itself gathers.
///
/// Threads: any number may query; a value does not depend on the order of queries.
class InterpolatedLight {
 public:
  /// Keeps references to all.
  InterpolatedLight(const Scene& scene, const PlanePoints& points, const GatheredLight& gathered,
                    const LampLight& lamps);
  ~InterpolatedLight();
  InterpolatedLight(const InterpolatedLight&) = delete;
  InterpolatedLight& operator=(const InterpolatedLight&) = delete;

  /// Irradiance by what is not a lamp, W/m².
  /// @throws Canceled
  Rgb at_point(PatchId patch, const Vec3& x, const Interpolation& precision,
               const Cancellation& cancellation) const;

 private:
  struct Cell;
  struct Check;
  struct PatchCells;
  struct Quad;
  std::unique_ptr<const PatchCells> cells_of(PatchId patch) const;
  const GatheredLight::Gathered& light_of(std::int32_t n, const Cancellation& cancellation) const;
  GatheredLight::Gathered light_inside(const PatchCells& cells, const Vec3& x,
                                       const Cancellation& cancellation) const;
  std::unique_ptr<const Cell> root_of(const PatchCells& cells, const Quad& quad,
                                      const Cancellation& cancellation) const;
  double difference_at_quarters(const PatchCells& cells, const std::array<Vec3, 4>& corners,
                                const Cell& cell, const Cancellation& cancellation) const;
  std::unique_ptr<const Check> check_of(const PatchCells& cells, const std::array<Vec3, 4>& corners,
                                        const Cell& cell, const Cancellation& cancellation) const;
  std::unique_ptr<const std::array<Cell, 4>> parts_of(const PatchCells& cells,
                                                      const std::array<Vec3, 4>& corners,
                                                      const Cell& cell, const Check& check,
                                                      const Cancellation& cancellation) const;

  const Scene& scene_;
  const PlanePoints& points_;
  const GatheredLight& gathered_;
  const LampLight& lamps_;
  double diagonal_;
  std::vector<Kept<GatheredLight::Gathered>> light_;  ///< by PlanePoint
  std::vector<Kept<PatchCells>> cells_;               ///< by patch
};

}  // namespace transillum
