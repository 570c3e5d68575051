// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "algorithm_state.h"

#include <algorithm>
#include <map>
#include <numbers>

namespace transillum::viewer {

const std::vector<CodeText>& algorithm_code() {
  using L = CodeLine;
  static const std::vector<CodeText> code = {
      {L::start, 0, QStringLiteral("for each patch i: B_i(0) ← E_i")},
      {L::each_iteration, 0, QStringLiteral("for n = 0, 1, 2, …")},
      {L::restart, 1, QStringLiteral("for each patch i: B_i(n+1) ← E_i")},
      {L::each_direction, 1, QStringLiteral("for each direction d")},
      {L::sort, 2, QStringLiteral("L ← the patches, sorted along ω_d")},
      {L::empty_map, 2, QStringLiteral("V ← nothing")},
      {L::each_patch, 2, QStringLiteral("for each patch i of L")},
      {L::clip, 3, QStringLiteral("clip V by i: I inside, O outside")},
      {L::if_front, 3, QStringLiteral("if i faces the light")},
      {L::gather, 4,
       QStringLiteral("B_i(n+1) += Σ over j in I: A(j)/A_i · ρ_i/(π M) · J_d · B_j(n)")},
      {L::leave_hole, 4, QStringLiteral("V ← O, a hole where i is")},
      {L::otherwise, 3, QStringLiteral("else")},
      {L::put_in, 4, QStringLiteral("V ← O and i")},
  };
  return code;
}

const std::vector<QString>& global_map_code() {
  static const std::vector<QString> code = {
      QStringLiteral("M ← the visibility map of all patches along ω_d"),
      QStringLiteral("for each region R of M"),
      QStringLiteral("    L ← the patches over R, sorted along ω_d"),
      QStringLiteral("    for each i of L that faces the light"),
      QStringLiteral("        j ← the next of L above i"),
      QStringLiteral("        if j faces away from the light"),
      QStringLiteral("            B_i(n+1) += A(R)/A_i · ρ_i/(π M) · J_d · B_j(n)"),
  };
  return code;
}

std::vector<CodeLine> current_lines(const Focus& focus) {
  const auto map = focus.map();
  if (!map) return {};
  const std::int32_t k = focus.moment().step;
  if (k < 0) return {CodeLine::empty_map};
  const MapHistory::Step& step = map->history.step(k);
  if (focus.phase() == Phase::before || step.row == MapRecord::no_row)
    return {CodeLine::each_patch};
  if (focus.phase() == Phase::split) return {CodeLine::clip};
  if (step.front_facing) return {CodeLine::gather, CodeLine::leave_hole};
  return {CodeLine::put_in};
}

std::optional<AlgorithmState> algorithm_state(const Focus& focus, const SolverSnapshot& snapshot,
                                              PatchId selected) {
  const auto map = focus.map();
  const std::int32_t k = focus.moment().step;
  if (!map || k < 0 || map->loaded != snapshot.loaded) return std::nullopt;
  const MapHistory& history = map->history;
  const MapHistory::Step& step = history.step(k);
  const Scene& scene = *snapshot.loaded->scene;

  AlgorithmState state;
  state.i = step.patch;
  state.front_facing = step.front_facing;
  state.area_i = scene.patch(step.patch).area;
  state.map_before = k > 0 ? history.step(k - 1).map_size : 0;
  state.map_after = step.map_size;
  state.inside = step.cut;
  state.outside = static_cast<std::int32_t>(history.outside_at(k).size());
  state.weight = 4 * std::numbers::pi;
  state.directions = snapshot.progress.passes * (snapshot.options.two_way ? 2 : 1);

  std::map<PatchId, double> areas;  // A(j) of what lights i
  for (const std::int32_t r : history.inside_at(k))
    if (history.exchanges(r)) areas[history.row(r).patch] += history.record().area(history.row(r));
  if (areas.empty()) return state;
  const auto largest = std::max_element(
      areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const auto chosen = areas.find(selected);
  const auto j = chosen == areas.end() ? largest : chosen;
  state.j = j->first;
  state.area_j = j->second;

  const auto n = static_cast<std::size_t>(focus.moment().iteration);
  if (n >= snapshot.kept_radiosity.size() || !snapshot.kept_radiosity[n]) return state;
  const std::vector<Rgb>& radiosity = *snapshot.kept_radiosity[n];
  state.radiosity_j = radiosity[static_cast<std::size_t>(state.j)];
  const double share = state.weight / (std::numbers::pi * state.directions * state.area_i);
  Rgb sum;
  for (const auto& [source, area] : areas)
    sum += (share * area) * radiosity[static_cast<std::size_t>(source)];
  state.gathered = scene.reflectance(step.patch) * sum;
  return state;
}

}  // namespace transillum::viewer
