// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "map/map_canvas.h"
#include "model/engine_comparer.h"

class QLabel;

namespace transillum::viewer {

/// The polygons that one patch sees along a direction, each in the color of the difference between
/// two engines for its pair of patches. The second engine finds less where it is blue, more where
/// it is orange.
class PairPicture : public QWidget {
  Q_OBJECT

 public:
  static constexpr double full_color_at = 0.1;  ///< share of the pair's larger area

  explicit PairPicture(Selection& selection, QWidget* parent = nullptr);

  /// Shows nothing without a map, a comparison of its direction and a receiver.
  void show(const std::shared_ptr<const RecordedMap>& map,
            std::shared_ptr<const EngineComparison> comparison, PatchId receiver);
  /// Second minus first over the larger, of the pair of the receiver and `source`, −1 to 1; 0 if
  /// both are equal.
  double share(PatchId source) const;
  PatchId receiver() const { return receiver_; }
  MapCanvas* canvas() const { return canvas_; }

 private:
  MapCanvas* canvas_;
  std::vector<double> shares_;  ///< by source
  PatchId receiver_ = no_patch;
};

}  // namespace transillum::viewer
