// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "transillum/at.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// A MapRecord with indexes that make queries by step and by patch fast: for debuggers.
///
/// Steps count from 0; -1 is the state before the first. Areas are in m² of the transillumination
/// plane, up to the rounding of the record's corners. Threads: immutable.
class MapHistory {
 public:
  /// No step.
  static constexpr std::int32_t none = -1;

  /// Values of one step, which processes one polygon.
  struct Step {
    PatchId patch = no_patch;              ///< patch of the polygon
    std::int32_t row = MapRecord::no_row;  ///< the polygon's row; no_row if it is edge-on
    bool front_facing = false;             ///< the patch receives for omega
    std::int32_t cut = 0;                  ///< rows of V that it consumed, wholly or in part
    std::int32_t exchanges = 0;            ///< rows among them that it exchanges light with
    std::int32_t map_size = 0;             ///< rows of V after the step
    double area = 0;                       ///< area of the polygon
    double covered = 0;                    ///< part of it with something above: the inside list
    double exchanged = 0;                  ///< part of it that exchanges light
    double smallest = 0;  ///< area of the smallest row made by the step; 0 if none was made

    /// |area - covered| / area: the open part of the polygon, which for a receiver is the closure
    /// defect; 0 up to rounding in a closed scene.
    double open_fraction() const;
  };

  /// An empty history, of no steps.
  MapHistory() = default;
  /// Builds the indexes. O(rows + steps).
  explicit MapHistory(MapRecord record);

  /// The record it was built from.
  const MapRecord& record() const { return record_; }
  /// MapRecord::step_count().
  std::int32_t step_count() const { return record_.step_count(); }
  /// Values of step k.
  const Step& step(std::int32_t k) const { return at(steps_, k); }
  /// Row r of the record.
  const MapRecord::Row& row(std::int32_t r) const { return at(record_.rows, r); }

  /// Rows of V that step k consumed; its inside and outside lists are parts of them.
  std::vector<std::int32_t> cut_at(std::int32_t k) const;
  /// The inside list of step k: the parts of the consumed rows above its polygon.
  std::vector<std::int32_t> inside_at(std::int32_t k) const;
  /// The outside list of step k: the remaining parts of the consumed rows.
  std::vector<std::int32_t> outside_at(std::int32_t k) const;
  /// Whether row r, of an inside list, exchanges light with the polygon it was cut by: that polygon
  /// receives from the row's patch for omega, and emits to it for -omega.
  bool exchanges(std::int32_t r) const;
  /// The patch by whose polygon row r was cut from its parent; no_patch for an uncut polygon.
  PatchId cut_by(std::int32_t r) const;
  /// The polygon that entered V and of which row r is a part: a row without a parent.
  std::int32_t whole_of(std::int32_t r) const;
  /// Where each edge of row r comes from: the polygon that entered V with an edge on the same line,
  /// as a row without a parent. It is row r, an ancestor of it, or a polygon that cut one of them.
  std::vector<std::int32_t> edge_origins(std::int32_t r) const;

  /// Steps, ascending, that processed a polygon of the patch or consumed a row of it.
  std::span<const std::int32_t> steps_of(PatchId patch) const;
  /// The first step after `k` in steps_of(); `none` if there is none.
  std::int32_t next_step_of(PatchId patch, std::int32_t k) const;
  /// The last step before `k` in steps_of(); `none` if there is none.
  std::int32_t previous_step_of(PatchId patch, std::int32_t k) const;

  /// Memory used, bytes.
  std::size_t memory() const;

 private:
  void find_steps();
  void find_patches();
  /// First row made at step k or later.
  std::int32_t first_row(std::int32_t k) const { return at(first_row_, k); }

  MapRecord record_;
  std::vector<Step> steps_;
  std::vector<std::int32_t> first_row_;     ///< per step, and the end
  std::vector<std::int32_t> patch_steps_;   ///< steps_of() of all patches, concatenated
  std::vector<std::uint32_t> patch_begin_;  ///< per patch, and the end
};

}  // namespace transillum
