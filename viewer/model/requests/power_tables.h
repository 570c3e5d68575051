// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "model/snapshot.h"
#include "radiosity/analysis/power_table.h"

namespace transillum::viewer {

/// Powers by group and by material of a snapshot.
struct PowerTables {
  std::shared_ptr<const SolverSnapshot> snapshot;
  PowerTable groups;            ///< with exchanges where the snapshot has form factors
  PowerTable materials;         ///< likewise
  bool received_known = false;  ///< false before the first iteration: received and absorbed are 0
};
/// Adds up the powers. Any thread.
PowerTables power_tables(const std::shared_ptr<const SolverSnapshot>& snapshot);

}  // namespace transillum::viewer
