// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Lesson": text and page turning. Each page turned to is passed on by page_shown(); the
// window applies its state.
#include "lessons/lesson_panel.h"

#include <QApplication>
#include <QComboBox>
#include <QDesktopServices>
#include <QFontInfo>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QScopedValueRollback>
#include <QScrollBar>
#include <QSettings>
#include <QTimer>
#include <QUrl>
#include <algorithm>
#include <utility>

#include "lessons/control_widget.h"
#include "lessons/page_text.h"
#include "lessons/question_box.h"
#include "lessons/symbols.h"
#include "lessons/tally.h"
#include "support/failure_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/elided.h"
#include "widgets/markdown.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr double text_scale = 1.25,
                 title_scale = 1.6;  // relative to the window's font, for projectors
const QString lesson_scheme = QStringLiteral("lesson"),
              pages_seen_key = QStringLiteral("lessons/pages-seen/");

QToolButton* wide_button_for(QAction* action, Qt::ToolButtonStyle style) {
  auto* button = button_for(action);
  button->setToolButtonStyle(style);
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  return button;
}

}  // namespace

LessonPanel::LessonPanel(std::vector<Lesson> lessons, Selection& selection, Focus& focus,
                         MaterialEdits& edits, QWidget* parent)
    : QWidget(parent),
      lessons_(std::move(lessons)),
      selection_(selection),
      focus_(focus),
      edits_(edits),
      question_(new QuestionBox(selection, focus)) {
  make_page();
  make_actions();
  auto* layout = make_column(this, {12, 10, 12, 10}, 10);
  layout->addWidget(list_);
  layout->addWidget(title_);
  layout->addWidget(text_, 1);
  layout->addWidget(question_);
  layout->addLayout(make_buttons());
  connect(question_, &QuestionBox::revealed, this, &LessonPanel::page_shown);
  connect(question_, &QuestionBox::then_shown, this, [this] {
    show_state();
    point_at({});
    if (question_->solved()) {  // the explanation ends the text
      QTimer::singleShot(0, text_, [this] {
        text_->verticalScrollBar()->setValue(text_->verticalScrollBar()->maximum());
      });
    }
  });
  connect(question_, &QuestionBox::sketched, this, &LessonPanel::sketched);
  connect(question_, &QuestionBox::failed, this, &LessonPanel::failed);
  connect(question_, &QuestionBox::values_hidden, this, &LessonPanel::values_hidden);
  fill_list();
  show_state();
}

void LessonPanel::make_page() {
  list_ = named("lesson_list", new ElidedComboBox);
  list_->setPlaceholderText(tr("Lessons"));
  list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  qApp->installEventFilter(this);
  title_ = named("lesson_title", new QLabel);
  title_->setWordWrap(true);
  text_ = named("lesson_text", new PageText);
  text_->setOpenLinks(false);
  text_->setMinimumHeight(2 * text_->fontMetrics().lineSpacing() + 8);  // beside a long question
  connect(text_, &QTextBrowser::anchorClicked, this, [this](const QUrl& link) {
    if (link.scheme().startsWith(QStringLiteral("http"))) {
      QDesktopServices::openUrl(link);
    } else if (link.scheme() == lesson_scheme) {
      show_page(link.path().toInt(), 0);
    }
  });
  connect(text_, qOverload<const QUrl&>(&QTextBrowser::highlighted), this,
          [this](const QUrl& link) { point_at(link.toString()); });
  text_->setFrameShape(QFrame::NoFrame);
  text_->setFocusPolicy(Qt::ClickFocus);
  text_->installEventFilter(this);
  page_number_ = named("lesson_place", new QLabel);
  page_number_->setAlignment(Qt::AlignCenter);
  connect(list_, qOverload<int>(&QComboBox::activated), this, [this](int row) {
    if (row < static_cast<int>(lessons_.size())) {
      show_page(row, 0);
    } else {
      emit open_clicked();
    }
    show_state();
  });
}

