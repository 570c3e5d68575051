// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QRectF>
#include <QWidget>
#include <vector>

namespace transillum::viewer {

/// Callouts over another widget, which receives all events of the pointer.
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
  /// Draws them into a picture.
  /// @param bounds  of the picture, logical pixels
  void draw(QPainter& painter, const QRectF& bounds) const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<Placed> callouts_;
};

}  // namespace transillum::viewer
