// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The page shown before a scene is open. Input: the built-in scenes, with pictures from the
// resources, and what the window knows: layouts, lessons and recent files.
#include "scene/start_page.h"

#include <QAbstractButton>
#include <QAction>
#include <QEvent>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QScrollBar>
#include <QTimer>
#include <algorithm>

#include "support/first_sentence.h"
#include "transillum/scene.h"
#include "widgets/build.h"
#include "widgets/theme.h"

// The resources of a static library must be initialized explicitly.
static void init_resources() { Q_INIT_RESOURCE(pictures); }

namespace transillum::viewer {

namespace {

constexpr int page_margin = 28, card_gap = 12, card_padding = 10;
constexpr int small_picture_height = 40, small_picture_width = 62;
constexpr int least_picture_height = 66, most_picture_height = 150;
constexpr double picture_ratio = 0.44, flat_picture_ratio = 0.28;
constexpr int low_height = 640;  // a lower page has flat pictures
constexpr int least_files_width = 220, most_files_width = 290, least_card_width = 150;
constexpr double files_part = 0.185;  // fraction of the page's width
constexpr double small_type = 0.88, heading_type = 1.1, choice_type = 1.3;

QFont scaled_font(QFont font, double factor, bool bold) {
  font.setPixelSize(qRound(factor * QFontInfo(font).pixelSize()));
  font.setBold(bold);
  return font;
}

int height_of(const QString& text, const QFontMetrics& metrics, int width) {
  constexpr int any_height = 10'000;
  return metrics.boundingRect(QRect(0, 0, width, any_height), Qt::TextWordWrap, text).height();
}

/// The text with as many of its words as fit, in lines of this width, into this height.
QString shortened(const QString& text, const QFontMetrics& metrics, int width, int height) {
  QString fitting = text;
  for (QString words = text; height_of(fitting, metrics, width) > height;) {
    const int space = words.lastIndexOf(QLatin1Char(' '));
    if (space < 0) {
      return metrics.elidedText(text, Qt::ElideRight, width);
    }
    words.truncate(space);
    fitting = words + QStringLiteral("…");
  }
  return fitting;
}

/// Draws the middle of a picture, which fills `rect`.
void draw_filling(QPainter& painter, const QRect& rect, const QPixmap& picture) {
  const double ratio = painter.device()->devicePixelRatioF();
  QPixmap scaled =
      picture.scaled(rect.size() * ratio, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation);
  scaled.setDevicePixelRatio(ratio);
  const QSizeF size = QSizeF(scaled.size()) / ratio;
  painter.save();
  painter.setClipRect(rect, Qt::IntersectClip);
  painter.drawPixmap(QRectF(rect).center() - QPointF(size.width(), size.height()) / 2, scaled);
  painter.restore();
}

}  // namespace

class StartCard : public QAbstractButton {
 public:
  enum class Look { choice, picture_above, picture_left };

  StartCard(Look look, const QString& title, const QString& note, const QPixmap& picture = {})
      : look_(look), note_(note), picture_(picture) {
    setText(title);
    setAccessibleName(title);
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_Hover);
    setCursor(Qt::PointingHandCursor);
  }

  /// @param flat  whether a picture above the text is flat
  void set_width(int width, bool flat) {
    ratio_ = flat ? flat_picture_ratio : picture_ratio;
    const int line = fontMetrics().lineSpacing();
    const int padding = theme::scaled(card_padding);
    int height = 0;
    switch (look_) {
      case Look::choice:
        height = qRound(choice_type * line) + line + 2 * padding;
        break;
      case Look::picture_above:
        height = picture_height(width) + 3 * line + padding;
        break;
      case Look::picture_left:
        height = std::max(theme::scaled(small_picture_height) + 2,
                          2 * line + fontMetrics().height() + padding / 2);
        break;
    }
    setFixedSize(std::max(width, 1), height);
  }
  /// @param read  how much of it has been read, 0 to 1: a bar at the bottom
  void set_progress(bool first_hour, double read) {
    first_hour_ = first_hour;
    read_ = read;
  }

