// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFrame>
#include <QVector>

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
  /// The present message, which another bar may hide; empty without one.
  QString text() const;

 signals:
  /// The user has closed it.
  void closed();
  /// There is a message now, or none any more; `urgent` if it is an error.
  void changed(bool urgent);
  void next_clicked();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  friend class BannerStack;
  void show_icon();
  void show_place(int place, int count);

  QHBoxLayout* layout_;
  QLabel* icon_;
  QLabel* text_;
  QPushButton* next_;  ///< "1 of 3"
  Kind kind_ = Kind::offer;
  bool has_message_ = false;
};

/// Several bars in the place of one: the bar in front says how many there are, and a button goes to
/// the next.
class BannerStack : public QWidget {
  Q_OBJECT

 public:
  explicit BannerStack(QWidget* parent = nullptr);

  /// Adds a bar. Of bars that get messages, the one added first comes to the front; an error always
  /// does.
  /// @param of_scene  whether the bar is about the open scene
  void add(Banner* banner, bool of_scene = false);
  /// Bars about the scene are shown only while it is.
  void set_scene_shown(bool shown);

 private:
  void arrange(Banner* wanted);
  QVector<Banner*> present() const;

  QVector<Banner*> banners_, of_scene_;
  Banner* front_ = nullptr;
  bool scene_shown_ = false;
};

}  // namespace transillum::viewer
