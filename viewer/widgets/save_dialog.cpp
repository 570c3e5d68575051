// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/save_dialog.h"

#include <QFileDialog>
#include <QFileInfo>

namespace transillum::viewer {

QString ask_where_to_write(QWidget* parent, const QString& title, const QString& filter,
                           const QString& proposed, const QString& suffix) {
  static QString folder;
  QFileDialog dialog(parent, title, folder, filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(suffix.isEmpty() ? QFileInfo(proposed).suffix() : suffix);
  dialog.selectFile(proposed);
  if (dialog.exec() == QDialog::Rejected || dialog.selectedFiles().isEmpty()) {
    return {};
  }
  folder = dialog.directory().path();
  return dialog.selectedFiles().front();
}

}  // namespace transillum::viewer
