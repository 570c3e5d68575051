// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>

class QStatusBar;

namespace transillum::viewer {

class Banner;

/// Messages to the user: failures and warnings above the scene, confirmations in the status bar.
class Notifier : public QObject {
  Q_OBJECT

 public:
  /// Both must outlive this object.
  Notifier(Banner& banner, QStatusBar& status_bar);

  void show_failure(const QString& message);
  /// Shows the first warning and the number of others; hides the banner where there is none.
  void show_warnings(const QStringList& warnings);
  /// Confirms for a few seconds that a file has been written.
  void show_written(const QString& path);
  void dismiss();

 private:
  Banner& banner_;
  QStatusBar& status_bar_;
};

}  // namespace transillum::viewer
