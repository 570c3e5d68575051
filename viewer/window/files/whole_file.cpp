// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/whole_file.h"

#include <QBuffer>
#include <QSaveFile>
#include <stdexcept>

namespace transillum::viewer {

void write_whole(const QString& path, const QByteArray& bytes) {
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) < 0 || !file.commit()) {
    throw std::runtime_error((path + ": " + file.errorString()).toStdString());
  }
}

void write_png(const QString& path, const QImage& image) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (image.isNull() || !image.save(&buffer, "PNG")) {
    throw std::runtime_error(path.toStdString() + ": there is no picture to write");
  }
  write_whole(path, bytes);
}

}  // namespace transillum::viewer
