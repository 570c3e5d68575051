// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Maps the position of the focus to lines of the paper's pseudo-code and to the values of its
// variables, from the recorded map and the newest snapshot of the solver.
#include "state/algorithm_state.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "model/snapshot_values.h"
#include "state/step_events.h"
#include "support/has_index.h"
#include "transillum/at.h"
#include "transillum/linear_basis.h"

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
      {L::if_front, 3, QStringLiteral("if i is front-facing")},
      {L::gather, 4,
       QStringLiteral("B_i(n+1) += Σ over j in I: A(j)/A_i · ρ_i/(π M) · J_d · B_j(n)")},
      {L::leave_hole, 4, QStringLiteral("V ← O, a hole where i is")},
      {L::otherwise, 3, QStringLiteral("else")},
      {L::put_in, 4, QStringLiteral("V ← O and i")},
      {L::global_map, 2, QStringLiteral("M ← the visibility map of all patches along ω_d")},
      {L::each_region, 2, QStringLiteral("for each region R of M")},
      {L::region_list, 3, QStringLiteral("L ← the patches over R, sorted along ω_d")},
      {L::each_receiver, 3, QStringLiteral("for each front-facing i of L")},
      {L::next_above, 4, QStringLiteral("j ← the next of L above i")},
      {L::if_back, 4, QStringLiteral("if j is back-facing")},
      {L::gather_region, 5, QStringLiteral("B_i(n+1) += A(R)/A_i · ρ_i/(π M) · J_d · B_j(n)")},
  };
  return code;
}

namespace {

std::vector<CodeLine> lines_of_local_map(const Focus& focus, const MapHistory& history) {
  const std::int32_t k = focus.position().step;
  if (k < 0) {
    return {CodeLine::empty_map};
  }
  const MapHistory::Step& step = history.step(k);
  if (focus.phase() == Phase::before || step.row == MapRecord::no_row) {
    return {CodeLine::each_patch};
  }
  if (focus.phase() == Phase::split) {
    return {CodeLine::clip};
  }
  if (step.front_facing) {
    return {CodeLine::gather, CodeLine::leave_hole};
  }
  return {CodeLine::put_in};
}

/// The last event of the line at or before `step`; null if there is none.
const StepEvent* event_reached(const std::vector<StepEvent>& line, std::int32_t step) {
  const StepEvent* reached = nullptr;
  for (const StepEvent& event : line) {
    if (event.step <= step) {
      reached = &event;
    }
  }
  return reached;
}

std::vector<CodeLine> lines_of_global_map(const Focus& focus, const MapHistory& history) {
  if (!focus.probe()) {
    return {CodeLine::global_map};
  }
  const std::vector<StepEvent> line = events_at_point(history, *focus.probe());
  const std::int32_t k = focus.position().step;
  const StepEvent* event = event_reached(line, k);
  if (event == nullptr) {
    return {CodeLine::region_list};
  }
  if (event->step != k || focus.phase() == Phase::before || !history.step(k).front_facing) {
    return {CodeLine::each_receiver};
  }
  if (focus.phase() == Phase::split) {
    return {CodeLine::next_above};
  }
  if (event->kind != StepEvent::Kind::exchange) {
    return {CodeLine::if_back};
  }
  return {CodeLine::if_back, CodeLine::gather_region};
}

constexpr double weight = 4 * std::numbers::pi;  // J_d

/// M of the iteration in focus; a two-way pass counts as two.
int directions_of(const SolverSnapshot& snapshot, const Focus& focus) {
  return snapshot.passes_of(focus.position().iteration) * (snapshot.options.two_way ? 2 : 1);
}

/// B_j(n); not set if it was not stored.
std::optional<Rgb> kept_radiosity(const SolverSnapshot& snapshot, int iteration, PatchId patch) {
  const auto& kept = snapshot.kept_radiosity;
  if (!has_index(kept, iteration) || !at(kept, iteration)) {
    return std::nullopt;
  }
  return at(*at(kept, iteration), patch);
}

using LinearTerms = std::shared_ptr<const std::vector<LinearTerm>>;

/// The linear terms of B(n); null if they were not stored.
LinearTerms kept_linear_terms(const SolverSnapshot& snapshot, int iteration) {
  const auto& kept = snapshot.kept_linear_terms;
  return has_index(kept, iteration) ? at(kept, iteration) : nullptr;
}

}  // namespace

std::vector<CodeLine> current_lines(const Focus& focus, MapKind kind) {
  const auto map = focus.map();
  if (!map) {
    return {};
  }
  return kind == MapKind::local ? lines_of_local_map(focus, map->history)
                                : lines_of_global_map(focus, map->history);
}