void LessonPanel::make_actions() {
  previous_ = make_action(this, "lesson_previous", tr("Previous page"),
                          tr("Go to the previous page (Page Up)"), Qt::Key_PageUp);
  next_ = make_action(this, "lesson_next", tr("Next page"),
                      tr("Go to the next page (Page Down, also sent by presenter remotes)"),
                      Qt::Key_PageDown);
  again_ = make_action(this, "lesson_again", tr("Show this page again"),
                       tr("Restore the window to the state of this page"), QKeySequence("Ctrl+L"));
  open_ =
      make_action(this, "lesson_open", tr("Open a lesson…"), tr("Open a lesson from a JSON file"));
  keep_ = make_action(this, "tally_keep", tr("Keep the tally"),
                      tr("Keep the answers of the class in a file, and add those that it has; "
                         "otherwise they are forgotten with the window"));
  keep_->setCheckable(true);
  connect(keep_, &QAction::toggled, this, &LessonPanel::keep_tallies);
  previous_->setIcon(theme::icon(theme::Icon::step_back));
  next_->setIcon(theme::icon(theme::Icon::step_on));
  connect(previous_, &QAction::triggered, this, [this] { turn(-1); });
  connect(next_, &QAction::triggered, this, [this] {
    if (!scroll_on()) {
      turn(1);
    }
  });
  connect(again_, &QAction::triggered, this, [this] { turn(0); });
  connect(open_, &QAction::triggered, this, &LessonPanel::open_clicked);
}

QLayout* LessonPanel::make_buttons() {
  auto* buttons = make_row({}, 8);
  buttons->addWidget(wide_button_for(previous_, Qt::ToolButtonTextBesideIcon), 2);
  buttons->addWidget(page_number_, 1);
  buttons->addWidget(wide_button_for(next_, Qt::ToolButtonTextBesideIcon), 2);
  return buttons;
}

void LessonPanel::add_to(QMenu& menu) {
  auto* lessons = new QMenu(tr("Lessons"), &menu);
  connect(lessons, &QMenu::aboutToShow, this, [this, lessons] {
    lessons->clear();
    for (int k = 0; k < static_cast<int>(lessons_.size()); ++k) {
      const QString place = place_text(k);
      lessons->addAction(list_->itemText(k) + (place.isEmpty() ? QString() : '\t' + place), this,
                         [this, k] { show_page(k, 0); });
    }
  });
  menu.addMenu(lessons);
  for (QAction* action : {open_, previous_, next_, again_}) {
    menu.addAction(action);
  }
  menu.addSeparator();
  for (QAction* action : question_->actions()) {
    menu.addAction(action);
  }
  menu.addAction(keep_);
}

void LessonPanel::add(Lesson lesson) {
  lessons_.insert(lessons_.begin(), std::move(lesson));
  fill_list();
}

void LessonPanel::fill_list() {
  list_->clear();
  for (const Lesson& lesson : lessons_) {
    list_->addItem(QString::fromStdString(lesson.title));
  }
  list_->addItem(tr("Open a lesson…"));
}

void LessonPanel::show_page(int lesson, int page) {
  if (!guard_()) {
    show_state();
    return;
  }
  lesson_ = lesson;
  page_ = page;
  int& seen = pages_seen_[at(lessons_, lesson).file];
  seen = std::max(seen, page + 1);
  show_question();
  show_state();
  emit page_shown(at(at(lessons_, lesson).pages, page).state);
  emit enlarged(at(at(lessons_, lesson).pages, page).large);
  point_at({});
  emit values_hidden(question_->hides_values());
  emit errors_wanted(at(at(lessons_, lesson).pages, page).errors);
  // Last: the new page dismisses older messages.
  if (!tally_failure_.isEmpty()) {
    emit failed(std::exchange(tally_failure_, QString()));
  }
}

void LessonPanel::continue_lesson(int lesson) {
  const int seen = pages_seen(lesson);
  show_page(lesson, seen < pages_of(lesson) ? std::max(0, seen - 1) : 0);
}

int LessonPanel::pages_seen(int lesson) const {
  const auto found = pages_seen_.find(at(lessons_, lesson).file);
  return found == pages_seen_.end() ? 0 : std::min(found->second, pages_of(lesson));
}

void LessonPanel::save(QSettings& settings) const {
  for (int k = 0; k < std::ssize(lessons_); ++k) {
    if (at(lessons_, k).built_in) {
      settings.setValue(pages_seen_key + QString::fromStdString(at(lessons_, k).file),
                        pages_seen(k));
    }
  }
}

void LessonPanel::load(const QSettings& settings) {
  for (const Lesson& lesson : lessons_) {
    const QString key = pages_seen_key + QString::fromStdString(lesson.file);
    if (lesson.built_in && settings.contains(key)) {
      pages_seen_[lesson.file] = std::max(0, settings.value(key).toInt());
    }
  }
}

void LessonPanel::leave_scene() {
  question_->leave_scene();
  emit callouts_shown({});
  emit errors_wanted({});
  emit values_hidden(false);
}

