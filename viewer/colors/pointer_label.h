// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QTimer>
#include <functional>
#include <optional>

#include "colors/color_choice.h"
#include "widgets/plate.h"

namespace transillum::viewer {

/// A patch under the pointer, and the point of it, if that is known, m.
struct PointedPatch {
  PatchId patch = no_patch;
  std::optional<Vec3> point = std::nullopt;
};

/// A few lines about a patch: its number, the shown quantity with its unit, and its form factor to
/// the selected patch, or why there is none yet. If the quantity is linear on the patch, the lines
/// show the point, the value there and the mean.
QString pointer_text(const ColorChoice& colors, const PointedPatch& pointed);

/// A plate beside the mouse pointer with pointer_text() of the patch under it, without delay.
/// Hidden while a button is pressed.
class PointerLabel : public Plate {
  Q_OBJECT

 public:
  /// @param canvas over which it is shown; becomes the parent
  /// @param patch_at the patch drawn at a point of the canvas, logical pixels
  PointerLabel(const ColorChoice& colors, QWidget& canvas,
               std::function<PointedPatch(const QPoint&)> patch_at);
  /// Further lines that are shown once the pointer has rested.
  /// @param explained what the lines are about, in the canvas: the plate covers as little of it as
  ///        there is room for
  void set_details(std::function<QString(const QPoint&)> details,
                   std::function<QRect(const QPoint&)> explained);
  /// To be called when the canvas shows something else.
  void point_again();
  static constexpr int rest_ms = 500;

 signals:
  void rested(const QPoint& position);  ///< the details are shown
  void left();                          ///< they are hidden
  /// A form factor is to be shown, and the snapshot has none.
  void form_factors_requested();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void show_patch(const PointedPatch& pointed);
  void show_details();
  void end_rest();
  void place();

  const ColorChoice& colors_;
  QWidget& canvas_;
  std::function<PointedPatch(const QPoint&)> patch_at_;
  std::function<QString(const QPoint&)> details_;
  std::function<QRect(const QPoint&)> explained_;
  QTimer rest_;
  bool detailed_ = false;
  QPoint pointer_;
  PointedPatch pointed_;
};

}  // namespace transillum::viewer
