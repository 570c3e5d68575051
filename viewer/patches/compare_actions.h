// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "colors/color_choice.h"

class QAction;
class QMenu;

namespace transillum::viewer {

/// Keeps a run as A; shows A while a key is held down, or the difference of the newest run from A.
class CompareActions : public QObject {
  Q_OBJECT

 public:
  /// @param window its keys are handled, while it is active
  CompareActions(ColorChoice& colors, const QWidget* window, QObject* parent = nullptr);

  void add_to(QMenu& menu) const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void show_state();

  ColorChoice& colors_;
  const QWidget* window_;
  QAction *keep_, *show_, *difference_;
};

}  // namespace transillum::viewer