void LessonPanel::point_at(const QString& link) {
  if (lesson_ < 0) {
    return;
  }
  std::vector<Callout> callouts = at(at(lessons_, lesson_).pages, page_).callouts;
  for (Callout& callout : callouts_of_symbol(link, focus_, selection_)) {
    callouts.push_back(std::move(callout));
  }
  if (const std::optional<PatchId> right = question_->right_patch()) {
    callouts.push_back({tr("the answer").toStdString(), Callout::Anchor::patch, *right, {}});
  }
  emit callouts_shown(callouts);
  emit symbol_pointed(link.section(':', 1));
}

void LessonPanel::show_question() {
  const Lesson& lesson = at(lessons_, lesson_);
  const auto page = std::make_shared<const Lesson::Page>(at(lesson.pages, page_));
  question_->show_page(page, page_, page->question ? tally_of(lesson) : nullptr);
}

// Two lessons from the same file share one.
std::shared_ptr<Tally> LessonPanel::tally_of(const Lesson& lesson) {
  std::shared_ptr<Tally>& tally = tallies_[lesson.file];
  if (!tally) {
    tally = std::make_shared<Tally>();
    keep(*tally, lesson);
  }
  return tally;
}

void LessonPanel::keep(Tally& tally, const Lesson& lesson) {
  try {
    tally.keep(keep_->isChecked() ? tally_file(lesson, tally_folder_) : QString());
  } catch (const std::exception& error) {
    tally_failure_ = tr("%1. Answers are counted, but not kept").arg(failure_text(error));
  }
}

void LessonPanel::keep_tallies() {
  for (const Lesson& lesson : lessons_) {
    if (const auto found = tallies_.find(lesson.file); found != tallies_.end()) {
      keep(*found->second, lesson);
    }
  }
  question_->refresh();
  if (!tally_failure_.isEmpty()) {
    emit failed(std::exchange(tally_failure_, QString()));
  }
}

void LessonPanel::turn(int pages) {
  const int page = page_ + pages;
  if (lesson_ < 0) {
    show_page(0, 0);
  } else if (page < 0) {
    const int before = neighbor(-1);
    show_page(before, pages_of(before) - 1);
  } else if (page == pages_of(lesson_)) {
    show_page(neighbor(1), 0);
  } else {
    show_page(lesson_, page);
  }
}

int LessonPanel::neighbor(int step) const {
  for (int k = lesson_ + step; at(lessons_, lesson_).first_hour && has_index(lessons_, k);
       k += step) {
    if (at(lessons_, k).first_hour) {
      return k;
    }
  }
  return lesson_ + step;
}

int LessonPanel::pages_of(int lesson) const {
  return static_cast<int>(at(lessons_, lesson).pages.size());
}

