// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/form_factor.h"
#include "transillum/linear_basis.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"
#include "visibility/pairs/merged_pieces.h"
#include "visibility/pairs/point_view.h"
#include "visibility/pairs/shaft.h"

namespace transillum {

/// The exchange of two patches.
struct PatchExchange {
  double area = 0;          ///< A_i F_ij = A_j F_ji, m²
  bool whole = true;        ///< nothing blocks any part of it: exact up to rounding
  double error = 0;         ///< estimate of the exact area less `area`, m²
  bool integrated = false;  ///< a whole part was integrated numerically (polygon_exchange())
  /// T^10 and T^20 of receiver i, and estimates of their errors, m²; 0 unless they are requested.
  std::array<double, 2> moments{}, moment_errors{};
};

/// A convex polygon that emits: patches of one face that emit alike, or an open part of one patch.
/// Lengths are in the finder's unit.
struct LampPolygon {
  Rgb exitance;                  ///< E, W/m²
  Corners outline;               ///< seen from its lit side, counter-clockwise
  HalfSpace front;               ///< in front of it
  double bend = 0;               ///< largest distance of the corners from their plane
  std::vector<PatchId> patches;  ///< ascending
};

struct PointSums;
class RefinedCells;
struct SampledPolygon;

/// Form factors of single pairs of patches, with blockers between them.
///
/// If nothing reaches into the shaft between the two, the polygons alone give the form factor.
/// Otherwise one of the two is sampled by points (SampledPolygon), and the form factor from each
/// point to the visible part of the other is computed exactly: the error decreases about as the
/// square of the distance between points, or in proportion to it if a blocker touches the sampled
/// patch. It is estimated, for the former, from what a quarter and a sixteenth of the points give;
/// where one point suffices, as the square of the patch's size over the distance.
///
/// Among coplanar patches with the same normal, those cover others that do so in BspTree::order().
/// Surfaces closer to each other than 1e-12 of the scene's size are treated as touching, and then
/// as back to back or side by side. Patches are planar: a patch that is bent by rounding, and what
/// is no farther from its plane than its own corners, never blocks it.
///
/// The time grows with the number of blockers in the shaft and the logarithm of the number of
/// patches.
/// Threads: immutable once built.
class ExchangeFinder {
 public:
  /// Keeps a reference to `scene`.
  /// @param density number of points along a patch as large as its distance from the other.
  /// @throws Canceled
  explicit ExchangeFinder(const Scene& scene, const Cancellation& cancellation = {},
                          double density = 16);

  /// Past thousands of blockers, one pair takes minutes.
  /// @param tick if set, called often, on this thread; may throw to abandon the query.
  /// @param receiver basis of i, whose moments are then computed too, by points of one
  /// patch, also where nothing blocks; null: moments are not computed
  PatchExchange operator()(PatchId i, PatchId j, const std::function<void()>& tick = {},
                           const LinearBasis* receiver = nullptr) const;
  /// The area alone, m², past blockers by as many points as its error takes, as in
  /// for_each_after().
  double area_between(PatchId i, PatchId j, const std::function<void()>& tick) const;
  /// Calls visit(j, exchange, moments) for the patches j > i with which i exchanges light, in
  /// order. Faster than pair by pair: blockers are first found for all patches of a face, and no
  /// error is returned. The moments are T^ab(i,j) over all directions, T^00 being the area. The
  /// others are found by points of one patch, also where nothing blocks; of the other one
  /// exactly.
  /// @param bases of all patches; empty: T^00 alone is found
  void for_each_after(
      PatchId i, const std::vector<LinearBasis>& bases, const std::function<void()>& tick,
      const std::function<void(PatchId j, const PatchExchange&, const TransferMoments&)>& visit)
      const;
  /// Form factor from an area element at x to the visible part of patch j, exact up to rounding.
  /// Polygons in whose plane x is do not block.
  /// @param x position, m.
  /// @param normal unit, of the element.
  /// @param tick as above.
  double from_point(const Vec3& x, const Vec3& normal, PatchId j,
                    const std::function<void()>& tick = {}) const;
  /// The finder's unit of length in meters is 1 / scale().
  double scale() const { return scale_; }
  /// The polygons of some emitting patches: where all patches of a face emit alike, its outline.
  /// @param patches ascending.
  std::vector<LampPolygon> lamps(std::span<const PatchId> patches) const;
  /// The view of a lamp from points of patch i, past all that stands between some of them and the
  /// lamp; nothing where no point of the patch sees the lamp.
  std::optional<PointView> view_of(const LampPolygon& lamp, PatchId i) const;
  /// The view from one point: blockers are found for it alone.
  /// @param x in the finder's unit.
  std::optional<PointView> view_from(const Vec3& x, const LampPolygon& lamp) const;

