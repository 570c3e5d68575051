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
#include "model/material_edits.h"
#include "model/run_options.h"
#include "model/solve_runner.h"
#include "state/algorithm_state.h"
#include "state/focus.h"
#include "state/initial_view.h"
#include "state/layout.h"
#include "state/overlay.h"

namespace transillum::viewer {

/// A step of a direction, as it is numbered or as what is found first in it.
enum class StepName {
  exchange,  ///< a polygon that exchanges light
  cut,       ///< one that cuts a fragment of V in two
  event,     ///< one that concerns the selected patch
  fullest,   ///< the one after which most of V shines
  polygon,   ///< the selected patch's own
};
using StepChoice = std::variant<std::int32_t, StepName>;

/// Which moment of a run is to be looked at.
struct FocusChoice {
  int iteration = 0, direction = 0;  ///< from 0
  StepChoice step = -1;              ///< from 0; -1: before the first; beyond the last: the last
  Phase phase = Phase::after;
};

/// All that the window shows, as lessons and session files tell it. Whatever is not told has the
/// value of a window that was just opened.
struct ViewState {
  std::string scene;  ///< file or built-in; empty: whichever is open
  RunOptions options;
  Goal solve{Goal::Kind::finished};
  std::optional<FocusChoice> focus;       ///< none: the newest direction is followed
  std::vector<MaterialChange> materials;  ///< the others are the scene's own
  PatchId selection = no_patch;
  std::optional<ViewPoint> camera;          ///< none: as at first
  Quantity quantity = Quantity::radiosity;  ///< colored; a difference is not kept
  ColorMode color_mode = ColorMode::true_color;
  ColorMap color_map = ColorMap::viridis;
  bool logarithmic = false;
  RangeRule range_rule = RangeRule::automatic;
  std::optional<std::pair<double, double>> range;  ///< ends of the color map, unless automatic
  std::optional<double> exposure;                  ///< of true color; none: automatic
  double gamma = ColorScale().gamma;
  std::optional<bool> outlines;  ///< none: as the scene has it at first
  bool direction_shown = true;
  std::vector<Overlay> overlays;
  MapKind algorithm = MapKind::local;  ///< whose pseudo-code is shown
  bool labels = false;                 ///< patches named in the map
  std::optional<Layout> layout;        ///< none: as it is
  std::vector<std::string> panels;     ///< brought to the front, by their short names
};

/// @throws InputError that begins with `where`.
ViewPoint view_point_from_json(const nlohmann::json& value, const std::string& where);
nlohmann::json to_json(const ViewPoint& camera);

/// Numbers are counted from 1, as in the window. Files of scenes are relative to `folder`.
/// @throws InputError that begins with `where`.
ViewState view_state_from_json(const nlohmann::json& value, const std::string& where,
                               const std::string& folder);
/// Complete: read again, it gives the same.
nlohmann::json to_json(const ViewState& state);

}  // namespace transillum::viewer
