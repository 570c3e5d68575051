// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel that lists and adds breakpoints (state/breakpoints.h) and runs to where one holds, by
// Focus.
#include "stepping/breakpoint_panel.h"

#include <QComboBox>
#include <QDoubleValidator>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QShortcut>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>
#include <limits>

#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

using Kind = Condition::Kind;

struct Choice {
  Kind kind;
  const char* text;
  const char* unit;  ///< unit of the value; null if it has none
  const char* first_value;
};
constexpr Choice choices[] = {
    {Kind::patch, QT_TRANSLATE_NOOP("BreakpointPanel", "patch takes part"), nullptr, ""},
    {Kind::cut, QT_TRANSLATE_NOOP("BreakpointPanel", "patch is cut"), nullptr, ""},
    {Kind::pair, QT_TRANSLATE_NOOP("BreakpointPanel", "pair exchanges light"), nullptr, ""},
    {Kind::small_fragment, QT_TRANSLATE_NOOP("BreakpointPanel", "polygon smaller than"), "m²",
     "1e-9"},
    {Kind::open_receiver, QT_TRANSLATE_NOOP("BreakpointPanel", "open part above"), "", "1e-10"},
    {Kind::large_map, QT_TRANSLATE_NOOP("BreakpointPanel", "polygons of V above"), "", "1000"},
    {Kind::growing_map, QT_TRANSLATE_NOOP("BreakpointPanel", "V grows beyond"), "", "1000"},
};

}  // namespace

BreakpointPanel::BreakpointPanel(Focus& focus, Selection& selection, Breakpoints& breakpoints,
                                 QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection), breakpoints_(breakpoints) {
  make_actions();
  make_list();
  hint_ = note_label(tr("No breakpoints. Add one, then press F9."), {10, 4, 10, 4});
  auto* layout = make_column(this, {}, 4);
  layout->addLayout(make_buttons());
  layout->addWidget(hint_, 1, Qt::AlignTop);
  layout->addWidget(list_, 1);
  layout->addWidget(make_new_row());
  layout->addLayout(make_join_row());

  connect(&breakpoints_, &Breakpoints::changed, this, [this] {
    hits_.reset();
    show_list();
  });
  connect(&focus_, &Focus::moved, this, &BreakpointPanel::show_state);
  connect(&focus_, &Focus::seek_ended, this, &BreakpointPanel::mark_current);
  connect(&focus_, &Focus::target_changed, this, &BreakpointPanel::mark_current);
  connect(&selection_, &Selection::changed, this, [this](PatchId patch) {
    if (patch != no_patch) {
      patch_->setValue(patch);
    }
  });
  show_inputs();
  show_list();
}

void BreakpointPanel::make_actions() {
  run_back_ = make_key_action(this, "run_back", tr("Run back"),
                              tr("Run back to the previous breakpoint"), QKeySequence("Shift+F9"));
  run_on_ = make_key_action(this, "run_on", tr("Run forward"),
                            tr("Run forward to the next breakpoint"), Qt::Key_F9);
  connect(run_on_, &QAction::triggered, this, [this] { run(StepOrder::forward); });
  connect(run_back_, &QAction::triggered, this, [this] { run(StepOrder::backward); });
}

void BreakpointPanel::make_list() {
  list_ = named("breakpoint_list", new QListWidget,
                tr("Right-click a breakpoint to run to it, even if it is disabled"));
  list_->setFrameShape(QFrame::NoFrame);
  list_->setMinimumHeight(48);
  list_->setWordWrap(true);
  connect(list_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
    breakpoints_.set_enabled(static_cast<std::size_t>(list_->row(item)),
                             item->checkState() == Qt::Checked);
  });
  connect(list_, &QListWidget::currentRowChanged, this, &BreakpointPanel::show_state);
  auto* delete_key = new QShortcut(QKeySequence::Delete, list_);
  delete_key->setContext(Qt::WidgetShortcut);
  connect(delete_key, &QShortcut::activated, this, &BreakpointPanel::remove_current);
  list_->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(list_, &QWidget::customContextMenuRequested, this, &BreakpointPanel::show_run_menu);
}

QLayout* BreakpointPanel::make_buttons() {
  remove_ = named("remove_breakpoint", new QToolButton,
                  tr("Remove the breakpoint chosen in the list (Del)"));
  remove_->setText(tr("Remove"));
  connect(remove_, &QToolButton::clicked, this, &BreakpointPanel::remove_current);
  auto* buttons = make_row({8, 4, 8, 0});
  for (QAction* action : {run_back_, run_on_}) {
    buttons->addWidget(button_for(action));
  }
  buttons->addStretch(1);
  buttons->addWidget(remove_);
  return buttons;
}

