// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::cli {

/// The surfaces of a table of sunlit fractions, each a set of patches.
class ShadedSurfaces {
 public:
  /// @param by group, face or patch; empty chooses group, or face in a scene without groups
  ShadedSurfaces(const Scene& scene, const std::string& by);

  std::size_t count() const { return names_.size(); }
  /// The name of surface k as a cell of a CSV file.
  std::string cell(std::size_t k) const;
  /// All cells, separated by commas.
  std::string header() const;
  /// Means over the area of each surface; the sides of two-sided patches are one area.
  /// @param of_patch fractions of each patch
  std::vector<double> means(const std::vector<double>& of_patch) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::size_t> of_patch_;  ///< number of the surface, by patch
  std::vector<double> area_;           ///< area of each patch over the area of its surface
};

}  // namespace transillum::cli
