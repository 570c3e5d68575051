// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <QImage>
#include <QString>

namespace transillum::viewer {

/// Writes a file whole or not at all. @throws std::runtime_error
void write_whole(const QString& path, const QByteArray& bytes);
/// Writes a picture whole or not at all. @throws std::runtime_error
void write_png(const QString& path, const QImage& image);

}  // namespace transillum::viewer
