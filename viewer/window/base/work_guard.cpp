// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/work_guard.h"

#include <QMessageBox>
#include <QPushButton>

#include "support/number_text.h"
#include "window/base/open_scene.h"

namespace transillum::viewer {

bool WorkGuard::may_lose(QWidget* parent, const QString& what) const {
  const auto snapshot = scene_.snapshot();
  const double seconds = snapshot && !scene_.at_start() ? snapshot->statistics.seconds_total : 0;
  if (!(seconds > long_seconds_)) {
    return true;
  }
  QMessageBox box(QMessageBox::Question, what,
                  QObject::tr("The solve took %1 so far. It is kept only in results that you "
                              "export (File → Export).")
                      .arg(duration_text(seconds)),
                  QMessageBox::Cancel, parent);
  box.setObjectName("long_work");
  const QPushButton* lose = box.addButton(what, QMessageBox::DestructiveRole);
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == lose;
}

}  // namespace transillum::viewer
