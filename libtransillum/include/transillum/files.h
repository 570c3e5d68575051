// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "transillum/directions.h"
#include "transillum/form_factors.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum {

// All writers write beside the target and rename: a file is there whole or not at all. Numbers
// read back bit for bit. They throw std::runtime_error naming the file when it cannot be written.

/// Writes `path` by way of a temporary neighbor; `write` fills the stream. When `write` throws,
/// nothing is left behind.
void write_file_whole(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write);

/// Writes the description as OBJ with its MTL beside it (same stem).
void write_obj(const std::filesystem::path& path, const SceneDescription& description);

/// For use before long work.
/// @throws InputError where `path` is a folder, or lies in one that is missing or not writable.
void check_writable(const std::filesystem::path& path);

/// check_writable, and @throws InputError unless `path` ends in .csv, .vtp, .ply or .obj.
void check_result_path(const std::filesystem::path& path);
/// check_writable, and @throws InputError unless `path` ends in .json.
void check_statistics_path(const std::filesystem::path& path);
/// Writes a solution as the ending of `path` says (cli.md for the columns of CSV).
void write_result(const std::filesystem::path& path, const Solution& solution);

/// Whether `path` ends in .vtp, as what read_result() reads.
bool is_result_file(const std::filesystem::path& path);
/// A solution as write_result() has written it to a .vtp file: the same patches with the same E,
/// rho, B and H, to the bit. The patches are the faces of its scene; which were parts of one face
/// is not told. Of the statistics and the error estimate it has what the file keeps.
/// @throws InputError naming the file and what is wrong with it, Canceled
Solution read_result(const std::filesystem::path& path, const Cancellation& cancellation = {});

/// receiver,source,area; source -1: nothing above, or a back side. Only the forward direction.
void write_transfers_csv(std::ostream& out, const Transfers& transfers);
void write_transfers_csv(const std::filesystem::path& path, const Transfers& transfers);
/// i,j,F; rows by i, then j
void write_form_factors_csv(std::ostream& out, const FormFactors& form_factors);
void write_form_factors_csv(const std::filesystem::path& path, const FormFactors& form_factors);
/// u,v,x,y,z
void write_directions_csv(std::ostream& out, const std::vector<DirectionSample>& directions);
void write_directions_csv(const std::filesystem::path& path,
                          const std::vector<DirectionSample>& directions);
/// The JSON of --stats.
void write_statistics(const std::filesystem::path& path, const SolveOptions& options,
                      const Solution& solution);

}  // namespace transillum
