// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The engines of section 2: the transillumination plane is divided into pixels, each of which
// counts with its whole area for what is visible at its center.
#include "visibility/pixels/discrete_engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/pixels/counted_transfers.h"
#include "visibility/pixels/painter.h"
#include "visibility/pixels/pixel_engines.h"
#include "visibility/pixels/zbuffer.h"

namespace transillum {
namespace {

int resolution_of(const EngineOptions& options) {
  return options.resolution > 0 ? options.resolution : EngineOptions::default_resolution;
}

void paint(PaintersOrder order, const PixelScene& view, VisibilitySink& sink,
           const Cancellation& cancellation) {
  const auto& [scene, tree, grid, heights] = view;
  if (order == PaintersOrder::newell) {
    const PieceOutlines pieces(scene, grid);
    Painter(pieces, grid, heights, sink, cancellation)
        .paint(newell_order(scene, grid, pieces, heights, cancellation));
  } else {
    const SnappedFragments fragments(tree, grid);
    Painter(fragments, grid, heights, sink, cancellation)
        .paint(tree.order(grid.frame().omega, cancellation));
  }
}

/// `fragments`, sorted by Newell's order of the pieces that they are parts of.
std::vector<FragmentId> in_newell_order(const PixelScene& view,
                                        std::span<const FragmentId> fragments,
                                        const Cancellation& cancellation) {
  const auto& [scene, tree, grid, heights] = view;
  const PieceOutlines pieces(scene, grid);
  const std::vector<std::int32_t> order = newell_order(scene, grid, pieces, heights, cancellation);
  std::vector<std::size_t> rank(scene.pieces().size(), order.size());  // edge-on ones last
  for (std::size_t n = 0; n < order.size(); ++n) {
    at(rank, order[n]) = n;
  }
  const PieceFinder finder(scene, tree, grid.frame());
  std::vector<std::pair<std::size_t, FragmentId>> ranked;
  for (const FragmentId f : fragments) {
    ranked.emplace_back(rank[finder.piece_of(f)], f);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<FragmentId> sorted;
  for (const auto& [_, f] : ranked) {
    sorted.push_back(f);
  }
  return sorted;
}

[[noreturn]] void fail_without_pixels(Engine engine) {
  throw InputError(fmt::format("engine {} does not use pixels", name_of(engine)));
}

}  // namespace

void sample_visibility(const PixelEngine& engine, const PixelScene& view, VisibilitySink& sink,
                       const Cancellation& cancellation) {
  switch (engine.engine) {
    case Engine::zbuffer:
      return fill_zbuffer(view.scene, view.grid, view.heights, sink, cancellation);
    case Engine::painter:
      return paint(engine.options.order, view, sink, cancellation);
    case Engine::rays:
      return trace_lines(engine.options.seed, view, nullptr, sink, cancellation);
    default:
      fail_without_pixels(engine.engine);
  }
}

void sample_visibility(const PixelEngine& engine, const PixelScene& view,
                       std::span<const FragmentId> fragments, VisibilitySink& sink,
                       const Cancellation& cancellation) {
  const auto& [scene, tree, grid, heights] = view;
  switch (engine.engine) {
    case Engine::zbuffer:
      return fill_zbuffer(tree, fragments, grid, heights, sink, cancellation);
    case Engine::painter: {
      const SnappedFragments outlines(tree, grid);
      Painter painter(outlines, grid, heights, sink, cancellation);
      if (engine.options.order == PaintersOrder::bsp) {
        return painter.paint(fragments);
      }
      return painter.paint(in_newell_order(view, fragments, cancellation));
    }
    case Engine::rays: {
      const ProcessedFragments processed(scene, tree, fragments, grid.frame());
      return trace_lines(engine.options.seed, view, &processed, sink, cancellation);
    }
    default:
      fail_without_pixels(engine.engine);
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
    paint(order, {*scene, *tree, grid, heights}, counted, cancellation);
    return counted.finish(omega, grid.area());
  };
}

}  // namespace transillum
