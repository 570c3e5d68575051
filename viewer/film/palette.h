// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>

namespace transillum::viewer {

/// The picture in the 256 colors that fit it best, as QImage::Format_Indexed8.
/// @param picture  of QImage::Format_RGB32
QImage with_palette(const QImage& picture);

}  // namespace transillum::viewer
