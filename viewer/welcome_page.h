// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QScrollArea>
#include <QString>
#include <QVector>

class QGridLayout;
class QLabel;

namespace transillum::viewer {

/// What the window shows before there is a scene: those that come along, as pictures.
class WelcomePage : public QScrollArea {
  Q_OBJECT

 public:
  explicit WelcomePage(QWidget* parent = nullptr);

 signals:
  void open_clicked();
  void lesson_clicked();
  void built_in_clicked(const QString& name);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  class Card;
  /// Gives all the size that the type wants.
  void measure();
  void place_cards();

  QLabel* title_;
  QGridLayout* grid_;
  QVector<Card*> cards_;
  int columns_ = 0;
};

}  // namespace transillum::viewer