std::optional<RegionState> region_state(const Focus& focus, const SolverSnapshot& snapshot) {
  const auto map = focus.map();
  if (!map || !focus.probe() || map->loaded != snapshot.loaded) {
    return std::nullopt;
  }
  const MapHistory& history = map->history;
  RegionState state;
  state.point = *focus.probe();
  const std::vector<StepEvent> line = events_at_point(history, state.point);
  for (const StepEvent& event : line) {
    state.list.push_back(event.below);
  }
  state.region = region_at(history, state.point);
  const StepEvent* event = event_reached(line, focus.position().step);
  if (event == nullptr) {
    return state;
  }
  state.i = event->below;
  state.front_facing = history.step(event->step).front_facing;
  state.j = event->above;
  state.exchanges = event->kind == StepEvent::Kind::exchange;
  state.pair_area = event->pair_area;
  if (state.j == no_patch) {
    return state;
  }
  state.radiosity_j = kept_radiosity(snapshot, focus.position().iteration, state.j);
  if (!state.exchanges || !state.radiosity_j || !state.region) {
    return state;
  }
  const double fraction = weight / (std::numbers::pi * directions_of(snapshot, focus)) *
                          state.region->area / snapshot.loaded->scene->patch(state.i).area;
  state.gathered = fraction * (snapshot.loaded->scene->reflectance(state.i) * *state.radiosity_j);
  return state;
}

std::optional<AlgorithmState> algorithm_state(const Focus& focus, const SolverSnapshot& snapshot,
                                              PatchId selected) {
  const auto map = focus.map();
  const std::int32_t k = focus.position().step;
  if (!map || k < 0 || map->loaded != snapshot.loaded) {
    return std::nullopt;
  }
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
  state.weight = weight;
  state.directions = directions_of(snapshot, focus);

  std::map<PatchId, double> areas;  // A(j) of each patch j that i receives from
  for (const std::int32_t r : history.inside_at(k)) {
    if (history.exchanges(r)) {
      areas[history.row(r).patch] += history.record().area(history.row(r));
    }
  }
  if (areas.empty()) {
    return state;
  }
  const auto largest = std::max_element(
      areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const auto chosen = areas.find(selected);
  const auto j = chosen == areas.end() ? largest : chosen;
  state.j = j->first;
  state.area_j = j->second;

  state.radiosity_j = kept_radiosity(snapshot, focus.position().iteration, state.j);
  if (!state.radiosity_j) {
    return state;
  }
  const double fraction = state.weight / (std::numbers::pi * state.directions * state.area_i);
  Rgb sum;
  for (const auto& [source, area] : areas) {
    sum += (fraction * area) * *kept_radiosity(snapshot, focus.position().iteration, source);
  }
  if (snapshot.options.basis == Basis::linear) {
    const auto moments = moments_of_step(history, scene, k);
    state.moments = moments.at(state.j);
    const LinearTerms terms = kept_linear_terms(snapshot, focus.position().iteration);
    if (!terms) {
      return state;
    }
    for (const auto& [source, moment] : moments) {
      const LinearTerm& term = at(*terms, source);
      sum += fraction * (moment.of(0, 1) * term.first + moment.of(0, 2) * term.second);
    }
  }
  state.gathered = scene.reflectance(step.patch) * sum;
  return state;
}

namespace {

/// The functions phi_0, phi_1 and phi_2 of a patch over the transillumination plane.
class PlaneFunctions {
 public:
  PlaneFunctions(const PlaneFrame& frame, const Scene& scene, PatchId i)
      : frame_(frame), patch_(scene.patch(i)), basis_(linear_basis(scene, i)) {}

  std::array<double, 3> at(const Vec2& p) const {
    const std::optional<Vec3> point = frame_.point_on(patch_, p);
    const std::array<double, 2> values = point ? basis_.at(*point) : std::array<double, 2>{};
    return {1, values[0], values[1]};
  }

 private:
  const PlaneFrame& frame_;
  const Patch& patch_;
  LinearBasis basis_;
};

double twice_area(const Vec2& p, const Vec2& q, const Vec2& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// Adds the integrals of the products of functions over a convex polygon.
void add_polygon(std::span<const Vec2> polygon, const PlaneFunctions& own,
                 const PlaneFunctions& other, TransferMoments& moments) {
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const std::array corners{polygon[0], polygon[k], polygon[k + 1]};
    const double area = std::abs(twice_area(corners[0], corners[1], corners[2])) / 2;
    std::array<std::array<double, 3>, 3> f, g;  // by corner, then function
    for (std::size_t c = 0; c < 3; ++c) {
      f[c] = own.at(corners[c]);
      g[c] = other.at(corners[c]);
    }
    // ∫ f g = A/12 (Σ f Σ g + Σ f g), sums over the corners of a triangle.
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        double products = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          products += f[c][a] * g[c][b];
        }
        const double sums = (f[0][a] + f[1][a] + f[2][a]) * (g[0][b] + g[1][b] + g[2][b]);
        moments.of(a, b) += area / 12 * (sums + products);
      }
    }
  }
}

}  // namespace

std::map<PatchId, TransferMoments> moments_of_step(const MapHistory& history, const Scene& scene,
                                                   std::int32_t step) {
  std::map<PatchId, TransferMoments> moments;
  if (step < 0) {
    return moments;
  }
  const MapRecord& record = history.record();
  const PlaneFunctions own(record.frame, scene, history.step(step).patch);
  for (const std::int32_t r : history.inside_at(step)) {
    if (!history.exchanges(r)) {
      continue;
    }
    const MapRecord::Row& row = history.row(r);
    const PlaneFunctions other(record.frame, scene, row.patch);
    add_polygon(record.outline(row), own, other, moments[row.patch]);
  }
  return moments;
}

}  // namespace transillum::viewer
