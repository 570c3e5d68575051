// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The status bar's permanent part. Loading progress, state and snapshots come from the solver's
// thread by queued signals; this only formats them.
#include "solve/progress_line.h"

#include <QAbstractAnimation>
#include <QFileInfo>
#include <QLabel>
#include <QProgressBar>
#include <algorithm>
#include <climits>
#include <cmath>
#include <utility>

#include "model/snapshot_values.h"
#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/elided.h"

namespace transillum::viewer {

namespace {

QString iterations_text(int count) {
  return count == 1 ? ProgressLine::tr("1 iteration")
                    : ProgressLine::tr("%1 iterations").arg(count_text(count));
}

QString percent(double fraction) {
  return ProgressLine::tr("%1 %").arg(number_text(100 * fraction));
}

// "error by directions of the worst surface, floor,": where the goal is about surfaces. Names of
// files can be longer than the window is wide.
QString error_name(const AccuracyReport& report, int longest_name) {
  return report.surface.empty()
             ? ProgressLine::tr("error by directions")
             : ProgressLine::tr("error by directions of the worst surface, %1,")
                   .arg(elided_name(QString::fromStdString(report.surface), longest_name));
}

// The text on a finished solve with a goal.
QString accuracy_text(const AccuracyReport& report, int longest_name) {
  const QString passes = count_text(report.passes_made), error = error_name(report, longest_name);
  if (report.goal.accuracy == 0 &&
      (report.obstacle == AccuracyObstacle::none || report.obstacle == AccuracyObstacle::seconds)) {
    return ProgressLine::tr("Time is up: %1 at most %2 after %3 passes")
        .arg(error, percent(report.error), passes);
  }
  if (!report.reached) {
    return ProgressLine::tr("Not reached: %1 at most %2 (limit %3), %4 passes")
        .arg(error, percent(report.error), percent(report.goal.accuracy), passes);
  }
  return ProgressLine::tr("Good enough: %1 at most %2 (limit %3), %4 passes")
      .arg(error, percent(report.error), percent(report.goal.accuracy), passes);
}

// The same without shortening.
QString accuracy_tip(const AccuracyReport& report) {
  const QString text =
      ProgressLine::tr(
          "%1.\nThe size of the patches adds to it: Errors, in the panel Surfaces, "
          "measures every cause")
          .arg(accuracy_text(report, INT_MAX));
  return report.is_dark ? ProgressLine::tr(
                              "%1.\nThe error is relative to a thousandth of the brightest "
                              "surface, as the surface is in the dark")
                              .arg(text)
                        : text;
}

// The text on a finished solve to a total error.
QString total_text(const SolverSnapshot& snapshot) {
  const TotalState& total = *snapshot.total;
  const TotalStage& last = total.stages.back();
  const std::int64_t most =
      snapshot.refine.patches > 0 ? snapshot.refine.patches : TotalGoal().patches;
  return ProgressLine::tr("In all %1 (%2), limit %3: %4")
      .arg(percent(last.errors.total()), elided_name(QString::fromStdString(last.surface), 20),
           percent(snapshot.options.goal.accuracy),
           QString::fromStdString(end_text(*total.end, most)));
}

QString finished_text(const SolverSnapshot& snapshot) {
  const auto& total = snapshot.total;
  if (snapshot.materials) {
    // The solve reached its accuracy with other materials.
    return ProgressLine::tr("Changed materials: light after %1")
        .arg(iterations_text(snapshot.statistics.iterations));
  }
  if (total && total->end && !total->stages.empty()) {
    return total_text(snapshot);
  }
  if (snapshot.accuracy) {
    constexpr int longest_name = 20;
    return accuracy_text(*snapshot.accuracy, longest_name);
  }
  return (snapshot.statistics.converged ? ProgressLine::tr("Converged after %1, %2 s")
                                        : ProgressLine::tr("Finished after %1, %2 s"))
      .arg(iterations_text(snapshot.progress.iteration),
           QString::number(snapshot.statistics.seconds_total, 'f', 1));
}

bool is_within_iteration(const SolveProgress& progress) {
  return progress.direction > 0 && progress.direction < progress.passes;
}

double light_left(const IterationRecord& record) {
  return std::max(record.remainder, record.remainder_dimmest);
}

// The fraction of the iterations that is done, by their number or by how far the light that is left
// has decreased, on a logarithmic scale, from the first of them to the tolerance.
double fraction_of_iterations(const SolverSnapshot& snapshot) {
  const SolveOptions& options = snapshot.options;
  if (options.iterations > 0) {
    return std::min(1.0, 1.0 * snapshot.progress.iteration / options.iterations);
  }
  const auto& records = snapshot.statistics.iteration_records;
  if (records.empty()) {
    return 0;
  }
  // The first has done its part, too.
  const double factor = std::clamp(snapshot.statistics.rho_max, 0.1, 0.9);
  const double first = light_left(records.front()), now = light_left(records.back());
  const double start = (std::isfinite(first) ? first : 1.0) / factor;
  const double done = std::log(start / now) / std::log(start / options.tolerance);
  return now > 0 ? std::clamp(done, 0.0, 1.0) : 1.0;
}

// Whether iterations take their form factors from those that are kept, and make no passes.
bool iterates_without_passes(const SolverSnapshot& snapshot) {
  return snapshot.progress.iteration > 0 && snapshot.statistics.kept_form_factors &&
         !traits_of(snapshot.options.scheme).renews_directions;
}

// Where a solve is that has not finished.
QString unfinished_text(const SolverSnapshot& snapshot, bool running) {
  const SolveProgress& progress = snapshot.progress;
  if (snapshot.of_file) {
    return (snapshot.loaded->description ? ProgressLine::tr("Earlier solve: %1 of %2 passes each")
                                         : ProgressLine::tr("From the file: %1 of %2 passes each"))
        .arg(iterations_text(snapshot.statistics.iterations),
             count_text(snapshot.statistics.passes));
  }
  const auto& rounds = snapshot.statistics.refinement;
  const auto& total = snapshot.total;
  const QString round =
      !snapshot.refinement.left ? QString()
      : total ? ProgressLine::tr("Stage %1: ").arg(count_text(std::ssize(total->stages) + 1))
              : ProgressLine::tr("Round %1: ").arg(count_text(std::ssize(rounds) + 1));
  if (progress.iteration == 0 && progress.direction == 0 && (running || rounds.empty())) {
    return running ? round + ProgressLine::tr("Starting")
                   : ProgressLine::tr("Ready: run, or process one direction");
  }
  const QString at =
      is_within_iteration(progress) || progress.iteration == 0
          ? ProgressLine::tr("Iteration %1, direction %2 of %3")
                .arg(count_text(progress.iteration + 1), count_text(progress.direction),
                     count_text(progress.passes))
      : running && !iterates_without_passes(snapshot)
          ? ProgressLine::tr("%1 done, the next begins").arg(iterations_text(progress.iteration))
          : ProgressLine::tr("%1 done").arg(iterations_text(progress.iteration));
  return !running            ? ProgressLine::tr("Paused: %1").arg(round + at)
         : snapshot.of_draft ? ProgressLine::tr("Draft shown. %1").arg(at)
                             : round + at;
}

// The name of the scene; for a result file, the names of the file and of its scene.
QString name_of(const LoadedScene& loaded) {
  const auto short_name = [](const std::string& path) {
    return QFileInfo(QString::fromStdString(path)).fileName();
  };
  QString scene = short_name(loaded.scene->name());
  if (!loaded.stored || loaded.scene->name() == loaded.file) {
    return scene;
  }
  return ProgressLine::tr("%1 (%2)").arg(short_name(loaded.file), scene);
}

}  // namespace

ProgressLine::ProgressLine(QWidget* parent) : QWidget(parent) {
  scene_ = named("scene_summary", new QLabel);
  set_strong(*scene_);
  scene_->hide();
  phase_ = named("phase", new ElidedLabel(tr("No scene")));
  phase_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar_ = named("progress", new QProgressBar);
  bar_->setMinimumWidth(90);
  bar_->setMaximumWidth(260);
  bar_->setFixedHeight(16);
  bar_->setVisible(false);
  rate_ = named("rate", new QLabel);
  time_ = named("time", new QLabel);
  // Fixed widths, so that labels do not move while numbers change.
  rate_->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("8888.8 passes/s  ")));
  time_->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("88 min 88 s left  ")));
  rate_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  time_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);

  auto* layout = make_row(this, {8, 3, 8, 3}, 16);
  layout->addWidget(scene_);
  layout->addWidget(phase_, 1);
  layout->addWidget(bar_, 1);
  layout->addWidget(rate_);
  layout->addWidget(time_);
}

