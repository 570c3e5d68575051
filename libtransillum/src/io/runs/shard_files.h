// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Passes in files: each run that makes a share of a solve's passes writes a shard; another run
// reads all of them and has the bits of a solve that made its passes itself
// (decisions/0062-shards.md).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "radiosity/solver/shares.h"
#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/engine.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum {

/// Description of a shard, stored in it.
struct ShardInfo {
  Share share;        ///< its part of the passes
  int passes = 0;     ///< passes of all shares
  std::string scene;  ///< name of the scene
  /// Texts stored by the program that wrote it, such as its arguments; the library does not read
  /// them.
  std::vector<std::string> notes;
};

/// Contents of a shard that write_shard() makes.
struct ShardOptions {
  Share share;                     ///< its part of the passes
  std::vector<std::string> notes;  ///< ShardInfo::notes
  /// Called after each pass with the number done; may be empty.
  std::function<void(int)> progress;
};

/// Makes the passes of a share and writes them as a shard, complete or not at all. It takes no more
/// memory than a few passes.
/// @param file .tsh by convention.
/// @param scene, options, tree, cancellation as for make_passes().
/// @param shard its share and notes.
/// @throws InputError, Canceled; std::runtime_error if the file cannot be written
void write_shard(const std::filesystem::path& file, const std::shared_ptr<const Scene>& scene,
                 const SolveOptions& options, const std::shared_ptr<const BspTree>& tree,
                 const ShardOptions& shard, const Cancellation& cancellation = {});

/// Returns the description of a shard; reads its head only.
/// @param file a shard.
/// @throws InputError where it is not one, or of another version of the library
ShardInfo read_shard_info(const std::filesystem::path& file);

/// An engine that reads the passes from shards, for a RadiositySolver with the same scene and
/// options. Any number of threads may call it; a pass that no shard has is an InputError.
/// @param files the shards; all of one solve, each share once.
/// @param scene the scene.
/// @param options of the solve.
/// @param cancellation checked while the files are read and checked.
/// @throws InputError naming the file that is damaged, cut off, given twice or of another solve, or
/// the shares that are missing.
TransferEngine engine_of_shards(const std::vector<std::string>& files, const Scene& scene,
                                const SolveOptions& options, const Cancellation& cancellation = {});

}  // namespace transillum