  /// Whether the title is whole, in the width that is set.
  bool title_fits(double type) const {
    const QFontMetrics metrics(scaled_font(font(), type, look_ != Look::picture_left));
    const int lines = title_lines();
    const int most = (lines - 1) * metrics.lineSpacing() + metrics.height();
    return height_of(text(), metrics, text_room().width()) <= most;
  }
  /// Whether the texts are whole that a card has room for beside its picture. Other cards have as
  /// much of a summary as fits.
  bool text_fits(double type) const {
    const bool is_note_whole =
        look_ != Look::picture_left ||
        QFontMetrics(scaled_font(font(), small_type, false)).horizontalAdvance(note_) <=
            text_room().width();
    return look_ == Look::picture_above || (title_fits(type) && is_note_whole);
  }
  /// @param type  factor of the size of the title's letters
  void set_title_type(double type) {
    title_type_ = type;
    setProperty("title_fits", title_fits(type));
    setProperty("text_fits", text_fits(type));
    update();
  }

  // The button does not know its content.
  QSize sizeHint() const override { return size(); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    const bool marked = underMouse() || hasFocus();
    QPainterPath outline;
    outline.addRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 7, 7);
    painter.fillPath(outline, isDown() ? theme::hover : theme::paper);
    painter.setClipPath(outline);
    draw_content(painter);
    const int bar = theme::scaled(3);
    painter.fillRect(QRectF(0, height() - bar, read_ * width(), bar), theme::accent);
    painter.setClipping(false);
    painter.setPen(QPen(marked ? theme::accent : theme::rule, marked ? 2 : 1));
    painter.drawPath(outline);
  }

 private:
  int picture_height(int width) const {
    return std::clamp(qRound(ratio_ * width), theme::scaled(least_picture_height),
                      theme::scaled(most_picture_height));
  }

  int title_lines() const { return look_ == Look::picture_left ? 2 : 1; }
  QRect picture_place() const {
    switch (look_) {
      case Look::choice:
        break;
      case Look::picture_above:
        return {0, 0, width(), picture_height(width())};
      case Look::picture_left:
        return {0, 0, theme::scaled(small_picture_width), height()};
    }
    return {};
  }
  QRect text_room() const {
    const int padding = theme::scaled(card_padding);
    QRect room = rect().adjusted(padding, padding / 2, -padding, -padding / 2);
    if (look_ == Look::picture_above) {
      room.setTop(picture_place().height() + padding / 2);
    } else if (look_ == Look::picture_left) {
      room.setLeft(picture_place().width() + padding);
    }
    return room;
  }

  void draw_content(QPainter& painter) const {
    if (look_ != Look::choice) {
      draw_filling(painter, picture_place(), picture_);
    }
    const QRect room = text_room();
    const double type = look_ == Look::choice ? choice_type : title_type_;
    painter.setFont(scaled_font(font(), type, look_ != Look::picture_left));
    painter.setPen(theme::ink);
    // The tool tip has the whole texts.
    const auto fitting = [&](const QString& text, int lines) {
      const QFontMetrics metrics = painter.fontMetrics();
      const int most = (lines - 1) * metrics.lineSpacing() + metrics.height();
      return shortened(text, metrics, room.width(), most);
    };
    const QString name = fitting(text(), title_lines());
    const int used = height_of(name, painter.fontMetrics(), room.width());
    const QFont note_font = scaled_font(font(), look_ == Look::choice ? 1 : small_type, false);
    const int note_lines = look_ == Look::picture_above ? 2 : 1;
    const QFontMetrics note_metrics(note_font);
    const int note_height = (note_lines - 1) * note_metrics.lineSpacing() + note_metrics.height();
    const QRect title(room.left(), room.center().y() - (used + note_height) / 2 + 1, room.width(),
                      used);
    // Lines that are rounded up would lose the lowest pixels of their letters.
    constexpr int flags = Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap | Qt::TextDontClip;
    painter.drawText(title, flags, name);
    painter.setFont(note_font);
    painter.setPen(first_hour_ ? theme::accent : theme::ink_dim);
    const QRect note(room.left(), title.bottom() + 1, room.width(), note_height);
    painter.drawText(note, flags, fitting(note_, note_lines));
  }

  Look look_;
  QString note_;
  QPixmap picture_;
  double ratio_ = picture_ratio, read_ = 0, title_type_ = 1;
  bool first_hour_ = false;
};

