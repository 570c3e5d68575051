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
  const QRect title(indent, 0, painter.fontMetrics().horizontalAdvance(text()), height());
  painter.drawText(title, Qt::AlignVCenter, text());
  painter.setFont(font());
  painter.setPen(theme::ink_dim);
  const QRect rest(title.right() + gap, 0, width() - title.right() - gap, height());
  painter.drawText(rest, Qt::AlignVCenter,
                   painter.fontMetrics().elidedText(state_, Qt::ElideRight, rest.width()));
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