QWidget* BreakpointPanel::make_new_row() {
  kind_ = named("breakpoint_kind", new QComboBox);
  kind_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  kind_->setMinimumContentsLength(12);
  for (const Choice& choice : choices) {
    kind_->addItem(tr(choice.text));
  }
  const auto patch_box = [](const char* name) {
    auto* box = named(name, new QSpinBox, tr("Patch number; selecting a patch fills it in"));
    box->setRange(0, std::numeric_limits<PatchId>::max());
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    return box;
  };
  patch_ = patch_box("breakpoint_patch");
  other_ = patch_box("breakpoint_other");
  value_ = named("breakpoint_value", new QLineEdit);
  auto* positive = new QDoubleValidator(0, 1e300, 12, value_);
  positive->setLocale(QLocale::c());
  value_->setValidator(positive);
  unit_ = new QLabel;
  auto* row = new QWidget;
  auto* layout = make_row(row, {8, 0, 8, 0}, 4);
  layout->addWidget(kind_, 2);
  for (QWidget* input : std::initializer_list<QWidget*>{patch_, other_, value_}) {
    layout->addWidget(input, 1);
  }
  layout->addWidget(unit_);
  connect(kind_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &BreakpointPanel::show_inputs);
  connect(value_, &QLineEdit::textChanged, this, &BreakpointPanel::show_state);
  connect(value_, &QLineEdit::returnPressed, this, &BreakpointPanel::add_new);
  for (const QSpinBox* box : {patch_, other_}) {
    connect(box->findChild<QLineEdit*>(), &QLineEdit::returnPressed, this,
            &BreakpointPanel::add_new);
  }
  return row;
}

QLayout* BreakpointPanel::make_join_row() {
  const auto button = [](const char* name, const QString& text, const QString& tip) {
    auto* result = named(name, new QToolButton, tip);
    result->setText(text);
    return result;
  };
  add_ = button("add_breakpoint", tr("Add"), tr("Add a breakpoint with this condition (Return)"));
  and_ =
      button("and_condition", tr("And"),
             tr("Let the breakpoint chosen in the list stop only where this condition holds too;\n"
                "“and” binds more strongly than “or”"));
  or_ = button("or_condition", tr("Or"),
               tr("Let the breakpoint chosen in the list stop also where this condition holds"));
  stop_at_ = named(
      "breakpoint_stop_at", new QSpinBox,
      tr("The hit of the breakpoint chosen in the list at which a run stops, counted from where "
         "the run begins.\nThe list shows how often the last run hit each breakpoint."));
  stop_at_->setRange(1, Breakpoint::most_hits);
  stop_at_->setKeyboardTracking(false);
  auto* label = new QLabel(tr("Stop at &hit"));
  label->setBuddy(stop_at_);
  auto* row = make_row({8, 0, 8, 6}, 4);
  for (QToolButton* each : {add_, and_, or_}) {
    row->addWidget(each);
  }
  row->addStretch(1);
  row->addWidget(label);
  row->addWidget(stop_at_);
  connect(add_, &QToolButton::clicked, this, &BreakpointPanel::add_new);
  connect(and_, &QToolButton::clicked, this, [this] { join_new(false); });
  connect(or_, &QToolButton::clicked, this, [this] { join_new(true); });
  connect(stop_at_, qOverload<int>(&QSpinBox::valueChanged), this, [this](int hit) {
    breakpoints_.set_stop_at(static_cast<std::size_t>(list_->currentRow()), hit);
  });
  return row;
}

void BreakpointPanel::add_to(QMenu& menu) const { menu.addActions({run_on_, run_back_}); }

void BreakpointPanel::show_run_menu(const QPoint& position) {
  const int row = list_->indexAt(position).row();
  if (row < 0 || !focus_.map()) {
    return;
  }
  const StepFinder finder =
      find_where([b = at(breakpoints_.list(), row)](const MapHistory& history, std::int32_t k) {
        return holds(b, history, k);
      });
  auto* menu = named("breakpoint_menu", new QMenu(this));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(
      tr("Run back to the previous step where the breakpoint holds"), this,
      [this, finder] { focus_.seek(finder, StepOrder::backward, StepReason::breakpoint); });
  menu->addAction(
      tr("Run forward to the next step where the breakpoint holds"), this,
      [this, finder] { focus_.seek(finder, StepOrder::forward, StepReason::breakpoint); });
  const auto k = static_cast<std::size_t>(row);
  QAction* remove = menu->addAction(tr("Remove its last condition"), this,
                                    [this, k] { breakpoints_.remove_last_condition(k); });
  enable_if(*remove, !breakpoints_.list()[k].further.empty(), tr("The breakpoint has only one"));
  menu->popup(list_->viewport()->mapToGlobal(position));
}

