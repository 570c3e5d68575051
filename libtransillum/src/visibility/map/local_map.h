// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The local visibility map of section 3.2. All fragments come in BSP order, those nearest to the
// light first. V holds what would be seen from below the fragments done so far. Fragment i cuts
// from V what lies above it (inside list I), which is what it sees, and takes its place:
//
//       light                      V before      step i          V after
//         |  omega ^                _____      ___|I|___         _  ___  _
//         v        |                             i
//
// The paper leaves a hole in V below a front-facing i, because nothing shines down from there. We
// put i in, marked: so one pass tells for omega and for -omega who looks at whom, and V covers
// the whole scene, which makes closure (method, oracle 1) a fact to check.
#pragma once

#include <algorithm>
#include <utility>

#include "transillum/at.h"
#include "transillum/visibility_map.h"
#include "visibility/plane/plane_index.h"
#include "visibility/plane/visible_fragment.h"
#include "visibility/transfers/transfer_sums.h"

namespace transillum {

/// Keeps no history.
struct NoRecorder {
  static constexpr bool records = false;
};

/// Writes the table of one direction.
struct Recorder {
  static constexpr bool records = true;
  MapRecord& record;
};

/// The local visibility map of one direction, in numbers of type Number.
template <class Number, class RecorderType>
class LocalMap {
 public:
  LocalMap(const Scene& scene, const BspTree& tree, const Vec3& omega,
           const Cancellation& cancellation, RecorderType recorder)
      : tree_(tree),
        cancellation_(cancellation),
        recorder_(recorder),
        omega_(omega),
        projection_(scene, tree, omega, cancellation),
        seen_(tree, projection_),
        clipper_(projection_),
        index_(whole_plane(), tree.fragments().size()),
        sums_(scene.patch_count()) {}

  Transfers run() {
    const std::vector<FragmentId> order = tree_.order(omega_, cancellation_);
    begin_record(order);
    for (step_ = 0; step_ < static_cast<std::int32_t>(order.size()); ++step_) {
      if (step_ % 64 == 0) {
        cancellation_.throw_if_canceled();
      }
      process(tree_.fragment(at(order, step_)));
    }
    return sums_.finish(omega_, cancellation_);
  }

 private:
  /// A polygon of V.
  struct MapFragment {
    BasicMapPolygon<Number> outline;
    PatchId patch = no_patch;
    bool front_facing = false;
    std::int32_t row = MapRecord::no_row;
  };

  PlaneBox whole_plane() const {
    PlaneBox all{0, 0, 0, 0};
    for (const BasicPlanePoint<Number>& p : projection_.points) {
      all.add(p);
    }
    return all;
  }

  void process(const BspTree::Fragment& fragment) {
    if (!seen_.look_at(fragment)) {
      return;
    }
    const BasicMapPolygon<Number>& window = seen_.outline();
    const bool front_facing = seen_.front_facing();
    sums_.project(fragment.patch, front_facing, MapNumber<Number>::area(seen_.area()));

    // Cut out of V what lies above, piece by piece.
    const PlaneBox box = box_of(window);
    found_.clear();
    index_.query(box, found_);
    for (const std::int32_t id : found_) {
      cancellation_.throw_if_canceled();
      const MapFragment& above = at(fragments_, id);
      if (!clipper_.clip(above.outline, window)) {
        continue;
      }
      sums_.accumulate(fragment.patch, front_facing, above.patch, above.front_facing,
                       MapNumber<Number>::area(clipper_.inside_area()));
      replace_by_outside(id);
    }

    const std::int32_t row =
        add_row(window, fragment.patch, front_facing, MapRecord::no_row, MapRecord::never);
    add(window, fragment.patch, front_facing, row, box);
  }

  /// Takes polygon `above` out of V and puts in the parts that clipper_ found outside.
  void replace_by_outside(std::int32_t above) {
    MapFragment& cut = at(fragments_, above);
    const PatchId patch = cut.patch;
    const bool front_facing = cut.front_facing;
    const std::int32_t row = cut.row;
    index_.erase(above);
    free_.push_back(above);
    if constexpr (RecorderType::records) {
      at(recorder_.record.rows, row).consumed = step_;
      add_row(clipper_.inside(), patch, front_facing, row, step_);
    }
    for (std::size_t k = 0; k < clipper_.outside_count(); ++k) {
      const BasicMapPolygon<Number>& outside = clipper_.outside(k);
      if (!(area_of(outside) > 0)) {
        continue;
      }
      const std::int32_t part = add_row(outside, patch, front_facing, row, MapRecord::never);
      add(outside, patch, front_facing, part, box_of(outside));
    }
  }

  void add(const BasicMapPolygon<Number>& outline, PatchId patch, bool front_facing,
           std::int32_t row, const PlaneBox& box) {
    std::int32_t id = static_cast<std::int32_t>(fragments_.size());
    if (free_.empty()) {
      fragments_.emplace_back();
    } else {
      id = free_.back();
      free_.pop_back();
    }
    MapFragment& fragment = at(fragments_, id);
    fragment.outline.assign(outline.begin(), outline.end());
    fragment.patch = patch;
    fragment.front_facing = front_facing;
    fragment.row = row;
    index_.insert(id, box);
  }

  void begin_record(const std::vector<FragmentId>& order) {
    if constexpr (RecorderType::records) {
      MapRecord& record = recorder_.record;
      record.frame = projection_.frame;
      record.order = order;
      for (const FragmentId f : order) {
        record.step_patch.push_back(tree_.fragment(f).patch);
      }
    }
  }

  std::int32_t add_row(const BasicMapPolygon<Number>& outline, PatchId patch, bool front_facing,
                       std::int32_t parent, std::int32_t consumed) {
    if constexpr (RecorderType::records) {
      MapRecord& record = recorder_.record;
      MapRecord::Row row{patch,  step_,        consumed,
                         parent, front_facing, static_cast<std::uint32_t>(record.corners.size()),
                         0};
      for (const BasicMapCorner<Number>& corner : outline) {
        record.corners.push_back(
            {static_cast<double>(corner.at.x), static_cast<double>(corner.at.y)});
      }
      row.end = static_cast<std::uint32_t>(record.corners.size());
      record.rows.push_back(row);
      return static_cast<std::int32_t>(record.rows.size()) - 1;
    } else {
      return MapRecord::no_row;
    }
  }

  const BspTree& tree_;
  const Cancellation& cancellation_;
  RecorderType recorder_;
  Vec3 omega_;
  BasicProjection<Number> projection_;
  SeenFragment<Number> seen_;  ///< the polygon at hand
  BasicMapClipper<Number> clipper_;
  PlaneIndex index_;
  TransferSums<typename MapNumber<Number>::Area> sums_;
  std::int32_t step_ = 0;
  std::vector<MapFragment> fragments_;
  std::vector<std::int32_t> free_;  ///< unused places in fragments_
  std::vector<std::int32_t> found_;
};

}  // namespace transillum
