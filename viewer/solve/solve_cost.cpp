// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/solve_cost.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/build/patch_count.h"
#include "support/number_text.h"

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("SolveCost", text); }

int unknowns_of(const SolveOptions& options) { return options.basis == Basis::linear ? 3 : 1; }

/// The time of a pass of these options relative to another engine's cannot be told from its own.
bool comparable(const SolveOptions& a, const SolveOptions& b) {
  return takes_directions(b.engine) && a.engine == b.engine && a.glossy == b.glossy &&
         a.engine_options.resolution == b.engine_options.resolution &&
         a.engine_options.order == b.engine_options.order;
}

struct Passes {
  double least, most;
};

/// Passes of all stages until the worst surface is off by at most 1 %. Measured: boards 268,
/// furnace and stars 308, gallery 415, cornell-box 880, rooms 940.
constexpr Passes passes_of_percent{250, 1000};
/// The error of antipodal sets decreases about as the passes to this power.
constexpr double exponent = 0.9;

/// Passes of all stages of a solve so far, with all passes of the present one.
double passes_begun(const SolverSnapshot& done) {
  const bool is_between = done.progress.finished && done.accuracy;
  return (done.accuracy ? static_cast<double>(done.accuracy->passes_made) : 0.0) +
         (is_between ? 0 : done.progress.passes);
}

/// The error of `done` that a goal is about, 0 if it is not known; and the passes of all its
/// stages. The estimate of the first iteration under way is no error of B.
std::pair<double, double> known_error(const SolverSnapshot& done, const AccuracyGoal& goal) {
  if (done.accuracy && done.accuracy->goal.of == goal.of) {
    return {done.accuracy->error, static_cast<double>(done.accuracy->passes_made)};
  }
  if (done.error.replicas == 0 || done.of_draft || done.progress.iteration == 0) {
    return {0, 0};
  }
  const double error = goal.of == AccuracyOf::surfaces     ? done.error.surfaces.limit
                       : goal.of == AccuracyOf::irradiance ? done.error.irradiance.limit
                       : goal.of == AccuracyOf::rms        ? done.error.rms_limit
                                                           : 0;
  return {error, static_cast<double>(done.statistics.passes_made)};
}

/// Iterations of `done` when it ends; those finished, where that is not known.
double iterations_of(const SolverSnapshot& done) {
  const auto& records = done.statistics.iteration_records;
  const double made = std::max(1.0, static_cast<double>(records.size()));
  if (done.progress.finished || records.empty()) {
    return made;
  }
  const IterationRecord& last = records.back();
  const double left = std::max(last.remainder, last.remainder_dimmest);
  const double more = std::log(done.options.tolerance / left) / std::log(last.contraction);
  return std::isfinite(more) && more > 0 && last.contraction < 1 ? made + std::ceil(more) : made;
}

/// Whether lobes reflect in each iteration, which takes longer than the passes do.
bool reflects_lobes(const SolverSnapshot& done) { return done.statistics.glossy.patches > 0; }

/// Whether each iteration makes its passes, which are not kept.
bool repeats_passes(const SolverSnapshot& done) {
  return done.statistics.iterations > 1 && !done.statistics.kept_form_factors;
}

/// The passes that a solve makes; not set where the solve chooses them and nothing tells how many.
std::optional<Passes> passes_of(const SolverSnapshot& done, const SolveOptions& wanted) {
  const AccuracyGoal& goal = wanted.goal;
  if (!goal.is_set()) {
    const bool renews = traits_of(wanted.scheme).renews_directions;
    const int iterations = wanted.iterations > 0 ? wanted.iterations : wanted.averaged_iterations;
    const double passes = wanted.directions * (renews                 ? std::max(iterations, 1)
                                               : repeats_passes(done) ? iterations_of(done)
                                                                      : 1.0);
    return Passes{passes, passes};
  }
  if (!(goal.accuracy > 0)) {
    return std::nullopt;
  }
  const bool is_same = done.options.goal == goal;
  if (is_same && done.accuracy && done.progress.finished) {
    const auto passes = static_cast<double>(done.accuracy->passes_made);
    return Passes{passes, passes};
  }
  Passes result{};
  const auto [error, made] = known_error(done, goal);
  if (error > 0 && std::isfinite(error)) {
    result.least = result.most = made * std::pow(error / goal.accuracy, 1 / exponent);
  } else if (goal.of == AccuracyOf::surfaces) {
    const double more = std::pow(0.01 / goal.accuracy, 1 / exponent);
    result = {more * passes_of_percent.least, more * passes_of_percent.most};
  } else {
    return std::nullopt;
  }
  if (is_same) {  // and not finished
    const double least = passes_begun(done);
    result = {std::max(result.least, least), std::max(result.most, least)};
  }
  if (goal.passes > 0) {
    const auto limit = static_cast<double>(goal.passes);
    result = {std::min(result.least, limit), std::min(result.most, limit)};
  }
  return result;
}

/// Linear systems that are solved: one for each replica, and one for all.
int systems_of(const SolveOptions& options) {
  const int usual = options.goal.of == AccuracyOf::max ? 8 : 4;
  const int replicas = options.goal.is_set() && options.replicas < 2 ? usual : options.replicas;
  return replicas > 1 ? replicas + 1 : 1;
}

