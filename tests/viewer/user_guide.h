// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The user guide of the viewer, for tests that compare it with the window.
#pragma once

#include <QDir>
#include <QFile>
#include <QString>
#include <QStringList>

namespace transillum::viewer::test {

/// The texts of the pages of the user guide, in their order; the first one is the list of pages.
inline QStringList user_guide() {
  const QDir folder(QStringLiteral(TRANSILLUM_SOURCE "/viewer/guide"));
  QStringList files{folder.filePath(QStringLiteral("../USER_GUIDE.md"))};
  for (const QString& name : folder.entryList({QStringLiteral("*.md")}, QDir::Files, QDir::Name)) {
    files << folder.filePath(name);
  }
  QStringList pages;
  for (const QString& name : files) {
    QFile file(name);
    pages << (file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString());
  }
  return pages;
}

}  // namespace transillum::viewer::test
