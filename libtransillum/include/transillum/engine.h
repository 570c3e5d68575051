// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum {

/// Which algorithm turns a direction into transfers.
enum class Engine {
  fast,       ///< each receiver's polygon eaten up by what lies above it, nearest first
  local,      ///< the local visibility map of section 3.2, the one that can be watched
  global,     ///< the global visibility map of section 3.1, by CGAL's exact arrangement
  exact,      ///< the local map in exact numbers: an oracle for small scenes
  zbuffer,    ///< the generalized z-buffer of section 2: a list of patches a pixel
  painter,    ///< the painter's algorithm of section 2: one item buffer, painted over and over
  rays,       ///< parallel lines through the scene by Embree: statistical
  corrected,  ///< no cutting: what is partly hidden stays whole and is corrected (section 8)
  hemicube,   ///< no directions: what each patch's middle sees, by solve_by_hemicubes()
};
const std::vector<std::string>& engine_names();
/// @throws InputError naming the choices.
Engine engine_from_name(const std::string& name);
const std::string& name_of(Engine engine);
/// Whether make_engine() has it; not so hemicube.
bool takes_directions(Engine engine);

/// An engine at work: from a direction omega (unit) to its Transfers. Pure: no shared mutable
/// state, so any number of threads may call one; the same omega gives the same bits.
/// @throws Canceled
using TransferEngine = std::function<Transfers(const Vec3& omega, const Cancellation&)>;

/// How the painter's algorithm comes by its order.
enum class PaintersOrder {
  bsp,     ///< the tree's, which always has one
  newell,  ///< Newell, Newell and Sancha's tests; gives up where patches overlap in a circle
};
const std::vector<std::string>& painters_order_names();
/// @throws InputError naming the choices.
PaintersOrder painters_order_from_name(const std::string& name);
const std::string& name_of(PaintersOrder order);

/// Options that only some engines read.
struct EngineOptions {
  static constexpr int default_resolution = 512, largest_resolution = 16384;

  double lines_per_patch = 100;  ///< rays: lines a direction over the number of patches, (0, 1e6]
  bool gridded = true;           ///< rays: on a jittered grid; else anywhere at random
  std::uint64_t seed = 1;        ///< rays
  /// zbuffer, painter: pixels along the longer side of the window, the box round the projected
  /// scene; 0: default_resolution. rays: the same grid, one line a pixel; 0: by lines_per_patch.
  /// hemicube: pixels along a side of the cube; 0: HemicubeOptions' default.
  int resolution = 0;
  PaintersOrder order = PaintersOrder::bsp;  ///< painter

  friend bool operator==(const EngineOptions&, const EngineOptions&) = default;
};

/// Keeps scene and tree alive. `tree` is `scene`'s.
/// @throws InputError where the engine cannot take the scene or an option.
TransferEngine make_engine(Engine engine, std::shared_ptr<const Scene> scene,
                           std::shared_ptr<const BspTree> tree, const EngineOptions& options = {});

}  // namespace transillum
