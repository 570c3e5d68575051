// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/solve_summary.h"

#include <QLabel>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/snapshot_values.h"
#include "radiosity/analysis/power_table.h"
#include "scene/build/patch_count.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "widgets/build.h"
#include "widgets/value_grid.h"

namespace transillum::viewer {

namespace {

constexpr double accuracy = 0.01;  ///< accuracy of the rows "Directions for 1 %"

QString closure_text(const SolverSnapshot& snapshot) {
  const SolveStatistics& s = snapshot.statistics;
  if (!is_open(s)) {
    // The outer sides of two-sided faces see nothing, which is no defect.
    return has_two_sided_faces(*snapshot.loaded->scene)
               ? SolveSummary::tr("closed, outer sides of two-sided faces omitted")
               : SolveSummary::tr("closed, defect %1").arg(number_text(s.closure_defect_max));
  }
  const auto fraction = escaped_share(snapshot);
  return fraction
             ? SolveSummary::tr("open: %1 % of the light escapes").arg(number_text(100 * *fraction))
             : SolveSummary::tr("open: light escapes");
}

QString reason_text(QueryFailure reason) {
  const QString label =
      QString::fromStdString(choices_of<QueryFailure>().labels[static_cast<std::size_t>(reason)]);
  return label.toLower();
}

/// The exact and the repeated queries of some passes, each with its most frequent reason.
QString reasons_text(const PatchCost& total, int passes) {
  const std::int64_t exact = total.exact_queries();
  const auto repeated = std::accumulate(total.repeated.begin(), total.repeated.end(), 0.0);
  QString text = exact == 0 ? SolveSummary::tr("none")
                            : SolveSummary::tr("%1 per pass (%2)")
                                  .arg(number_text(static_cast<double>(exact) / passes),
                                       reason_text(main_of(total.exact)));
  if (repeated > 0) {
    text += SolveSummary::tr("; %1 % repeated (%2)")
                .arg(number_text(100 * repeated / static_cast<double>(total.queries)),
                     reason_text(main_of(total.repeated)));
  }
  return text;
}

}  // namespace

SolveSummary::SolveSummary(QWidget* parent) : QWidget(parent) {
  auto* grid = new ValueGrid;
  patches_ = grid->add_row(tr("Patches"), {});
  fragments_ = grid->add_row(tr("Fragments"), {}, tr("Parts of patches after the BSP tree"));
  transfers_ = grid->add_row(tr("Exchanges"), {}, tr("Found by the passes of the first iteration"));
  form_factors_ = grid->add_row(tr("Form factors"), {},
                                tr("Kept in memory, so that later iterations need no passes"));
  closure_ = grid->add_row(
      tr("Closure"), {},
      tr("Closed scene: the closure defect, the largest fraction of a patch's projected area\n"
         "that is unaccounted for. Open scene: the fraction of all light that escapes"));
  closure_->setObjectName("summary_closure");
  closure_->setWordWrap(true);
  escaped_ = grid->add_row(
      tr("Open to the sky"), {},
      tr("Fraction of all projected area with nothing above it; 0 in a closed scene"));
  negative_ = grid->add_row(
      tr("Corners below 0"), {},
      symbol_tip(tr("Corners of patches at which B, linear on the patch, is below 0 in a channel; "
                    "they are drawn as 0"),
                 "6.12"));
  negative_->setObjectName("summary_negative");
  lobes_ = grid->add_row(
      tr("Lobes"), {},
      symbol_tip(
          tr("Patches whose lobes reflect, and the memory of their radiance by direction and "
             "of the transfers kept for it. M directions resolve exponents n up to about M/10"),
          "6.14"));
  lobes_->setObjectName("summary_lobes");
  energy_ =
      grid->add_row(tr("Energy defect"), {},
                    tr("Difference between power received and power sent, relative to power sent"));
  contraction_ =
      grid->add_row(tr("Contraction"), {},
                    symbol_tip(tr("Factor by which the newest iteration reduced the change of B, "
                                  "and its\nbound by eq. 22 with eq. 21"),
                               "6"));
  error_ =
      grid->add_row(tr("Error of B"), {},
                    tr("RMS over patches, from the spread of the replicas, and the limit that\n"
                       "it does not exceed in 95 % of all runs. Set an accuracy or the number\n"
                       "of replicas in Solve settings. The estimate is too small on patches\n"
                       "that few directions of each replica connect to small sources"));
  error_->setObjectName("summary_error");
  bound_ =
      grid->add_row(tr("Directions for 1 %:\nguaranteed"), {},
                    symbol_tip(tr("M by the paper's bounds, in a nearly homogeneous environment "
                                  "(eq. 37)\nand in any environment (eq. 43)"),
                               "7.2"));
  bound_->setObjectName("summary_bound");
  estimate_ =
      grid->add_row(tr("Directions for 1 %:\nestimated"), {},
                    tr("M extrapolated from the error of this run, which requires replicas, and\n"
                       "from the rate at which errors decrease with M"));
  estimate_->setObjectName("summary_estimate");
  add_cost_rows(*grid);
  auto* layout = make_column(this, {12, 8, 12, 10});
  layout->addWidget(grid);
  layout->addStretch(1);
}

void SolveSummary::add_cost_rows(ValueGrid& grid) {
  const auto add = [&grid](const QString& name, const QString& title, const QString& tip) {
    QLabel* row = grid.add_row(title, {}, tip);
    row->setObjectName(name);
    return row;
  };
  time_ = add("summary_time", tr("Queries of a pass"),
              tr("Time of the visibility queries of one direction, by engine fast on one thread.\n"
                 "A few directions are run again to measure it"));
  time_->setTextInteractionFlags(Qt::TextBrowserInteraction);
  connect(time_, &QLabel::linkActivated, this, &SolveSummary::costs_wanted);
  candidates_ = add("summary_candidates", tr("Candidates"),
                    tr("Fragments that may hide others, compared in each query"));
  exact_ = add("summary_exact", tr("Exact queries"),
               tr("Queries repeated with exact predicates, per pass, and why; and the fraction\n"
                  "repeated in coordinates for needles"));
  costly_ =
      add("summary_costly", tr("Costly faces"), tr("Faces that take most of the time, and why"));
  costly_->setTextFormat(Qt::PlainText);  // has names of the file
  show_costs(nullptr, {});
}

void SolveSummary::show_costs(const std::shared_ptr<const MeasuredCosts>& measured,
                              const QString& missing) {
  if (!measured) {
    time_->setText(missing.isEmpty()
                       ? QStringLiteral("<a href=\"measure\">%1</a>").arg(tr("Measure"))
                       : missing);
    for (QLabel* row : {candidates_, exact_, costly_}) {
      row->setText(QStringLiteral("–"));
    }
    return;
  }
  const PatchCosts& costs = measured->costs;
  const Scene& scene = *measured->loaded->scene;
  const PatchCost total = costs.total();
  const auto queries = static_cast<double>(std::max<std::int64_t>(total.queries, 1));
  time_->setText(tr("%1 ms").arg(number_text(1e3 * total.seconds / costs.passes)));
  candidates_->setText(
      tr("%1 per query").arg(number_text(static_cast<double>(total.candidates) / queries)));
  exact_->setText(reasons_text(total, costs.passes));
  QStringList lines;
  for (const FaceCost& face : costly_faces(scene, costs, 5)) {
    lines << tr("face %1 (%2): %3 %, %4")
                 .arg(QString::number(scene.patch(face.patch).face),
                      QString::fromStdString(scene.material(face.patch).name),
                      number_text(std::round(100 * face.cost.seconds / total.seconds)),
                      reason_text(face.cost.main_reason()));
  }
  costly_->setText(lines.join('\n'));
}

void SolveSummary::show_snapshot(const SolverSnapshot& snapshot) {
  const SolveStatistics& s = snapshot.statistics;
  const bool lit = has_light(snapshot);
  const bool any_pass = lit && (s.iterations > 0 || snapshot.progress.direction > 0);
  const bool any_iteration = lit && s.iterations > 0;
  const QString none = QStringLiteral("–");
  patches_->setText(count_text(s.patches));
  fragments_->setText(count_text(s.fragments));
  transfers_->setText(any_pass ? count_text(s.transfers) : none);
  form_factors_->setText(!any_iteration        ? none
                         : s.kept_form_factors ? tr("%1 kept").arg(count_text(s.form_factors))
                                               : tr("recomputed"));
  closure_->setText(any_pass ? closure_text(snapshot) : none);
  escaped_->setText(!any_pass    ? none
                    : is_open(s) ? tr("%1 %").arg(number_text(100 * s.escaped))
                                 : tr("0, the scene is closed"));
  negative_->setText(snapshot.linear_terms.empty() ? tr("none, B is constant")
                                                   : count_text(s.negative_corners));
  const GlossyStatistics& g = s.glossy;
  const int replicas = snapshot.options.replicas;
  const auto bytes = g.radiance_bytes + g.lobe_bytes + g.transfer_bytes;
  const QString lobes =
      tr("%1 patches, %2 MB")
          .arg(count_text(g.patches), number_text(1e-6 * static_cast<double>(bytes)));
  lobes_->setText(
      g.patches == 0 ? tr("no lobe reflects")
      : g.exponent > resolved_exponent(s.passes / replicas)
          ? tr("%1; n = %2 needs M = %3")
                .arg(lobes, number_text(g.exponent), number_text(10 * g.exponent * replicas))
          : lobes);
  show_error(snapshot);
  show_directions_needed(snapshot);
  energy_->setText(any_iteration ? number_text(s.energy_defect) : none);
  contraction_->setText(any_iteration && s.iteration_records.size() > 1
                            ? tr("%1, bound %2")
                                  .arg(number_text(s.iteration_records.back().contraction),
                                       number_text(s.predicted_contraction))
                        : any_pass ? tr("bound %1").arg(number_text(s.predicted_contraction))
                                   : none);
}

void SolveSummary::show_error(const SolverSnapshot& snapshot) {
  const ErrorEstimate& error = snapshot.error;
  if (error.replicas == 0) {
    error_->setText(tr("no replicas"));
    return;
  }
  const SurfaceErrors& surfaces = error.surfaces;
  if (surfaces.worst < 0) {
    error_->setText(tr("no light"));
    return;
  }
  const SurfaceError& worst = at(surfaces.surfaces, surfaces.worst);
  const QString limit = tr("%1: %2 %; no surface above %3 %")
                            .arg(QString::fromStdString(worst.name), number_text(100 * worst.rms),
                                 number_text(100 * surfaces.limit));
  const double met = snapshot.statistics.light_directions / error.replicas;
  const std::int64_t uncertain = snapshot.uncertain_patches;
  error_->setText(met > 0 && met < least_light_directions ? tr("%1;\ncannot be trusted").arg(limit)
                  : uncertain > 0
                      ? tr("%1;\ncannot be trusted on %2 patches").arg(limit, count_text(uncertain))
                      : limit);
}

void SolveSummary::show_directions_needed(const SolverSnapshot& snapshot) {
  const SceneMeasures& m = snapshot.loaded->measures;
  bound_->setText(
      tr("M = %1 (eq. 37)\n%2 (eq. 43)")
          .arg(number_text(directions_if_homogeneous(m.rho_max, accuracy)),
               number_text(directions_if_heterogeneous(m.rho_max, accuracy, m.size_ratio))));
  const SolveStatistics& s = snapshot.statistics;
  const bool replicas = snapshot.error.replicas > 0;
  // The error of a mean over iterations decreases at another rate.
  const bool known = replicas && s.iterations > 0 && snapshot.error.rms > 0 &&
                     snapshot.options.scheme != Scheme::semi_iterative;
  estimate_->setText(known      ? tr("M ≈ %1").arg(number_text(estimated_passes_by_replicas(
                                 snapshot.options.used_sampling(), snapshot.options.directions,
                                 snapshot.error.replicas, snapshot.error.rms, accuracy)))
                     : replicas ? QStringLiteral("–")
                                : tr("no replicas"));
}

}  // namespace transillum::viewer
