// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include "cli/reports/report_text.h"
#include "cli/reports/summaries.h"
#include "io/results/error_report_files.h"
#include "transillum/at.h"

namespace transillum::cli {

std::string error_summary(const ErrorReport& report, const std::string& total) {
  if (report.worst < 0) {
    return {};
  }
  const SurfaceCauses& worst = at(report.surfaces, report.worst);
  const CauseErrors& errors = worst.errors;
  std::string text =
      report_row("error in all",
                 fmt::format("{}: {} = {} directions + {} patches + {} iterations + {} method",
                             worst.name, error_percentage(errors.total()),
                             error_percentage(errors.directions), error_percentage(errors.patches),
                             error_percentage(errors.iterations), error_percentage(errors.method)));
  if (!total.empty()) {
    text += report_row("total error", total);
  }
  if (!report.steps.empty()) {
    text += report_row("next step", step_text(report.steps.front()));
  }
  return text;
}

}  // namespace transillum::cli
