// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "transillum/choice.h"
#include "transillum/form_factors.h"
#include "transillum/solution.h"

namespace transillum {

/// The kind of the rows of a power table.
enum class SurfaceKind {
  group,     ///< groups of faces
  material,  ///< materials
};
/// Their names (choice.h).
template <>
const Choices& choices_of<SurfaceKind>();

/// Sums over the patches of a group, of a material or of all. Powers are in W, per channel.
struct SurfacePower {
  std::string name = {};     ///< name of the group or material; empty: the patches of no group
  std::int32_t index = -1;   ///< in Scene::groups() or Scene::materials(); -1: no group, or all
  std::int64_t patches = 0;  ///< number
  double area = 0;           ///< m²
  Rgb emitted = {};          ///< sum A_i E_i
  Rgb received = {};         ///< sum A_i H_i, of all light
  Rgb from_sky = {};         ///< the part of it that comes from the sky
  Rgb from_sun = {};         ///< the part of it that comes from the sun, if known separately
  Rgb absorbed = {};         ///< sum A_i (1 - rho_i) H_i
  Rgb escaped = {};          ///< sum A_i B_i times the fraction that meets no patch; 0 if not known
};

/// Fraction of the light that escapes: the escaped power over the emitted and that from sky and
/// sun, all channels together; 0 without light.
/// @param total over all patches
double escaped_share(const SurfacePower& total);

/// Whether light escapes from the scene: more than rounding, or the errors of form factors without
/// directions, explains.
bool is_open(const SolveStatistics& statistics);

/// Powers by group or by material.
///
/// Up to the tolerance of the solve, and the error of row sums (eq. 17) where they are not
/// normalized, emitted + from_sky + from_sun = absorbed + escaped in total, if no light meets a
/// back side.
struct PowerTable {
  std::vector<SurfacePower> surfaces;  ///< parts with patches, in the order of the scene; the
                                       ///< patches of no group come last
  SurfacePower total;                  ///< over all patches; its name is "total"
  bool escape_known = false;           ///< Solution::sky_fractions is known
  /// Entry [i][j]: power that leaves part j and arrives directly at part i, sum A_k F_kl B_l over
  /// their patches, with linear functions sum_b T^0b(k,l) b_lb, W; empty without form factors. What
  /// a first shot found the sources to send more or less is included: rows, `from_sky` and
  /// `from_sun` add up to `received`.
  std::vector<std::vector<Rgb>> exchanged;
};

/// Adds up the powers of a solution. Time: linear in the patches and form factors.
/// @param solution of a solve, or read from a file.
/// @param by rows.
/// @param form_factors of its scene; if null, the table has no exchanges.
/// @param materials E and rho that the solution has, where they differ from the scene's
/// (relight()); if empty, the scene's apply.
/// @param patch_materials index into `materials` for each patch; read with `materials` only.
/// @param sun SunLight::irradiance of the solution; if empty, `from_sky` includes the sun.
/// @throws InputError where the form factors are of another number of patches, or have no moments
/// for a solution with linear functions.
PowerTable power_table(const Solution& solution, SurfaceKind by,
                       const FormFactors* form_factors = nullptr,
                       std::span<const Material> materials = {},
                       std::span<const std::int32_t> patch_materials = {},
                       std::span<const Rgb> sun = {});

}  // namespace transillum
