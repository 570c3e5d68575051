// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// All that is chosen for a solve, from the file to the radiosity. option_table.h says what each
// member is called, on the command line and in files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "transillum/export.h"
#include "transillum/material_changes.h"
#include "transillum/refinement.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace TRANSILLUM_API transillum {

/// How a scene's file is read, and what is changed before its faces become patches.
struct SceneInput {
  ReadOptions read = {};                     ///< how the file is read
  std::vector<MaterialChange> changes = {};  ///< changes of materials, in their order
  bool orient = false;                       ///< faces are turned by orient()
  bool unite_solids = false;                 ///< then closed parts are united by unite_solids()
  /// About how many patches to make, instead of SceneOptions::max_patch_area; 0 if not given. Once
  /// the scene is loaded, that area says the same.
  std::int64_t patches = 0;
  /// Patches that are divided into about four, one entry after the other: the name of a surface,
  /// "all" for all patches, or "patch:3,7-20" for patches by their numbers after the entries
  /// before it, as rounds and steps choose them. "shadows:1,0,2" divides along the edges of
  /// shadows; the direction is that to the light.
  std::vector<std::string> divided = {};

  /// Exact comparison of all members.
  friend bool operator==(const SceneInput&, const SceneInput&) = default;
};

/// Where the sun is, if no direction is given.
struct SunPlace {
  std::optional<SolarPosition> position = {};  ///< given by angles
  std::optional<Site> site = {};               ///< given by place and time
  std::optional<ZonedTime> time = {};          ///< goes with `site`
  std::optional<Vec3> north = {};              ///< default_north() if unset

  /// Exact comparison of all members.
  friend bool operator==(const SunPlace&, const SunPlace&) = default;
};

/// Whether and how patches are divided in rounds.
struct RefineChoice {
  std::optional<RefineBy> by = {};  ///< unset: they are not
  int patches = 0;                  ///< RefineOptions::patches
  double until = 0;                 ///< RefineOptions::until

  /// Whether there are rounds.
  bool is_set() const { return by.has_value(); }
  /// Requires is_set().
  RefineOptions options() const { return {*by, patches, until}; }

  /// Limits without a criterion change nothing.
  friend bool operator==(const RefineChoice& a, const RefineChoice& b) {
    return a.by == b.by && (!a.is_set() || (a.patches == b.patches && a.until == b.until));
  }
};

/// All options of a solve run.
struct RunOptions {
  SolveOptions solve = {};   ///< options of the solve
  SceneOptions scene = {};   ///< how faces become patches
  SceneInput input = {};     ///< how the scene is read and changed
  RefineChoice refine = {};  ///< rounds of refinement
  SunPlace sun = {};         ///< sets SolveOptions::sky.sun, once the vertical is known
  bool paper = false;        ///< options that are not given are as in the paper
  /// The accuracy limits the sum of all errors: patches are divided too, up to refine.patches.
  bool total = false;

  /// @throws InputError naming the option and its range, or two options that exclude each other
  void validate() const;
  /// Exact comparison of all members.
  friend bool operator==(const RunOptions&, const RunOptions&) = default;
};

}  // namespace TRANSILLUM_API transillum
