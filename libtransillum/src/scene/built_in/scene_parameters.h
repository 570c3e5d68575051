// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace transillum {

/// A parameter of a built-in scene: a whole number within a range.
struct SceneParameter {
  std::string name;
  int default_value;
  int low, high;  ///< range
};

/// The values that follow a built-in's name and a colon, as in `levels=2,slices=17`.
class ParameterValues {
 public:
  /// @throws InputError that lists the available parameters.
  ParameterValues(const std::string& scene, const std::string& text,
                  const std::vector<SceneParameter>& parameters);
  int operator[](const std::string& name) const { return values_.at(name); }

 private:
  std::map<std::string, int> values_;
};

/// `levels=2,slices=17,stacks=8`: the parameters with their defaults.
std::string describe(const std::vector<SceneParameter>& parameters);

}  // namespace transillum
