// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/visibility_map.h"

namespace transillum::testing {

/// Draws the visibility map of one direction if a test of engines fails: if an expectation fails
/// during the lifetime of this object, its destructor writes the map as an SVG to failed-maps/ in
/// the build folder and prints the path; at most five per test.
class MapOnFailure {
 public:
  MapOnFailure(const Scene& scene, const BspTree& tree, const Vec3& omega);
  ~MapOnFailure();
  MapOnFailure(const MapOnFailure&) = delete;
  MapOnFailure& operator=(const MapOnFailure&) = delete;

 private:
  const Scene& scene_;
  const BspTree& tree_;
  Vec3 omega_;
  int failures_;
};

/// Writes the map as failed-maps/NAME.svg and returns its path.
std::string save_map(const Scene& scene, const BspTree& tree, const Vec3& omega,
                     const std::string& name);

}  // namespace transillum::testing
