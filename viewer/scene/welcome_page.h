// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QScrollArea>
#include <QString>
#include <QVector>

class QGridLayout;
class QLabel;
class QPushButton;

namespace transillum::viewer {

/// The scenes that come along, as pictures.
class WelcomePage : public QScrollArea {
  Q_OBJECT

 public:
  explicit WelcomePage(QWidget* parent = nullptr);

  /// From now on there is an open scene to go back to.
  void offer_way_back();

 signals:
  void back_clicked();
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
  QPushButton* back_;
  QGridLayout* grid_;
  QVector<Card*> cards_;
  int columns_ = 0;
};

}  // namespace transillum::viewer
