// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lessons/view_state.h"

namespace transillum::viewer {

/// A slider or a choice in the text of a page, at the place of `{name}`.
struct PageControl {
  enum class Kind {
    option,       ///< one of `values` of an option of the solve
    reflectance,  ///< gray of a material, group or face, from `low` to `high`
    exitance,     ///< the same, W/m²
    step,         ///< step of the direction shown
    direction     ///< direction of the run
  };
  std::string name;  ///< in the text, between braces
  Kind kind = Kind::option;
  std::string target;               ///< the option; or the material, as for change_materials()
  std::vector<std::string> values;  ///< values of an option: at least two JSON texts
  std::vector<std::string> labels;  ///< names of the values
  bool slides = false;              ///< the values are numbers: a slider, else a choice
  double low = 0, high = 1;
};

/// Reads the key `controls` of a page; each control must be in the text exactly once.
/// @param page_options  the JSON of the page's `options`
/// @throws InputError that begins with `where`
std::vector<PageControl> controls_from_json(const nlohmann::json& value, const std::string& where,
                                            const nlohmann::json& page_options,
                                            const std::string& text);

/// Options with one option of the solve replaced.
/// @param name,value  as in PageControl::target and values
RunOptions with_option(const RunOptions& options, const std::string& name,
                       const std::string& value);
/// The index in `values` of the value that the options have now; -1 if it is not among them.
int value_in(const PageControl& control, const RunOptions& options);

}  // namespace transillum::viewer