/// Wall time of the iterations of `done` when it ends, without their passes, s.
double seconds_of_iterations(const SolverSnapshot& done) {
  const SolveStatistics& s = done.statistics;
  const auto made = static_cast<double>(s.iteration_records.size());
  if (made < 2 || repeats_passes(done)) {  // the first iteration's time includes its passes
    return s.seconds_iterate;
  }
  return s.seconds_iterate + (iterations_of(done) - made) * s.iteration_records.back().seconds;
}

/// Wall time of so many passes and of what follows them, s.
double seconds_of(double passes, const SolverSnapshot& done, const SolveOptions& wanted) {
  const SolveStatistics& s = done.statistics;
  const double more = passes / static_cast<double>(s.passes_made);
  // A pass with linear functions takes about one and a half times as long.
  const double basis =
      (unknowns_of(wanted) > 1 ? 1.5 : 1) / (unknowns_of(done.options) > 1 ? 1.5 : 1);
  // Directions meet pairs of patches that others have met, so that form factors grow slower; lobes
  // reflect the light of each pass.
  const double iterate = 1.0 * systems_of(wanted) / systems_of(done.options) *
                         (reflects_lobes(done) ? more : std::sqrt(more));
  return basis * s.seconds_transfers * more + s.seconds_bsp + s.seconds_first_shot +
         iterate * seconds_of_iterations(done);
}

/// Whether enough of `done` is finished to tell the time of another solve.
bool tells_time(const SolverSnapshot& done) {
  constexpr int fewest = 2;  // the first iteration has passes
  return done.statistics.passes_made > 0 && done.statistics.seconds_transfers > 0 &&
         (!reflects_lobes(done) || done.statistics.iterations >= fewest);
}

/// "3 s", "2 min", "5 h".
struct ShortTime {
  double value;
  QString unit;
};

ShortTime short_time(double seconds) {
  return seconds < 100           ? ShortTime{std::ceil(seconds), tr("s")}
         : seconds < 100 * 60    ? ShortTime{std::round(seconds / 60), tr("min")}
         : seconds < 1000 * 3600 ? ShortTime{std::round(seconds / 3600), tr("h")}
                                 : ShortTime{std::round(seconds / 86400), tr("days")};
}

// In few characters, so that a line of a narrow panel has room for it.
QString time_text(const SolveCost& cost) {
  const ShortTime least = short_time(*cost.seconds), most = short_time(*cost.most_seconds);
  const QString to = tr("%1 %2").arg(most.value).arg(most.unit);
  if (*cost.most_seconds < 1) {
    return tr("less than 1 s");
  }
  if (least.unit != most.unit) {
    return tr("up to %1").arg(to);
  }
  return least.value == most.value ? tr("about %1").arg(to) : tr("%1–%2").arg(least.value).arg(to);
}

QString memory_text(std::uint64_t bytes) {
  const double megabytes = 1e-6 * static_cast<double>(bytes);
  if (megabytes < 1000) {
    return tr("%1 MB").arg(std::max(1.0, std::round(megabytes)));
  }
  return tr("%1 GB").arg(QString::number(megabytes / 1000, 'f', megabytes < 10000 ? 1 : 0));
}

}  // namespace

SolveCost cost_of(const SolverSnapshot* done, const SolveOptions& wanted, std::int64_t patches) {
  SolveCost cost{.patches = patches,
                 .seconds = {},
                 .most_seconds = {},
                 .memory = expected_memory(patches, wanted.replicas, unknowns_of(wanted))};
  if (!done || !comparable(done->options, wanted) || !tells_time(*done)) {
    return cost;
  }
  const std::optional<Passes> passes = passes_of(*done, wanted);
  if (!passes) {
    return cost;
  }
  const double size = static_cast<double>(patches) /
                      static_cast<double>(std::max<std::int64_t>(done->statistics.patches, 1));
  cost.seconds = size * seconds_of(passes->least, *done, wanted);
  cost.most_seconds = size * seconds_of(passes->most, *done, wanted);
  return cost;
}

QString cost_text(const SolveCost& cost) {
  constexpr std::int64_t countless = std::int64_t{1} << 40;
  if (cost.patches > countless) {
    return tr("more than 10¹² patches");
  }
  QStringList parts{tr("%1 patches").arg(count_text(cost.patches))};
  if (cost.seconds) {
    parts << time_text(cost);
  }
  parts << memory_text(cost.memory);
  return parts.join(QStringLiteral(", "));
}

QString short_time_text(const SolveCost& cost) {
  if (!cost.seconds) {
    return {};
  }
  const ShortTime least = short_time(*cost.seconds), most = short_time(*cost.most_seconds);
  const QString to = tr("%1 %2").arg(most.value).arg(most.unit);
  if (*cost.most_seconds < 1) {
    return tr("< 1 s");
  }
  if (least.unit != most.unit) {
    return QStringLiteral("≤ ") + to;
  }
  return least.value == most.value ? to : tr("%1–%2").arg(least.value).arg(to);
}

}  // namespace transillum::viewer
