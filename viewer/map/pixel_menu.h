// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolButton>

#include "map/map_picture.h"

class QActionGroup;

namespace transillum::viewer {

/// A button that tells how the map is drawn, exactly or in a discrete engine's pixels, and lets
/// choose.
class PixelMenu : public QToolButton {
  Q_OBJECT

 public:
  explicit PixelMenu(QWidget* parent = nullptr);

  const PixelChoice& choice() const { return choice_; }

 signals:
  void changed();

 private:
  void change(const PixelChoice& choice);

  PixelChoice choice_;
  QActionGroup* resolutions_;
  QAction* differences_;
};

}  // namespace transillum::viewer
