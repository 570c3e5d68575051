// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/count_box.h"

#include <algorithm>
#include <iterator>

#include "support/number_text.h"

namespace transillum::viewer {

namespace {

QString without_spaces(const QString& text) {
  QString rest;
  std::copy_if(text.begin(), text.end(), std::back_inserter(rest),
               [](QChar letter) { return !letter.isSpace(); });
  return rest;
}

}  // namespace

CountBox::CountBox(QWidget* parent) : QSpinBox(parent) { setGroupSeparatorShown(false); }

QString CountBox::textFromValue(int value) const { return count_text(value); }

int CountBox::valueFromText(const QString& text) const {
  if (!specialValueText().isEmpty() && text == specialValueText()) {
    return minimum();
  }
  return number_in(text).toInt();
}

/// The digits between prefix and suffix: without spaces and commas.
QString CountBox::number_in(const QString& text) const {
  QString number = without_spaces(text);
  const QString before = without_spaces(prefix()), after = without_spaces(suffix());
  if (!before.isEmpty() && number.startsWith(before)) {
    number.remove(0, before.size());
  }
  if (!after.isEmpty() && number.endsWith(after)) {
    number.chop(after.size());
  }
  return number.remove(',');
}

// The base class knows which texts are numbers in its range, but not the spaces.
QValidator::State CountBox::validate(QString& text, int& position) const {
  if (!specialValueText().isEmpty() && text == specialValueText()) {
    return QValidator::Acceptable;
  }
  QString plain = prefix() + number_in(text) + suffix();
  int at = std::min(position, static_cast<int>(plain.size()));
  return QSpinBox::validate(plain, at);
}

void CountBox::fixup(QString& text) const { text = prefix() + number_in(text) + suffix(); }

}  // namespace transillum::viewer
