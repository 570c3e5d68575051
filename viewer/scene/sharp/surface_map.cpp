// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/sharp/surface_map.h"

#include <QCoreApplication>
#include <cmath>

#include "model/snapshot_values.h"

namespace transillum::viewer {

namespace {

// A texel takes about as long as a sample of a pixel, and 12 bytes.
constexpr double fine_texels = 300'000, coarse_texels = 40'000;
// In motion: a difference of a level or two of a screen.
constexpr double tolerance = 0.016;
// Each patch also needs points that gather its reflected light.
constexpr PatchId most_patches = 20'000;

}  // namespace

QString why_no_map(const SolverSnapshot& snapshot) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("SurfaceMap", text); };
  if (snapshot.loaded->scene->patch_count() > most_patches) {
    return tr("While the camera moves, patches are shown: light maps are made for up to %1 patches")
        .arg(most_patches);
  }
  return {};
}

void make_map(const SnapshotLight& light, const Cancellation& cancellation,
              const std::function<void(const SurfaceMap&)>& deliver) {
  double area = 0;
  for (const Patch& patch : light.scene->patches()) {
    area += patch.area;
  }
  LightMap::Options options{.tolerance = tolerance, .threads = light.snapshot->options.threads};
  for (const double texels : {coarse_texels, fine_texels}) {
    options.density = std::sqrt(texels / area);
    deliver({light.snapshot,
             std::make_shared<const LightMap>(*light.scene, light.light, options, cancellation)});
  }
}

}  // namespace transillum::viewer
