// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/direction_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/luminance.h"
#include "transillum/at.h"

namespace transillum::viewer {

std::vector<double> exchanged_areas(const RecordedMap& map) {
  std::vector<double> areas(static_cast<std::size_t>(map.loaded->scene->patch_count()));
  const MapHistory& history = map.history;
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    for (const std::int32_t r : history.inside_at(k)) {
      if (history.exchanges(r)) {
        const double area = history.record().area(history.row(r));
        at(areas, history.row(r).patch) += area;
        at(areas, history.step(k).patch) += area;
      }
    }
  }
  return areas;
}

namespace {

/// Whether both scenes have a patch, as part of the same face.
bool is_in_both(const Scene& a, const Scene& b, PatchId i) {
  return i < std::min(a.patch_count(), b.patch_count()) && a.patch(i).face == b.patch(i).face;
}

}  // namespace

void DirectionComparer::compare_factors(const RowRequest& row, const Cancellation& cancellation) {
  if (row_ == row) {
    return;
  }
  row_.reset();
  factors_.clear();
  RowRequest there = row;
  there.loaded = loaded_;
  there.form_factors = nullptr;
  std::map<PatchId, std::array<double, 2>> by_source;
  const auto add = [&](const RowRequest& request, std::size_t side) {
    const ReceiverRow found = compute_row(request, cancellation, {}).row;
    for (std::size_t k = 0; k < found.source.size(); ++k) {
      by_source[found.source[k]][side] = found.value[k];
    }
  };
  add(there, 0);
  add(row, 1);
  for (const auto& [source, value] : by_source) {
    if (is_in_both(*row.loaded->scene, *loaded_->scene, source)) {
      factors_.push_back({source, value});
    }
  }
  row_ = row;
}

DirectionComparison DirectionComparer::operator()(const DirectionRequest& request,
                                                  const Cancellation& cancellation) {
  const std::shared_ptr<const Scene>& other = request.kept->loaded->scene;
  if (!loaded_ || loaded_->scene != other) {
    auto loaded = std::make_shared<LoadedScene>();
    loaded->scene = other;
    loaded->tree = request.map->loaded->scene == other ? request.map->loaded->tree
                                                       : std::make_shared<const BspTree>(*other);
    loaded_ = std::move(loaded);
    map_ = nullptr;
    row_.reset();
  }
  const Vec3& omega = request.map->record().frame.omega;
  if (!map_ || !(map_->record().frame.omega == omega)) {
    map_ = std::make_shared<const RecordedMap>(
        record_map({loaded_, omega, request.map->iteration, request.map->direction,
                    request.map->passes, request.kept->options.memory},
                   cancellation));
  }
  DirectionComparison result{.kept_map = map_, .map = request.map, .rows = {}};
  const Scene& open = *request.map->loaded->scene;
  const std::vector<double> seen_there = exchanged_areas(*map_),
                            seen = exchanged_areas(*request.map);
  const auto value = [](const auto& list, PatchId i, const auto& of) {
    return i < std::ssize(list) ? of(at(list, i)) : 0.0;
  };
  const auto itself = [](double x) { return x; };
  const auto light = [](const Rgb& b) { return luminance(b); };
  for (PatchId i = 0; i < std::min(open.patch_count(), other->patch_count()); ++i) {
    if (!is_in_both(open, *other, i)) {
      continue;
    }
    result.rows.push_back(
        {i,
         {at(seen_there, i), at(seen, i)},
         {value(request.kept->form_factor_sums, i, itself),
          value(request.current->form_factor_sums, i, itself)},
         {value(request.kept->radiosity, i, light), value(request.current->radiosity, i, light)}});
  }
  const auto matched = static_cast<PatchId>(result.rows.size());
  result.unmatched = {other->patch_count() - matched, open.patch_count() - matched};
  std::stable_sort(result.rows.begin(), result.rows.end(), [](const auto& a, const auto& b) {
    return std::abs(a.change()) > std::abs(b.change());
  });
  if (request.row && is_in_both(open, *other, request.row->receiver)) {
    compare_factors(*request.row, cancellation);
    result.receiver = request.row->receiver;
    result.factors = factors_;
  }
  return result;
}

}  // namespace transillum::viewer
