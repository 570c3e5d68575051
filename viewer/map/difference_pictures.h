// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The maps of CompareView that show where two engines differ, each with a legend of its colors.
#pragma once

#include <QColor>
#include <QString>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "map/map_canvas.h"
#include "model/requests/engine_comparison.h"

class QLabel;

namespace transillum::viewer {

/// A color bar with its range as text, below a picture.
class ColorLegend : public QWidget {
 public:
  /// @param color of a place on the bar, 0 to 1
  ColorLegend(std::function<QColor(double)> color, const QString& range);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::function<QColor(double)> color_;
  QString range_;
};

/// The map V of a direction, with each patch colored by the fraction of its projected area that two
/// engines assign to different patches. White stands for 0, red for a tenth or more.
class DifferencePicture : public QWidget {
 public:
  static constexpr double full_color_at = 0.1;

  explicit DifferencePicture(Selection& selection, QWidget* parent = nullptr);

  /// Shows nothing unless both are set and of the same scene.
  void show(const std::shared_ptr<const RecordedMap>& map,
            std::shared_ptr<const EngineComparison> comparison);
  /// The fraction of a patch, 0 to 1; -1 without a comparison.
  double fraction(PatchId patch) const;
  MapCanvas* canvas() const { return canvas_; }

 private:
  MapCanvas* canvas_;
  std::shared_ptr<const EngineComparison> comparison_;
};

/// The polygons that one patch sees along a direction, each in the color of the difference between
/// two engines for its pair of patches. The second engine finds less where it is blue, more where
/// it is orange.
class PairPicture : public QWidget {
  Q_OBJECT

 public:
  static constexpr double full_color_at = 0.1;  ///< fraction of the pair's larger area

  explicit PairPicture(Selection& selection, QWidget* parent = nullptr);

  /// Shows nothing without a map, a comparison of its direction and a receiver.
  void show(const std::shared_ptr<const RecordedMap>& map,
            const std::shared_ptr<const EngineComparison>& comparison, PatchId receiver);
  /// Second minus first over the larger, of the pair of the receiver and `source`, −1 to 1; 0 for
  /// equal ones.
  double fraction(PatchId source) const;
  PatchId receiver() const { return receiver_; }
  MapCanvas* canvas() const { return canvas_; }

 private:
  MapCanvas* canvas_;
  std::vector<double> shares_;  ///< by source
  PatchId receiver_ = no_patch;
};

}  // namespace transillum::viewer
