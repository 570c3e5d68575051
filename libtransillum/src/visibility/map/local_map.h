// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The local visibility map V of section 3.2. Fragments enter it in BSP order, the one nearest to
// the light first. V is what is visible from below the fragments processed so far. The step of
// fragment i cuts out of V the part above i (the inside list I), which is what i sees, and puts i
// in its place:
//
//       light                      V before      step i          V after
//         |  omega ^                _____      ___|I|___         _  ___  _
//         v        |                             i
//
// The paper leaves a hole in V below a front-facing i, because i emits nothing toward -omega. Here
// i is put in, marked as front-facing: so one pass gives the transfers along omega and -omega, and
// V covers the whole scene, which allows the check of closure (ALGORITHM.md, oracle 1).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/visibility_map.h"
#include "visibility/plane/fragment_projector.h"
#include "visibility/plane/plane_index.h"
#include "visibility/plane/polygon_moments.h"
#include "visibility/transfers/transfer_sums.h"

namespace transillum {

/// For runs that keep no history.
struct NoRecorder {
  static constexpr bool records = false;
};

/// Writes the history of one direction into a MapRecord.
class Recorder {
 public:
  static constexpr bool records = true;

  /// @param memory limit of the record's lists, bytes
  Recorder(MapRecord& record, std::uint64_t memory)
      : record_(record), memory_(std::min(memory, numbered_bytes)) {}

  MapRecord& record() { return record_; }
  void add_step(FragmentId fragment, PatchId patch) {
    make_room(record_.order, 1);
    make_room(record_.step_patch, 1);
    record_.order.push_back(fragment);
    record_.step_patch.push_back(patch);
  }
  /// @param row its corners are set here
  /// @returns its number
  template <class Outline>
  std::int32_t add_row(MapRecord::Row row, const Outline& outline) {
    make_room(record_.rows, 1);
    make_room(record_.corners, outline.size());
    make_room(record_.lines, outline.size());
    row.begin = static_cast<std::uint32_t>(record_.corners.size());
    for (const auto& corner : outline) {
      record_.corners.push_back(
          {static_cast<double>(corner.at.x), static_cast<double>(corner.at.y)});
      record_.lines.push_back(corner.line);
    }
    row.end = static_cast<std::uint32_t>(record_.corners.size());
    record_.rows.push_back(row);
    return static_cast<std::int32_t>(record_.rows.size()) - 1;
  }

 private:
  /// In so many bytes, rows and corners can be numbered by the types of MapRecord.
  static constexpr std::uint64_t numbered_bytes =
      sizeof(MapRecord::Row) * std::uint64_t{std::numeric_limits<std::int32_t>::max()};

  /// Lets a list grow by a quarter where it has no room for `count` more. Both lists, the old and
  /// the new one, count until the old one is gone.
  template <class T>
  void make_room(std::vector<T>& list, std::size_t count) {
    const std::size_t needed = list.size() + count, before = list.capacity();
    if (needed <= before) {
      return;
    }
    const std::size_t capacity = std::max(needed, before + before / 4);
    if (bytes_ + capacity * sizeof(T) > memory_) {
      throw MemoryLimitExceeded(fmt::format(
          "the record of this direction exceeds the memory limit of {:.3g} MB after {} polygons",
          1e-6 * static_cast<double>(memory_), record_.rows.size()));
    }
    list.reserve(capacity);
    bytes_ += (list.capacity() - before) * sizeof(T);
  }

  MapRecord& record_;
  std::uint64_t memory_, bytes_ = 0;
};

/// The local visibility map of one direction.
/// @tparam Number of coordinates: Real, or Rational for exact results
/// @tparam RecorderType NoRecorder or Recorder
template <class Number, class RecorderType>
class LocalMap {
 public:
  /// @param bases of all patches, for Transfers::moments; null if it has none
  LocalMap(const Scene& scene, const BspTree& tree, const Vec3& omega,
           const Cancellation& cancellation, RecorderType recorder,
           const std::vector<LinearBasis>* bases = nullptr)
      : tree_(tree),
        cancellation_(cancellation),
        recorder_(recorder),
        omega_(omega),
        projection_(scene, tree, omega, cancellation),
        projector_(tree, projection_),
        clipper_(projection_),
        index_(whole_plane(), tree.fragments().size()),
        sums_(scene.patch_count(), bases != nullptr) {
    if (bases) {
      moments_.emplace(scene, *bases, projection_);
    }
  }

