// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The question of a page, below its text: widgets for the prediction by the question's kind, and
// after Reveal the result of solve_question(), which runs on a worker thread.
#include "lessons/question_box.h"

#include <QButtonGroup>
#include <QDoubleValidator>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QRadioButton>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "lessons/computed_values.h"
#include "lessons/result_text.h"
#include "support/failure_text.h"
#include "support/list_change.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QLabel* wrapped_label(const char* name) {
  auto* label = named(name, new QLabel);
  label->setWordWrap(true);
  return label;
}

/// The text of a choice, which a radio button would not wrap; a click chooses it.
class ChoiceText : public QLabel {
 public:
  ChoiceText(const QString& text, QRadioButton& button) : QLabel(text), button_(button) {
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
  }

 protected:
  void mouseReleaseEvent(QMouseEvent*) override { button_.click(); }

 private:
  QRadioButton& button_;
};

int total_of(const AnswerCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0,
                         [](int sum, const auto& item) { return sum + item.second; });
}

}  // namespace

QuestionBox::QuestionBox(Selection& selection, Focus& focus, QWidget* parent)
    : QFrame(parent),
      selection_(selection),
      focus_(focus),
      solver_(*this, [this](const QuestionRequest&, const std::shared_ptr<const Solved>& solved,
                            const QString& error) {
        computed_ = solved;
        failure_ = error;
        show_computed();
      }) {
  setObjectName("question");
  setFrameShape(QFrame::StyledPanel);
  make_actions();
  make_widgets();
  connect(&progress_timer_, &QTimer::timeout, this, &QuestionBox::show_progress);
  connect(&selection_, &Selection::changed, this, &QuestionBox::take_patch);
  connect(&focus_, &Focus::probed, this, &QuestionBox::take_point);
  hide();
}

void QuestionBox::make_actions() {
  reveal_ = make_action(this, "question_reveal", {},
                        tr("Show what the program computes, and whether the prediction is right "
                           "(Ctrl+Return); again to hide it"),
                        QKeySequence("Ctrl+Return"));
  count_ = make_action(this, "question_count", tr("Count for the class"),
                       tr("Add this answer to the tally of the class, and take the next "
                          "(Ctrl+Shift+Return)"),
                       QKeySequence("Ctrl+Shift+Return"));
  reset_ = make_action(this, "question_reset", tr("Reset the tally"),
                       tr("Set the tally of this question to zero; Ctrl+Z restores it"));
  connect(reveal_, &QAction::triggered, this, [this] { solved_ ? ask_again() : reveal(); });
  connect(count_, &QAction::triggered, this, &QuestionBox::count);
  connect(reset_, &QAction::triggered, this, [this] { set_counts({}, tr("Reset the tally")); });
}

void QuestionBox::make_widgets() {
  ask_ = wrapped_label("question_ask");
  ask_->setTextFormat(Qt::MarkdownText);
  result_ = wrapped_label("question_result");
  result_->setTextFormat(Qt::RichText);
  counts_ = wrapped_label("question_counts");
  counts_->setForegroundRole(QPalette::PlaceholderText);
  progress_ = named("question_progress", new QProgressBar);
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(theme::scaled(8));
  layout_ = make_column(this, {10, 8, 10, 8}, 6);
  layout_->addWidget(ask_);
  layout_->addWidget(result_);
  layout_->addWidget(progress_);
  auto* tally = make_row({});
  tally->addWidget(counts_, 1);
  tally->addWidget(text_button(*reset_), 0, Qt::AlignBottom);
  layout_->addLayout(tally);
  layout_->addLayout(make_buttons());
}

QToolButton* QuestionBox::text_button(QAction& action) {
  auto* button = button_for(&action);
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  button->setVisible(action.isVisible());
  connect(&action, &QAction::changed, button,
          [&action, button] { button->setVisible(action.isVisible()); });
  return button;
}

QLayout* QuestionBox::make_buttons() {
  auto* row = make_row({});
  for (QAction* action : {reveal_, count_}) {
    auto* button = text_button(*action);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    row->addWidget(button);
  }
  return row;
}

