// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/elided.h"

#include <QHelpEvent>
#include <QStyleOptionComboBox>
#include <QStylePainter>
#include <QTextDocument>
#include <QToolTip>

namespace transillum::viewer {

QString elided_name(const QString& name, int longest) {
  return name.size() > longest
             ? name.left(longest / 2) + QStringLiteral("…") + name.right((longest - 1) / 2)
             : name;
}

void ElidedComboBox::paintEvent(QPaintEvent*) {
  QStyleOptionComboBox option;
  initStyleOption(&option);
  if (currentIndex() < 0) {
    option.palette.setBrush(QPalette::ButtonText, option.palette.placeholderText());
    option.currentText = placeholderText();
  }
  const QRect text_field =
      style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
  const int room = text_field.width() - 4;
  const QString shorter = currentData(short_text).toString();
  if (!shorter.isEmpty() && fontMetrics().horizontalAdvance(option.currentText) > room) {
    option.currentText = shorter;
  }
  option.currentText = fontMetrics().elidedText(option.currentText, Qt::ElideRight, room);
  QStylePainter painter(this);
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

QSize ElidedLabel::minimumSizeHint() const {
  if (wordWrap()) {
    return QLabel::minimumSizeHint();
  }
  constexpr int least_characters = 16;
  return {least_characters * fontMetrics().averageCharWidth(), QLabel::minimumSizeHint().height()};
}

QString ElidedLabel::shown_text() const {
  return wordWrap() ? text()
                    : fontMetrics().elidedText(text(), Qt::ElideMiddle, contentsRect().width());
}

bool ElidedLabel::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && toolTip().isEmpty() && shown_text() != text()) {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text(), this);
    return true;
  }
  return QLabel::event(event);
}

void ElidedLabel::paintEvent(QPaintEvent* event) {
  if (wordWrap()) {
    QLabel::paintEvent(event);
    return;
  }
  QStylePainter painter(this);
  painter.drawItemText(contentsRect(), static_cast<int>(alignment()), palette(), isEnabled(),
                       shown_text(), foregroundRole());
}

ClauseLabel::ClauseLabel(QWidget* parent) : QLabel(parent) {
  setTextFormat(Qt::RichText);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
}

void ClauseLabel::set_clauses(const QStringList& clauses, const QString& tip) {
  if (clauses == clauses_ && tip == tip_) {
    return;
  }
  clauses_ = clauses;
  tip_ = tip;
  fit();
}

void ClauseLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  fit();
}

void ClauseLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    fit();
  }
}

void ClauseLabel::fit() {
  const QString separator = QStringLiteral(" · ");
  QTextDocument measured;
  measured.setDefaultFont(font());
  measured.setDocumentMargin(0);
  QString text = clauses_.join(separator);
  for (int count = clauses_.size() - 1; count > 0; --count) {
    measured.setHtml(text);
    if (measured.idealWidth() <= width()) {
      break;
    }
    text = QStringList(clauses_.mid(0, count)).join(separator) + QStringLiteral(" …");
  }
  setText(text);
  const QString all = clauses_.join(separator);
  setToolTip(tip_.isEmpty() ? all : all + QStringLiteral("<br>") + tip_);
}

}  // namespace transillum::viewer
