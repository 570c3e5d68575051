// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFrame>

class QLabel;

namespace transillum::viewer {

/// Non-modal message bar above the scene: an error, or warnings about the scene.
class Banner : public QFrame {
  Q_OBJECT

 public:
  enum class Kind { error, warning };

  explicit Banner(QWidget* parent = nullptr);

  /// Replaces the shown message. `details` is the tool tip.
  void show_message(Kind kind, const QString& text, const QString& details = {});
  void dismiss();
  /// Empty while hidden.
  QString text() const;

 private:
  QLabel* icon_;
  QLabel* text_;
};

}  // namespace transillum::viewer
