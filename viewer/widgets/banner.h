// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFrame>

class QLabel;

namespace transillum::viewer {

/// Words above the scene that wait for nobody: an error, or what a scene was found to be like.
class Banner : public QFrame {
  Q_OBJECT

 public:
  enum class Kind { error, warning };

  explicit Banner(QWidget* parent = nullptr);

  void say(Kind kind, const QString& text, const QString& details = {});
  void dismiss();
  QString text() const;

 private:
  QLabel* icon_;
  QLabel* text_;
};

}  // namespace transillum::viewer
