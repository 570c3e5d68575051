// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/fold.h"

#include <QPainter>
#include <QStyleOption>

#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int arrow_width = 14, gap = 8;

}  // namespace

FoldHeader::FoldHeader(const QString& title, QWidget* parent) : QAbstractButton(parent) {
  setText(title);
  setCheckable(true);
  setCursor(Qt::PointingHandCursor);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void FoldHeader::set_state(const QString& state) {
  state_ = state;
  setToolTip(state);
  setAccessibleDescription(state);
  update();
}

QFont FoldHeader::bold() const {
  QFont font = this->font();
  font.setBold(true);
  return font;
}

/// Where the state begins, from the left.
int FoldHeader::state_left() const { return minimumSizeHint().width() + gap; }

QString FoldHeader::shown_state() const {
  const QString between = QString::fromUtf8(separator);
  const int room = width() - state_left();
  const auto fits = [&](const QString& text) {
    return fontMetrics().horizontalAdvance(text) <= room;
  };
  QString text = state_;
  QStringList parts = state_.split(between);
  while (parts.size() > 1 && !fits(text)) {
    parts.removeLast();
    text = parts.join(between) + QStringLiteral(" …");
  }
  if (!fits(text)) {
    text = fontMetrics().elidedText(parts.front(), Qt::ElideRight, room);
  }
  return fits(text) ? text : QString();
}

QSize FoldHeader::sizeHint() const {
  return {minimumSizeHint().width() + 2 * gap + fontMetrics().horizontalAdvance(state_),
          minimumSizeHint().height()};
}

QSize FoldHeader::minimumSizeHint() const {
  return {theme::scaled(arrow_width) + QFontMetrics(bold()).horizontalAdvance(text()),
          fontMetrics().height() + theme::scaled(14)};
}

void FoldHeader::enterEvent(QEvent* event) {
  update();
  QAbstractButton::enterEvent(event);
}

void FoldHeader::leaveEvent(QEvent* event) {
  update();
  QAbstractButton::leaveEvent(event);
}

void FoldHeader::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (underMouse() && isEnabled()) {
    painter.fillRect(rect(), theme::hover);
  }
  painter.setPen(theme::rule);
  painter.drawLine(0, 0, width(), 0);
  const int indent = theme::scaled(arrow_width);
  QStyleOption arrow;
  arrow.initFrom(this);
  arrow.rect = QRect(0, (height() - indent) / 2 + 2, indent - 4, indent - 4);
  style()->drawPrimitive(
      isChecked() ? QStyle::PE_IndicatorArrowDown : QStyle::PE_IndicatorArrowRight, &arrow,
      &painter, this);
  painter.setFont(bold());
  painter.setPen(palette().color(QPalette::WindowText));
  const QRect title(indent, 0, width() - indent, height());
  painter.drawText(title, Qt::AlignVCenter, text());
  painter.setFont(font());
  painter.setPen(theme::ink_dim);
  const QRect rest(state_left(), 0, width() - state_left(), height());
  painter.drawText(rest, Qt::AlignVCenter, shown_state());
  if (hasFocus()) {
    QStyleOptionFocusRect focus;
    focus.initFrom(this);
    style()->drawPrimitive(QStyle::PE_FrameFocusRect, &focus, &painter, this);
  }
}

Fold::Fold(const QString& name, const QString& title, QWidget* content, QWidget* parent)
    : QWidget(parent), header_(named(name, new FoldHeader(title, this))) {
  auto* layout = make_column(this, {}, 0);
  layout->addWidget(header_);
  layout->addWidget(content);
  content->hide();
  connect(header_, &FoldHeader::toggled, content, &QWidget::setVisible);
}

}  // namespace transillum::viewer
