// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QStringList>

namespace transillum::viewer {

/// A name of at most `longest` characters; the middle of a longer one is replaced by "…".
QString elided_name(const QString& name, int longest);

/// A combo box that shows the short text of the selected item, or elides it ("…"), if it does not
/// fit.
class ElidedComboBox : public QComboBox {
 public:
  /// The role of an item's short text; without one, the text is elided.
  static constexpr int short_text = Qt::UserRole + 1;

  using QComboBox::QComboBox;

 protected:
  void paintEvent(QPaintEvent* event) override;
};

/// One line that is elided in its middle where it does not fit; the tool tip then has all of it.
/// With word wrap, a plain label.
class ElidedLabel : public QLabel {
 public:
  using QLabel::QLabel;

  QSize minimumSizeHint() const override;
  /// The text as shown.
  QString shown_text() const;

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
};

/// A line of clauses, the most important first. It shows as many as fit, then "…"; the tool tip has
/// all.
class ClauseLabel : public QLabel {
 public:
  explicit ClauseLabel(QWidget* parent = nullptr);

  /// @param clauses  may be rich text
  /// @param tip  further lines of the tool tip
  void set_clauses(const QStringList& clauses, const QString& tip = {});

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void fit();

  QStringList clauses_;
  QString tip_;
};

}  // namespace transillum::viewer
