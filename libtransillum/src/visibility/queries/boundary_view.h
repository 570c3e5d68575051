// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/transfers.h"
#include "visibility/queries/boundary_cut.h"
#include "visibility/queries/cut_corners.h"
#include "visibility/queries/fragment_bins.h"
#include "visibility/queries/needle_frame.h"
#include "visibility/queries/projected_fragments.h"
#include "visibility/queries/query_cost.h"

namespace transillum {

/// The visibility query of one projected fragment, or of its part in one bin: the candidates,
/// nearest first, are subtracted from its region (decisions/0023-boundary-segments.md). The region
/// that remains is stored as boundary segments only, in doubles relative to the fragment or the
/// bin, or in a NeedleFrame (decisions/0088-needles.md). If rounding makes the segments
/// inconsistent, the query fails and has to be repeated with another view.
class BoundaryView {
 public:
  using Coordinate = double;
  enum class Frame {
    plane,  ///< coordinates of the plane; fails for fragments that are too thin
    needle  ///< coordinates in which each fragment is about as high as long
  };

  /// @param backs_hidden candidates are of the opposite side, and so seldom neighbors.
  BoundaryView(const ProjectedFragments& projected, CutCorners& cut_corners, PassCounts& counts,
               bool backs_hidden, Frame frame)
      : projected_(projected),
        cut_corners_(cut_corners),
        counts_(counts),
        backs_hidden_(backs_hidden),
        in_frame_(frame == Frame::needle) {}

  /// Begins the query of a whole fragment.
  void begin_query(std::int32_t fragment);
  /// Begins the query of the part of a fragment that lies in a bin, which may be empty.
  void begin_query(std::int32_t fragment, const FragmentBins::Bin& bin);

  /// Subtracts a candidate from the region, and returns the area that it covered, in square grid
  /// units.
  double subtract(std::int32_t candidate);
  /// Bounds of the region.
  const FragmentWindow& window() const { return window_; }

  /// Whether nothing remains but rounding.
  bool done() const {
    return region_->count == 0 || region_area_ <= std::min(0x1p-40 * area_, 64 * reach_);
  }
  /// Whether the fragment or a candidate exceeded what doubles can resolve; the areas returned so
  /// far must be discarded.
  bool failed() const { return failure_ != QueryFailure::none; }
  /// Why it failed.
  QueryFailure failure() const { return failure_; }
  /// Whether the last candidate is so small beside the fragment that the error of its area is too
  /// large for it, though not for the fragment.
  bool is_too_small() const { return too_small_; }

  /// The same for a candidate and a fragment or bin with a given size.
  bool is_too_small_beside(std::int32_t candidate, double size) const;
  /// Bound on the error of areas seen from a fragment or bin with a given size.
  static double largest_error(double size) { return 2 * rounding * size * size; }

  /// Whether the region has too many segments for another subtract(): it has to be divided.
  bool is_crowded() const { return region_->count > BoundarySegments::max_count; }
  /// Divides a crowded region by lines. The query continues with one part; the others wait.
  /// Returns false if that fails.
  bool divide();
  std::size_t waiting_parts() const { return waiting_.size(); }
  /// Continues with the part that has waited least.
  void next_part();

  /// The point that coordinates are relative to.
  const GridPoint& origin() const { return origin_; }
  /// Calls visit(px, py, qx, qy) for each directed segment that bounds what the last subtract()
  /// covered, if that was more than 0; on the plane, relative to origin().
  template <class Visit>
  void for_each_covered_segment(Visit visit) const {
    if (!in_frame_) {
      for_each_framed_segment(visit);
      return;
    }
    for_each_framed_segment([&](double px, double py, double qx, double qy) {
      const NeedleFrame::Point p = frame_.unmap(px, py), q = frame_.unmap(qx, qy);
      visit(p.x, p.y, q.x, q.y);
    });
  }

  /// The same in the coordinates of frame().
  template <class Visit>
  void for_each_framed_segment(Visit visit) const {
    for (std::uint64_t bits = cut_.inside; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(bits));
      visit(cut_.in_x[k], cut_.in_y[k], cut_.out_x[k], cut_.out_y[k]);
    }
    // The edges of the candidate, reversed as they bound the rest.
    for (std::size_t k = outside_count_; k < region_->count; ++k) {
      visit(region_->bx[k], region_->by[k], region_->ax[k], region_->ay[k]);
    }
  }
  /// The map from the plane to the coordinates of the segments.
  NeedleFrame frame() const { return in_frame_ ? frame_ : NeedleFrame::at_origin(origin_); }

 private:
  /// Bound on the rounding error of positions derived from a polygon's coordinates, relative to the
  /// largest coordinate.
  static constexpr double rounding = 0x1p-49;
  struct EdgeCrossings;

  void load_whole();
  void load_part_in_bin();
  void start(double area, double reach);
  void load();
  void load_in_frame();
  bool load_cutter(std::int32_t candidate);
  bool load_cutter_in_frame(std::int32_t candidate);
  bool is_cutter_outside_own_edge() const;
  bool is_beside_frame(const ProjectedFragments::Fragment& by) const;
  bool is_outside_own_edge(const double* x, const double* y, std::size_t count, double far) const;
  bool is_inaccurate(double error, const ProjectedFragments::Fragment& fragment) const;
  void set_own_edges();
  bool is_outside_own_edge(const ProjectedFragments::Fragment& by) const;
  bool is_outside_cutter() const;
  bool add_edges(double& twice_area);
  void find_crossings(std::size_t m, EdgeCrossings& crossings) const;
  void put_next_in_order(std::size_t m, std::size_t k, int winding, EdgeCrossings& crossings) const;
  bool add_edge(std::size_t m, EdgeCrossings& crossings, int& winding, double& twice_area);
  void find_window();
  void find_window_in_frame();
  bool halve(BoundarySegments& high, double& high_area);

  std::array<BoundarySegments, 2> segments_;
  Cutter cutter_;
  BoundaryCut cut_;
  std::size_t outside_count_ = 0;  ///< segments that the last cut left of the region's own

  const ProjectedFragments& projected_;
  CutCorners& cut_corners_;
  PassCounts& counts_;
  const bool backs_hidden_;
  const bool in_frame_;  ///< coordinates are in frame_

  const ProjectedFragments::Fragment* subject_ = nullptr;  ///< the fragment of the query
  const FragmentBins::Bin* bin_ = nullptr;                 ///< nullptr: all of the fragment
  Cutter own_edges_;                                       ///< the edges of the fragment
  bool loaded_ = false;  ///< the region is loaded when the first candidate is subtracted
  GridPoint origin_;
  double reach_ = 0;  ///< largest |x| + |y| of the fragment, or the size of the bin
  double area_ = 0, region_area_ = 0;
  QueryFailure failure_ = QueryFailure::none;
  bool too_small_ = false;
  NeedleFrame frame_;    ///< a translation in Frame::plane, for candidates that the tree has cut
  double per_area_ = 1;  ///< square grid units per unit of area of the coordinates
  FragmentWindow window_;
  Extent extent_;         ///< extent of the region, relative to origin_
  Extent origin_extent_;  ///< extent of origin_, to be added to extent_
  BoundarySegments* region_ = &segments_[0];
  BoundarySegments* next_region_ = &segments_[1];  ///< the rest of the region after subtract()
  struct Waiting {
    BoundarySegments segments;
    double area;
  };
  std::vector<Waiting> waiting_;  ///< parts of the region, by divide()
};

}  // namespace transillum
