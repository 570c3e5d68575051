// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/form_factor_views.h"

#include <QCoreApplication>
#include <algorithm>
#include <iterator>

#include "transillum/at.h"

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("FormFactors", text); }

}  // namespace

double form_factor(const FormFactors& form_factors, PatchId i, PatchId j) {
  const auto source = form_factors.source.begin();
  const auto end = source + static_cast<std::ptrdiff_t>(at(form_factors.row_begin, i + 1));
  const auto found =
      std::lower_bound(source + static_cast<std::ptrdiff_t>(at(form_factors.row_begin, i)), end, j);
  return found != end && *found == j ? at(form_factors.value, found - source) : 0.0;
}

std::vector<double> form_factors_from(const FormFactors& form_factors, PatchId i) {
  std::vector<double> row(form_factors.row_begin.size() - 1);
  for (std::size_t k = at(form_factors.row_begin, i); k < at(form_factors.row_begin, i + 1); ++k) {
    at(row, form_factors.source[k]) = form_factors.value[k];
  }
  return row;
}

std::vector<double> form_factors_to(const FormFactors& form_factors, PatchId i) {
  std::vector<double> column(form_factors.row_begin.size() - 1);
  for (PatchId j = 0; j < std::ssize(column); ++j) {
    at(column, j) = form_factor(form_factors, j, i);
  }
  return column;
}

QString why_no_form_factors(const SolverSnapshot& snapshot) {
  if (snapshot.glossy) {
    return tr("With lobes, transfers are kept by direction; there are no form factors.");
  }
  if (snapshot.progress.iteration == 0) {
    return tr("Form factors are available after the first iteration.");
  }
  if (!snapshot.form_factors_fit) {
    return tr("The form factors exceed the memory limit.");
  }
  return tr("Assembling the form factors…");
}

}  // namespace transillum::viewer
