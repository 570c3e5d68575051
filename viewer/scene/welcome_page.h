// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QScrollArea>
#include <QString>
#include <QVector>

class QGridLayout;
class QLabel;
class QPushButton;

namespace transillum::viewer {

/// The built-in scenes as pictures to choose from.
class WelcomePage : public QScrollArea {
  Q_OBJECT

 public:
  explicit WelcomePage(QWidget* parent = nullptr);

  /// Shows the button that goes back to the open scene.
  void show_back_button();
  /// Names the scene that is being loaded in the title; empty if none is.
  void set_loading(const QString& name);

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
  /// Sizes title and cards by the font.
  void measure();
  void show_title();
  void place_cards();

  QString loading_;
  QLabel* title_;
  QPushButton* back_;
  QGridLayout* grid_;
  QVector<Card*> cards_;
  int columns_ = 0;
};

}  // namespace transillum::viewer
