// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve_summary.h"

#include <QLabel>
#include <QVBoxLayout>

#include "number_text.h"
#include "value_grid.h"

namespace transillum::viewer {

SolveSummary::SolveSummary(QWidget* parent) : QWidget(parent) {
  auto* grid = new ValueGrid;
  patches_ = grid->add_row(tr("Patches"), {});
  fragments_ = grid->add_row(tr("Fragments"), {}, tr("Parts that the BSP tree makes of patches"));
  transfers_ = grid->add_row(tr("Exchanges"), {}, tr("Found by the passes of the first iteration"));
  form_factors_ =
      grid->add_row(tr("Form factors"), {}, tr("Kept, so that later iterations need no passes"));
  closure_ = grid->add_row(tr("Closure defect"), {},
                           tr("Largest share of a patch's projection that is unaccounted for"));
  escaped_ = grid->add_row(tr("Open to the sky"), {},
                           tr("Share of all projected area with nothing above it; 0: closed"));
  energy_ = grid->add_row(tr("Energy defect"), {}, tr("Power received against power sent"));
  contraction_ = grid->add_row(tr("Contraction"), {},
                               tr("Of the newest iteration, and its bound by eq. 22 with eq. 21"));
  error_ = grid->add_row(tr("Error of B"), {},
                         tr("RMS over patches, from the spread of replicas; set some under\n"
                            "Solve settings to have one"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 8, 12, 10);
  layout->addWidget(grid);
  layout->addStretch(1);
}

void SolveSummary::show_snapshot(const SolverSnapshot& snapshot) {
  const SolveStatistics& s = snapshot.statistics;
  const bool any_pass = s.iterations > 0 || snapshot.progress.direction > 0;
  const bool any_step = s.iterations > 0;
  const QString none = QStringLiteral("–");
  patches_->setText(count_text(s.patches));
  fragments_->setText(count_text(s.fragments));
  transfers_->setText(any_pass ? count_text(s.transfers) : none);
  form_factors_->setText(!any_step             ? none
                         : s.kept_form_factors ? tr("%1 kept").arg(count_text(s.form_factors))
                                               : tr("recomputed"));
  closure_->setText(any_pass ? number_text(s.closure_defect_max) : none);
  constexpr double rounding = 1e-9;
  escaped_->setText(!any_pass              ? none
                    : s.escaped < rounding ? tr("no: closed")
                                           : tr("%1 %").arg(number_text(100 * s.escaped)));
  error_->setText(snapshot.error.replicas > 0
                      ? tr("%1 %").arg(number_text(100 * snapshot.error.rms))
                      : tr("no replicas"));
  energy_->setText(any_step ? number_text(s.energy_defect) : none);
  contraction_->setText(s.steps.size() > 1 ? tr("%1, bound %2")
                                                 .arg(number_text(s.steps.back().contraction),
                                                      number_text(s.predicted_contraction))
                        : any_pass ? tr("bound %1").arg(number_text(s.predicted_contraction))
                                   : none);
}

}  // namespace transillum::viewer
