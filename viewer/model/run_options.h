// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "transillum/material_changes.h"
#include "transillum/radiosity.h"
#include "transillum/refinement.h"
#include "transillum/scene.h"
#include "transillum/settings.h"

namespace transillum::viewer {

/// How a scene's file is read, and what is changed before its faces become patches.
struct SceneInput {
  ReadOptions read;
  std::vector<MaterialChange> changes;  ///< part of the scene, unlike MaterialEdits
  bool orient = false;                  ///< faces are turned by orient()
  /// About how many patches to make, instead of SceneOptions::max_patch_area; 0: not given. Once
  /// the scene is loaded, that area says the same.
  std::int64_t patches = 0;

  friend bool operator==(const SceneInput& a, const SceneInput& b) {
    return a.read.default_reflectance == b.read.default_reflectance &&
           a.read.max_reflectance == b.read.max_reflectance && a.read.scale == b.read.scale &&
           a.read.join == b.read.join && a.read.photometric == b.read.photometric &&
           a.changes == b.changes && a.orient == b.orient && a.patches == b.patches;
  }
};

/// Whether and how patches are divided in rounds.
struct RefineChoice {
  std::optional<RefineBy> by;  ///< unset: they are not
  int patches = 0;             ///< RefineOptions::patches
  double until = 0;            ///< RefineOptions::until

  bool set() const { return by.has_value(); }
  /// Requires set().
  RefineOptions options() const { return {*by, patches, until}; }

  /// Limits without a criterion change nothing.
  friend bool operator==(const RefineChoice& a, const RefineChoice& b) {
    return a.by == b.by && (!a.set() || (a.patches == b.patches && a.until == b.until));
  }
};

/// All options of a solve run.
struct RunOptions {
  SolveOptions solve;
  SceneOptions scene = {};
  SceneInput input = {};
  RefineChoice refine = {};

  friend bool operator==(const RunOptions& a, const RunOptions& b) {
    return a.solve == b.solve && a.scene.two_sided == b.scene.two_sided &&
           a.scene.max_patch_area == b.scene.max_patch_area && a.input == b.input &&
           a.refine == b.refine;
  }
};

/// SolveOptions::sampling for a choice: unset for the default, so that options that say the same
/// are equal.
std::optional<Sampling> unless_default(Sampling sampling, bool two_way);

/// Reads options from a lesson or session file. Names as on the command line, without dashes;
/// missing options have their defaults. The numbers of threads and bytes depend on the computer and
/// are not included.
/// @throws InputError that begins with `where`
RunOptions run_options_from_json(const nlohmann::json& value, const std::string& where);
/// All options of run_options_from_json().
nlohmann::json to_json(const RunOptions& options);

}  // namespace transillum::viewer