void QuestionBox::show_page(std::shared_ptr<const Lesson::Page> page, int number,
                            std::shared_ptr<Tally> tally) {
  const bool asks = page && page->question;
  page_ = asks ? std::move(page) : nullptr;
  page_number_ = number;
  tally_ = std::move(tally);
  cancel();
  solved_.reset();
  answer_ = {};
  delete std::exchange(answers_, nullptr);
  choices_ = nullptr;
  number_ = nullptr;
  given_ = nullptr;
  drop_ = nullptr;
  chart_ = nullptr;
  rows_.clear();
  setVisible(asks);
  if (asks) {
    fill_answers();
  }
  show_state();
  send_sketch();
  // The call is made after the window has applied the page.
  QTimer::singleShot(0, this, [this] {
    if (!runs_) {
      compute();
    }
  });
}

void QuestionBox::set_text_font(const QFont& font) {
  ask_->setFont(font);
  result_->setFont(font);
  // The style sheet keeps fonts from being inherited.
  const auto widgets = answers_ ? answers_->findChildren<QWidget*>() : QList<QWidget*>();
  for (QWidget* widget : widgets) {
    widget->setFont(font);
  }
  show_state();  // colors of the theme may have changed too
}

void QuestionBox::lay_out() {
  if (answers_) {
    answers_->layout()->activate();
  }
  layout_->activate();
}

