// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>

namespace transillum::viewer {

/// A dialog with a page of text; deletes itself when closed.
class PageDialog : public QDialog {
  Q_OBJECT

 public:
  PageDialog(const char* name, const QString& title, const QString& html, QWidget& parent);
};

}  // namespace transillum::viewer
