// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// From this R²/A on a source counts as small: of 2,048 directions fewer than one meets it from a
/// point half a scene away.
inline constexpr double small_source_ratio = 1000;

/// The ratio that a command line names: `auto`, that above; a number from 0; or `none`.
/// @throws InputError naming the choices.
std::optional<double> first_shot_from_name(const std::string& name);

/// The patches of small bright sources, rising (paper, section 5.2). A source is all emitting
/// patches that hang together by common points; it is small where R²/A >= `ratio`, R the scene's
/// diagonal and A the source's area, and bright where it has 1/10,000 of all power emitted.
/// @param ratio >= 0; 0 takes all bright sources.
std::vector<PatchId> find_small_sources(const Scene& scene, double ratio = small_source_ratio);

/// The light that some sources send directly to all patches.
struct DirectLight {
  /// What the sources of one material bring.
  struct Part {
    int material = 0;
    std::vector<double> irradiance;  ///< H for an exitance of 1, one a patch
  };

  std::vector<Rgb> irradiance;   ///< H, W/m², one a patch
  std::vector<Rgb> exitance;     ///< E of the sources, 0 for other patches: what has been shot
  std::vector<PatchId> sources;  ///< rising
  double power_share = 0;        ///< of the sources in all power emitted
  std::vector<Part> parts;       ///< by rising material; none where they would take over 256 MiB
};

/// Shoots the emission of `sources` onto all patches by exact form factors, of whole polygons where
/// nothing stands between, else of points of the smaller polygon with exact shadows. Time grows as
/// sources times patches times what stands between. `progress`, if given, hears the share done, in
/// [0,1], now and then on the calling thread.
/// @param threads 0: all cores; the result does not depend on it.
/// @throws Canceled
DirectLight shoot(const Scene& scene, const std::vector<PatchId>& sources, int threads = 0,
                  const Cancellation& cancellation = {},
                  const std::function<void(double)>& progress = {});

/// The light of the same sources where the scene's materials are others, from the parts of `light`;
/// it has no parts itself.
/// @throws InputError where `light` is of another scene, or its parts have been left out.
DirectLight with_materials(const DirectLight& light, const Scene& scene,
                           const std::vector<Material>& materials);

}  // namespace transillum
