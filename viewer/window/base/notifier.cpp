// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/base/notifier.h"

#include <QPushButton>
#include <QStatusBar>

#include "widgets/banner.h"

namespace transillum::viewer {

Notifier::Notifier(Banner& banner, QStatusBar& status_bar)
    : banner_(banner), status_bar_(status_bar) {
  list_ = banner_.add_button("list_warnings", tr("List"));
  list_->setToolTip(tr("List all warnings; a click on one goes to its face"));
  list_->hide();
  connect(list_, &QPushButton::clicked, this, &Notifier::list_requested);
}

void Notifier::show_failure(const QString& message) {
  list_->hide();
  banner_.show_message(Banner::Kind::error, message);
}

void Notifier::show_warnings(const QStringList& warnings, bool listed) {
  list_->setVisible(listed);
  if (warnings.isEmpty()) {
    banner_.dismiss();
    return;
  }
  const QString text = warnings.size() == 1
                           ? warnings.front()
                           : tr("%1 (and %2 more)").arg(warnings.front()).arg(warnings.size() - 1);
  banner_.show_message(Banner::Kind::warning, text, warnings.join('\n'));
}

void Notifier::show_written(const QString& path) {
  constexpr int ms = 5000;
  status_bar_.showMessage(tr("Written: %1").arg(path), ms);
}

void Notifier::dismiss() { banner_.dismiss(); }

}  // namespace transillum::viewer
