// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The future work of section 8: "avoid the majority of the cuttings of the patches. Instead of
// cutting, the radiosity of the patch can be corrected". A face that is partly hidden stays whole;
// of it is only known how much is still open, as if that were spread evenly. What two faces
// exchange is their overlap, corrected by what is open of them. Where this leaves a receiver with
// less than must lie above it, all that lies there gives more: what is received stays right.
#include <algorithm>
#include <memory>
#include <utility>

#include "visibility/convex_overlap.h"
#include "visibility/engines.h"
#include "visibility/fast_bins.h"
#include "visibility/fast_faces.h"
#include "visibility/transfer_sums.h"

namespace transillum {
namespace {

/// A face of which less is open counts as hidden.
constexpr double hidden = 1e-6;

/// What all passes share.
struct CorrectedScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  FastOutlines outlines;
  bool in_air;  ///< no lit side looks at a back, whatever the direction

  CorrectedScene(std::shared_ptr<const Scene> of_scene, std::shared_ptr<const BspTree> of_tree)
      : scene(std::move(of_scene)),
        tree(std::move(of_tree)),
        outlines(*tree),
        in_air(lit_sides_see_no_backs(scene, tree)) {}
};

/// One direction.
class CorrectedPass {
 public:
  explicit CorrectedPass(const CorrectedScene& shared)
      : shared_(shared), bins_(faces_, shared.in_air), overlap_(faces_) {}

  Transfers run(const Vec3& omega, const Cancellation& cancellation) {
    faces_.project(*shared_.scene, *shared_.tree, shared_.outlines, omega, cancellation);
    bins_.fill(cancellation);
    TransferSums<double> sums(shared_.scene->patch_count());
    const double unit = faces_.grid.step * faces_.grid.step;
    open_below_.clear();
    met_by_.assign(faces_.faces.size(), -1);
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(faces_.faces.size()); ++k) {
      if (k % 64 == 0) cancellation.throw_if_cancelled();
      const FastFaces::Face& below = face(k);
      open_below_.push_back(below.area);
      sums.project(below.patch, below.front, unit * below.area);
      if (shared_.in_air && !below.front) continue;
      find_above(k);
      exchange(below);
      for (const Above& above : above_) {
        if (!(above.seen > 0)) continue;
        const FastFaces::Face& other = face(above.face);
        sums.see(below.patch, below.front, other.patch, other.front, unit * above.seen);
      }
    }
    return sums.finish(omega, cancellation);
  }

 private:
  /// A face above the one that looks.
  struct Above {
    std::int32_t face;
    double overlap;  ///< steps squared; < 0: not looked for yet
    double seen;
  };
  const FastFaces::Face& face(std::int32_t k) const {
    return faces_.faces[static_cast<std::size_t>(k)];
  }
  double& open_below(std::int32_t k) { return open_below_[static_cast<std::size_t>(k)]; }

  /// Those whose boxes overlap that of face k, nearest first.
  void find_above(std::int32_t k) {
    FaceWindow window;
    const FaceBox& box = faces_.boxes[static_cast<std::size_t>(k)];
    for (std::size_t d = 0; d < 4; ++d) {
      window.ends[d] = -box.ends[d + 4];
      window.ends[d + 4] = -box.ends[d];
    }
    above_.clear();
    for (auto own = bins_.last_entry(k); own != FastBins::none; own = bins_.entry_before(own)) {
      for (FastBins::Entry e = own - 1; bins_.face(e) >= 0; --e) {
        if (!window.overlaps(bins_.box(e))) continue;
        const std::int32_t other = bins_.face(e);
        if (std::exchange(met_by_[static_cast<std::size_t>(other)], k) == k) continue;
        above_.push_back({other, -1, 0});
      }
    }
    std::sort(above_.begin(), above_.end(),
              [](const Above& a, const Above& b) { return a.face > b.face; });
  }

  double overlap(Above& above) const {
    if (above.overlap < 0) above.overlap = overlap_.with(face(above.face));
    return above.overlap;
  }

  /// Fills in what is seen of each face above.
  void exchange(const FastFaces::Face& below) {
    overlap_.look_from(below);
    open_ = below.area;
    const double least = hidden * below.area;
    for (Above& above : above_) {
      if (open_ <= least) return;
      const double area = face(above.face).area, left = open_below(above.face);
      if (left > hidden * area)
        take(above, corrected(overlap(above), below.area, open_, area, left));
    }
    // What was not found open but must be covered: from the nearest that has room, ...
    for (Above& above : above_) {
      if (open_ <= least) return;
      const double room = std::max(open_below(above.face), 0.0);
      take(above, std::min({open_, room, overlap(above) - above.seen}));
    }
    // ... and then a little more than there is, from all.
    double rest = 0;
    for (Above& above : above_) rest += overlap(above) - above.seen;
    if (!(rest > 0) || open_ <= least) return;
    const double share = std::min(1.0, open_ / rest);
    for (Above& above : above_) take(above, share * (above.overlap - above.seen));
  }

  void take(Above& above, double seen) {
    above.seen += seen;
    open_below(above.face) -= seen;
    open_ -= seen;
  }

  /// What of an overlap is open, from what of both faces is: as much of it as of the face of which
  /// it is the larger part, but within what both leave possible.
  static double corrected(double overlap, double area, double open, double other_area,
                          double other_open) {
    const double share = area < other_area ? open / area : other_open / other_area;
    const double least =
        std::max({0.0, overlap - (area - open), overlap - (other_area - other_open)});
    return std::min({std::max(overlap * share, least), overlap, open, other_open});
  }

  const CorrectedScene& shared_;
  FastFaces faces_;
  FastBins bins_;
  ConvexOverlap overlap_;
  std::vector<double> open_below_;    ///< a face: of its area what looks down unhindered
  std::vector<std::int32_t> met_by_;  ///< a face: the last one that found it
  std::vector<Above> above_;
  double open_ = 0;  ///< of the face that looks
};

}  // namespace

TransferEngine corrected_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree) {
  auto shared = std::make_shared<const CorrectedScene>(std::move(scene), std::move(tree));
  return [shared = std::move(shared)](const Vec3& omega, const Cancellation& cancellation) {
    return CorrectedPass(*shared).run(omega, cancellation);
  };
}

}  // namespace transillum
