// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/quality_controls.h"

#include <QComboBox>
#include <QDoubleValidator>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStyle>
#include <utility>

#include "solve/setting_tips.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/count_box.h"

namespace transillum::viewer {

namespace {

constexpr int draft_passes = 64;
constexpr double normal_percent = 1, fine_percent = 0.3;

// The accuracy is about the sum of all errors: data of its entry, beside the values of AccuracyOf.
constexpr int in_all = -1;

QPushButton* segment(const QString& name, const QString& text, const QString& tip) {
  auto* button = named(name, new QPushButton(text), tip);
  button->setCheckable(true);
  button->setProperty("segment", true);
  button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  button->setMinimumWidth(button->fontMetrics().horizontalAdvance(text) + 14);
  return button;
}

}  // namespace

QualityControls::QualityControls(QWidget* parent) : QWidget(parent) {
  add_buttons();
  add_accuracy_of();
  directions_ = named("directions", new CountBox, setting_tip("directions"));
  directions_->setRange(1, 1 << 24);
  directions_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  QSizePolicy policy = directions_->sizePolicy();
  policy.setRetainSizeWhenHidden(true);  // the button beside it keeps its width
  directions_->setSizePolicy(policy);
  passes_ = new QWidget;
  auto* passes = make_row(passes_, {}, 3);
  passes->addWidget(by_number_, 1);
  passes->addWidget(directions_, 1);
  note_ = named("quality_note", note_label());
  note_->hide();
  auto* column = make_column(this, {}, 6);
  column->addLayout(make_choices());
  column->addWidget(passes_);
  column->addWidget(note_);
  connect(directions_, qOverload<int>(&QSpinBox::valueChanged), this, &QualityControls::changed);
  connect(accuracy_, &QLineEdit::textChanged, this, &QualityControls::changed);
  connect(accuracy_of_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &QualityControls::changed);
}

QGridLayout* QualityControls::make_choices() {
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(3);
  grid->setVerticalSpacing(0);
  int place = 0;
  for (QPushButton* button : {draft_, normal_, fine_}) {
    QLabel*& cost = at(costs_, place);
    cost = named(button->objectName() + QStringLiteral("_cost"), new QLabel,
                 tr("Time of such a solve, by the passes of the last one; a range where its error "
                    "is not known"));
    cost->setAlignment(Qt::AlignHCenter);
    cost->setForegroundRole(QPalette::PlaceholderText);
    cost->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    QFont small = cost->font();
    small.setPixelSize(QFontInfo(small).pixelSize() * 6 / 7);
    cost->setFont(small);
    grid->addWidget(button, 0, place);
    grid->addWidget(cost, 1, place);
    grid->setColumnStretch(place++, 3);
  }
  grid->addWidget(accuracy_, 0, place);
  grid->setColumnStretch(place, 2);
  percent_ = new QLabel(QStringLiteral("%"));
  grid->addWidget(percent_, 0, place + 1);
  return grid;
}

void QualityControls::show_cost(Choice choice, const QString& text) {
  at(costs_, choice)->setText(text);
}

SolveOptions QualityControls::with(SolveOptions solve, Choice choice) const {
  const AccuracyOf of = goal().of;
  if (choice == Choice::draft) {
    solve.goal = {};
    solve.directions = draft_passes;
  } else {
    solve.goal.accuracy = 0.01 * (choice == Choice::normal ? normal_percent : fine_percent);
    solve.goal.of = of;
  }
  solve.replicas = 1;
  return solve;
}

void QualityControls::add_buttons() {
  draft_ = segment("draft", tr("Draft"), tr("A first picture: %1 passes").arg(draft_passes));
  const QString tip = tr("The passes that an error of at most %1 % requires");
  normal_ = segment("normal", tr("Normal"), tip.arg(normal_percent));
  fine_ = segment("fine", tr("Fine"), tip.arg(fine_percent));
  connect(draft_, &QPushButton::clicked, this, &QualityControls::choose_draft);
  connect(normal_, &QPushButton::clicked, this, [this] { choose(normal_percent); });
  connect(fine_, &QPushButton::clicked, this, [this] { choose(fine_percent); });
  by_number_ = segment(
      "by_number", tr("Passes"),
      tr("The number of passes, whatever error it leaves; each is of one direction ω, or of ω and "
         "−ω"));
  connect(by_number_, &QPushButton::clicked, this, &QualityControls::choose_number);
  accuracy_ = named("accuracy", new QLineEdit, setting_tip("accuracy"));
  auto* percent = new QDoubleValidator(0, 99, 6, accuracy_);
  percent->setLocale(QLocale::c());
  accuracy_->setValidator(percent);
  accuracy_->setPlaceholderText(tr("Other"));
  accuracy_->setAlignment(Qt::AlignRight);
  accuracy_->setMinimumWidth(accuracy_->fontMetrics().horizontalAdvance(tr("Other")) + 14);
}

void QualityControls::add_accuracy_of() {
  accuracy_of_ = named("accuracy_of", new QComboBox, setting_tip("accuracy-of"));
  for (const auto& [of, text] : {std::pair{AccuracyOf::surfaces, tr("worst surface")},
                                 {AccuracyOf::irradiance, tr("irradiance")},
                                 {AccuracyOf::rms, tr("RMS of all")},
                                 {AccuracyOf::max, tr("largest")},
                                 {AccuracyOf::patch, tr("patch")},
                                 {AccuracyOf::mean, tr("mean")}}) {
    accuracy_of_->addItem(text, static_cast<int>(of));
  }
  accuracy_of_->insertItem(1, tr("all errors together"), in_all);
  accuracy_of_->setItemData(1, setting_tip("total"), Qt::ToolTipRole);
}

void QualityControls::choose(double percent) {
  accuracy_->setText(exact_digits(percent));
  mark_choice();  // also where nothing has changed: the click has toggled the button
}

void QualityControls::choose_draft() {
  directions_->setValue(draft_passes);
  emit draft_chosen();
  choose_number();
}

void QualityControls::choose_number() {
  base_ = {};
  {
    const QSignalBlocker quiet(accuracy_);
    accuracy_->clear();
  }
  emit changed();
}

void QualityControls::mark_choice() {
  const AccuracyGoal goal = this->goal();
  draft_->setChecked(!goal.is_set() && directions_->value() == draft_passes);
  normal_->setChecked(accuracy_->text() == exact_digits(normal_percent));
  fine_->setChecked(accuracy_->text() == exact_digits(fine_percent));
  by_number_->setChecked(!goal.is_set() && !draft_->isChecked());
  // The style sheet shows another accuracy like a pressed button.
  accuracy_->setProperty("chosen",
                         goal.accuracy > 0 && !normal_->isChecked() && !fine_->isChecked());
  style()->unpolish(accuracy_);
  style()->polish(accuracy_);
}

AccuracyGoal QualityControls::goal() const {
  AccuracyGoal goal = base_;
  if (accuracy_->text() != exact_digits(100 * goal.accuracy)) {
    goal.accuracy = QLocale::c().toDouble(accuracy_->text()) / 100;
  }
  const int of = accuracy_of_->currentData().toInt();
  goal.of = of == in_all ? AccuracyOf::surfaces : static_cast<AccuracyOf>(of);
  return goal;
}

bool QualityControls::total() const {
  return accuracy_of_->currentData().toInt() == in_all && goal().accuracy > 0;
}

int QualityControls::directions() const { return directions_->value(); }

void QualityControls::set_total(bool total) {
  accuracy_of_->setCurrentIndex(total ? accuracy_of_->findData(in_all) : 0);
}

void QualityControls::set_options(const SolveOptions& solve) {
  base_ = solve.goal;
  directions_->setValue(solve.directions);
  accuracy_->setText(solve.goal.accuracy > 0 ? exact_digits(100 * solve.goal.accuracy) : QString());
  const auto item_of = [this](AccuracyOf of) {
    return accuracy_of_->findData(static_cast<int>(of));
  };
  accuracy_of_->setItemText(item_of(AccuracyOf::patch), tr("patch %1").arg(solve.goal.patch));
  if (solve.goal.of == AccuracyOf::groups && item_of(AccuracyOf::groups) < 0) {
    accuracy_of_->addItem(tr("groups named"), static_cast<int>(AccuracyOf::groups));
  }
  if (!(accuracy_of_->currentData().toInt() == in_all && solve.goal.of == AccuracyOf::surfaces)) {
    accuracy_of_->setCurrentIndex(item_of(solve.goal.of));
  }
  mark_choice();
}

void QualityControls::write_to(SolveOptions& solve) const {
  solve.directions = directions_->value();
  solve.goal = goal();
}

void QualityControls::show_state(bool takes_directions, const QString& conflict) {
  const bool chosen = goal().is_set();
  passes_->setVisible(takes_directions);
  for (QLabel* cost : costs_) {
    cost->setVisible(takes_directions);
  }
  directions_->setVisible(!chosen);
  for (QPushButton* button : {draft_, normal_, fine_}) {
    button->setVisible(takes_directions);
  }
  // An accuracy that is asked for can be taken back.
  for (QWidget* widget : {static_cast<QWidget*>(accuracy_), static_cast<QWidget*>(percent_)}) {
    widget->setVisible(takes_directions || goal().accuracy > 0);
  }
  note_->setText(!conflict.isEmpty() ? capitalized(conflict)
                 : !takes_directions ? tr("This engine has no directions to choose")
                 : goal().seconds > 0 && goal().accuracy == 0
                     ? tr("The directions that fit into %1").arg(duration_text(goal().seconds))
                     : QString());
  note_->setVisible(!note_->text().isEmpty());
  mark_choice();
}

}  // namespace transillum::viewer
