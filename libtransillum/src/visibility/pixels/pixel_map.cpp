// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The maps of the engines zbuffer, painter and rays: an item buffer filled through a
// VisibilitySink, and its conversion to rectangles for pictures and files.
#include "visibility/pixels/pixel_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "transillum/errors.h"
#include "visibility/pixels/counted_transfers.h"
#include "visibility/pixels/discrete_engines.h"

namespace transillum {
namespace {

/// Keeps the patch that is visible in each pixel.
class ItemBuffer : public VisibilitySink {
 public:
  ItemBuffer(PixelMap& map, const PatchHeights& heights, CountedTransfers& counted)
      : map_(map), heights_(heights), counted_(counted) {}

  void record(int row, int begin, int end, PatchId below, PatchId above) override {
    counted_.record(row, begin, end, below, above);
    const bool from_below = map_.receiver == no_patch;
    if (!from_below && (below != map_.receiver || !heights_.front_facing(below))) {
      return;
    }
    for (int column = begin; column < end; ++column) {
      const std::size_t pixel = map_.index(column, row);
      map_.items[pixel] = from_below ? below : above;
      if (!from_below) {
        map_.window[pixel] = true;
      }
    }
  }

 private:
  PixelMap& map_;
  const PatchHeights& heights_;
  CountedTransfers& counted_;
};

}  // namespace

bool has_pixels(Engine engine) {
  return traits_of(engine).picture == EngineTraits::Picture::pixels;
}

namespace {

int checked(int resolution) {
  if (resolution == 0) {
    return PixelMap::default_resolution;
  }
  if (resolution < 0 || resolution > PixelMap::largest_resolution) {
    throw InputError(fmt::format("resolution of a map: {} is not in the range 1 to {}", resolution,
                                 PixelMap::largest_resolution));
  }
  return resolution;
}

/// @param fill fill(grid, heights, sink) records the visible patches of the pixels in sink
template <class Fill>
PixelMap map_from(const Scene& scene, const Vec3& omega, int resolution, PatchId receiver,
                  const Cancellation& cancellation, Fill fill) {
  const PixelGrid grid(scene, omega, checked(resolution));
  const PatchHeights heights(scene, grid.frame(), grid.snapping());
  PixelMap map;
  map.frame = grid.frame();
  map.corner = grid.corner();
  map.side = grid.side();
  map.columns = grid.columns();
  map.rows = grid.rows();
  map.receiver = receiver;
  map.items.assign(map.index(0, map.rows), no_patch);
  if (receiver != no_patch) {
    map.window.assign(map.items.size(), false);
  }
  CountedTransfers counted(scene, heights, cancellation);
  ItemBuffer buffer(map, heights, counted);
  fill(grid, heights, buffer);
  map.exchanges = counted.finish(omega, grid.area()).exchanges;
  return map;
}

}  // namespace

PixelMap pixel_map(const PixelEngine& engine, const Scene& scene, const BspTree& tree,
                   const Vec3& omega, PatchId receiver, const Cancellation& cancellation) {
  return map_from(scene, omega, engine.options.resolution, receiver, cancellation,
                  [&](const PixelGrid& grid, const PatchHeights& heights, VisibilitySink& sink) {
                    sample_visibility(engine, {scene, tree, grid, heights}, sink, cancellation);
                  });
}

PixelMap pixel_map_after(const PixelEngine& engine, const Scene& scene, const BspTree& tree,
                         const MapRecord& record, std::int32_t step,
                         const Cancellation& cancellation) {
  const std::span<const FragmentId> all(record.order);
  const auto fragments = all.first(static_cast<std::size_t>(step + 1));
  return map_from(
      scene, record.frame.omega, engine.options.resolution, no_patch, cancellation,
      [&](const PixelGrid& grid, const PatchHeights& heights, VisibilitySink& sink) {
        sample_visibility(engine, {scene, tree, grid, heights}, fragments, sink, cancellation);
      });
}

namespace {

/// Rectangles of pixels that show the same patch: runs of a row, extended as long as the next row
/// has the same span.
class Rectangles {
 public:
  Rectangles(const PixelMap& pixels, VisibilityMap& map, const Cancellation& cancellation)
      : pixels_(pixels), map_(map), cancellation_(cancellation) {}

