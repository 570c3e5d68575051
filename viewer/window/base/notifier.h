// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>

class QPushButton;
class QStatusBar;

namespace transillum::viewer {

class Banner;

/// Messages to the user: failures and warnings above the scene, confirmations in the status bar.
class Notifier : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  Notifier(Banner& banner, QStatusBar& status_bar);

  void show_failure(const QString& message);
  /// Shows the first warning and the number of others; hides the banner where there is none.
  /// @param listed  whether a panel lists all of them, which a button brings to the front
  void show_warnings(const QStringList& warnings, bool listed = false);
  /// Confirms for a few seconds that a file has been written.
  void show_written(const QString& path);
  void dismiss();

 signals:
  void list_requested();

 private:
  Banner& banner_;
  QStatusBar& status_bar_;
  QPushButton* list_;
};

}  // namespace transillum::viewer
