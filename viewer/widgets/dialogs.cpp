// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/dialogs.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QTextBrowser>

#include "widgets/build.h"

namespace transillum::viewer {

PageDialog::PageDialog(const char* name, const QString& title, const QString& html, QWidget& parent)
    : QDialog(&parent) {
  setObjectName(QString::fromLatin1(name));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(title);
  auto* page = new QTextBrowser;
  page->setFrameShape(QFrame::NoFrame);
  page->setHtml(html);
  auto* layout = make_column(this, {});
  layout->addWidget(page);
  resize(QSize(960, 760).boundedTo(parent.size()));
}

namespace {

QString& folder_to_write() {
  static QString folder;
  return folder;
}

}  // namespace

void propose_folder(const QString& folder) { folder_to_write() = folder; }

QString ask_where_to_write(QWidget* parent, const QString& title, const QString& filter,
                           const QString& proposed, const QString& suffix) {
  QFileDialog dialog(parent, title, folder_to_write(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(suffix.isEmpty() ? QFileInfo(proposed).suffix() : suffix);
  dialog.selectFile(proposed);
  if (dialog.exec() == QDialog::Rejected || dialog.selectedFiles().isEmpty()) {
    return {};
  }
  propose_folder(dialog.directory().path());
  return dialog.selectedFiles().front();
}

}  // namespace transillum::viewer
