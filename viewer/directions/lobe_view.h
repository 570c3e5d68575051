// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPointF>
#include <QRectF>
#include <QWidget>
#include <memory>
#include <vector>

#include "colors/color_choice.h"
#include "model/snapshot.h"
#include "state/selection.h"

namespace transillum::viewer {

/// Two polar plots over the directions above the selected patch: what arrives, Phi, and what it
/// sends, L. The distance from the center is the value. Dragging rotates both.
class LobeView : public QWidget {
  Q_OBJECT

 public:
  LobeView(const Selection& selection, const ColorChoice& colors, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();

  /// A direction above the patch and the light along it, W/(m² sr).
  struct Ray {
    Vec3 direction;  ///< in the patch's frame: z along its normal
    Rgb light;
  };
  /// The points of the left plot; empty where nothing is kept by direction.
  const std::vector<Ray>& arriving();
  /// The light of the sun that arrives from its direction, W/m², which is no part of arriving(); 0
  /// where nothing is kept by direction.
  const Ray& sun();
  /// The points of the right plot: `rings` + 1 times `sectors`, by angle from the normal.
  const std::vector<Ray>& leaving();
  static constexpr int rings = 22, sectors = 64;
  /// The text that is shown instead of the plots; empty if the plots are shown.
  QString message() const;

  QSize sizeHint() const override { return {420, 340}; }
  QSize minimumSizeHint() const override { return {220, 128}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  /// Where a plot is, and what its outer ring stands for.
  struct Plot {
    QRectF area;
    QPointF center;
    double radius;   ///< pixels
    double largest;  ///< W/(m² sr), at the outer ring; 0 if there is no light
  };
  void forget();
  void find_light();
  QString heading() const;
  Plot plot_in(const QRectF& area, const std::vector<Ray>& rays) const;
  Vec3 turned(const Vec3& direction) const;
  QPointF position_of(const Plot& plot, const Vec3& direction, double length) const;
  void draw_ground(QPainter& painter, const Plot& plot) const;
  void draw_arriving(QPainter& painter, const Plot& plot) const;
  void draw_leaving(QPainter& painter, const Plot& plot) const;
  void draw_marks(QPainter& painter, const Plot& left, const Plot& right) const;
  void draw_mark(QPainter& painter, const Plot& plot, const Vec3& direction, const QColor& color,
                 const QString& text) const;
  void draw_texts(QPainter& painter, const Plot& plot, const QString& title,
                  const QString& what) const;
  const Ray* strongest() const;
  Vec3 toward_eye() const;

  const Selection& selection_;
  const ColorChoice& colors_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  bool known_ = false;  ///< arriving_ and leaving_ belong to the snapshot and the selection
  std::vector<Ray> arriving_, leaving_;
  Ray sun_;
  Vec3 right_{1, 0, 0}, ahead_{0, 1, 0}, normal_{0, 0, 1};  ///< the patch's frame
  double turn_ = 0.9, tilt_ = 0.42;                         ///< radians
  QPointF last_;
};

}  // namespace transillum::viewer