StartPage::StartPage(QWidget* parent) : QScrollArea(parent) {
  init_resources();
  auto* content = new QWidget;
  page_ = new QGridLayout(content);
  page_->setContentsMargins(page_margin, card_gap + 4, page_margin, card_gap);
  page_->setHorizontalSpacing(2 * card_gap);
  page_->setVerticalSpacing(card_gap);
  for (Grid* grid : {&choices_, &scenes_, &lessons_, &recent_}) {
    grid->layout = new QGridLayout;
    grid->layout->setSpacing(card_gap);
    grid->layout->setVerticalSpacing(card_gap - 4);
  }
  choices_.most_columns = 3;
  scenes_.most_columns = 4;
  lessons_.most_columns = 4;
  recent_.most_columns = 1;
  recent_.layout->setSpacing(card_gap / 2);
  loading_ = named("start_loading", new QLabel);
  loading_->hide();
  auto* left = make_column({}, card_gap - 4);
  add_heading(*left, tr("Scenes"));
  left->addLayout(scenes_.layout);
  left->addSpacing(4);
  auto* heading = make_row({}, 8);
  add_heading(*heading, tr("Lessons"));
  lessons_hint_ = note_label({});
  heading->addWidget(lessons_hint_, 1, Qt::AlignBottom);
  left->addLayout(heading);
  left->addLayout(lessons_.layout);
  left->addStretch(1);
  files_ = make_files();
  page_->addWidget(loading_, 0, 0, 1, 2);
  page_->addLayout(choices_.layout, 1, 0, 1, 2);
  page_->addLayout(left, 2, 0);
  page_->setColumnStretch(0, 1);
  page_->setRowStretch(4, 1);
  for (const BuiltInScene& scene : built_in_scenes()) {
    const QString name = QString::fromStdString(scene.name);
    const QString summary = first_sentence(scene.summary);  // others are about parameters
    auto* card = named("built_in_" + name,
                       new StartCard(StartCard::Look::picture_above, name, summary,
                                     QPixmap(QStringLiteral(":/pictures/scene-%1.png").arg(name))),
                       summary);
    connect(card, &StartCard::clicked, this, [this, name] { emit built_in_clicked(name); });
    scenes_.cards << card;
  }
  setWidget(content);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  arrange();
}

QLabel* StartPage::add_heading(QBoxLayout& column, const QString& text) {
  headings_ << new QLabel(text);
  column.addWidget(headings_.back());
  return headings_.back();
}

QWidget* StartPage::make_files() {
  auto* files = new QWidget;
  auto* column = make_column(files, {}, card_gap - 4);
  add_heading(*column, tr("Your files"));
  auto* open = named("start_open", new QPushButton(theme::icon(theme::Icon::open), tr("Open…")));
  open->setToolTip(tr("Open a scene, a result, a session or a lesson (Ctrl+O)"));
  open->setDefault(true);
  open->setMinimumHeight(theme::scaled(34));
  column->addWidget(open);
  column->addWidget(note_label(tr("or drop a scene, a result, a session or a lesson here")));
  column->addSpacing(4);
  column->addLayout(recent_.layout);
  column->addStretch(1);
  connect(open, &QPushButton::clicked, this, &StartPage::open_clicked);
  return files;
}

void StartPage::clear(Grid& grid) {
  qDeleteAll(grid.cards);
  grid.cards.clear();
}

void StartPage::set_choices(const QList<QAction*>& choices) {
  clear(choices_);
  for (QAction* action : choices) {
    auto* card = named("choose_" + action->objectName(),
                       new StartCard(StartCard::Look::choice, action->text(),
                                     action->toolTip().section(QStringLiteral(" ("), 0, 0)),
                       action->toolTip());
    connect(card, &StartCard::clicked, action, &QAction::trigger);
    choices_.cards << card;
  }
  arrange();
}

