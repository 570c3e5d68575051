// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <QVector>
#include <QWidget>

class QLabel;

namespace transillum::viewer {

/// What the window shows before there is a scene.
class WelcomePage : public QWidget {
  Q_OBJECT

 public:
  explicit WelcomePage(QWidget* parent = nullptr);

 signals:
  void open_clicked();
  void built_in_clicked(const QString& name);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* column_;
  QVector<QLabel*> summaries_;
};

}  // namespace transillum::viewer
