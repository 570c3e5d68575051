// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolButton>

class QAction;

namespace transillum::viewer {

/// What is drawn of the scene beside its coloured patches, to be switched on and off.
class ShowMenu : public QToolButton {
  Q_OBJECT

 public:
  explicit ShowMenu(QWidget* parent = nullptr);

  QAction* outlines() const { return outlines_; }
  QAction* direction() const { return direction_; }

 private:
  QAction *outlines_, *direction_;
};

}  // namespace transillum::viewer