void ProgressLine::show_scene(const LoadedScene& loaded) {
  snapshot_ = nullptr;
  scene_->show();
  const QString name = name_of(loaded);
  constexpr int longest_name = 30;
  const QString short_name =
      name.size() > longest_name
          ? name.left(longest_name / 2) + QStringLiteral("…") + name.right(longest_name / 2 - 1)
          : name;
  scene_->setText(tr("%1, %2 patches").arg(short_name, count_text(loaded.scene->patch_count())));
  scene_->setToolTip(
      tr("%1: %2 fragments; scene read in %3 s, BSP tree built in %4 s")
          .arg(QString::fromStdString(loaded.scene->name()),
               count_text(static_cast<std::int64_t>(loaded.tree->fragments().size())),
               QString::number(loaded.seconds_load, 'f', 2),
               QString::number(loaded.seconds_bsp, 'f', 2)));
}

void ProgressLine::show_loading(const QString& phase, double fraction) {
  const bool measuring =
      state_ == RunState::running && snapshot_ && snapshot_->total && snapshot_->progress.finished;
  if (state_ != RunState::loading && !measuring) {
    return;
  }
  phase_->setText(phase + QStringLiteral("…"));
  bar_->setVisible(true);
  bar_->setToolTip({});
  set_steps(fraction < 0 ? 0 : 1000);
  bar_->setValue(static_cast<int>(1000 * fraction));
  rate_->clear();
  time_->clear();
}

