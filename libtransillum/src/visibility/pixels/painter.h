// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "visibility/pixels/outlines.h"
#include "visibility/pixels/patch_heights.h"
#include "visibility/pixels/pixel_grid.h"

namespace transillum {

/// The painter's algorithm of section 2: paints polygons, farthest toward omega first, into one
/// item buffer. The patch that a pixel held before is what the polygon sees there; the pair is
/// recorded in the sink.
///
/// The buffer holds one band of rows at a time, so its memory does not grow with the resolution.
template <class Outlines>
class Painter {
 public:
  /// Keeps references.
  Painter(const Outlines& outlines, const PixelGrid& grid, const PatchHeights& heights,
          VisibilitySink& sink, const Cancellation& cancellation)
      : outlines_(outlines),
        grid_(grid),
        heights_(heights),
        sink_(sink),
        cancellation_(cancellation),
        converter_(grid) {}

  /// @param order numbers of outlines, in painting order
  /// @throws Canceled
  void paint(std::span<const std::int32_t> order) {
    const int rows = std::max(max_pixels / grid_.columns(), 1);
    for (first_row_ = 0; first_row_ < grid_.rows(); first_row_ += rows) {
      end_row_ = std::min(first_row_ + rows, grid_.rows());
      items_.assign(static_cast<std::size_t>(end_row_ - first_row_) *
                        static_cast<std::size_t>(grid_.columns()),
                    no_patch);
      std::size_t done = 0;
      for (const std::int32_t k : order) {
        if (done++ % 64 == 0) {
          cancellation_.throw_if_canceled();
        }
        paint(k);
      }
    }
  }

 private:
  static constexpr int max_pixels = 1 << 22;

  void paint(std::int32_t k) {
    const PatchId patch = outlines_.patch(k);
    if (heights_.edge_on(patch)) {
      return;
    }
    converter_.begin(first_row_, end_row_);
    outlines_.add_edges(k, converter_);
    converter_.finish([&](int row, int begin, int end) { paint_span(patch, row, begin, end); });
  }

  void paint_span(PatchId patch, int row, int begin, int end) {
    painted_ += end - begin;
    if (painted_ > max_pixels / 4) {
      painted_ = 0;
      cancellation_.throw_if_canceled();
    }
    PatchId* const items = items_.data() + static_cast<std::size_t>(row - first_row_) *
                                               static_cast<std::size_t>(grid_.columns());
    while (begin < end) {
      const PatchId above = items[begin];
      int span_end = begin;
      while (span_end < end && items[span_end] == above) {
        items[span_end++] = patch;
      }
      if (above != patch) {
        sink_.record(row, begin, span_end, patch, above);
      }
      begin = span_end;
    }
  }

  const Outlines& outlines_;
  const PixelGrid& grid_;
  const PatchHeights& heights_;
  VisibilitySink& sink_;
  const Cancellation& cancellation_;
  ScanConverter converter_;
  int first_row_ = 0, end_row_ = 0;
  int painted_ = 0;             ///< pixels since the last cancellation check
  std::vector<PatchId> items_;  ///< item buffer of the band: the patch visible from below so far
};

/// The pieces of a scene in painting order, farthest toward omega first, by the tests of M. E.
/// Newell, R. G. Newell and T. L. Sancha ("A solution to the hidden surface problem", 1972),
/// without splitting. Pieces are sorted by their highest point; a piece that another lies above,
/// even in part, is put after that one.
///
/// Where the original tests would split one of two pieces, heights at the corners of their overlap
/// are compared first.
/// @returns indexes into Scene::pieces(), without edge-on pieces
/// @throws InputError naming the patches, where they overlap in a cycle or intersect; Canceled
std::vector<std::int32_t> newell_order(const Scene& scene, const PixelGrid& grid,
                                       const PieceOutlines& outlines, const PatchHeights& heights,
                                       const Cancellation& cancellation);

}  // namespace transillum
