// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "welcome_page.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "theme.h"
#include "transillum/scene.h"

namespace transillum::viewer {

namespace {

constexpr int margin = 32, button_width = 150, gap = 14, narrowest_words = 100;

}  // namespace

WelcomePage::WelcomePage(QWidget* parent) : QWidget(parent) {
  setAutoFillBackground(true);
  auto* title = new QLabel(tr("Open a scene or drop an OBJ file here"));
  QFont large = font();
  large.setPixelSize(22);
  large.setBold(true);
  title->setFont(large);
  auto* open = new QPushButton(theme::icon(theme::Icon::open), tr("Open a file…"));
  open->setIconSize(QSize(20, 20));
  auto* or_built_in = new QLabel(tr("or look at one that comes along:"));
  or_built_in->setForegroundRole(QPalette::PlaceholderText);

  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(gap);
  grid->setVerticalSpacing(8);
  grid->setColumnStretch(1, 1);
  int row = 0;
  for (const BuiltInScene& scene : built_in_scenes()) {
    const QString name = QString::fromStdString(scene.name);
    auto* button = new QPushButton(theme::icon(theme::Icon::scene), name);
    button->setObjectName(QStringLiteral("built_in_") + name);
    button->setIconSize(QSize(20, 20));
    button->setFixedWidth(button_width);
    button->setStyleSheet(QStringLiteral("text-align: left; padding: 5px 10px;"));
    auto* summary = new QLabel(QString::fromStdString(scene.summary));
    summary->setWordWrap(true);
    summary->setForegroundRole(QPalette::PlaceholderText);
    summaries_.append(summary);
    grid->addWidget(button, row, 0, Qt::AlignTop);
    grid->addWidget(summary, row++, 1);
    connect(button, &QPushButton::clicked, this, [this, name] { emit built_in_clicked(name); });
  }

  column_ = new QWidget;
  auto* inner = new QVBoxLayout(column_);
  inner->setContentsMargins(0, 0, 0, 0);
  inner->setSpacing(14);
  inner->addWidget(title);
  inner->addWidget(open, 0, Qt::AlignLeft);
  inner->addWidget(or_built_in);
  inner->addLayout(grid);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(margin, 24, margin, 24);
  layout->addStretch(2);
  layout->addWidget(column_, 0, Qt::AlignHCenter);
  layout->addStretch(3);
  // The column follows the page's width, and must not hold the window to it.
  layout->setSizeConstraint(QLayout::SetNoConstraint);
  setMinimumWidth(2 * margin + button_width + gap + narrowest_words);
  connect(open, &QPushButton::clicked, this, &WelcomePage::open_clicked);
}

void WelcomePage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  // A grid does not ask wrapped words for their height at the width they will get.
  const int column_width = std::min(width() - 2 * margin, 760);
  const int words_width = std::max(column_width - button_width - gap, narrowest_words);
  column_->setFixedWidth(button_width + gap + words_width);
  for (QLabel* summary : summaries_)
    summary->setFixedHeight(std::max(summary->heightForWidth(words_width), 32));
}

}  // namespace transillum::viewer
