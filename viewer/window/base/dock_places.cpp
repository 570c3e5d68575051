// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/dock_places.h"

#include <map>

namespace transillum::viewer {

namespace {

using Places = std::vector<DockPlace>;

/// Teach: the page and the scene; a page opens the panels that it needs. Inspect: settings, the
/// scene, the patch and its light. Step: the map; the scene is small, below the pseudo-code.
const std::map<std::string, Places>& all_places() {
  constexpr auto teach = Layout::teach, inspect = Layout::inspect, step = Layout::debug;
  constexpr auto left = Qt::LeftDockWidgetArea, right = Qt::RightDockWidgetArea,
                 above = Qt::TopDockWidgetArea, bottom = Qt::BottomDockWidgetArea;
  constexpr auto front = DockPlace::Opening::front, behind = DockPlace::Opening::behind;
  static const std::map<std::string, Places> places{
      {"lesson", {{teach, left, 1, 700, front}}},
      {"notes", {{teach, left, 1, 700}}},
      {"settings", {{inspect, left, 1, 700, front}}},
      {"summary", {{inspect, left, 1, 700}}},
      {"material", {{inspect, left, 1, 700}}},
      {"move", {{teach, right, 2, 260}, {inspect, right, 1, 330}, {step, above, 1, 330}}},
      {"inspector", {{inspect, right, 1, 330, front}}},
      {"map", {{teach, right, 1, 400}, {inspect, right, 1, 330}, {step, left, 1, 480, front}}},
      {"section", {{teach, right, 1, 400}, {inspect, right, 1, 330}, {step, left, 1, 480}}},
      {"error", {{teach, right, 1, 400}}},
      {"lobe", {{teach, right, 1, 400}, {inspect, right, 1, 330}}},
      {"compare", {{inspect, right, 1, 330}, {step, left, 1, 480}}},
      {"paths", {{inspect, right, 2, 420, front}}},
      {"table", {{inspect, right, 2, 420}}},
      {"runs", {{inspect, right, 2, 420}}},
      {"warnings", {{inspect, right, 2, 420}}},
      {"algorithm", {{teach, right, 2, 420}, {step, above, 1, 330, front}}},
      {"received", {{inspect, right, 2, 420, behind}, {step, above, 1, 330}}},
      {"parts", {{inspect, right, 2, 420, behind}}},
      {"convergence", {{teach, right, 2, 420}, {inspect, right, 2, 420}}},
      {"direction", {{teach, right, 2, 420}, {inspect, right, 2, 420}}},
      {"event", {{teach, right, 2, 420}, {step, above, 1, 330, behind}}},
      {"breakpoint", {{step, above, 1, 330, behind}}},
      {"tree", {{teach, right, 2, 420}, {step, above, 1, 330, behind}}},
      {"timeline",
       {{teach, bottom, 1, 132}, {inspect, bottom, 1, 132}, {step, bottom, 1, 132, front}}}};
  return places;
}

}  // namespace

const Places& dock_places_of(const std::string& panel) {
  static const Places none;
  const auto found = all_places().find(panel);
  return found == all_places().end() ? none : found->second;
}

}  // namespace transillum::viewer
