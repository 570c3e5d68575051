// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The local visibility map of section 3.2. All fragments come in BSP order, those nearest to the
// light first. V holds what would be seen from below the fragments done so far. Fragment i cuts
// from V what lies above it (inside list I), which is what it sees, and takes its place:
//
//       light                      V before      step i          V after
//         |  omega ^                _____      ___|I|___         _  ___  _
//         v        |                             i
//
// The paper leaves a hole in V below a front-facing i, because nothing shines down from there. We
// put i in, marked: so one pass tells for omega and for -omega who looks at whom, and V covers
// the whole scene, which makes closure (method, oracle 1) a fact to check.
#include <algorithm>
#include <memory>
#include <utility>

#include "invariant.h"
#include "transillum/visibility_map.h"
#include "visibility/engines.h"
#include "visibility/map_polygon.h"
#include "visibility/plane_index.h"

namespace transillum {
namespace {

/// Keeps no history.
struct NoRecorder {
  static constexpr bool records = false;
};

/// Writes the table of one direction.
struct Recorder {
  static constexpr bool records = true;
  MapRecord& record;
};

template <class RecorderType>
class LocalMap {
 public:
  LocalMap(const Scene& scene, const BspTree& tree, const Vec3& omega,
           const Cancellation& cancellation, RecorderType recorder)
      : scene_(scene),
        tree_(tree),
        cancellation_(cancellation),
        recorder_(recorder),
        projection_(scene, tree, omega),
        clipper_(projection_),
        index_(whole_plane(), tree.fragments().size()) {
    const auto patches = static_cast<std::size_t>(scene.patch_count());
    transfers_.direction = omega;
    transfers_.forward.resize(patches);
    transfers_.backward.resize(patches);
    transfers_.back_seen.resize(patches);
  }

  Transfers run() {
    const std::vector<FragmentId> order = tree_.order(transfers_.direction);
    begin_record(order);
    for (step_ = 0; step_ < static_cast<std::int32_t>(order.size()); ++step_) {
      if (step_ % 64 == 0) cancellation_.throw_if_cancelled();
      process(tree_.fragment(order[static_cast<std::size_t>(step_)]));
    }
    merge_exchanges();
    return std::move(transfers_);
  }

 private:
  /// A polygon of V.
  struct MapFragment {
    MapPolygon outline;
    PatchId patch = no_patch;
    bool front_facing = false;
    std::int32_t row = MapRecord::no_row;
  };

  /// Whether the outline turns left everywhere: a polygon seen within rounding of edge-on may
  /// not, and takes no part.
  static bool is_convex(const MapPolygon& outline) {
    const std::size_t count = outline.size();
    for (std::size_t k = 0; k < count; ++k) {
      const PlanePoint& a = outline[k].at;
      const PlanePoint& b = outline[(k + 1) % count].at;
      const PlanePoint& c = outline[(k + 2) % count].at;
      const Real turn = cross(b - a, c - b);
      // Collinear corners may turn either way by rounding.
      const Real size = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y) +
                        (c.x - b.x) * (c.x - b.x) + (c.y - b.y) * (c.y - b.y);
      if (turn < -1e-14L * size) return false;
    }
    return true;
  }

  PlaneBox whole_plane() const {
    PlaneBox all{0, 0, 0, 0};
    for (const PlanePoint& p : projection_.points) {
      all.x0 = std::min(all.x0, static_cast<double>(p.x));
      all.y0 = std::min(all.y0, static_cast<double>(p.y));
      all.x1 = std::max(all.x1, static_cast<double>(p.x));
      all.y1 = std::max(all.y1, static_cast<double>(p.y));
    }
    return all;
  }

  void project(const BspTree::Fragment& fragment) {
    const auto corners = tree_.corners(fragment);
    window_.clear();
    for (const BspTree::Corner& corner : corners) {
      window_.push_back({projection_.points[static_cast<std::size_t>(corner.point)], corner.line,
                         corner.forward});
    }
  }

  /// Turns a clockwise outline round: the edge that left a corner now arrives there.
  void reverse_window() {
    const std::size_t count = window_.size();
    reversed_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const MapCorner& corner = window_[count - 1 - k];
      const MapCorner& before = window_[(2 * count - 2 - k) % count];
      reversed_[k] = {corner.at, before.line, !before.forward};
    }
    window_.swap(reversed_);
  }

  void process(const BspTree::Fragment& fragment) {
    project(fragment);
    Real area = area_of(window_);
    const bool front_facing = area > 0;
    if (!front_facing) {
      reverse_window();
      area = -area;
    }
    if (!(area > 0) || !is_convex(window_)) return;  // edge-on
    auto& side = front_facing ? transfers_.forward : transfers_.backward;
    side[static_cast<std::size_t>(fragment.patch)].projected += static_cast<double>(area);

    // Cut out of V what lies above, piece by piece.
    const PlaneBox box = box_of(window_);
    found_.clear();
    index_.query(box, found_);
    for (const std::int32_t above : found_) {
      if (!clipper_.clip(fragments_[static_cast<std::size_t>(above)].outline, window_)) continue;
      see(fragment.patch, front_facing, fragments_[static_cast<std::size_t>(above)],
          static_cast<double>(clipper_.inside_area()));
      replace_by_outside(above);
    }

    const std::int32_t row =
        add_row(window_, fragment.patch, front_facing, MapRecord::no_row, MapRecord::never);
    add(window_, fragment.patch, front_facing, row, box);
  }

