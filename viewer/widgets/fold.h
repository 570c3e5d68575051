// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractButton>

namespace transillum::viewer {

/// The header of a section that can be folded: an arrow, the title, and the state of the section's
/// controls in dim text. A click shows or hides the controls.
class FoldHeader : public QAbstractButton {
  Q_OBJECT

 public:
  static constexpr const char* separator = " · ";

  FoldHeader(const QString& title, QWidget* parent);

  /// Sets the dim text, of parts with `separator` between them. Where it does not fit, its last
  /// parts are omitted, at last the end of the first.
  void set_state(const QString& state);
  const QString& state() const { return state_; }
  /// The part of state() that fits, with "…" for the rest.
  QString shown_state() const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void enterEvent(QEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  QFont bold() const;
  int state_left() const;

  QString state_;
};

/// A section of a panel that can be folded; it is folded at the start.
class Fold : public QWidget {
  Q_OBJECT

 public:
  /// @param name  object name of the header
  Fold(const QString& name, const QString& title, QWidget* content, QWidget* parent = nullptr);

  FoldHeader* header() const { return header_; }
  bool is_open() const { return header_->isChecked(); }
  void set_open(bool open) { header_->setChecked(open); }

 private:
  FoldHeader* header_;
};

}  // namespace transillum::viewer
