// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>

#include "model/snapshot.h"
#include "transillum/cancellation.h"
#include "visibility/map/map_history.h"

namespace transillum::viewer {

/// The history of one direction's visibility map. Immutable.
struct RecordedMap {
  std::shared_ptr<const LoadedScene> loaded;
  MapHistory history;
  int iteration = 0;  ///< from 0; arbitrary if all iterations have the same directions
  int direction = 0;  ///< from 0: number of the pass within the iteration
  int passes = 0;     ///< M, of the iteration

  const MapRecord& record() const { return history.record(); }
  const MapRecord::Row& row(std::int32_t r) const { return history.row(r); }
};

/// A direction of a solve run whose map is to be recorded.
struct MapRequest {
  std::shared_ptr<const LoadedScene> loaded;
  Vec3 omega;
  int iteration = 0, direction = 0, passes = 0;  ///< values of the RecordedMap
  std::uint64_t memory = 0;                      ///< SolveOptions::memory
};
/// Any thread.
/// @throws Canceled
RecordedMap record_map(const MapRequest& request, const Cancellation& cancellation);

}  // namespace transillum::viewer
