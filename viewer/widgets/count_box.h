// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QSpinBox>

namespace transillum::viewer {

/// A spin box of a count, written like other counts of the window: 2 013, by count_text(). A number
/// may be typed with or without spaces or commas.
class CountBox : public QSpinBox {
 public:
  explicit CountBox(QWidget* parent = nullptr);

 protected:
  QString textFromValue(int value) const override;
  int valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;

 private:
  QString number_in(const QString& text) const;
};

}  // namespace transillum::viewer
