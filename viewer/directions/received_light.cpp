// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "directions/received_light.h"

#include "transillum/at.h"

namespace transillum::viewer {

PerDirectionVisibility::Request visibility_request(const SolverSnapshot& snapshot, int iteration,
                                                   int count, PatchId patch) {
  const SolveOptions& options = snapshot.options;
  return {snapshot.loaded,
          options.engine,
          options.engine_options,
          options.two_way,
          snapshot.directions_of(iteration),
          count,
          patch};
}

std::vector<ReceivedLight> received_light(
    const PerDirectionVisibility::Request& request,
    std::span<const PerDirectionVisibility::VisibleAreas> visible_areas,
    const std::vector<Rgb>& radiosity, int passes) {
  std::vector<ReceivedLight> received;
  const Patch& patch = request.loaded->scene->patch(request.patch);
  const double weight = 4.0 / (passes * (request.two_way ? 2 : 1) * patch.area);
  const auto add = [&](int pass, bool opposite,
                       const std::vector<PerDirectionVisibility::VisibleArea>& areas) {
    const double cosine = dot(patch.normal, at(*request.directions, pass));
    ReceivedLight light;
    light.pass = pass;
    light.opposite = opposite;
    light.cosine = opposite ? -cosine : cosine;
    double largest = 0;
    for (const PerDirectionVisibility::VisibleArea& visible : areas) {
      const Rgb part = weight * visible.area * at(radiosity, visible.source);
      light.area += visible.area;
      light.irradiance += part;
      if (luminance(part) <= largest) {
        continue;
      }
      largest = luminance(part);
      light.brightest = visible.source;
    }
    received.push_back(light);
  };
  for (std::size_t k = 0; k < visible_areas.size(); ++k) {
    add(static_cast<int>(k), false, visible_areas[k].forward);
    if (request.two_way) {
      add(static_cast<int>(k), true, visible_areas[k].backward);
    }
  }
  return received;
}

}  // namespace transillum::viewer
