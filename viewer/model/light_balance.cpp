// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/light_balance.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/luminance.h"

namespace transillum::viewer {

namespace {

using Term = LightBalance::Term;

/// The light that entry `k` of the row brings from patch j, without what the first shot has
/// brought.
Rgb irradiance_of(const SolverSnapshot& snapshot, const ReceiverRow& row, std::size_t k) {
  const PatchId j = row.source[k];
  const bool shot = snapshot.shot && !snapshot.shot->sources.empty();
  Rgb h = row.value[k] * (shot ? at(snapshot.radiosity, j) - at(snapshot.shot->exitance, j)
                               : at(snapshot.radiosity, j));
  if (!row.moments.empty() && !snapshot.linear_terms.empty()) {
    const LinearTerm& linear = at(snapshot.linear_terms, j);
    h += row.moments[k][0] * linear.first + row.moments[k][1] * linear.second;
  }
  return h;
}

std::vector<Term> all_terms(const SolverSnapshot& snapshot, const ReceiverRow& row,
                            const Rgb& rho) {
  const Scene& scene = *snapshot.loaded->scene;
  std::map<std::pair<int, int>, std::size_t> numbers;
  std::vector<Term> terms;
  std::vector<double> largest;
  for (std::size_t k = 0; k < row.source.size(); ++k) {
    const PatchId j = row.source[k];
    const auto [number, added] = numbers.emplace(source_of(scene.patch(j)), terms.size());
    if (added) {
      terms.emplace_back();
      largest.push_back(-1);
    }
    Term& term = terms[number->second];
    const Rgb part = rho * irradiance_of(snapshot, row, k);
    term.patches.push_back(j);
    term.form_factor += row.value[k];
    term.radiosity += row.value[k] * at(snapshot.radiosity, j);
    term.contribution += part;
    if (luminance(part) > largest[number->second]) {
      largest[number->second] = luminance(part);
      term.largest = j;
    }
  }
  for (Term& term : terms) {
    term.radiosity = (1 / term.form_factor) * term.radiosity;
  }
  return terms;
}

}  // namespace

std::pair<int, int> source_of(const Patch& patch) {
  return patch.group == no_group ? std::pair(0, static_cast<int>(patch.face))
                                 : std::pair(1, static_cast<int>(patch.group));
}

LightBalance light_balance(const SolverSnapshot& snapshot, PatchId receiver, const ReceiverRow& row,
                           std::size_t most) {
  LightBalance balance;
  balance.receiver = receiver;
  balance.radiosity = at(snapshot.radiosity, receiver);
  balance.exitance = material_of(snapshot, receiver).exitance;
  balance.reflectance = material_of(snapshot, receiver).reflectance;
  balance.terms = all_terms(snapshot, row, balance.reflectance);
  std::stable_sort(balance.terms.begin(), balance.terms.end(), [](const Term& a, const Term& b) {
    return luminance(a.contribution) > luminance(b.contribution);
  });
  Rgb listed;
  for (std::size_t k = 0; k < balance.terms.size(); ++k) {
    (k < most ? listed : balance.others) += balance.terms[k].contribution;
  }
  balance.other_count = balance.terms.size() - std::min(balance.terms.size(), most);
  balance.terms.resize(balance.terms.size() - balance.other_count);
  if (snapshot.shot && !snapshot.shot->sources.empty()) {
    balance.shot = balance.reflectance * at(snapshot.shot->irradiance, receiver);
  }
  if (!snapshot.sky_irradiance.empty()) {
    balance.sun = balance.reflectance * row.sun;
    balance.sky = balance.reflectance * (at(snapshot.sky_irradiance, receiver) - row.sun);
  }
  balance.remainder = balance.radiosity - (balance.exitance + listed + balance.others +
                                           balance.shot + balance.sky + balance.sun);
  return balance;
}

}  // namespace transillum::viewer
