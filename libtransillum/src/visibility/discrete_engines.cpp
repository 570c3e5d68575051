// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The engines of section 2: the transillumination plane in pixels, each of which stands for its
// area wherever its centre is seen.
#include "visibility/discrete_engines.h"

#include <fmt/format.h>

#include <utility>

#include "transillum/errors.h"
#include "visibility/counted_transfers.h"
#include "visibility/engines.h"
#include "visibility/newell_order.h"
#include "visibility/painter.h"
#include "visibility/zbuffer.h"

namespace transillum {
namespace {

int resolution_of(const EngineOptions& options) {
  return options.resolution > 0 ? options.resolution : EngineOptions::default_resolution;
}

void paint(const Scene& scene, const BspTree& tree, PaintersOrder order, const PixelGrid& grid,
           const PatchHeights& heights, PixelBook& book, const Cancellation& cancellation) {
  if (order == PaintersOrder::newell) {
    const PieceOutlines pieces(scene, grid);
    Painter(pieces, grid, heights, book, cancellation)
        .paint(newell_order(scene, grid, pieces, heights, cancellation));
  } else {
    const FragmentOutlines fragments(tree, grid);
    Painter(fragments, grid, heights, book, cancellation)
        .paint(tree.order(grid.frame().omega, cancellation));
  }
}

}  // namespace

void fill_pixels(Engine engine, const Scene& scene, const BspTree& tree,
                 const EngineOptions& options, const PixelGrid& grid, const PatchHeights& heights,
                 PixelBook& book, const Cancellation& cancellation) {
  switch (engine) {
    case Engine::zbuffer:
      return fill_zbuffer(scene, grid, heights, book, cancellation);
    case Engine::painter:
      return paint(scene, tree, options.order, grid, heights, book, cancellation);
    case Engine::rays:
      return cast_lines(scene, options.seed, grid, heights, book, cancellation);
    default:
      throw InputError(
          fmt::format("engine {} has no pixels: choose zbuffer, painter or rays", name_of(engine)));
  }
}

TransferEngine zbuffer_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options) {
  return [scene = std::move(scene), resolution = resolution_of(options)](
             const Vec3& omega, const Cancellation& cancellation) {
    const PixelGrid grid(*scene, omega, resolution);
    const PatchHeights heights(*scene, grid.frame(), grid.snapping());
    CountedTransfers counted(*scene, heights, cancellation);
    fill_zbuffer(*scene, grid, heights, counted, cancellation);
    return counted.finish(omega, grid.area());
  };
}

TransferEngine painter_engine(std::shared_ptr<const Scene> scene,
                              std::shared_ptr<const BspTree> tree, const EngineOptions& options) {
  return [scene = std::move(scene), tree = std::move(tree), resolution = resolution_of(options),
          order = options.order](const Vec3& omega, const Cancellation& cancellation) {
    const PixelGrid grid(*scene, omega, resolution);
    const PatchHeights heights(*scene, grid.frame(), grid.snapping());
    CountedTransfers counted(*scene, heights, cancellation);
    paint(*scene, *tree, order, grid, heights, counted, cancellation);
    return counted.finish(omega, grid.area());
  };
}

}  // namespace transillum
