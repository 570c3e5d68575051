// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "welcome_page.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "theme.h"
#include "transillum/scene.h"

namespace transillum::viewer {

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
  grid->setHorizontalSpacing(14);
  grid->setVerticalSpacing(8);
  grid->setColumnStretch(1, 1);
  int row = 0;
  for (const BuiltInScene& scene : built_in_scenes()) {
    const QString name = QString::fromStdString(scene.name);
    auto* button = new QPushButton(theme::icon(theme::Icon::scene), name);
    button->setObjectName(QStringLiteral("built_in_") + name);
    button->setIconSize(QSize(20, 20));
    button->setMinimumWidth(150);
    button->setStyleSheet(QStringLiteral("text-align: left; padding: 5px 10px;"));
    auto* summary = new QLabel(QString::fromStdString(scene.summary));
    summary->setWordWrap(true);
    summary->setForegroundRole(QPalette::PlaceholderText);
    grid->addWidget(button, row, 0);
    grid->addWidget(summary, row++, 1);
    connect(button, &QPushButton::clicked, this, [this, name] { emit built_in_clicked(name); });
  }

  auto* column = new QWidget;
  column->setMaximumWidth(660);
  auto* inner = new QVBoxLayout(column);
  inner->setSpacing(14);
  inner->addWidget(title);
  inner->addWidget(open, 0, Qt::AlignLeft);
  inner->addWidget(or_built_in);
  inner->addLayout(grid);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(32, 24, 32, 24);
  layout->addStretch(2);
  layout->addWidget(column, 0, Qt::AlignHCenter);
  layout->addStretch(3);
  connect(open, &QPushButton::clicked, this, &WelcomePage::open_clicked);
}

}  // namespace transillum::viewer