void QuestionBox::fill_answers() {
  answers_ = new QWidget;
  auto* grid = new QGridLayout(answers_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(2);
  layout_->insertWidget(1, answers_);
  const Question& question = *page_->question;
  if (question.kind == Question::Kind::choice) {
    choices_ = new QButtonGroup(answers_);
    for (int k = 0; k < static_cast<int>(question.choices.size()); ++k) {
      add_choice(k);
    }
    connect(choices_, &QButtonGroup::idClicked, this, [this](int k) { set_answer({.choice = k}); });
  } else if (question.kind == Question::Kind::number) {
    add_number();
  } else {
    add_drawing();
  }
}

void QuestionBox::add_choice(int k) {
  auto* grid = static_cast<QGridLayout*>(answers_->layout());
  auto* button = named(QStringLiteral("choice_%1").arg(k + 1), new QRadioButton,
                       tr("Predict this (arrow keys move between the answers)"));
  const QString label = label_of(at(page_->question->choices, k));
  button->setAccessibleName(label);
  choices_->addButton(button, k);
  ChoiceRow row{new QLabel, new ChoiceText(label, *button), new QLabel, new QProgressBar};
  row.mark->setFixedWidth(theme::scaled(16));
  row.bar->setTextVisible(false);
  row.bar->setFixedSize(theme::scaled(70), theme::scaled(10));
  row.value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  row.value->setForegroundRole(QPalette::PlaceholderText);
  grid->addWidget(row.mark, k, 0);
  grid->addWidget(button, k, 1);
  grid->addWidget(row.text, k, 2);
  grid->addWidget(row.value, k, 3);
  grid->addWidget(row.bar, k, 4);
  grid->setColumnStretch(2, 1);
  rows_.push_back(row);
}

void QuestionBox::add_number() {
  const Question& question = *page_->question;
  auto* grid = static_cast<QGridLayout*>(answers_->layout());
  number_ =
      named("question_number", new QLineEdit, tr("Enter a number; Return reveals the answer"));
  number_->setPlaceholderText(tr("Your guess"));
  auto* validator = new QDoubleValidator(number_);
  validator->setLocale(QLocale::c());
  number_->setValidator(validator);
  grid->addWidget(number_, 0, 0);
  grid->addWidget(new QLabel(QString::fromStdString(question.unit)), 0, 1);
  connect(number_, &QLineEdit::textChanged, this, [this](QString text) {
    bool valid = false;
    // The validator lets commas pass as separators; many users write them for the point.
    const double value =
        text.replace(',', '.').toDouble(&valid) / (page_->question->percent ? 100 : 1);
    set_answer({.number = valid && std::isfinite(value) ? std::optional(value) : std::nullopt});
  });
  connect(number_, &QLineEdit::returnPressed, reveal_, &QAction::trigger);
}

void QuestionBox::take_patch(PatchId patch) {
  if (!page_ || solved_ || page_->question->kind != Question::Kind::patch) {
    return;
  }
  // The patch that the page itself selects is no answer.
  set_answer({.patch = patch == page_->state.selection ? no_patch : patch});
}

void QuestionBox::set_answer(GivenAnswer answer) {
  answer_ = std::move(answer);
  show_state();
  send_sketch();
}

void QuestionBox::clear_answer() {
  if (choices_ && choices_->checkedButton()) {
    choices_->setExclusive(false);
    choices_->checkedButton()->setChecked(false);
    choices_->setExclusive(true);
  }
  if (number_) {
    number_->clear();
  }
  if (page_ && page_->question->kind == Question::Kind::patch) {
    selection_.select(page_->state.selection);
  }
  set_answer({});
}

void QuestionBox::reveal() {
  if (!page_) {
    return;
  }
  if (std::exchange(waits_, false)) {
    show_state();  // the computation continues
    return;
  }
  compute();
  if (!computed_ && !solver_.busy() && failure_.isEmpty()) {
    emit failed(tr("The scene of this page is not open. Show the page again (Ctrl+L)."));
    return;
  }
  waits_ = true;
  show_computed();
}

void QuestionBox::show_run(RunState run) {
  runs_ = run == RunState::running || run == RunState::loading;
  if (!runs_) {
    compute();
  }
}

void QuestionBox::compute() {
  const auto loaded = page_ && scene_ ? scene_(page_->state) : nullptr;
  if (loaded && !computed_ && !solver_.busy() && failure_.isEmpty()) {
    done_ = std::make_shared<std::atomic<double>>(0.0);
    time_.start();
    solver_.request({loaded, *page_->question, done_});
  }
}

void QuestionBox::cancel() {
  solver_.clear();
  computed_ = nullptr;
  failure_.clear();
  waits_ = false;
}

void QuestionBox::leave_scene() {
  cancel();
  show_state();
}

// The answer, or the reason why there is none, is shown only after Reveal.
void QuestionBox::show_computed() {
  if (!waits_ || solver_.busy()) {
    show_state();
    return;
  }
  waits_ = false;
  if (computed_) {
    show_solved(*computed_);
    return;
  }
  show_state();
  emit failed(std::exchange(failure_, QString()));
}

void QuestionBox::show_progress() {
  constexpr double least_to_tell = 0.05;
  const double done = *done_;
  progress_->setValue(static_cast<int>(done * progress_->maximum()));
  const double left =
      done > 0 ? 1e-3 * static_cast<double>(time_.elapsed()) * (1 - done) / done : 0;
  result_->setText(done < least_to_tell
                       ? tr("The program computes the answer…")
                       : tr("The program computes the answer: %1 left").arg(duration_text(left)));
}

void QuestionBox::show_solved(const Solved& solved) {
  solved_ = solved;
  if (is_given(*page_->question, answer_)) {
    count();
  }
  select_right();
  show_state();
  send_sketch();
  emit then_shown();
}

// The window shows the state that the file sets for Reveal. The patch that the page is about is
// selected again, since its panels and texts are about it; a callout marks the right patch. Where
// the page selects none, the right patch is selected.
void QuestionBox::select_right() {
  const Question& question = *page_->question;
  const std::optional<PatchId> right = right_patch();
  const PatchId of_page = page_->state.selection;
  const PatchId shown = right && of_page == no_patch ? *right : of_page;
  if (question.reveal) {
    ViewState state = *question.reveal;
    if (right) {
      state.selection = shown;
    }
    emit revealed(state);
  } else if (right) {
    selection_.select(shown);
  }
}

std::optional<PatchId> QuestionBox::right_patch() const {
  if (!solved_ || page_->question->kind != Question::Kind::patch || solved_->right.empty()) {
    return std::nullopt;
  }
  return solved_->right.front();
}

void QuestionBox::ask_again() {
  solved_.reset();
  clear_answer();
  if (page_->question->reveal) {
    emit revealed(page_->state);
  }
  emit then_shown();
}

void QuestionBox::count() {
  if (!page_ || !tally_ || !is_given(*page_->question, answer_)) {
    return;
  }
  AnswerCounts counts = tally_->of(page_number_, *page_->question);
  ++counts[label_of_answer()];
  set_counts(counts, tr("Count an answer"));
  if (!solved_) {
    clear_answer();
  }
}

void QuestionBox::set_counts(const AnswerCounts& counts, const QString& what) {
  const auto set = [this, tally = tally_, page = page_,
                    number = page_number_](const AnswerCounts& now) {
    try {
      tally->set(number, *page->question, now);
    } catch (const std::exception& error) {
      emit failed(failure_text(error));
    }
    show_state();
  };
  change_list<AnswerCounts>(undo_, what, tally_->of(page_number_, *page_->question), counts, set);
}

std::string QuestionBox::label_of_answer() const {
  const Question& question = *page_->question;
  switch (question.kind) {
    case Question::Kind::choice:
      return label_of(at(question.choices, answer_.choice)).toStdString();
    case Question::Kind::patch:
      return tr("patch %1").arg(answer_.patch).toStdString();
    case Question::Kind::number:
      return value_text(*page_->question, *answer_.number).toStdString();
    default:
      break;
  }
  const bool right = solved_ && is_right(question, *solved_, answer_);
  return (right ? tr("right") : tr("not right")).toStdString();
}

QString QuestionBox::label_of(const Question::Choice& choice) const {
  return choice.text.empty() && choice.value && !is_computed(*choice.value)
             ? value_text(*page_->question, choice.value->number)
             : QString::fromStdString(choice.text);
}

QString QuestionBox::tally_text(const AnswerCounts& counts) const {
  const int total = total_of(counts);
  if (total == 0) {
    return {};
  }
  if (!solved_ || page_->question->kind == Question::Kind::choice) {
    return total == 1 ? tr("1 answer counted") : tr("%1 answers counted").arg(total);
  }
  std::vector<std::pair<int, QString>> sorted;
  for (const auto& [answer, count] : counts) {
    sorted.emplace_back(-count, QString::fromStdString(answer));
  }
  std::sort(sorted.begin(), sorted.end());
  QStringList parts;
  for (const auto& [count, answer] : sorted) {
    parts << tr("%1: %2").arg(answer).arg(-count);
  }
  return tr("Answers of the class: %1").arg(parts.join(QStringLiteral(" · ")));
}

void QuestionBox::show_state() {
  const bool asks = page_ != nullptr;
  const bool hides = asks && !solved_ && is_of_direction(*page_->question);
  if (hides != std::exchange(hides_values_, hides)) {
    emit values_hidden(hides);
  }
  const bool given = asks && is_given(*page_->question, answer_);
  const AnswerCounts counts =
      asks && tally_ ? tally_->of(page_number_, *page_->question) : AnswerCounts();
  reveal_->setText(waits_ ? tr("Stop") : solved_ ? tr("Ask again") : tr("Reveal the answer"));
  progress_->setVisible(waits_);
  constexpr int period = 100;
  waits_ ? progress_timer_.start(period) : progress_timer_.stop();
  enable_if(*reveal_, asks, tr("This page asks no question"));
  enable_if(*count_, given && !solved_ && !is_drawn(*page_->question),
            solved_ ? tr("The answer is shown")
            : given ? tr("What is drawn is not counted")
                    : tr("Give an answer first"));
  reset_->setVisible(total_of(counts) > 0);
  if (!asks) {
    return;
  }
  ask_->setText(window_text(page_->question->ask));
  result_->setText(solved_ ? result_text(*page_->question, *solved_, answer_).trimmed()
                           : QString());
  result_->setVisible(waits_ || !result_->text().isEmpty());
  if (waits_) {
    show_progress();
  }
  const QString tally = tally_text(counts);
  counts_->setText(tally);
  counts_->setVisible(!tally.isEmpty());
  if (number_) {
    number_->setReadOnly(solved_.has_value());
  }
  if (given_) {
    given_->setText(given_text());
  }
  if (chart_) {
    show_chart();
  }
  if (drop_) {
    enable_if(*drop_, !solved_ && !answer_.outline.empty(),
              solved_ ? tr("The answer is shown") : tr("No corner is given yet"));
  }
  show_choices(counts);
}

void QuestionBox::show_choices(const AnswerCounts& counts) {
  const int most = std::max(1, total_of(counts));
  for (int k = 0; k < static_cast<int>(rows_.size()); ++k) {
    const ChoiceRow& row = at(rows_, k);
    const Question::Choice& choice = at(page_->question->choices, k);
    const auto count = counts.find(label_of(choice).toStdString());
    row.bar->setRange(0, most);
    row.bar->setValue(count == counts.end() ? 0 : count->second);
    row.bar->setToolTip(tr("%1 of %2 answers").arg(row.bar->value()).arg(total_of(counts)));
    row.bar->setVisible(solved_ && total_of(counts) > 0);
    enable_if(*choices_->button(k), !solved_, tr("The answer is shown"));
    row.text->setEnabled(!solved_);
    const bool right =
        solved_ && std::binary_search(solved_->right.begin(), solved_->right.end(), k);
    row.mark->setText(right ? colored(QStringLiteral("✓"), theme::good) : QString());
    const bool computed = solved_ && choice.value && is_computed(*choice.value);
    row.value->setText(computed ? value_text(*page_->question, at(solved_->values, k)) : QString());
  }
}

}  // namespace transillum::viewer
