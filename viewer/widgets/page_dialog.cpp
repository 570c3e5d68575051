// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/page_dialog.h"

#include <QTextBrowser>
#include <QVBoxLayout>

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

}  // namespace transillum::viewer