void BreakpointPanel::show_inputs() {
  const Choice& choice = choices[kind_->currentIndex()];
  const bool valued = choice.unit != nullptr;
  patch_->setVisible(!valued);
  other_->setVisible(choice.kind == Kind::pair);
  value_->setVisible(valued);
  value_->setText(QString::fromLatin1(choice.first_value));
  unit_->setVisible(valued);
  unit_->setText(valued ? QString::fromUtf8(choice.unit) : QString());
  show_state();
}

void BreakpointPanel::show_list() {
  {
    const QSignalBlocker quiet(list_);
    const int row = list_->currentRow();
    list_->clear();
    for (const Breakpoint& breakpoint : breakpoints_.list()) {
      auto* item = new QListWidgetItem(list_);
      item->setCheckState(breakpoint.enabled ? Qt::Checked : Qt::Unchecked);
    }
    list_->setCurrentRow(std::min(row, list_->count() - 1));
  }
  hint_->setVisible(list_->count() == 0);
  list_->setVisible(list_->count() > 0);
  show_state();
}

void BreakpointPanel::show_state() {
  const bool can_run = focus_.map() && breakpoints_.any_enabled();
  if (const auto map = focus_.map()) {
    for (QSpinBox* box : {patch_, other_}) {
      box->setMaximum(map->loaded->scene->patch_count() - 1);
    }
  }
  for (QAction* run : {run_on_, run_back_}) {
    enable_if(*run, can_run,
              focus_.map() ? tr("No breakpoint is checked") : tr("No direction is shown yet"));
  }
  const int row = list_->currentRow();
  const QString none_chosen = tr("No breakpoint is chosen in the list");
  for (QWidget* control : std::initializer_list<QWidget*>{remove_, stop_at_}) {
    enable_if(*control, row >= 0, none_chosen);
  }
  const QSignalBlocker quiet(stop_at_);
  stop_at_->setValue(row >= 0 ? at(breakpoints_.list(), row).stop_at : 1);
  mark_current();
  const bool valid = choices[kind_->currentIndex()].unit == nullptr || value_->hasAcceptableInput();
  const QString no_number = tr("The condition needs a number");
  enable_if(*add_, valid, no_number);
  for (QToolButton* join : {and_, or_}) {
    enable_if(*join, valid && row >= 0, valid ? none_chosen : no_number);
  }
}

QString BreakpointPanel::text_of_row(int row) const {
  QString text = text_of(at(breakpoints_.list(), row));
  if (!hits_ || !at(breakpoints_.list(), row).enabled) {
    return text;
  }
  const std::int64_t hits = at(*hits_, row).steps;
  text = hits == 1 ? tr("%1: 1 hit").arg(text) : tr("%1: %2 hits").arg(text, count_text(hits));
  const QString miss = text_of_miss(at(breakpoints_.list(), row), at(*hits_, row));
  return focus_.seeking() || miss.isEmpty() ? text : text + '\n' + miss;
}

void BreakpointPanel::mark_current() {
  const QSignalBlocker quiet(list_);
  const auto map = focus_.map();
  const std::int32_t step = focus_.position().step;
  for (int row = 0; row < list_->count(); ++row) {
    const Breakpoint& breakpoint = at(breakpoints_.list(), row);
    const bool here = map && focus_.at_step() && step >= 0 && holds(breakpoint, map->history, step);
    QListWidgetItem* item = list_->item(row);
    item->setText(here ? tr("%1, true here").arg(text_of_row(row)) : text_of_row(row));
    QFont font = list_->font();
    font.setBold(here);
    item->setFont(font);
  }
}

Condition BreakpointPanel::entered() const {
  const Choice& choice = choices[kind_->currentIndex()];
  return {choice.kind, patch_->value(), other_->value(),
          choice.unit != nullptr ? value_->text().toDouble() : 0};
}

void BreakpointPanel::add_new() {
  if (add_->isEnabled()) {
    breakpoints_.add({entered()});
    list_->setCurrentRow(list_->count() - 1);  // "And" and "Or" join conditions to it
  }
}

void BreakpointPanel::join_new(bool alternative) {
  breakpoints_.join(static_cast<std::size_t>(list_->currentRow()), {alternative, entered()});
}

void BreakpointPanel::remove_current() {
  if (list_->currentRow() >= 0) {
    breakpoints_.remove(static_cast<std::size_t>(list_->currentRow()));
  }
}

void BreakpointPanel::run(StepOrder order) {
  hits_ = std::make_shared<HitCounts>();
  focus_.seek(breakpoints_.run_finder(hits_, [this] { return focus_.target(); }), order,
              StepReason::breakpoint);
}

}  // namespace transillum::viewer
