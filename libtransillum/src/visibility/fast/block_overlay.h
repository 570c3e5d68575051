// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Divides the area in which one block sees another among their patches. Input: the boundary of the
// area on the plane, from a visibility query. The lines of both grids cut it one after another,
// each into two closed boundaries, which have the points on the line in common to the last bit. So
// no area is lost, however rounding has moved the points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/fast/patch_blocks.h"
#include "visibility/queries/needle_frame.h"
#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// A directed segment of a boundary; the area is on its left.
struct BoundarySegment {
  double ax, ay, bx, by;
};

/// The boundary of a cell, as FragmentMoments reads it.
struct CellBoundary {
  using Coordinate = double;
  NeedleFrame frame;  ///< in whose coordinates the segments are
  std::span<const BoundarySegment> segments;

  const GridPoint& origin() const { return frame.origin; }
  template <class Visit>
  void for_each_covered_segment(Visit visit) const {
    for (const BoundarySegment& s : segments) {
      const NeedleFrame::Point p = frame.unmap(s.ax, s.ay), q = frame.unmap(s.bx, s.by);
      visit(p.x, p.y, q.x, q.y);
    }
  }
};

/// Divides what blocks see of each other by the lines of their grids.
class BlockOverlay {
 public:
  /// The area in which patch `own` sees patch `other`.
  struct Cell {
    PatchId own, other;
    double area;               ///< in the coordinates' unit
    std::uint32_t begin, end;  ///< the segments of its boundary
  };

  BlockOverlay(const PatchBlocks& blocks, const ProjectedFragments& projected)
      : blocks_(blocks), projected_(projected) {}

  /// To be called when a view begins a query: its frame changes.
  void begin_query() { own_ = nullptr; }
  /// Divides what the fragment of the query sees of another.
  /// @param view in its frame: the boundary of what its last subtract() has covered
  /// @param keep_segments whether boundary() will be called
  template <class View>
  std::span<const Cell> divide(const View& view, const NeedleFrame& frame,
                               const ProjectedFragments::Fragment& own,
                               const ProjectedFragments::Fragment& other, bool keep_segments) {
    begin(frame, own, other, keep_segments);
    view.for_each_framed_segment([&](double ax, double ay, double bx, double by) {
      pool_.push_back({ax, ay, bx, by});
    });
    finish();
    return cells_;
  }
  /// Whether the grid of the plane is so coarse beside a block that its patches may not have their
  /// shares of the area.
  bool is_narrow(PatchId block) const;
  /// Divides the outline of a fragment by the lines of its own block.
  std::span<const Cell> divide_outline(const ProjectedFragments::Fragment& fragment);
  /// The boundary of a cell; empty unless segments were kept.
  std::span<const BoundarySegment> boundary(const Cell& cell) const {
    return {kept_.data() + cell.begin, cell.end - cell.begin};
  }

 private:
  /// The columns, rows or strips of one of the two blocks.
  struct Axis {
    std::int32_t count = 1;
    std::size_t lines = 0;    ///< first in lines_
    std::int32_t chosen = 0;  ///< the one that holds the part being divided
  };

  void begin(const NeedleFrame& frame, const ProjectedFragments::Fragment& own,
             const ProjectedFragments::Fragment& other, bool keep_segments);
  void add_axes(const NeedleFrame& frame, const ProjectedFragments::Fragment& fragment,
                std::size_t first_axis);
  template <class Between, class Through>
  void add_lines(const PatchBlock& block, std::size_t corners, bool front, Between between,
                 Through through);
  void finish();
  void divide_axis(std::size_t axis, std::size_t begin);
  void divide_axis(std::size_t axis, std::int32_t low, std::int32_t high, std::size_t begin);
  int cut(const NeedleFrame::Line& line, std::size_t begin, std::size_t& right);
  void close();
  PatchId chosen_patch(const PatchBlock& block, std::size_t first_axis) const;
  void add_cell(std::size_t begin);

  const PatchBlocks& blocks_;
  const ProjectedFragments& projected_;
  const PatchBlock* own_ = nullptr;
  const PatchBlock* other_ = nullptr;
  bool keep_segments_ = false;
  std::array<Axis, 6> axes_;              ///< columns, rows, strips of the one, then of the other
  std::vector<NeedleFrame::Line> lines_;  ///< the query's block has the first ones
  std::size_t own_lines_ = 0;
  double own_far_ = 0;  ///< largest coordinate of the fragment of the query in its frame
  std::vector<BoundarySegment> pool_;  ///< parts that wait, and at its end the one being divided
  struct Crossing {
    double along, x, y;
    int change;  ///< the winding number changes by this, in the order of `along`
  };
  std::vector<Crossing> crossings_;
  std::vector<BoundarySegment> right_;
  std::vector<Cell> cells_;
  std::vector<BoundarySegment> kept_;
};

}  // namespace transillum