bool LessonPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == text_ && event->type() == QEvent::Resize && theme::appearance().projector &&
      !fits_text_) {
    QTimer::singleShot(0, this, &LessonPanel::fit_text);
  }
  // The keys of a presenter turn pages, wherever the keyboard focus is, and do nothing else.
  const auto* widget = qobject_cast<QWidget*>(watched);
  if (event->type() == QEvent::KeyPress && lesson_ >= 0 && widget && widget->window() == window()) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_PageUp || key == Qt::Key_PageDown) {
      QAction* turn = key == Qt::Key_PageUp ? previous_ : next_;
      if (turn->isEnabled()) {
        turn->trigger();
      }
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

QFont LessonPanel::text_font(double scale) const {
  QFont large = font();
  large.setPixelSize(static_cast<int>(scale * QFontInfo(qApp->font()).pixelSize()));
  return large;
}

void LessonPanel::show_text(const Lesson::Page& page) {
  std::vector<PageText::Inset> insets;
  controls_.clear();
  for (const PageControl& control : page.controls) {
    auto* widget = new ControlWidget(control, focus_, edits_);
    widget->set_text_font(text_font(text_scale));
    widget->show_options(options_);
    connect(widget, &ControlWidget::option_chosen, this, &LessonPanel::option_chosen);
    controls_.push_back(widget);
    insets.push_back({'{' + QString::fromStdString(control.name) + '}', widget});
  }
  const std::string then = question_->solved() ? "\n\n" + page.question->then : "";
  const QString needs = page_ == 0 ? needs_text(lesson_) : QString();
  text_->show_page(
      (needs.isEmpty() ? needs : '*' + needs + "*\n\n") + window_text(page.text + then), insets);
}

void LessonPanel::show_snapshot(const SolverSnapshot& snapshot) {
  options_.solve = snapshot.options;
  options_.refine = snapshot.refine;
  options_.total = snapshot.total.has_value();
  for (ControlWidget* control : controls_) {
    control->show_options(options_);
  }
}

void LessonPanel::set_text_scale(double scale) {
  question_->set_text_font(text_font(scale));
  if (theme::appearance().projector) {
    question_->lay_out();
    layout()->activate();  // the question may leave less room to the text
  }
  text_->setFont(text_font(scale));
  spread_paragraphs(*text_->document());
  text_->place_insets();
}

// Pages are not scrolled on a projector: the type is as large as the page has room for.
void LessonPanel::fit_text() {
  constexpr double smallest = 0.95, largest = 1.6, step = 0.05;
  const QScopedValueRollback fitting(fits_text_, true);
  double scale = theme::appearance().projector ? largest : text_scale;
  set_text_scale(scale);
  while (theme::appearance().projector && is_cut_off() && scale > smallest) {
    scale -= step;
    set_text_scale(scale);
  }
}

bool LessonPanel::is_cut_off() const {
  return text_->document()->size().height() > text_->viewport()->height();
}

bool LessonPanel::scroll_on() {
  QScrollBar* bar = text_->verticalScrollBar();
  if (!theme::appearance().projector || bar->value() == bar->maximum()) {
    return false;
  }
  bar->setValue(bar->value() + bar->pageStep());
  return true;
}

/// The lessons as links, in Markdown.
QString LessonPanel::list_of_lessons() const {
  QString text =
      tr("Each page sets up the window. Explore as you like; *Show this page again* "
         "(Ctrl+L) restores the page's state.\n\n");
  for (int k = 0; k < static_cast<int>(lessons_.size()); ++k) {
    const Lesson& lesson = at(lessons_, k);
    QStringList notes = {needs_text(k), place_text(k)};
    notes.removeAll(QString());
    text += QStringLiteral("[%1](%2:%3)  \n%4\n\n")
                .arg(QString::fromStdString(lesson.title), lesson_scheme, QString::number(k),
                     notes.join(QStringLiteral(" · ")));
  }
  return text;
}

QString LessonPanel::place_text(int lesson) const {
  const FirstHour hour = first_hour_of(lessons_, lesson);
  return hour.place > 0 ? tr("First hour, %1 of %2").arg(hour.place).arg(hour.lessons) : QString();
}

QString LessonPanel::needs_text(int lesson) const {
  const Lesson& shown = at(lessons_, lesson);
  QStringList parts;
  if (shown.minutes > 0) {
    parts << tr("%1 min").arg(shown.minutes);
  }
  if (!shown.needs.empty()) {
    parts << tr("needs %1").arg(QString::fromStdString(shown.needs));
  }
  return parts.join(QStringLiteral(" · "));
}

void LessonPanel::show_state() {
  list_->setCurrentIndex(lesson_);
  const bool any = lesson_ >= 0;
  enable_if(*again_, any, tr("No lesson is open"));
  const bool first = any && page_ == 0, last = any && page_ + 1 == pages_of(lesson_);
  enable_if(*previous_, any && (!first || lesson_ > 0),
            any ? tr("This is the first page") : tr("No lesson is open"));
  previous_->setText(first && lesson_ > 0 ? tr("Previous lesson") : tr("Previous page"));
  const bool end = last && lesson_ + 1 == static_cast<int>(lessons_.size());
  enable_if(*next_, !lessons_.empty() && !end, tr("This is the last page of the last lesson"));
  next_->setText(end ? tr("No more pages") : last ? tr("Next lesson") : tr("Next page"));
  if (!any) {
    title_->setText(tr("Choose a lesson"));
    controls_.clear();
    text_->show_page(list_of_lessons(), {});
    page_number_->clear();
  } else {
    const Lesson& lesson = at(lessons_, lesson_);
    const Lesson::Page& page = at(lesson.pages, page_);
    title_->setText(QString::fromStdString(page.title.empty() ? lesson.title : page.title));
    show_text(page);
    page_number_->setText(tr("%1 of %2").arg(page_ + 1).arg(pages_of(lesson_)));
  }
  typeset_symbols(*text_->document());
  fit_text();
  QFont bold = text_font(title_scale);
  bold.setBold(true);
  title_->setFont(bold);
}

}  // namespace transillum::viewer