void StartPage::set_lessons(const QVector<LessonEntry>& lessons, const QString& hint) {
  clear(lessons_);
  lessons_hint_->setText(hint);
  for (const LessonEntry& lesson : lessons) {
    const int number = lessons_.cards.size();
    QString note = lesson.minutes > 0 ? tr("%1 min").arg(lesson.minutes) : tr("lesson");
    if (lesson.place > 0) {
      note = tr("First hour · %1").arg(note);
    }
    if (lesson.read == 1) {
      note = tr("✓ %1").arg(note);
    }
    auto* card =
        named(QStringLiteral("lesson_%1").arg(number + 1),
              new StartCard(StartCard::Look::picture_left, lesson.title, note, lesson.picture),
              lesson.title);
    card->set_progress(lesson.place > 0, lesson.read);
    connect(card, &StartCard::clicked, this, [this, number] { emit lesson_clicked(number); });
    lessons_.cards << card;
  }
  arrange();
}

void StartPage::set_recent(const QVector<RecentFile>& files) {
  clear(recent_);
  for (const RecentFile& file : files) {
    const QFileInfo info(file.path);
    QPixmap picture = file.picture;
    if (picture.isNull()) {
      picture = theme::icon(theme::Icon::scene).pixmap(small_picture_height);
    }
    auto* card =
        named("recent_" + info.fileName(),
              new StartCard(StartCard::Look::picture_left, info.fileName(), info.path(), picture),
              file.path);
    connect(card, &StartCard::clicked, this,
            [this, path = file.path] { emit recent_clicked(path); });
    recent_.cards << card;
  }
  arrange();
}

void StartPage::set_loading(const QString& name) {
  loading_->setText(loading_->fontMetrics().elidedText(tr("Loading %1…").arg(name), Qt::ElideMiddle,
                                                       viewport()->width() - 2 * page_margin));
  loading_->setToolTip(name);
  loading_->setVisible(!name.isEmpty());
}

void StartPage::changeEvent(QEvent* event) {
  QScrollArea::changeEvent(event);
  // The call is made later, when the cards have the new font.
  if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
    QTimer::singleShot(0, this, &StartPage::arrange);
  }
}

void StartPage::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  arrange();
}

void StartPage::arrange() {
  for (QLabel* heading : headings_) {
    heading->setFont(scaled_font(font(), heading_type, true));
    set_strong(*heading);
  }
  const int room = width() - 2 * page_margin - verticalScrollBar()->sizeHint().width();
  const int beside = std::clamp(qRound(files_part * room), theme::scaled(least_files_width),
                                theme::scaled(most_files_width));
  // In a narrow window the files are below.
  const bool wide = room > 2 * beside + 2 * card_gap;
  files_->setFixedWidth(wide ? beside : std::max(room, least_card_width));
  page_->addWidget(files_, wide ? 2 : 3, wide ? 1 : 0, Qt::AlignTop);
  const int left = wide ? room - beside - 2 * card_gap : room;
  place(choices_, room);
  place(scenes_, left);
  place(lessons_, left);
  place(recent_, files_->width());
}

void StartPage::place(Grid& grid, int room) const {
  const int least = theme::scaled(least_card_width) + card_gap;
  int columns = std::clamp((room + card_gap) / least, 1, grid.most_columns);
  const auto fit = [&grid](double type) {
    return std::all_of(grid.cards.begin(), grid.cards.end(),
                       [type](const StartCard* card) { return card->text_fits(type); });
  };
  const auto set_columns = [&](int count) {
    const int across = (room - (count - 1) * card_gap) / count;
    for (StartCard* card : grid.cards) {
      card->set_width(across, viewport()->height() < theme::scaled(low_height));
    }
  };
  set_columns(columns);
  while (columns > 1 && !fit(small_type)) {
    set_columns(--columns);
  }
  // One size for all, so that all are whole where it is possible.
  const double type = fit(1) ? 1 : small_type;
  for (int k = 0; k < grid.cards.size(); ++k) {
    grid.cards[k]->set_title_type(type);
    grid.layout->addWidget(grid.cards[k], k / columns, k % columns);
  }
}

}  // namespace transillum::viewer
