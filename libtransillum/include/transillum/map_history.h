// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "transillum/at.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// A MapRecord with what makes questions about its steps and patches quick: for debuggers.
///
/// Steps count from 0; -1 stands for the time before the first. Areas are in m² of the
/// transillumination plane, to rounding of the record's corners. Threads: immutable.
class MapHistory {
 public:
  /// No such step.
  static constexpr std::int32_t none = -1;

  /// What one step did, in figures.
  struct Step {
    PatchId patch = no_patch;              ///< whose polygon it processed
    std::int32_t row = MapRecord::no_row;  ///< the polygon; no_row where it is seen edge-on
    bool front_facing = false;             ///< it receives for omega
    std::int32_t cut = 0;                  ///< rows of V that it consumed, whole or in part
    std::int32_t exchanges = 0;            ///< of them, those it exchanges light with
    std::int32_t map_size = 0;             ///< rows of V after it
    double area = 0;                       ///< of the polygon
    double covered = 0;                    ///< of that, what lies above it: the inside list
    double exchanged = 0;                  ///< of that, where light is exchanged
    double smallest = 0;                   ///< of the rows it made; 0 where it made none

    /// |area - covered| / area: what lies open above it; a receiver's closure defect, which is 0 to
    /// rounding in a closed scene.
    double open_share() const;
  };

  MapHistory() = default;
  explicit MapHistory(MapRecord record);

  const MapRecord& record() const { return record_; }
  std::int32_t step_count() const { return record_.step_count(); }
  const Step& step(std::int32_t k) const { return at(steps_, k); }
  const MapRecord::Row& row(std::int32_t r) const { return at(record_.rows, r); }

  /// Rows of V that step k consumed; the inside and outside lists are their parts.
  std::vector<std::int32_t> cut_at(std::int32_t k) const;
  /// The inside list: what lay above the polygon of step k.
  std::vector<std::int32_t> inside_at(std::int32_t k) const;
  /// The outside list: what step k left of the rows it cut.
  std::vector<std::int32_t> outside_at(std::int32_t k) const;
  /// Whether row r, of an inside list, exchanges light with the polygon it was cut by: that one
  /// receives from it for omega, and lights it for -omega.
  bool exchanges(std::int32_t r) const;
  /// The patch by whose polygon row r was cut from its parent; no_patch for a whole polygon.
  PatchId cut_by(std::int32_t r) const;

  /// Steps, ascending, that processed a polygon of the patch or consumed a row of it.
  std::span<const std::int32_t> steps_of(PatchId patch) const;
  /// The nearest step after `k` (before it) that steps_of() lists; none where there is none.
  std::int32_t next_step_of(PatchId patch, std::int32_t k) const;
  std::int32_t previous_step_of(PatchId patch, std::int32_t k) const;

  /// Bytes of memory taken.
  std::size_t memory() const;

 private:
  void find_steps();
  void find_patches();
  /// First row made at step k or later.
  std::int32_t first_row(std::int32_t k) const { return at(first_row_, k); }

  MapRecord record_;
  std::vector<Step> steps_;
  std::vector<std::int32_t> first_row_;     ///< a step, and the end
  std::vector<std::int32_t> patch_steps_;   ///< of all patches, one after the other
  std::vector<std::uint32_t> patch_begin_;  ///< a patch, and the end
};

}  // namespace transillum
