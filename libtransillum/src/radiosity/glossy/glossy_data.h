// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <vector>

#include "radiosity/glossy/lobe_tables.h"
#include "transillum/glossy.h"

namespace transillum {

/// Contents of radiance by direction. Arrays by glossy patch and pass have index
/// g · passes + p. Solutions share it: the solver replaces it, and changes none that may be shared.
struct GlossyLight::Data {
  std::shared_ptr<const Scene> scene;
  std::vector<Vec3> directions;             ///< omega of each pass
  std::vector<std::int32_t> index_of;       ///< by patch: which glossy patch it is, or -1
  std::vector<Rgb> fractions;               ///< by glossy patch: k
  std::shared_ptr<const LobeTables> lobes;  ///< null until they are scaled
  std::vector<Rgb> lambertian;              ///< by patch: radiance without the lobe, W/(m² sr)
  std::vector<Rgb> arriving;                ///< by glossy patch and pass: Phi
  std::vector<Rgb> reflected;               ///< by glossy patch and pass: radiance of the lobe

  std::size_t passes() const { return directions.size(); }
};

}  // namespace transillum
