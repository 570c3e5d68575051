// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/banner.h"

#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

struct Style {
  const char *background, *border;
  theme::Icon icon;
};
// The colors of each Banner::Kind.
constexpr Style styles[] = {{"#fdecec", "#e3b4b4", theme::Icon::error},
                            {"#fff6e0", "#e5cf97", theme::Icon::warning},
                            {"#e4effb", "#a9c4e2", theme::Icon::info}};

}  // namespace

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
  layout_ = make_row(this, {12, 7, 8, 7}, 10);
  layout_->addWidget(icon_, 0, Qt::AlignVCenter);
  layout_->addWidget(text_, 1);
  layout_->addWidget(close, 0, Qt::AlignVCenter);
  connect(close, &QToolButton::clicked, this, [this] {
    dismiss();
    emit closed();
  });
  hide();
}

QPushButton* Banner::add_button(const char* name, const QString& text) {
  auto* button = named(name, new QPushButton(text));
  layout_->insertWidget(layout_->count() - 1, button, 0, Qt::AlignVCenter);
  return button;
}

void Banner::show_message(Kind kind, const QString& text, const QString& details) {
  const Style& style = at(styles, kind);
  icon_->setPixmap(theme::icon(style.icon).pixmap(QSize(20, 20)));
  text_->setText(text);
  setToolTip(details);
  setStyleSheet(QStringLiteral("%3, %3 QLabel, %3 QPushButton { color: #1b212a; } "
                               "%3 { background: %1; border: none; border-bottom: 1px solid %2; } "
                               "%3 QPushButton { background: #ffffff; border: 1px solid %2; "
                               "border-radius: 4px; padding: 4px 12px; } "
                               "%3 QPushButton::menu-indicator { "
                               "subcontrol-position: right center; right: 3px; } "
                               "%3 QPushButton:hover { border-color: #5d84b0; } "
                               "%3 QPushButton:disabled { color: #8b929b; }")
                    .arg(QLatin1String(style.background), QLatin1String(style.border),
                         QLatin1String("transillum--viewer--Banner")));
  show();
}

void Banner::dismiss() { hide(); }

QString Banner::text() const { return isHidden() ? QString() : text_->text(); }

}  // namespace transillum::viewer
