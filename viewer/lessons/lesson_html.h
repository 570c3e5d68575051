// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "colors/color_map.h"
#include "lessons/lesson.h"
#include "model/requests/recorded_map.h"
#include "state/focus.h"

namespace transillum::viewer {

/// A step of a direction as an SVG element shows it without a script.
struct ShownStep {
  std::int32_t step = -1;      ///< from 0; -1 is before the first
  Phase phase = Phase::after;  ///< before and split show V before the step, and mark the step
  bool labels = false;         ///< with the numbers of patches

  /// The last step that V has taken in.
  std::int32_t last() const { return phase == Phase::after ? step : step - 1; }
};

/// A panel that a page needs, as the window shows it.
struct PanelPicture {
  QString title;
  QByteArray picture;  ///< PNG
};

/// A page of a lesson as the window shows it.
struct ShownPage {
  Lesson::Page page;
  QByteArray picture;                      ///< the scene as PNG
  std::shared_ptr<const RecordedMap> map;  ///< map of the page's direction; null if it has none
  ShownStep step;                          ///< shown first
  bool whole = false;                      ///< shows both sides of the direction instead of a step
  std::vector<Color8> patch_colors;        ///< colors of the map, one per patch
  std::optional<Solved> solved;            ///< answer to the page's question
  std::vector<PanelPicture> panels;        ///< panels of the page besides scene and map
};

/// A lesson as one HTML file that refers to no other: text, pictures, and maps as SVG with a slider
/// for the step. UTF-8. Maps of more than 20,000 polygons show one step only. Omits pages
/// whose whole text speaks of the window.
QByteArray lesson_html(const QString& title, const std::vector<ShownPage>& pages);

/// The map of a direction as an SVG element. Each polygon that was ever in V has the steps at which
/// it was made and consumed (`data-made`, `data-consumed`), so that a script shows any step.
/// @param all  whether the element has the polygons of all steps, not only of that step
/// @param callouts  drawn over it, where they are after that step
QByteArray map_svg(const RecordedMap& map, const ShownStep& step,
                   const std::vector<Color8>& patch_colors, bool all,
                   const std::vector<Callout>& callouts = {});

/// One side of a direction as an SVG element, as the window shows it without a step: the fronts
/// that receive, or that emit.
QByteArray side_svg(const RecordedMap& map, bool receivers,
                    const std::vector<Color8>& patch_colors);

/// The section of a direction as an SVG element (Section), with the same attributes, so that one
/// script shows a step of both.
QByteArray section_svg(const RecordedMap& map, const ShownStep& step,
                       const std::vector<Color8>& patch_colors, bool all,
                       const std::vector<Callout>& callouts = {});

}  // namespace transillum::viewer
