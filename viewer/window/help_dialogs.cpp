// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/help_dialogs.h"

#include <QMessageBox>

#include "window/main_window.h"

namespace transillum::viewer {

void show_about(QWidget* parent) {
  QMessageBox::about(
      parent, MainWindow::tr("About transillum"),
      MainWindow::tr(
          "<p><b>transillum %1</b></p><p>Diffuse light by the transillumination method of "
          "Szirmay-Kalos, Fóris, Neumann and Csébfalvi.</p><p>GPL-3.0-or-later.</p>")
          .arg(QStringLiteral(TRANSILLUM_VERSION)));
}

}  // namespace transillum::viewer
