// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QCoreApplication>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QMimeData>
#include <QString>
#include <QTest>
#include <QUrl>
#include <QWidget>

namespace transillum::viewer::test {

/// Writes a file and returns its path; the test fails where it cannot be written.
inline QString write_file(const QString& path, const QByteArray& text) {
  QFile file(path);
  if (QTest::qVerify(file.open(QIODevice::WriteOnly), "open", qPrintable(path), __FILE__,
                     __LINE__)) {
    file.write(text);
  }
  return path;
}

/// The content of a file; empty where it cannot be read.
inline QByteArray contents_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// Drops a file on a window; returns whether it has taken it.
inline bool drop_file(QWidget& window, const QString& path) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(path)});
  const QPoint place(50, 50);
  QDragEnterEvent enter(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&window, &enter);
  QDropEvent drop(QPointF(place), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&window, &drop);
  return enter.isAccepted();
}

}  // namespace transillum::viewer::test
