// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/help_dialogs.h"

#include <QCoreApplication>
#include <QMessageBox>

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("HelpDialogs", text); }

}  // namespace

void show_about(QWidget* parent) {
  QMessageBox::about(
      parent, tr("About transillum"),
      tr("<p><b>transillum %1</b></p><p>Diffuse light by the transillumination method of "
         "Szirmay-Kalos, Fóris, Neumann and Csébfalvi.</p><p>GPL-3.0-or-later.</p>")
          .arg(QStringLiteral(TRANSILLUM_VERSION)));
}

}  // namespace transillum::viewer
