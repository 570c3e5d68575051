// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/run_options.h"
#include "transillum/solution.h"
#include "visibility/fast/patch_costs.h"

namespace transillum {

/// The same as write_statistics() of files.h, with the cost of passes by face.
/// @param costs of the scene of `solution`; null where they were not measured.
/// @throws std::runtime_error if it cannot be written.
void write_statistics(const std::filesystem::path& path, const RunOptions& options,
                      const Solution& solution, const PatchCosts* costs);

}  // namespace transillum
