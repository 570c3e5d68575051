// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A row of fields below the lists of events. It shows and sets Focus::filter(), which the lists,
// the timeline and stepping follow.
#include "stepping/event_filter_row.h"

#include <QDoubleValidator>
#include <QIntValidator>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>
#include <algorithm>
#include <limits>

#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QLineEdit* field(const char* name, const QString& when_empty, const QString& tip) {
  auto* edit = named(name, new QLineEdit, tip);
  edit->setPlaceholderText(when_empty);
  return edit;
}

}  // namespace

EventFilterRow::EventFilterRow(Focus& focus, QWidget* parent) : QWidget(parent), focus_(focus) {
  least_ = field("filter_least_area", QStringLiteral("0"), tr("Only events of at least this area"));
  largest_ =
      field("filter_largest_area", QStringLiteral("∞"), tr("Only events of at most this area"));
  for (QLineEdit* edit : {least_, largest_}) {
    auto* valid = new QDoubleValidator(0, 1e300, 12, edit);
    valid->setLocale(QLocale::c());
    edit->setValidator(valid);
  }
  patch_ = field("filter_patch", tr("any"), tr("Only events of this patch"));
  patch_->setValidator(new QIntValidator(0, std::numeric_limits<PatchId>::max(), patch_));
  for (QLineEdit* edit : {least_, largest_, patch_}) {
    connect(edit, &QLineEdit::editingFinished, this, &EventFilterRow::enter);
    connect(edit, &QLineEdit::textEdited, this, [this](const QString& text) {
      if (text.isEmpty()) {
        enter();  // with a validator, no editing is finished with an empty text
      }
    });
  }
  make_kinds();
  make_actions();
  clear_button_ = button_for(clear_);
  auto* row = make_row(this, {8, 0, 8, 3}, 4);
  row->addWidget(new QLabel(tr("Area")));
  row->addWidget(least_, 1);
  row->addWidget(new QLabel(tr("to")));
  row->addWidget(largest_, 1);
  row->addWidget(new QLabel(tr("m²  Patch")));
  row->addWidget(patch_, 1);
  row->addWidget(kinds_);
  row->addWidget(clear_button_);
  connect(&focus_, &Focus::filtered, this, &EventFilterRow::show_filter);
  show_filter();
}

void EventFilterRow::make_kinds() {
  kinds_ = named("filter_kinds", new QToolButton, tr("Only events of the checked kinds"));
  kinds_->setText(tr("Kinds"));
  kinds_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(kinds_);
  for (int k = 0; k < StepEvent::kind_count; ++k) {
    QAction* kind = menu->addAction(text_of(static_cast<StepEvent::Kind>(k)));
    kind->setCheckable(true);
    connect(kind, &QAction::triggered, this, &EventFilterRow::enter);
    kind_actions_.push_back(kind);
  }
  kinds_->setMenu(menu);
}

void EventFilterRow::make_actions() {
  filter_ = make_action(this, "filter_events", tr("Filter events"),
                        tr("Choose the events that are listed and stepped to (Ctrl+E)"),
                        QKeySequence("Ctrl+E"));
  connect(filter_, &QAction::triggered, this, [this] {
    emit requested();
    least_->setFocus();
  });
  clear_ =
      make_action(this, "clear_filter", tr("Show all events"),
                  tr("Remove the filter of events (Ctrl+Shift+E)"), QKeySequence("Ctrl+Shift+E"));
  clear_->setIcon(theme::icon(theme::Icon::clear));
  connect(clear_, &QAction::triggered, this, [this] { focus_.set_filter({}); });
}

void EventFilterRow::add_to(QMenu& menu) const { menu.addActions({filter_, clear_}); }

void EventFilterRow::enter() {
  const EventFilter all;
  EventFilter filter;
  filter.least_area = least_->text().toDouble();
  filter.largest_area = largest_->text().isEmpty() ? all.largest_area : largest_->text().toDouble();
  filter.patch = patch_->text().isEmpty() ? no_patch : patch_->text().toInt();
  std::transform(kind_actions_.begin(), kind_actions_.end(), filter.kinds.begin(),
                 [](const QAction* kind) { return kind->isChecked(); });
  focus_.set_filter(filter);
}

void EventFilterRow::show_filter() {
  const EventFilter& filter = focus_.filter();
  const EventFilter all;
  const auto text = [](double area, double usual) {
    return area == usual ? QString() : QString::number(area, 'g', 12);
  };
  least_->setText(text(filter.least_area, all.least_area));
  largest_->setText(text(filter.largest_area, all.largest_area));
  patch_->setText(filter.patch == no_patch ? QString() : QString::number(filter.patch));
  for (std::size_t k = 0; k < kind_actions_.size(); ++k) {
    kind_actions_[k]->setChecked(filter.kinds[k]);
  }
  enable_if(*clear_, filter.on(), tr("All events are shown"));
}

}  // namespace transillum::viewer
