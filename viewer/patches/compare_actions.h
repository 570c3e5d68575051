// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "colors/color_choice.h"

class QAction;
class QMenu;

namespace transillum::viewer {

/// Keeps the newest run as A. Shows A while a key is held down, or colors by the difference from A.
class CompareActions : public QObject {
  Q_OBJECT

 public:
  /// @param window its keys are handled, while it is active
  CompareActions(ColorChoice& colors, const QWidget* window, QObject* parent = nullptr);

  void add_to(QMenu& menu) const;
  QAction* keep() const { return keep_; }
  QAction* difference() const { return difference_; }

 signals:
  void failed(const QString& message);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void keep_run();
  void show_state();

  ColorChoice& colors_;
  const QWidget* window_;
  QAction *keep_, *show_, *difference_;
};

}  // namespace transillum::viewer
