// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/banner.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "widgets/theme.h"

namespace transillum::viewer {

Banner::Banner(QWidget* parent) : QFrame(parent) {
  setObjectName("banner");
  icon_ = new QLabel;
  text_ = new QLabel;
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text_->setTextFormat(Qt::PlainText);
  auto* close = new QToolButton;
  close->setIcon(theme::icon(theme::Icon::close));
  close->setAutoRaise(true);
  close->setToolTip(tr("Close this message"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 7, 8, 7);
  layout->setSpacing(10);
  layout->addWidget(icon_, 0, Qt::AlignTop);
  layout->addWidget(text_, 1);
  layout->addWidget(close, 0, Qt::AlignTop);
  connect(close, &QToolButton::clicked, this, &Banner::dismiss);
  hide();
}

void Banner::show_message(Kind kind, const QString& text, const QString& details) {
  const bool error = kind == Kind::error;
  icon_->setPixmap(
      theme::icon(error ? theme::Icon::error : theme::Icon::warning).pixmap(QSize(20, 20)));
  text_->setText(text);
  setToolTip(details);
  setStyleSheet(error ? QStringLiteral("#banner, #banner QLabel { color: #1b212a; } "
                                       "#banner { background: #fdecec; border: none; "
                                       "border-bottom: 1px solid #e3b4b4; }")
                      : QStringLiteral("#banner, #banner QLabel { color: #1b212a; } "
                                       "#banner { background: #fff6e0; border: none; "
                                       "border-bottom: 1px solid #e5cf97; }"));
  show();
}

void Banner::dismiss() { hide(); }

QString Banner::text() const { return isHidden() ? QString() : text_->text(); }

}  // namespace transillum::viewer
