// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLabel>
#include <functional>

#include "colors/color_choice.h"

namespace transillum::viewer {

/// What is known about a patch in a few lines: its number, the shown quantity with its unit, and
/// its form factor to the selected patch, or why there is none yet.
QString pointer_text(const ColorChoice& colors, PatchId patch);

/// A plate beside the mouse pointer with pointer_text() of the patch under it, without delay.
/// Hidden while a button is pressed.
class PointerLabel : public QLabel {
  Q_OBJECT

 public:
  /// @param canvas over which it is shown; becomes the parent
  /// @param patch_at the patch drawn at a point of the canvas, logical pixels
  PointerLabel(const ColorChoice& colors, QWidget& canvas,
               std::function<PatchId(const QPoint&)> patch_at);

 signals:
  /// A form factor is to be shown, and the snapshot has none.
  void form_factors_requested();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void show_patch(PatchId patch);
  void place();

  const ColorChoice& colors_;
  QWidget& canvas_;
  std::function<PatchId(const QPoint&)> patch_at_;
  QPoint pointer_;
  PatchId patch_ = no_patch;
};

}  // namespace transillum::viewer
