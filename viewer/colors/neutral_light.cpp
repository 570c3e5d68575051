// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/neutral_light.h"

#include <algorithm>
#include <cmath>

#include "colors/color_scale.h"

namespace transillum::viewer {

double neutral_brightness(const Vec3& normal) {
  // The light comes from above in files whose up is z and in files whose up is y. Unit, up to
  // rounding.
  constexpr Vec3 toward_light{0.36, 0.62, 0.7};
  const double half = 0.5 + 0.5 * std::clamp(dot(normal, toward_light), -1.0, 1.0);
  return 0.25 + 0.75 * half * half;
}

void shade_neutral(const SolverSnapshot& snapshot, std::vector<Color8>& colors) {
  constexpr double darkest = 0.15, gamma = 2.2;
  const Scene& scene = *snapshot.loaded->scene;
  colors.resize(scene.patches().size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb& rho = material_of(snapshot, i).reflectance;
    const double brightness = neutral_brightness(scene.patch(i).normal);
    const auto level = [&](double channel) {
      const double value = brightness * (darkest + (1 - darkest) * channel);
      return static_cast<std::uint8_t>(std::lround(255 * std::pow(value, 1 / gamma)));
    };
    at(colors, i) = {level(rho.r), level(rho.g), level(rho.b)};
  }
}

void shade_gray(const SolverSnapshot& snapshot, std::vector<Color8>& colors) {
  ColorScale scale;
  scale.fit_exposure(*snapshot.loaded->scene, snapshot.radiosity);
  scale.color(snapshot.radiosity, colors);
  for (Color8& color : colors) {
    const int brightness = (color[0] + color[1] + color[2]) / 3;
    color.fill(static_cast<std::uint8_t>(0x38 + brightness / 3));
  }
}

}  // namespace transillum::viewer
