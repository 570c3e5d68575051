// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The page shown before a scene is open: one card per built-in scene, with its name, summary and a
// picture from the resources.
#include "scene/welcome_page.h"

#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPixmap>
#include <QPushButton>
#include <QScrollBar>
#include <QTimer>
#include <algorithm>

#include "transillum/scene.h"
#include "widgets/build.h"
#include "widgets/theme.h"

// The resources of a static library must be initialized explicitly.
static void init_resources() { Q_INIT_RESOURCE(pictures); }

namespace transillum::viewer {

namespace {

constexpr QSize picture_size{240, 150};
constexpr int margin = 28, gap = 14, padding = 8, max_columns = 3, min_lines = 4;

}  // namespace

/// A button with a scene's picture, name and summary.
class WelcomePage::Card : public QPushButton {
 public:
  explicit Card(const BuiltInScene& scene) {
    const QString name = QString::fromStdString(scene.name);
    setObjectName(QStringLiteral("built_in_") + name);
    setAccessibleName(name);
    setToolTip(QString::fromStdString(scene.summary));
    picture_ = new QLabel;
    picture_->setScaledContents(true);
    picture_->setPixmap(QPixmap(QStringLiteral(":/pictures/scene-%1.png").arg(name)));
    title_ = new QLabel(QStringLiteral("<b>%1</b>").arg(name));
    summary_ = note_label(QString::fromStdString(scene.summary));
    summary_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    auto* layout = make_column(this, {padding, padding, padding, padding}, 4);
    for (QLabel* label : {picture_, title_, summary_}) {
      label->setAttribute(Qt::WA_TransparentForMouseEvents);
      layout->addWidget(label);
    }
    layout->setStretch(2, 1);
  }

  /// Sizes the card by its font, with room for at least `lines` lines of summary.
  void measure(int lines) {
    const QSize size(theme::scaled(picture_size.width()), theme::scaled(picture_size.height()));
    picture_->setFixedSize(size);
    const int summary_height = std::max(summary_->heightForWidth(size.width()),
                                        lines * summary_->fontMetrics().lineSpacing());
    setFixedSize(size.width() + 2 * padding,
                 size.height() + 3 * padding + title_->sizeHint().height() + summary_height);
  }

 private:
  QLabel* picture_;
  QLabel* title_;
  QLabel* summary_;
};

WelcomePage::WelcomePage(QWidget* parent) : QScrollArea(parent) {
  init_resources();
  title_ = named("welcome_title", new QLabel);
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* hint =
      new QLabel(tr("The scene is solved immediately, one direction after another. You can also "
                    "open your own file "
                    "or drop it here."));
  hint->setWordWrap(true);
  auto* open = new QPushButton(theme::icon(theme::Icon::open), tr("Open a file…"));
  auto* lesson = named("begin_lesson",
                       new QPushButton(theme::icon(theme::Icon::run), tr("Start with a lesson")));
  auto* buttons = new QHBoxLayout;
  back_ = named("back_to_scene", new QPushButton(tr("Back to the open scene")));
  back_->hide();
  for (QPushButton* button : {lesson, open, back_}) {
    buttons->addWidget(button);
  }
  buttons->addStretch(1);

  grid_ = new QGridLayout;
  grid_->setSpacing(gap);
  for (const BuiltInScene& scene : built_in_scenes()) {
    cards_ << new Card(scene);
    const QString name = QString::fromStdString(scene.name);
    connect(cards_.back(), &QPushButton::clicked, this,
            [this, name] { emit built_in_clicked(name); });
  }
  auto* page = new QWidget;
  auto* column = make_column(page, {margin, margin, margin, margin}, gap);
  column->addWidget(title_);
  column->addWidget(hint);
  column->addLayout(buttons);
  column->addLayout(grid_);
  column->addStretch(1);
  setWidget(page);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  measure();
  connect(back_, &QPushButton::clicked, this, &WelcomePage::back_clicked);
  connect(open, &QPushButton::clicked, this, &WelcomePage::open_clicked);
  connect(lesson, &QPushButton::clicked, this, &WelcomePage::lesson_clicked);
}

void WelcomePage::show_back_button() { back_->show(); }

void WelcomePage::changeEvent(QEvent* event) {
  QScrollArea::changeEvent(event);
  // The call is made later, when the cards have the new font.
  if (event->type() == QEvent::FontChange) {
    QTimer::singleShot(0, this, &WelcomePage::measure);
  }
}

void WelcomePage::set_loading(const QString& name) {
  loading_ = name;
  show_title();
}

void WelcomePage::show_title() {
  QString title = loading_.isEmpty() ? tr("Choose a scene") : tr("Loading %1…").arg(loading_);
  title_->setToolTip(loading_);
  QFont bold = font();
  bold.setBold(true);
  bold.setPixelSize(theme::scaled(24));
  title = QFontMetrics(bold).elidedText(title, Qt::ElideMiddle, viewport()->width() - 2 * margin);
  // The title is HTML: a font set on the label would be lost when the style sheet changes.
  title_->setText(QStringLiteral("<span style='font-size: %1px; font-weight: bold'>%2</span>")
                      .arg(theme::scaled(24))
                      .arg(title.toHtmlEscaped()));
}

void WelcomePage::measure() {
  show_title();
  for (Card* card : cards_) {
    card->measure(min_lines);
  }
  setMinimumWidth(2 * margin + cards_.front()->width() + verticalScrollBar()->sizeHint().width());
  place_cards();
}

void WelcomePage::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  show_title();
  place_cards();
}

void WelcomePage::place_cards() {
  const int room = viewport()->width() - 2 * margin + gap;
  const int columns = std::clamp(room / (cards_.front()->width() + gap), 1, max_columns);
  if (columns == columns_) {
    return;
  }
  columns_ = columns;
  for (int k = 0; k < cards_.size(); ++k) {
    grid_->addWidget(cards_[k], k / columns, k % columns, Qt::AlignLeft | Qt::AlignTop);
  }
  grid_->setColumnStretch(max_columns, 1);
}

}  // namespace transillum::viewer
