// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "map/map_canvas.h"
#include "model/engine_comparer.h"

namespace transillum::viewer {

/// The map V of a direction, with each patch colored by the share of its projected area that two
/// engines assign to different patches. White stands for 0, red for a tenth or more.
class DifferencePicture : public QWidget {
 public:
  static constexpr double full_color_at = 0.1;

  explicit DifferencePicture(Selection& selection, QWidget* parent = nullptr);

  /// Shows nothing unless both are set and of the same scene.
  void show(const std::shared_ptr<const RecordedMap>& map,
            std::shared_ptr<const EngineComparison> comparison);
  /// The share of a patch, 0 to 1; -1 without a comparison.
  double share(PatchId patch) const;
  MapCanvas* canvas() const { return canvas_; }

 private:
  MapCanvas* canvas_;
  std::shared_ptr<const EngineComparison> comparison_;
};

}  // namespace transillum::viewer
