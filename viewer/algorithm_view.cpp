// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "algorithm_view.h"

#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "number_text.h"
#include "theme.h"
#include "value_grid.h"

namespace transillum::viewer {

namespace {

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setContentsMargins(12, 6, 12, 2);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

// Long lines break below their own beginning.
QLabel* code_line(const QString& words, int indent) {
  auto* label = new QLabel(words);
  label->setWordWrap(true);
  label->setContentsMargins(14 + 16 * indent, 1, 8, 1);
  return label;
}

}  // namespace

AlgorithmView::AlgorithmView(const Focus& focus, const Selection& selection, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 2, 0, 8);
  layout->setSpacing(0);
  layout->addWidget(heading(tr("All directions (section 3.3)")));
  for (const CodeText& text : algorithm_code()) {
    if (text.line == CodeLine::sort)
      layout->addWidget(heading(tr("One direction by a local visibility map (section 3.2)")));
    lines_.push_back(code_line(text.words, text.indent));
    layout->addWidget(lines_.back());
  }
  values_ = new ValueGrid;
  values_->layout()->setContentsMargins(12, 10, 12, 4);
  moment_ = values_->add_row(tr("n, d"), {}, tr("Iteration and direction"));
  i_ = values_->add_row(tr("i"), {}, tr("The patch whose polygon is processed"));
  i_->setObjectName("value_i");
  map_ = values_->add_row(tr("V"), {}, tr("Fragments of the map, before and after the step"));
  lists_ = values_->add_row(tr("I, O"), {}, tr("Fragments of the inside and of the outside list"));
  j_ = values_->add_row(tr("j, A(j)"), tr("m²"),
                        tr("The selected patch of those that light i, or the one that does most; "
                           "the area that i sees of it"));
  j_->setObjectName("value_j");
  weight_ =
      values_->add_row(tr("J_d, M"), {}, tr("Weight and number of directions; a pass serves two"));
  radiosity_ = values_->add_row(tr("B_j(n)"), tr("W/m²"), tr("Radiosity of j: red, green, blue"));
  gathered_ = values_->add_row(tr("Σ"), tr("W/m²"),
                               tr("What the step adds to B_i(n+1), before any normalisation"));
  gathered_->setObjectName("value_gathered");
  layout->addWidget(values_);

  layout->addWidget(heading(tr("The same by a global map (section 3.1)")));
  for (const QString& words : global_map_code()) {
    const auto text = words.trimmed();
    QLabel* label = code_line(text, static_cast<int>(words.size() - text.size()) / 4);
    label->setForegroundRole(QPalette::PlaceholderText);
    layout->addWidget(label);
  }
  layout->addStretch(1);
  connect(&focus_, &Focus::moved, this, &AlgorithmView::show_moment);
  connect(&selection_, &Selection::changed, this, &AlgorithmView::show_moment);
  show_moment();
}

void AlgorithmView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  show_moment();
}

void AlgorithmView::show_moment() {
  const auto current = current_lines(focus_);
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const CodeLine line = algorithm_code()[k].line;
    const bool on = std::find(current.begin(), current.end(), line) != current.end();
    const QString style =
        on ? QStringLiteral("background: %1; font-weight: bold;").arg(theme::processed.name())
           : QString();
    if (lines_[k]->styleSheet() != style) lines_[k]->setStyleSheet(style);
  }
  const auto state =
      snapshot_ ? algorithm_state(focus_, *snapshot_, selection_.patch()) : std::nullopt;
  values_->setEnabled(state.has_value());
  show_values(state.value_or(AlgorithmState()));
}

void AlgorithmView::show_values(const AlgorithmState& state) {
  const QString none = QStringLiteral("–");
  const bool any = state.i != no_patch, lit = state.j != no_patch;
  const Moment& moment = focus_.moment();
  moment_->setText(focus_.map()
                       ? tr("%1, %2").arg(moment.iteration).arg(count_text(moment.direction + 1))
                       : none);
  i_->setText(any ? tr("%1, A = %2 m², %3")
                        .arg(QString::number(state.i), number_text(state.area_i),
                             state.front_facing ? tr("faces the light") : tr("shines down"))
                  : none);
  map_->setText(any ? tr("%1 → %2").arg(count_text(state.map_before), count_text(state.map_after))
                    : none);
  lists_->setText(any ? tr("%1, %2").arg(count_text(state.inside), count_text(state.outside))
                      : none);
  j_->setText(lit ? tr("%1, %2").arg(QString::number(state.j), number_text(state.area_j)) : none);
  weight_->setText(any ? tr("4π, %1").arg(count_text(state.directions)) : none);
  radiosity_->setText(state.radiosity_j ? rgb_text(*state.radiosity_j) : none);
  gathered_->setText(state.gathered ? rgb_text(*state.gathered) : none);
}

}  // namespace transillum::viewer
