// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "help_dialogs.h"

#include <QMessageBox>

#include "main_window.h"

namespace transillum::viewer {

void show_keys(QWidget* parent) {
  QMessageBox::information(
      parent, MainWindow::tr("Keys and mouse"),
      MainWindow::tr(
          "<table cellspacing=6>"
          "<tr><td><b>Scene</b></td><td>drag: turn &nbsp; Shift+drag or middle button: move &nbsp; "
          "wheel: nearer &nbsp; click: select a patch</td></tr>"
          "<tr><td><b>Map</b></td><td>drag: move &nbsp; wheel: enlarge &nbsp; double click: all "
          "&nbsp; click: select a patch, list its line &nbsp; right button: run to a "
          "point</td></tr>"
          "<tr><td><b>Timeline</b></td><td>drag: go to a moment &nbsp; Shift+drag: polygon by "
          "polygon &nbsp; arrow keys: one polygon, with Ctrl one direction</td></tr>"
          "<tr><td><b>F5 F6</b></td><td>run, pause</td></tr>"
          "<tr><td><b>F7 F8</b></td><td>one direction, one iteration</td></tr>"
          "<tr><td><b>Shift+F5</b></td><td>stop: back to the first direction</td></tr>"
          "<tr><td><b>, .</b></td><td>one polygon back, on</td></tr>"
          "<tr><td><b>M /</b></td><td>one phase of a step back, on</td></tr>"
          "<tr><td><b>N Shift+N</b></td><td>next, previous event of the selected patch</td></tr>"
          "<tr><td><b>T Shift+T</b></td><td>next, previous polygon that exchanges light</td></tr>"
          "<tr><td><b>[ ] { }</b></td><td>previous, next direction; iteration</td></tr>"
          "<tr><td><b>F9 Shift+F9</b></td><td>run to the next breakpoint, back to the "
          "last</td></tr>"
          "<tr><td><b>F</b></td><td>follow the newest direction</td></tr>"
          "<tr><td><b>Ctrl+1 Ctrl+2</b></td><td>lay out to inspect, to step through</td></tr>"
          "<tr><td><b>Ctrl+T</b></td><td>study: error against directions</td></tr>"
          "<tr><td><b>Home Shift+Home Z</b></td><td>look as at first, at all of the scene, at the "
          "selected patch</td></tr>"
          "<tr><td><b>Ctrl+B Alt+1 …</b></td><td>keep this view, go to a kept one</td></tr>"
          "<tr><td><b>K A Shift+K</b></td><td>keep this run as A, show A while the key is down, "
          "colour by the difference</td></tr>"
          "<tr><td><b>Ctrl+F</b></td><td>find a patch</td></tr>"
          "<tr><td><b>Ctrl+Z Ctrl+Y</b></td><td>undo, redo changes of materials</td></tr>"
          "<tr><td><b>D</b></td><td>show or hide the direction</td></tr>"
          "<tr><td><b>Esc</b></td><td>select nothing</td></tr>"
          "<tr><td><b>Ctrl+O Ctrl+Q</b></td><td>open, quit</td></tr></table>"));
}

void show_about(QWidget* parent) {
  QMessageBox::about(
      parent, MainWindow::tr("About transillum"),
      MainWindow::tr(
          "<p><b>transillum %1</b></p><p>Diffuse light by the transillumination method of "
          "Szirmay-Kalos, Fóris, Neumann and Csébfalvi.</p><p>GPL-3.0-or-later.</p>")
          .arg(QStringLiteral(TRANSILLUM_VERSION)));
}

}  // namespace transillum::viewer
