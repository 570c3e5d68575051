// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFrame>

class QHBoxLayout;
class QLabel;
class QPushButton;

namespace transillum::viewer {

/// Non-modal message bar above the scene: an error, warnings about the scene, or an offer of the
/// window, with buttons.
class Banner : public QFrame {
  Q_OBJECT

 public:
  enum class Kind { error, warning, offer };

  explicit Banner(QWidget* parent = nullptr);

  /// Adds a button before the close button. The caller shows and hides it.
  QPushButton* add_button(const char* name, const QString& text);
  /// Replaces the shown message. `details` is the tool tip.
  void show_message(Kind kind, const QString& text, const QString& details = {});
  void dismiss();
  /// The shown message; empty while the bar is hidden.
  QString text() const;

 signals:
  /// The user has closed it.
  void closed();

 private:
  QHBoxLayout* layout_;
  QLabel* icon_;
  QLabel* text_;
};

}  // namespace transillum::viewer
