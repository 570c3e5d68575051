// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPolygonF>
#include <QRectF>
#include <QWidget>
#include <vector>

namespace transillum::viewer {

/// Callouts, and what the user draws on a patch, over another widget, which receives all events of
/// the pointer.
class CalloutLayer : public QWidget {
  Q_OBJECT

 public:
  explicit CalloutLayer(QWidget* under);

  struct Placed {
    QString text;
    QPointF anchor;  ///< in logical pixels

    friend bool operator==(const Placed&, const Placed&) = default;
  };
  /// Redraws if they have changed.
  void show_callouts(std::vector<Placed> callouts);
  const std::vector<Placed>& callouts() const { return callouts_; }
  /// Draws a polygon, and the region that it should match, under the callouts: draw_sketch().
  void show_sketch(QPolygonF outline, std::vector<QPolygonF> right);
  /// Whether draw() draws nothing.
  bool empty() const { return callouts_.empty() && outline_.empty() && right_.empty(); }
  /// Draws all into a picture.
  /// @param bounds  of the picture, logical pixels
  void draw(QPainter& painter, const QRectF& bounds) const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void follow();

  std::vector<Placed> callouts_;
  QPolygonF outline_;
  std::vector<QPolygonF> right_;
};

}  // namespace transillum::viewer
