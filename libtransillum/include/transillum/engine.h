// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/choice.h"
#include "transillum/export.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace TRANSILLUM_API transillum {

/// The algorithm that computes Transfers from a direction.
enum class Engine {
  fast,       ///< subtracts the candidates from each receiver's region, nearest first
  local,      ///< the local visibility map of section 3.2; can be recorded and stepped through
  global,     ///< the global visibility map of section 3.1, by an exact arrangement
  exact,      ///< the local map in exact arithmetic: a reference for small scenes
  zbuffer,    ///< the generalized z-buffer of section 2: a list of patches per pixel
  painter,    ///< the painter's algorithm of section 2: one item buffer, painted back to front
  rays,       ///< parallel lines through the scene: statistical
  corrected,  ///< no cutting: partly hidden polygons stay whole, areas are corrected (section 8)
  hemicube,   ///< no directions: item buffers at each patch's center, by solve_by_form_factors()
  pairs,      ///< no directions: form factors pair by pair, by solve_by_form_factors()
};

/// The properties of an engine. Callers ask these instead of naming engines.
struct EngineTraits {
  /// The kind of error in its transfers.
  enum class Error {
    none,         ///< not at all, up to rounding
    statistical,  ///< by chance: its own random numbers
    own,          ///< in a way that directions and replicas do not show
  };
  /// How a window can show V.
  enum class Picture {
    polygons,   ///< the exact map
    pixels,     ///< pixel_map()
    corrected,  ///< corrected_map()
    hemicube,   ///< the hemicube of a patch
    none,       ///< not at all
  };
  /// How the form factors between all patches are computed.
  enum class Factors {
    passes,     ///< summed over directions, by make_engine()
    rays,       ///< summed over directions in a solve, by rays from the patches where no solve runs
    hemicubes,  ///< hemicube_form_factors(), without directions
    pairs,      ///< pair_form_factors(), without directions
  };

  Engine value;                         ///< the engine
  const char* name;                     ///< in options and files
  const char* label;                    ///< in a list of choices
  const char* sentence;                 ///< one sentence on its method
  Error error = Error::none;            ///< error of its transfers
  Picture picture = Picture::polygons;  ///< form of V
  bool takes_directions = true;         ///< make_engine() accepts it
  bool has_moments = false;             ///< computes Transfers::moments
  bool has_linear_basis = false;        ///< solves with Basis::linear
  bool takes_resolution = false;        ///< reads EngineOptions::resolution
  bool takes_points = false;            ///< reads EngineOptions::points
  bool takes_order = false;             ///< reads EngineOptions::order
  Factors factors = Factors::passes;    ///< form factors between all patches
};
/// The traits of all engines, in the order of the enumeration.
std::span<const EngineTraits> engines();
/// The traits of one engine.
const EngineTraits& traits_of(Engine engine);

/// Their names (choice.h).
template <>
const Choices& choices_of<Engine>();
/// Whether make_engine() accepts it: all but hemicube and pairs.
bool takes_directions(Engine engine);
/// Whether it computes Transfers::moments: fast, local and exact.
bool has_moments(Engine engine);

/// Computes the Transfers of a direction omega (unit). A pure function without shared mutable
/// state: any number of threads may call one, and the same omega gives the same bits. Throws
/// Canceled.
using TransferEngine = std::function<Transfers(const Vec3& omega, const Cancellation&)>;

/// How engine painter determines the order of the fragments.
enum class PaintersOrder {
  bsp,     ///< by the BSP tree; always succeeds
  newell,  ///< by the tests of Newell, Newell and Sancha; fails where patches overlap cyclically
};
/// Their names (choice.h).
template <>
const Choices& choices_of<PaintersOrder>();

/// Options that only some engines read.
struct EngineOptions {
  static constexpr int default_resolution = 512;    ///< pixels, for zbuffer and painter
  static constexpr int largest_resolution = 16384;  ///< pixels
  static constexpr int default_points = 32;         ///< for engine pairs
  static constexpr int largest_points = 1024;       ///< for engine pairs

  double lines_per_patch = 100;  ///< rays: lines per direction over number of patches, (0, 1e6]
  bool gridded = true;           ///< rays: on a jittered grid; else uniformly random
  std::uint64_t seed = 1;        ///< rays: seed of the positions; a solve takes its own seed
  /// zbuffer, painter: pixels along the longer side of the window, the bounding box of the
  /// projected scene; 0 means default_resolution. rays: the same grid with one line per pixel; 0
  /// means lines_per_patch. hemicube: pixels along a side of the cube; 0 means the default of
  /// HemicubeOptions::resolution.
  int resolution = 0;
  PaintersOrder order = PaintersOrder::bsp;  ///< painter
  /// pairs: PairOptions::points, up to largest_points; 0 means default_points.
  int points = 0;
  /// fast, local and exact: Transfers::moments too, for Basis::linear. The other engines have none.
  bool moments = false;

  /// Exact comparison of all members.
  friend bool operator==(const EngineOptions&, const EngineOptions&) = default;
};

/// Makes an engine. It keeps scene and tree alive.
/// @param engine any that takes_directions().
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param options those that the engine does not read are ignored.
/// @param cancellation of making it: engine fast looks for patches that it can query together.
/// @throws InputError where the engine does not support the scene or an option.
/// @throws Canceled
TransferEngine make_engine(Engine engine, std::shared_ptr<const Scene> scene,
                           std::shared_ptr<const BspTree> tree, const EngineOptions& options = {},
                           const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
