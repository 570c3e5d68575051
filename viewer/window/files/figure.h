// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QImage>
#include <QSize>
#include <QSizeF>
#include <QString>
#include <functional>
#include <vector>

class QPainter;

namespace transillum::viewer {

class ColorChoice;
class ConvergenceView;
class MapView;
class SceneView;

/// The content and the look of a figure.
struct FigurePlan {
  enum class Background { light, dark, transparent };

  bool scene = true, map = false, chart = false;  ///< in a row, in this order
  QString title = {};                             ///< above them; may be empty
  bool explained = true;                          ///< with color bar, legend, scale bar and axes
  bool direction = false;                         ///< with the direction and the step in the scene
  QSizeF size{1200, 800};
  bool centimeters = false;  ///< the unit of `size`; otherwise pixels
  double text_points = 10;   ///< size of texts; lines are scaled with them
  Background background = Background::light;

  /// Pixels; for sizes in centimeters at 300 per inch.
  QSize pixels() const;
  /// Pixels of the scene, all of it.
  QSize scene_pixels(bool has_bar) const;
  /// @throws InputError where nothing is chosen or the size is out of range
  void validate() const;
};

/// The views that a figure is of.
struct FigureViews {
  SceneView& scene;
  const ColorChoice& colors;
  const MapView& map;
  const ConvergenceView& charts;
};

/// Writes a figure whole or not at all: .png, or with text as text, and map and charts as vectors,
/// .svg or .pdf.
/// @param sharp  sharp picture in scene_pixels(); null without one
/// @throws InputError as FigurePlan::validate(), or where the name has another ending;
/// std::runtime_error where it cannot be written
void write_figure(const QString& path, const FigurePlan& plan, const FigureViews& views,
                  const QImage& sharp = {});

}  // namespace transillum::viewer
