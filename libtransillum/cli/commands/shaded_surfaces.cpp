// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/commands/shaded_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "transillum/at.h"

namespace transillum::cli {

ShadedSurfaces::ShadedSurfaces(const Scene& scene, const std::string& by) {
  const std::string kind = !by.empty() ? by : scene.groups().empty() ? "face" : "group";
  std::map<std::int64_t, std::size_t> numbers;
  std::vector<double> whole;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Patch& patch = scene.patch(i);
    const std::int64_t key = kind == "group" ? patch.group : kind == "face" ? patch.face : i;
    const auto [found, is_new] = numbers.emplace(key, names_.size());
    if (is_new) {
      names_.push_back(kind != "group" ? fmt::format("{}:{}", kind, key)
                       : key < 0       ? std::string("no group")
                                       : at(scene.groups(), patch.group));
      whole.push_back(0);
    }
    of_patch_.push_back(found->second);
    area_.push_back(patch.area);
    whole[found->second] += patch.area;
  }
  const double sides = scene.options().two_sided ? 2 : 1;
  for (std::size_t i = 0; i < area_.size(); ++i) {
    area_[i] *= sides / whole[of_patch_[i]];
  }
}

std::string ShadedSurfaces::cell(std::size_t k) const {
  std::string text = names_[k];
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    return text;
  }
  for (std::size_t quote = 0; (quote = text.find('"', quote)) != std::string::npos; quote += 2) {
    text.insert(quote, 1, '"');
  }
  return '"' + text + '"';
}

std::string ShadedSurfaces::header() const {
  std::string text;
  for (std::size_t k = 0; k < names_.size(); ++k) {
    text += (k > 0 ? "," : "") + cell(k);
  }
  return text;
}

std::vector<double> ShadedSurfaces::means(const std::vector<double>& of_patch) const {
  std::vector<double> sums(names_.size());
  for (std::size_t i = 0; i < of_patch.size(); ++i) {
    sums[of_patch_[i]] += area_[i] * of_patch[i];
  }
  for (double& sum : sums) {
    sum = std::min(sum, 1.0);
  }
  return sums;
}

}  // namespace transillum::cli
