// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/banner.h"

#include <QEvent>
#include <QLabel>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>
#include <utility>

#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

struct Style {
  const char* kind;  ///< its name in the style sheet
  theme::Icon icon;
};
// In the order of Banner::Kind.
constexpr Style styles[] = {
    {"error", theme::Icon::error}, {"warning", theme::Icon::warning}, {"offer", theme::Icon::info}};

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
  next_ = named("next_message", new QPushButton, tr("Show the next message"));
  next_->hide();
  layout_->addWidget(next_, 0, Qt::AlignVCenter);
  connect(next_, &QPushButton::clicked, this, &Banner::next_clicked);
  layout_->addWidget(close, 0, Qt::AlignVCenter);
  connect(close, &QToolButton::clicked, this, [this] {
    dismiss();
    emit closed();
  });
  hide();
}

QPushButton* Banner::add_button(const char* name, const QString& text) {
  auto* button = named(name, new QPushButton(text));
  layout_->insertWidget(layout_->count() - 2, button, 0, Qt::AlignVCenter);
  return button;
}

void Banner::show_message(Kind kind, const QString& text, const QString& details) {
  const Style& style = at(styles, kind);
  kind_ = kind;
  show_icon();
  text_->setText(text);
  setToolTip(details);
  setProperty("kind", QString::fromLatin1(style.kind));
  this->style()->unpolish(this);
  this->style()->polish(this);
  for (QWidget* button : findChildren<QPushButton*>()) {
    this->style()->unpolish(button);
    this->style()->polish(button);
  }
  // A bar that repeats its message stays where it is among the others.
  if (!std::exchange(has_message_, true) || kind == Kind::error) {
    show();
    emit changed(kind == Kind::error);
  }
}

void Banner::show_icon() {
  icon_->setPixmap(theme::icon(at(styles, kind_).icon).pixmap(QSize(20, 20)));
}

void Banner::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) {
    show_icon();
  }
  QFrame::changeEvent(event);
}

void Banner::dismiss() {
  hide();
  if (std::exchange(has_message_, false)) {
    emit changed(false);
  }
}

QString Banner::text() const { return has_message_ ? text_->text() : QString(); }

void Banner::show_place(int place, int count) {
  next_->setText(tr("%1 of %2 ›").arg(place).arg(count));
  next_->setVisible(count > 1);
}

BannerStack::BannerStack(QWidget* parent) : QWidget(parent) { make_column(this, {}, 0); }

void BannerStack::add(Banner* banner, bool of_scene) {
  banners_ << banner;
  if (of_scene) {
    of_scene_ << banner;
  }
  layout()->addWidget(banner);
  connect(banner, &Banner::changed, this, [this, banner](bool urgent) {
    const bool before = !front_ || banners_.indexOf(banner) < banners_.indexOf(front_);
    arrange(urgent || before ? banner : front_);
  });
  connect(banner, &Banner::next_clicked, this, [this] {
    const QVector<Banner*> all = present();
    arrange(all[(all.indexOf(front_) + 1) % all.size()]);
  });
}

void BannerStack::set_scene_shown(bool shown) {
  scene_shown_ = shown;
  arrange(front_);
}

QVector<Banner*> BannerStack::present() const {
  QVector<Banner*> present;
  for (Banner* banner : banners_) {
    if (banner->has_message_ && (scene_shown_ || !of_scene_.contains(banner))) {
      present << banner;
    }
  }
  return present;
}

void BannerStack::arrange(Banner* wanted) {
  const QVector<Banner*> all = present();
  front_ = all.contains(wanted) ? wanted : all.value(0);
  for (Banner* banner : banners_) {
    banner->setVisible(banner == front_);
  }
  if (front_) {
    front_->show_place(all.indexOf(front_) + 1, all.size());
  }
}

}  // namespace transillum::viewer
