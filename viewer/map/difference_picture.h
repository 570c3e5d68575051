// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "map/map_canvas.h"
#include "model/engine_comparer.h"

namespace transillum::viewer {

/// Where two engines differ: the map V of a direction, each patch by the share of its projection
/// that goes to other patches. White: none; red: a tenth or more.
class DifferencePicture : public QWidget {
 public:
  static constexpr double full_color_at = 0.1;

  explicit DifferencePicture(Selection& selection, QWidget* parent = nullptr);

  /// Nothing is shown unless both are there, of one direction.
  void show(const std::shared_ptr<const RecordedMap>& map,
            std::shared_ptr<const EngineComparison> comparison);
  /// Of a patch, or below 0 where nothing is known.
  double share(PatchId patch) const;
  MapCanvas* canvas() const { return canvas_; }

 private:
  MapCanvas* canvas_;
  std::shared_ptr<const EngineComparison> comparison_;
};

}  // namespace transillum::viewer
