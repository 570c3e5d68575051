// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "colors/color_choice.h"
#include "colors/quantity.h"
#include "lessons/patch_ranges.h"
#include "model/run_options.h"
#include "model/solver/goal.h"
#include "state/algorithm_state.h"
#include "state/camera_views.h"
#include "state/focus.h"
#include "state/view_choices.h"
#include "transillum/material_changes.h"

namespace transillum::viewer {

/// A step of a direction described by its kind: the first such step of the direction.
enum class StepName {
  exchange,  ///< its fragment exchanges light
  cut,       ///< the step splits a polygon of V
  event,     ///< the step concerns the selected patch
  fullest,   ///< MapRecord::fullest_step()
  polygon,   ///< its fragment is part of the selected patch
  whole,     ///< no step: the whole direction
};
/// A step by number or by kind.
using StepChoice = std::variant<std::int32_t, StepName>;

/// The position of a run to show.
struct FocusChoice {
  int iteration = 0, direction = 0;  ///< from 0
  StepChoice step = -1;              ///< from 0; -1 is before the first step; numbers beyond the
                                     ///< last step mean the last
  Phase phase = Phase::after;
};

/// The state of the window, as lessons and session files describe it. Default values describe a
/// newly opened window.
struct ViewState {
  std::string scene;  ///< file or built-in; the open scene if it is empty
  RunOptions options;
  Goal solve{Goal::Kind::finished};
  std::optional<FocusChoice> focus;       ///< if not set, the view follows the newest direction
  std::vector<MaterialChange> materials;  ///< relative to the scene's own
  PatchId selection = no_patch;
  std::vector<PatchRange> also_selected;    ///< besides `selection`
  std::vector<PatchRange> hidden;           ///< omitted from the picture
  PatchId pointed_at = no_patch;            ///< largest patch of a page's callouts; in no file
  std::optional<ClipPlane> clip;            ///< if not set, clipping is off
  std::optional<ViewPoint> camera;          ///< the initial view if not set
  Quantity quantity = Quantity::radiosity;  ///< shown in color; never Quantity::difference
                                            ///< or measured_error
  ColorMode color_mode = ColorMode::true_color;
  ColorMap color_map = default_color_map;
  std::optional<bool> logarithmic;  ///< chosen by the quantity if not set
  RangeRule range_rule = RangeRule::automatic;
  std::optional<std::pair<double, double>> range;  ///< ends of the color map; automatic if not set
  std::optional<double> exposure;  ///< exposure of true color, EV; automatic if not set
  double gamma = ColorScale().gamma;
  std::optional<bool> outlines;  ///< the default for the scene if not set
  bool direction_shown = true;
  std::vector<Overlay> overlays;
  MapKind algorithm = MapKind::local;  ///< whose pseudo-code is shown
  bool labels = false;                 ///< patch numbers shown in the map
  std::optional<Layout> layout;        ///< unchanged if not set
  std::vector<std::string> panels;     ///< short names of panels to bring to the front
};

/// @throws InputError with a message that begins with `where`
ViewPoint view_point_from_json(const nlohmann::json& value, const std::string& where);
nlohmann::json to_json(const ViewPoint& camera);

/// In the JSON, iterations, directions and steps count from 1, as in the window.
/// @param folder where a relative scene file is searched first
/// @throws InputError with a message that begins with `where`
ViewState view_state_from_json(const nlohmann::json& value, const std::string& where,
                               const std::string& folder);
/// The complete state: view_state_from_json() restores it.
nlohmann::json to_json(const ViewState& state);

}  // namespace transillum::viewer
