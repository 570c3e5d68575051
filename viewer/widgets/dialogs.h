// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>
#include <QString>

class QWidget;

namespace transillum::viewer {

/// A dialog with a page of text; deletes itself when closed.
class PageDialog : public QDialog {
  Q_OBJECT

 public:
  PageDialog(const char* name, const QString& title, const QString& html, QWidget& parent);
};

/// The folder that the next dialog for a file to write starts in.
void propose_folder(const QString& folder);

/// Shows a file dialog for a file to write. Starts in the last chosen or proposed folder with the
/// name `proposed`; existing files need confirmation.
/// @param suffix appended to a name without one; if it is empty, the suffix of `proposed` is used
/// @return the path; empty if the dialog was canceled
QString ask_where_to_write(QWidget* parent, const QString& title, const QString& filter,
                           const QString& proposed, const QString& suffix = {});

}  // namespace transillum::viewer