  /// Books `area` between the polygon at hand and one of V right above it.
  void see(PatchId below, bool below_front_facing, const MapFragment& above, double area) {
    const auto i = static_cast<std::size_t>(below);
    const auto j = static_cast<std::size_t>(above.patch);
    if (below_front_facing) {
      transfers_.forward[i].covered += area;
      if (above.front_facing) {
        transfers_.back_seen[j] += area;
      } else {
        transfers_.backward[j].covered += area;
        transfers_.exchanges.push_back({below, above.patch, area});
      }
    } else if (!above.front_facing) {
      transfers_.backward[j].covered += area;
      transfers_.back_seen[i] += area;
    }
  }

  /// Takes polygon `above` out of V and puts in the parts that clipper_ found outside.
  void replace_by_outside(std::int32_t above) {
    MapFragment& cut = fragments_[static_cast<std::size_t>(above)];
    const PatchId patch = cut.patch;
    const bool front_facing = cut.front_facing;
    const std::int32_t row = cut.row;
    index_.erase(above);
    free_.push_back(above);
    if constexpr (RecorderType::records) {
      recorder_.record.rows[static_cast<std::size_t>(row)].consumed = step_;
      add_row(clipper_.inside(), patch, front_facing, row, step_);
    }
    for (std::size_t k = 0; k < clipper_.outside_count(); ++k) {
      const MapPolygon& outside = clipper_.outside(k);
      if (!(area_of(outside) > 0)) continue;
      const std::int32_t part = add_row(outside, patch, front_facing, row, MapRecord::never);
      add(outside, patch, front_facing, part, box_of(outside));
    }
  }

  void add(const MapPolygon& outline, PatchId patch, bool front_facing, std::int32_t row,
           const PlaneBox& box) {
    std::int32_t id = static_cast<std::int32_t>(fragments_.size());
    if (free_.empty()) {
      fragments_.emplace_back();
    } else {
      id = free_.back();
      free_.pop_back();
    }
    MapFragment& fragment = fragments_[static_cast<std::size_t>(id)];
    fragment.outline.assign(outline.begin(), outline.end());
    fragment.patch = patch;
    fragment.front_facing = front_facing;
    fragment.row = row;
    index_.insert(id, box);
  }

  /// One entry a pair, by receiver and source; parts summed in the order they were found.
  void merge_exchanges() {
    auto& all = transfers_.exchanges;
    std::stable_sort(all.begin(), all.end(), [](const Transfer& a, const Transfer& b) {
      return std::pair(a.receiver, a.source) < std::pair(b.receiver, b.source);
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (kept > 0 && all[kept - 1].receiver == all[k].receiver &&
          all[kept - 1].source == all[k].source) {
        all[kept - 1].area += all[k].area;
      } else {
        all[kept++] = all[k];
      }
    }
    all.resize(kept);
  }

  void begin_record(const std::vector<FragmentId>& order) {
    if constexpr (RecorderType::records) {
      MapRecord& record = recorder_.record;
      record.frame = projection_.frame;
      record.order = order;
      for (const FragmentId f : order) record.step_patch.push_back(tree_.fragment(f).patch);
    }
  }

  std::int32_t add_row(const MapPolygon& outline, PatchId patch, bool front_facing,
                       std::int32_t parent, std::int32_t consumed) {
    if constexpr (RecorderType::records) {
      MapRecord& record = recorder_.record;
      MapRecord::Row row{patch,  step_,        consumed,
                         parent, front_facing, static_cast<std::uint32_t>(record.corners.size()),
                         0};
      for (const MapCorner& corner : outline) {
        record.corners.push_back(
            {static_cast<double>(corner.at.x), static_cast<double>(corner.at.y)});
      }
      row.end = static_cast<std::uint32_t>(record.corners.size());
      record.rows.push_back(row);
      return static_cast<std::int32_t>(record.rows.size()) - 1;
    } else {
      return MapRecord::no_row;
    }
  }

  const Scene& scene_;
  const BspTree& tree_;
  const Cancellation& cancellation_;
  RecorderType recorder_;
  Projection projection_;
  MapClipper clipper_;
  PlaneIndex index_;
  Transfers transfers_;
  std::int32_t step_ = 0;
  MapPolygon window_, reversed_;  ///< the polygon at hand
  std::vector<MapFragment> fragments_;
  std::vector<std::int32_t> free_;  ///< unused places in fragments_
  std::vector<std::int32_t> found_;
};

}  // namespace

TransferEngine local_map_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree) {
  return [scene = std::move(scene), tree = std::move(tree)](const Vec3& omega,
                                                            const Cancellation& cancellation) {
    return LocalMap<NoRecorder>(*scene, *tree, omega, cancellation, {}).run();
  };
}

RecordedDirection record_local_map(const Scene& scene, const BspTree& tree, const Vec3& omega,
                                   const Cancellation& cancellation) {
  RecordedDirection result;
  result.transfers = LocalMap<Recorder>(scene, tree, omega, cancellation, {result.record}).run();
  return result;
}

}  // namespace transillum
