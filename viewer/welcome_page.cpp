// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "welcome_page.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPixmap>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "theme.h"
#include "transillum/scene.h"

// Resources of a static library are found only once it is asked for them.
static void find_resources() { Q_INIT_RESOURCE(pictures); }

namespace transillum::viewer {

namespace {

constexpr QSize picture_size{240, 150};
constexpr int margin = 28, gap = 14, padding = 8, most_columns = 3;

// A scene's picture, name and sentence; the whole of it is the button.
QPushButton* make_card(const BuiltInScene& scene) {
  const QString name = QString::fromStdString(scene.name);
  auto* card = new QPushButton;
  card->setObjectName(QStringLiteral("built_in_") + name);
  card->setAccessibleName(name);
  card->setToolTip(QString::fromStdString(scene.summary));
  auto* picture = new QLabel;
  picture->setFixedSize(picture_size);
  picture->setScaledContents(true);
  picture->setPixmap(QPixmap(QStringLiteral(":/pictures/scene-%1.png").arg(name)));
  auto* title = new QLabel(name);
  QFont bold = title->font();
  bold.setBold(true);
  title->setFont(bold);
  auto* summary = new QLabel(QString::fromStdString(scene.summary));
  summary->setWordWrap(true);
  summary->setForegroundRole(QPalette::PlaceholderText);
  summary->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  auto* layout = new QVBoxLayout(card);
  layout->setContentsMargins(padding, padding, padding, padding);
  layout->setSpacing(4);
  for (QLabel* label : {picture, title, summary}) {
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    layout->addWidget(label);
  }
  layout->setStretch(2, 1);
  const int words = std::max(summary->heightForWidth(picture_size.width()),
                             4 * summary->fontMetrics().lineSpacing());
  card->setFixedSize(picture_size.width() + 2 * padding,
                     picture_size.height() + 3 * padding + title->sizeHint().height() + words);
  return card;
}

}  // namespace

WelcomePage::WelcomePage(QWidget* parent) : QScrollArea(parent) {
  find_resources();
  auto* title = new QLabel(tr("See light settle"));
  QFont large = font();
  large.setPixelSize(24);
  large.setBold(true);
  title->setFont(large);
  auto* words = new QLabel(
      tr("Choose a scene: it is solved at once, direction by direction. Or open one of your own, "
         "or drop its file here."));
  words->setWordWrap(true);
  auto* open = new QPushButton(theme::icon(theme::Icon::open), tr("Open a file…"));
  auto* lesson = new QPushButton(theme::icon(theme::Icon::run), tr("Begin with a lesson"));
  lesson->setObjectName("begin_lesson");
  auto* buttons = new QHBoxLayout;
  for (QPushButton* button : {lesson, open}) {
    button->setIconSize(QSize(20, 20));
    buttons->addWidget(button);
  }
  buttons->addStretch(1);

  grid_ = new QGridLayout;
  grid_->setSpacing(gap);
  for (const BuiltInScene& scene : built_in_scenes()) {
    cards_ << make_card(scene);
    const QString name = QString::fromStdString(scene.name);
    connect(cards_.back(), &QPushButton::clicked, this,
            [this, name] { emit built_in_clicked(name); });
  }
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(margin, margin, margin, margin);
  column->setSpacing(gap);
  column->addWidget(title);
  column->addWidget(words);
  column->addLayout(buttons);
  column->addLayout(grid_);
  column->addStretch(1);
  setWidget(page);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setMinimumWidth(2 * margin + cards_.front()->width() + 20);
  place_cards();
  connect(open, &QPushButton::clicked, this, &WelcomePage::open_clicked);
  connect(lesson, &QPushButton::clicked, this, &WelcomePage::lesson_clicked);
}

void WelcomePage::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  place_cards();
}

void WelcomePage::place_cards() {
  const int room = viewport()->width() - 2 * margin + gap;
  const int columns = std::clamp(room / (cards_.front()->width() + gap), 1, most_columns);
  if (columns == columns_) return;
  columns_ = columns;
  for (int k = 0; k < cards_.size(); ++k)
    grid_->addWidget(cards_[k], k / columns, k % columns, Qt::AlignLeft | Qt::AlignTop);
  grid_->setColumnStretch(most_columns, 1);
}

}  // namespace transillum::viewer
