// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/solve_cost.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>

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

/// The passes that a solve makes; not set where the solve chooses them and nothing tells how many.
std::optional<double> passes_of(const SolverSnapshot& done, const SolveOptions& wanted) {
  if (!wanted.goal.is_set()) {
    const bool renews = traits_of(wanted.scheme).renews_directions;
    const int iterations = wanted.iterations > 0 ? wanted.iterations : wanted.averaged_iterations;
    return 1.0 * wanted.directions * (renews ? std::max(iterations, 1) : 1);
  }
  if (!(wanted.goal.accuracy > 0) || !done.accuracy || !(done.accuracy->error > 0) ||
      done.accuracy->goal.of != wanted.goal.of) {
    return std::nullopt;
  }
  // The error of antipodal sets decreases about as the passes to this power.
  constexpr double exponent = 0.9;
  const double more = std::pow(done.accuracy->error / wanted.goal.accuracy, 1 / exponent);
  const double passes = static_cast<double>(done.accuracy->passes_made) * more;
  return wanted.goal.passes > 0 ? std::min(passes, 1.0 * static_cast<double>(wanted.goal.passes))
                                : passes;
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
                 .memory = expected_memory(patches, wanted.replicas, unknowns_of(wanted))};
  if (!done || !comparable(done->options, wanted) || done->statistics.passes_made == 0) {
    return cost;
  }
  const std::optional<double> passes = passes_of(*done, wanted);
  if (!passes) {
    return cost;
  }
  const SolveStatistics& s = done->statistics;
  // A pass with linear functions takes about one and a half times as long.
  const double basis =
      (unknowns_of(wanted) > 1 ? 1.5 : 1) / (unknowns_of(done->options) > 1 ? 1.5 : 1);
  const double size =
      static_cast<double>(patches) / static_cast<double>(std::max<std::int64_t>(s.patches, 1));
  const double per_pass = s.seconds_transfers / static_cast<double>(s.passes_made);
  cost.seconds = size * (basis * per_pass * *passes + s.seconds_bsp + s.seconds_first_shot +
                         s.seconds_iterate);
  return cost;
}

QString cost_text(const SolveCost& cost) {
  constexpr std::int64_t countless = std::int64_t{1} << 40;
  if (cost.patches > countless) {
    return tr("more than 10¹² patches");
  }
  QStringList parts{tr("%1 patches").arg(count_text(cost.patches))};
  if (cost.seconds) {
    const QString time = duration_text(*cost.seconds);
    parts << (*cost.seconds < 1         ? tr("less than 1 s")
              : time.startsWith("over") ? time
                                        : tr("about %1").arg(time));
  }
  parts << memory_text(cost.memory);
  return parts.join(QStringLiteral(", "));
}

}  // namespace transillum::viewer