  /// Calls add(patch, rectangle) for all rectangles. of(index) is the patch that a pixel shows;
  /// pixels that show `nothing` are omitted.
  template <class Of, class Add>
  void find(PatchId nothing, Of of, Add add) {
    std::map<std::pair<int, PatchId>, Span> open;  // by first column and item
    for (int row = 0; row <= pixels_.rows; ++row) {
      cancellation_.throw_if_canceled();
      std::map<std::pair<int, PatchId>, Span> grown;
      for (int begin = 0; row < pixels_.rows && begin < pixels_.columns;) {
        const PatchId item = of(pixels_.index(begin, row));
        int end = begin + 1;
        while (end < pixels_.columns && of(pixels_.index(end, row)) == item) {
          ++end;
        }
        if (item != nothing) {
          const auto above = open.find({begin, item});
          const bool grows = above != open.end() && above->second.end == end;
          grown[{begin, item}] = {end, grows ? above->second.row : row};
          if (grows) {
            open.erase(above);
          }
        }
        begin = end;
      }
      for (const auto& [key, span] : open) {
        add(key.second, rectangle(key.first, span.end, span.row, row));
      }
      open.swap(grown);
    }
  }

 private:
  struct Span {
    int end, row;  ///< end column; first row
  };

  VisibilityMap::Polygon rectangle(int begin, int end, int first_row, int end_row) {
    const auto first = static_cast<std::uint32_t>(map_.corners.size());
    const auto x = [&](int column) { return pixels_.corner.x + column * pixels_.side; };
    const auto y = [&](int row) { return pixels_.corner.y + row * pixels_.side; };
    map_.corners.insert(map_.corners.end(), {{x(begin), y(first_row)},
                                             {x(end), y(first_row)},
                                             {x(end), y(end_row)},
                                             {x(begin), y(end_row)}});
    const double pixels = static_cast<double>(end - begin) * (end_row - first_row);
    return {no_patch, false, pixels * pixels_.side * pixels_.side, first, first + 4};
  }

  const PixelMap& pixels_;
  VisibilityMap& map_;
  const Cancellation& cancellation_;
};

/// The sides between pixels that show different patches, as pairs of end points.
std::vector<Vec2> borders(const PixelMap& pixels) {
  std::vector<Vec2> ends;
  const auto item = [&](int column, int row) {
    const bool inside = column >= 0 && column < pixels.columns && row >= 0 && row < pixels.rows;
    return inside ? pixels.items[pixels.index(column, row)] : no_patch;
  };
  const auto corner = [&](int column, int row) -> Vec2 {
    return {pixels.corner.x + column * pixels.side, pixels.corner.y + row * pixels.side};
  };
  for (int row = 0; row <= pixels.rows; ++row) {
    for (int begin = 0; begin < pixels.columns;) {
      int end = begin;
      while (end < pixels.columns && item(end, row) != item(end, row - 1)) {
        ++end;
      }
      if (end > begin) {
        ends.insert(ends.end(), {corner(begin, row), corner(end, row)});
      }
      begin = end + 1;
    }
  }
  for (int column = 0; column <= pixels.columns; ++column) {
    for (int begin = 0; begin < pixels.rows;) {
      int end = begin;
      while (end < pixels.rows && item(column, end) != item(column - 1, end)) {
        ++end;
      }
      if (end > begin) {
        ends.insert(ends.end(), {corner(column, begin), corner(column, end)});
      }
      begin = end + 1;
    }
  }
  return ends;
}

}  // namespace

VisibilityMap drawn_in_pixels(const Scene& scene, const PixelMap& pixels,
                              const Cancellation& cancellation) {
  VisibilityMap map;
  map.frame = pixels.frame;
  map.receiver = pixels.receiver;
  map.exchanges = pixels.exchanges;
  map.pixels.side = pixels.side;
  map.pixels.borders = borders(pixels);
  Rectangles rectangles(pixels, map, cancellation);
  if (pixels.receiver != no_patch) {
    rectangles.find(
        no_patch, [&](std::size_t at) { return pixels.window[at] ? pixels.receiver : no_patch; },
        [&](PatchId patch, VisibilityMap::Polygon rectangle) {
          rectangle.patch = patch;
          rectangle.front_facing = true;
          map.window.push_back(rectangle);
        });
  }
  rectangles.find(
      no_patch, [&](std::size_t at) { return pixels.items[at]; },
      [&](PatchId patch, VisibilityMap::Polygon rectangle) {
        rectangle.patch = patch;
        rectangle.front_facing = dot(scene.patch(patch).normal, pixels.frame.omega) > 0;
        map.polygons.push_back(rectangle);
      });
  std::stable_sort(map.polygons.begin(), map.polygons.end(),
                   [](const auto& a, const auto& b) { return a.patch < b.patch; });
  return map;
}

}  // namespace transillum