 private:
  /// The plane of a polygon.
  struct OpenPlane {
    HalfSpace front;
    double bend;  ///< bend of its piece
  };
  /// A convex part of a patch that coplanar patches do not cover.
  struct OpenPiece : OpenPlane {
    std::uint32_t begin, end;  ///< in open_corners_
  };
  struct Blocker {
    Corners outline;
    double bend;
    std::vector<PatchId> patches;  ///< equal to MergedPiece::patches

    bool is_of(PatchId i) const { return std::binary_search(patches.begin(), patches.end(), i); }
  };
  /// The patches that two polygons belong to.
  struct Sides {
    PatchId of_p, of_q;  ///< first sides
    Bends bends;
  };
  /// Blockers, by number.
  using Numbers = std::vector<std::int32_t>;
  /// The values to be found of a pair.
  struct Query {
    bool estimate;                      ///< whether errors are estimated
    const std::function<void()>& tick;  ///< may be empty
    const LinearBasis* receiver;  ///< basis of the first patch; null: moments are not computed
  };

  double bend_beyond_rounding(double bend) const { return bend > tolerance_ ? bend : 0; }
  double bend_of(Outline corners) const;
  std::vector<Blocker> blockers_of(const Scene& scene) const;
  static std::vector<Bounds> boxes_of(const std::vector<Blocker>& blockers);
  std::vector<Corners> open_pieces(const Piece& piece, const std::vector<Piece>& pieces,
                                   const BoxTree& tree) const;
  bool covers(PatchId upper, PatchId lower) const;
  bool is_open(PatchId j) const;
  Corners corners_of(const Piece& piece) const;
  Outline corners_of(const OpenPiece& open) const {
    return {open_corners_.data() + open.begin, open_corners_.data() + open.end};
  }
  void collect_blockers(const FacingPolygons& facing, const Sides& sides, const Numbers* among,
                        Numbers& blockers) const;
  bool is_any_hiding(const FacingPolygons& facing, const Numbers& blockers) const;
  bool is_hidden(const FacingPolygons& facing, const Corners& blocker) const;
  void add_partial(const FacingPolygons& facing, const Numbers& blockers, const Query& query,
                   PatchExchange& exchange) const;
  void add_whole(const FacingPolygons& facing, const Query& query, PatchExchange& exchange) const;
  void collect_blockers(const Vec3& x, Outline polygon, const OpenPlane& open, PatchId patch,
                        Numbers& blockers) const;
  TransferMoments moments_between(PatchId i, PatchId j, const std::vector<LinearBasis>& bases,
                                  const Numbers* among, const std::function<void()>& tick) const;
  void add_moments(const FacingPolygons& facing, const Numbers& blockers, const LinearBasis& of_p,
                   const LinearBasis& of_q, const std::function<void()>& tick,
                   TransferMoments& sum) const;
  class PointQuadrature;
  double seen_by_enough(PointQuadrature& by_points, RefinedCells& refined, const Corners& cell,
                        int divisions, const PointSums& sums, double exact, double smaller) const;
  template <class Visit>
  void for_each_cell(const SampledPolygon& sampled, const std::vector<Corners>& blockers,
                     Visit visit) const;
  std::vector<Corners> polygons_of(const Numbers& blockers) const;
  template <class Visit>
  void for_each_range_after(PatchId i, Visit visit) const;
  int divisions_of(double size) const;
  /// Calls visit(facing, blockers) for the parts of i and j that face each other.
  template <class Visit>
  void for_each_facing(PatchId i, PatchId j, const Numbers* among, Visit visit) const;
  PatchExchange between(PatchId i, PatchId j, const Numbers* among, const Query& query) const;
  std::span<const OpenPiece> open_pieces_of(PatchId i) const {
    const auto k = static_cast<std::size_t>(i);
    return {open_pieces_.data() + open_begin_[k], open_begin_[k + 1] - open_begin_[k]};
  }

  const Scene& scene_;
  double density_;
  int moment_divisions_;  ///< at least, of a cell
  double scale_;          ///< from meters to the finder's unit of length, a power of two
  double tolerance_;      ///< in that unit
  std::vector<PatchId> first_sides_;
  std::vector<Blocker> blockers_;
  BoxTree tree_;                    ///< tree of blockers_
  std::vector<Vec3> open_corners_;  ///< with room in each piece, as Corners, it would be 56 MB more
                                    ///< for 100,000 patches
  std::vector<OpenPiece> open_pieces_;
  std::vector<std::size_t> open_begin_;
  std::vector<MergedFace> faces_;  ///< faces of consecutive patches
};

}  // namespace transillum
