// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkRenderWindow.h>

#include <QImage>

namespace transillum::viewer {

/// Draws what a window shows, with `scale` times as many pixels per side; null if it cannot.
QImage image_of_window(vtkRenderWindow& window, int scale);

}  // namespace transillum::viewer