void ProgressLine::show_state(RunState state) {
  state_ = state;
  if (state == RunState::empty) {
    phase_->setText(tr("No scene"));
  }
  // A bar without an end would move on, whatever has become of the work.
  const bool is_busy = bar_->maximum() == 0;
  if (state == RunState::empty || (is_busy && state != RunState::loading)) {
    set_steps(1);
    bar_->reset();
    bar_->setVisible(false);
  }
  show_solve();
}

void ProgressLine::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  show_solve();
}

void ProgressLine::show_solve() {
  if (!snapshot_ || state_ == RunState::loading) {
    return;
  }
  const SolveProgress& progress = snapshot_->progress;
  const bool running = state_ == RunState::running, finished = state_ == RunState::finished;
  // A solve that is over needs the room for its text.
  bar_->setVisible(!snapshot_->of_file && !finished && has_light(*snapshot_));
  rate_->setVisible(!finished);
  time_->setVisible(!finished);
  if (running && progress.stage != SolveProgress::Stage::passes) {
    show_stage_of_lobes(progress);
    return;
  }
  const bool within = is_within_iteration(progress);
  show_bar(progress, within);
  const bool reached_with_materials = has_light(*snapshot_) && !snapshot_->materials;
  phase_->setToolTip(finished && snapshot_->accuracy && reached_with_materials
                         ? accuracy_tip(*snapshot_->accuracy)
                         : QString());
  phase_->setText(!running && !has_light(*snapshot_) ? tr("No light: not solved")
                  : finished                         ? finished_text(*snapshot_)
                                                     : unfinished_text(*snapshot_, running));

  const bool timed = running && progress.passes_per_second > 0;
  rate_->setText(timed ? tr("%1 passes/s").arg(QString::number(progress.passes_per_second, 'f', 1))
                       : QString());
  time_->setText(timed && within ? tr("%1 left").arg(duration_text(progress.seconds_left))
                                 : QString());
  time_->setToolTip(tr("Time left in this iteration"));
}

/// @param steps 0: the bar moves by itself
void ProgressLine::set_steps(int steps) {
  bar_->setRange(0, steps);
  if (steps == 0) {
    return;
  }
  // The style stops the movement only when it draws a step that is done.
  qDeleteAll(bar_->findChildren<QAbstractAnimation*>());
}

/// The bar is empty between iterations that make passes.
void ProgressLine::show_bar(const SolveProgress& progress, bool within) {
  constexpr int steps = 1000;
  if (!within && iterates_without_passes(*snapshot_)) {
    set_steps(steps);
    bar_->setValue(static_cast<int>(steps * fraction_of_iterations(*snapshot_)));
    bar_->setToolTip(tr("Iterations done, by the light that is still to be reflected"));
    return;
  }
  set_steps(std::max(progress.passes, 1));
  bar_->setToolTip(tr("Directions of this iteration"));
  if (within) {
    bar_->setValue(progress.direction);
  } else {
    bar_->reset();
  }
}

/// With lobes, passes are the smaller part of an iteration.
void ProgressLine::show_stage_of_lobes(const SolveProgress& progress) {
  bar_->setToolTip({});
  set_steps(1000);
  bar_->setValue(static_cast<int>(1000 * progress.stage_fraction));
  phase_->setText(progress.stage == SolveProgress::Stage::scaling_lobes
                      ? tr("Scaling lobes")
                      : tr("Iteration %1, reflecting").arg(count_text(progress.iteration + 1)));
  const bool timed = progress.lobes_per_second > 0;
  rate_->setText(timed ? tr("%1 lobes/s").arg(QString::number(progress.lobes_per_second, 'f', 1))
                       : QString());
  time_->setText(timed ? tr("%1 left").arg(duration_text(progress.seconds_left)) : QString());
  time_->setToolTip(tr("Time left in this step"));
}

}  // namespace transillum::viewer
