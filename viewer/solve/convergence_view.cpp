// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Charts". Both charts are redrawn from each snapshot of the solver; the position in
// focus is marked in them.
#include "solve/convergence_view.h"

#include <algorithm>
#include <numbers>

#include "support/number_text.h"
#include "transillum/bounds.h"
#include "widgets/build.h"
#include "widgets/log_chart.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

std::vector<LogChart::Level> levels_of(const SolverSnapshot& snapshot) {
  const double accuracy = snapshot.options.goal.accuracy;
  if (accuracy > 0) {  // the goal has chosen the tolerance
    return {{ConvergenceView::tr("accuracy %1 %").arg(number_text(100 * accuracy)), theme::ink,
             accuracy}};
  }
  if (snapshot.options.iterations > 0) {
    return {};
  }
  return {{ConvergenceView::tr("tolerance"), theme::warm, snapshot.options.tolerance}};
}

/// Adds the error of B after each iteration, estimated from the spread of replicas, between its
/// limits.
void add_error_band(const SolverSnapshot& snapshot, std::vector<LogChart::Line>& lines) {
  if (snapshot.errors.empty()) {
    return;
  }
  const auto add = [&](const QString& name, double ErrorBand::*member, ChartDashes dashes) {
    std::vector<double> values;
    for (const ErrorBand& error : snapshot.errors) {
      values.push_back(error.*member);
    }
    lines.push_back({name, theme::ink, std::move(values), false, dashes});
  };
  add(ConvergenceView::tr("error"), &ErrorBand::estimate, ChartDashes::solid);
  add({}, &ErrorBand::limit, ChartDashes::fine_dots);
  add({}, &ErrorBand::lowest, ChartDashes::fine_dots);
}

}  // namespace

std::vector<double> predicted_changes(const SolverSnapshot& snapshot) {
  const SolveStatistics& s = snapshot.statistics;
  const double rate = s.predicted_contraction;
  std::vector<double> predicted;
  // In the other schemes the matrix changes from iteration to iteration.
  if (snapshot.options.scheme != Scheme::fixed || s.iteration_records.empty() ||
      !(rate > 0 && rate < 1)) {
    return predicted;
  }
  const int requested = snapshot.options.iterations;
  // At most twice the iterations done, so that the chart leaves room for these.
  const auto last = requested > 0 ? static_cast<std::size_t>(requested)
                                  : std::max<std::size_t>(8, 2 * s.iteration_records.size());
  for (double change = s.iteration_records.front().change_of_b; predicted.size() < last;
       change *= rate) {
    predicted.push_back(change);
    if (requested == 0 && change <= snapshot.options.tolerance &&
        predicted.size() >= s.iteration_records.size()) {
      break;
    }
  }
  return predicted;
}

ConvergenceView::ConvergenceView(Focus& focus, QWidget* parent) : QWidget(parent), focus_(focus) {
  iteration_chart_ = new LogChart(tr("Change per iteration"), tr("Iteration"), tr("Relative"));
  iteration_chart_->set_hint(tr("A point for each iteration, once it is finished"));
  direction_chart_ = new LogChart(tr("Within an iteration"), tr("Direction"), tr("Relative"));
  direction_chart_->set_hint(tr("A point for each direction"));
  auto* layout = make_column(this, {}, 1);
  layout->addWidget(iteration_chart_);
  layout->addWidget(direction_chart_);

  iteration_chart_->setObjectName("iteration_chart");
  iteration_chart_->setToolTip(symbol_tip(
      tr("remainder: bound of the light that further iterations add to all patches, or to the "
         "dimmest tenth of their area, relative to the reflected light\n"
         "change (eq. 25): the paper's rule, the largest change of B over the largest B, with E\n"
         "its bound (eq. 22): the first one, reduced by the contraction with eq. 21\n"
         "error: estimate of the error of B from the replicas, between its limits\n"
         "Click to go to an iteration"),
      "6"));
  direction_chart_->setObjectName("direction_chart");
  direction_chart_->setToolTip(
      symbol_tip(tr("change of B: relative change of the running estimate by each direction\n"
                    "worst Σ F, ε/π: largest error of a sum of form factors with the directions so "
                    "far (eq. 17)\n"
                    "its bound (eq. 21): of ε, for evenly spread directions, divided by π\n"
                    "Click to go to a direction"),
                 "7.1"));
  connect(iteration_chart_, &LogChart::clicked, this,
          [this](int x) { focus_.go_to_direction(x - 1, focus_.target().direction); });
  connect(direction_chart_, &LogChart::clicked, this,
          [this](int x) { focus_.go_to_direction(shown_iteration_, x - 1); });
  connect(&focus_, &Focus::moved, this, &ConvergenceView::show_position);
}

std::vector<LineChart> ConvergenceView::charts() const {
  return {iteration_chart_->chart(), direction_chart_->chart()};
}

void ConvergenceView::show_position() {
  const bool any = focus_.map() != nullptr;
  const RunPosition& position = focus_.position();
  iteration_chart_->set_mark(any ? std::optional(position.iteration + 1) : std::nullopt);
  direction_chart_->set_mark(any && position.iteration == shown_iteration_
                                 ? std::optional(position.direction + 1)
                                 : std::nullopt);
}

void ConvergenceView::show_snapshot(const SolverSnapshot& snapshot) {
  // In the semi-iterative scheme, the change belongs to one iteration, the error to the mean.
  const bool averages = snapshot.options.scheme == Scheme::semi_iterative;
  std::vector<double> remainders, changes, mean_errors;
  for (const IterationRecord& iteration : snapshot.statistics.iteration_records) {
    changes.push_back(iteration.change_of_b);
    const double left = std::max(iteration.remainder, iteration.remainder_dimmest);
    remainders.push_back(std::isfinite(left) ? left : 0);
    if (averages) {
      mean_errors.push_back(iteration.error.value_or(0));
    }
  }
  std::vector<LogChart::Line> lines{
      {tr("remainder"), theme::accent, std::move(remainders), true},
      {tr("change (eq. 25)"), theme::good, std::move(changes)},
      averages ? LogChart::Line{tr("error of the mean"), theme::good, std::move(mean_errors)}
               : LogChart::Line{tr("its bound (eq. 22)"), theme::good, predicted_changes(snapshot),
                                false, ChartDashes::dash_dot}};
  add_error_band(snapshot, lines);
  iteration_chart_->show_lines(std::move(lines), levels_of(snapshot),
                               std::max(snapshot.options.iterations, 8));

  direction_chart_->set_title(
      tr("Within iteration %1").arg(count_text(snapshot.estimate_iteration + 1)));
  const int passes = snapshot.progress.passes;
  // The error of the directions so far in integrating the cosine, and its bound (section 4).
  std::vector<double> errors, bounds;
  const int per_pass = snapshot.options.two_way ? 2 : 1;
  for (std::size_t d = 0; d < snapshot.quadrature_errors.size(); ++d) {
    errors.push_back(snapshot.quadrature_errors[d] / std::numbers::pi);
    bounds.push_back(quadrature_error_bound(static_cast<double>(d + 1) * per_pass) /
                     std::numbers::pi);
  }
  direction_chart_->show_lines(
      {{tr("change of B"), theme::accent, snapshot.estimate_changes, false, ChartDashes::solid, 2},
       {tr("worst Σ F, ε/π"), theme::good, std::move(errors), false, ChartDashes::solid, 0.9},
       {tr("its bound (eq. 21)"), theme::warm, std::move(bounds), false, ChartDashes::dashes}},
      {}, passes);
  shown_iteration_ = snapshot.estimate_iteration;
  show_position();
}

}  // namespace transillum::viewer