  Transfers run() {
    const std::vector<FragmentId> order = tree_.order(omega_, cancellation_);
    begin_record(order);
    for (step_ = 0; step_ < std::ssize(order); ++step_) {
      if (step_ % 64 == 0) {
        cancellation_.throw_if_canceled();
      }
      process(tree_.fragment(at(order, step_)));
    }
    return sums_.finish(omega_, cancellation_);
  }

 private:
  /// A polygon of V.
  struct PolygonOfV {
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
    if (!projector_.project(fragment)) {
      return;
    }
    const BasicMapPolygon<Number>& outline = projector_.outline();
    const bool front_facing = projector_.front_facing();
    sums_.project(fragment.patch, front_facing, MapNumber<Number>::area(projector_.area()));
    if (moments_) {
      sums_.project_moments(fragment.patch, front_facing,
                            moments_->of_polygon(fragment.patch, outline));
    }

    // Clip each polygon of V that the fragment may lie below.
    const PlaneBox box = box_of(outline);
    found_.clear();
    index_.query(box, found_);
    for (const std::int32_t id : found_) {
      cancellation_.throw_if_canceled();
      const PolygonOfV& above = at(polygons_, id);
      if (!clipper_.clip(above.outline, outline)) {
        continue;
      }
      sums_.accumulate(fragment.patch, front_facing, above.patch, above.front_facing,
                       MapNumber<Number>::area(clipper_.inside_area()));
      if (moments_) {
        sums_.accumulate_moments(
            fragment.patch, front_facing, above.patch, above.front_facing,
            moments_->of_overlap(fragment.patch, above.patch, clipper_.inside()));
      }
      replace_by_outside(id);
    }

    const std::int32_t row =
        add_row(outline, fragment.patch, front_facing, MapRecord::no_row, MapRecord::never);
    add(outline, fragment.patch, front_facing, row, box);
  }

  /// Replaces polygon `above_id` of V by the parts of it that clipper_ found outside.
  void replace_by_outside(std::int32_t above_id) {
    const PolygonOfV& above = at(polygons_, above_id);
    const PatchId patch = above.patch;
    const bool front_facing = above.front_facing;
    const std::int32_t row = above.row;
    index_.erase(above_id);
    free_.push_back(above_id);
    if constexpr (RecorderType::records) {
      at(recorder_.record().rows, row).consumed = step_;
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
    std::int32_t id = static_cast<std::int32_t>(polygons_.size());
    if (free_.empty()) {
      polygons_.emplace_back();
    } else {
      id = free_.back();
      free_.pop_back();
    }
    PolygonOfV& polygon = at(polygons_, id);
    polygon.outline.assign(outline.begin(), outline.end());
    polygon.patch = patch;
    polygon.front_facing = front_facing;
    polygon.row = row;
    index_.insert(id, box);
  }

  void begin_record(const std::vector<FragmentId>& order) {
    if constexpr (RecorderType::records) {
      recorder_.record().frame = projection_.frame;
      for (const FragmentId f : order) {
        recorder_.add_step(f, tree_.fragment(f).patch);
      }
    }
  }

  std::int32_t add_row(const BasicMapPolygon<Number>& outline, PatchId patch, bool front_facing,
                       std::int32_t parent, std::int32_t consumed) {
    if constexpr (RecorderType::records) {
      return recorder_.add_row({patch, step_, consumed, parent, front_facing, 0, 0}, outline);
    } else {
      return MapRecord::no_row;
    }
  }

  const BspTree& tree_;
  const Cancellation& cancellation_;
  RecorderType recorder_;
  Vec3 omega_;
  BasicProjection<Number> projection_;
  FragmentProjector<Number> projector_;  ///< holds the fragment of the current step
  BasicMapClipper<Number> clipper_;
  PlaneIndex index_;
  TransferSums<typename MapNumber<Number>::Area> sums_;
  std::optional<PolygonMoments<Number>> moments_;  ///< nothing: no moments
  std::int32_t step_ = 0;
  std::vector<PolygonOfV> polygons_;
  std::vector<std::int32_t> free_;   ///< unused entries of polygons_
  std::vector<std::int32_t> found_;  ///< polygons of V that the step's fragment may lie below
};

}  // namespace transillum
