// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The statistical engine: parallel lines through the scene, traced by Embree with all their hits.
// Every line stands for an area of the plane; on it, neighbours that face each other exchange that
// area. Embree says which patches a line meets; at which height it meets them is computed anew in
// double precision, because float32 cannot tell close surfaces apart
// (decisions/0010-rays-are-counted.md).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "bit_mixing.h"
#include "transillum/errors.h"
#include "transillum/visibility_map.h"
#include "visibility/embree_scene.h"
#include "visibility/engines.h"

namespace transillum {
namespace {

constexpr std::size_t packet_size = 16;
/// Patches seen at less than this cosine are edge-on to float32.
constexpr double least_cosine = 1e-7;
/// Hits nearer to each other than this share of the scene's radius may be one seam hit twice.
constexpr double seam = 1e-5;

std::uint64_t bits_of(double x) {
  x += 0.0;  // -0 and 0 are one direction
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

std::uint64_t key_of(const Vec3& omega, std::uint64_t seed) {
  std::uint64_t key = mixed(seed + 1);
  for (const double x : {omega.x, omega.y, omega.z}) key = mixed(key ^ bits_of(x));
  return key;
}

/// Where the lines of one direction meet the plane: over the box of the scene's projection.
class LineGrid {
 public:
  struct Packet {
    std::array<double, packet_size> x, y;
    alignas(64) std::array<int, packet_size> valid;
  };

  LineGrid(const Vec2& low, const Vec2& high, double lines, bool gridded, std::uint64_t key)
      : low_(low), size_{high.x - low.x, high.y - low.y}, gridded_(gridded), key_(key) {
    lines = std::ceil(lines);
    if (!(size_.x > 0) || !(size_.y > 0)) return;  // nothing but edges
    const double cell = std::sqrt(size_.x * size_.y / lines);
    const double rows = gridded ? std::clamp(std::round(size_.y / cell), 1.0, lines) : 1.0;
    rows_ = static_cast<std::int64_t>(rows);
    columns_ = static_cast<std::int64_t>(std::ceil(lines / rows));
    tile_columns_ = gridded ? (columns_ + 3) / 4 : (columns_ + 15) / 16;
    packets_ = tile_columns_ * (gridded ? (rows_ + 3) / 4 : 1);
  }

  std::int64_t packets() const { return packets_; }
  /// What one line stands for, m².
  double area_of_line() const {
    return size_.x * size_.y / (static_cast<double>(rows_) * static_cast<double>(columns_));
  }

  /// On the grid a packet is a tile of 4 x 4 cells.
  void place(std::int64_t packet, Packet& lines) const {
    const std::int64_t row = packet / tile_columns_, column = packet % tile_columns_;
    for (std::size_t k = 0; k < packet_size; ++k) {
      const auto lane = static_cast<std::int64_t>(k);
      const std::int64_t i = gridded_ ? 4 * column + lane % 4 : 16 * column + lane;
      const std::int64_t j = gridded_ ? 4 * row + lane / 4 : 0;
      lines.valid[k] = i < columns_ && j < rows_ ? -1 : 0;
      const std::uint64_t number = static_cast<std::uint64_t>(j * columns_ + i);
      const std::uint64_t random = mixed(key_ + number * golden_step);
      const double u = (static_cast<double>(random >> 32) + 0.5) * 0x1p-32;
      const double v = (static_cast<double>(random & 0xffffffffU) + 0.5) * 0x1p-32;
      lines.x[k] = low_.x + size_.x * (gridded_ ? (static_cast<double>(i) + u) / columns() : u);
      lines.y[k] = low_.y + size_.y * (gridded_ ? (static_cast<double>(j) + v) / rows() : v);
    }
  }

 private:
  double columns() const { return static_cast<double>(columns_); }
  double rows() const { return static_cast<double>(rows_); }

  Vec2 low_, size_;
  bool gridded_;
  std::uint64_t key_;
  std::int64_t rows_ = 1, columns_ = 1, tile_columns_ = 1, packets_ = 0;
};

/// What Embree finds on the lines of a packet.
struct Meetings {
  const EmbreeScene& embree;
  std::array<std::vector<PatchId>, packet_size> patches;

  static void collect(const RTCFilterFunctionNArguments* hits) {
    auto& all = *static_cast<Meetings*>(EmbreeScene::data_of(hits));
    for (unsigned k = 0; k < hits->N; ++k) {
      if (!hits->valid[k]) continue;
      hits->valid[k] = 0;
      all.patches[RTCRayN_id(hits->ray, hits->N, k)].push_back(
          all.embree.patch_of(RTCHitN_primID(hits->hit, hits->N, k)));
    }
  }
};

/// One direction's lines.
class RayPass {
 public:
  RayPass(const Scene& scene, const EmbreeScene& embree, const EngineOptions& options,
          const Vec3& omega, const Cancellation& cancellation)
      : scene_(scene),
        embree_(embree),
        cancellation_(cancellation),
        gridded_(options.gridded),
        frame_(plane_frame(scene, omega)),
        grid_(make_grid(options)),
        meetings_{embree, {}} {
    const auto patches = static_cast<std::size_t>(scene.patch_count());
    transfers_.direction = omega;
    transfers_.forward.resize(patches);
    transfers_.backward.resize(patches);
    transfers_.back_seen.resize(patches);
    measure_planes();
    aim();
  }

  Transfers run() {
    for (std::int64_t packet = 0; packet < grid_.packets(); ++packet) {
      if (packet % 256 == 0) cancellation_.throw_if_cancelled();
      grid_.place(packet, lines_);
      trace();
      for (std::size_t k = 0; k < packet_size; ++k) book_line(k);
      if (transfers_.exchanges.size() >= merge_at_) merge_exchanges();
    }
    merge_exchanges();
    turn_counts_into_areas();
    return std::move(transfers_);
  }

 private:
  /// The height of a patch's plane above the point x, y of the plane, along omega, metres.
  struct PatchPlane {
    double cosine = 0;  ///< n·omega; 0: edge-on, takes no part
    double at_origin = 0, along_x = 0, along_y = 0;
    double slack = 0;  ///< what rounding may do to a height

    double height(double x, double y) const { return at_origin + along_x * x + along_y * y; }
  };
  struct Hit {
    PatchId patch;
    double height;
  };

  LineGrid make_grid(const EngineOptions& options) const {
    Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      for (const PointId p : scene_.outline(i)) {
        const Vec2 at = frame_.project(scene_.point(p));
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
      }
    }
    return {low, high, options.lines_per_patch * scene_.patch_count(), options.gridded,
            key_of(frame_.omega, options.seed)};
  }

  void measure_planes() {
    const double thickness = BspTree::thickness(scene_);
    planes_.resize(static_cast<std::size_t>(scene_.patch_count()));
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const Patch& patch = scene_.patch(i);
      const double cosine = dot(patch.normal, frame_.omega);
      if (std::abs(cosine) < least_cosine) continue;
      planes_[static_cast<std::size_t>(i)] = {
          cosine, dot(patch.normal, patch.center - frame_.origin) / cosine,
          -dot(patch.normal, frame_.u) / cosine, -dot(patch.normal, frame_.v) / cosine,
          thickness / std::abs(cosine)};
    }
  }

  /// All rays go down, against omega, from above the ball that holds the scene.
  void aim() {
    for (std::size_t k = 0; k < packet_size; ++k) {
      rays_.dir_x[k] = static_cast<float>(-frame_.omega.x);
      rays_.dir_y[k] = static_cast<float>(-frame_.omega.y);
      rays_.dir_z[k] = static_cast<float>(-frame_.omega.z);
      rays_.mask[k] = ~0U;
      rays_.id[k] = static_cast<unsigned>(k);
    }
  }

  void trace() {
    for (std::size_t k = 0; k < packet_size; ++k) {
      const Vec3 start =
          embree_.scale() * (lines_.x[k] * frame_.u + lines_.y[k] * frame_.v) + 1.25 * frame_.omega;
      rays_.org_x[k] = static_cast<float>(start.x);
      rays_.org_y[k] = static_cast<float>(start.y);
      rays_.org_z[k] = static_cast<float>(start.z);
      rays_.tnear[k] = 0;
      rays_.tfar[k] = HUGE_VALF;
      meetings_.patches[k].clear();
    }
    embree_.all_hits(lines_.valid.data(), rays_, gridded_, Meetings::collect, &meetings_);
  }

  const PatchPlane& plane(PatchId i) const { return planes_[static_cast<std::size_t>(i)]; }
  bool front_facing(PatchId i) const { return plane(i).cosine > 0; }

  /// Whether a comes before b among coincident patches, as in BspTree::order(): what receives
  /// before what emits, coverers first above and last below.
  bool comes_first(PatchId a, PatchId b) const {
    if (front_facing(a) != front_facing(b)) return front_facing(a);
    const auto rank = [this](PatchId i) {
      return std::tuple(-max_abs(scene_.exitance(i)), scene_.patch(i).area, -i);
    };
    return front_facing(a) ? rank(a) < rank(b) : rank(b) < rank(a);
  }

  bool above(const Hit& a, const Hit& b) const {
    const bool coincident =
        std::abs(a.height - b.height) <= plane(a.patch).slack + plane(b.patch).slack;
    return coincident ? comes_first(a.patch, b.patch) : a.height > b.height;
  }

  /// The hits of line k from above, each patch once.
  void sort_hits(std::size_t k) {
    hits_.clear();
    for (const PatchId i : meetings_.patches[k]) {
      if (plane(i).cosine != 0) hits_.push_back({i, plane(i).height(lines_.x[k], lines_.y[k])});
    }
    std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) {
      return std::pair(-a.height, a.patch) < std::pair(-b.height, b.patch);
    });
    // A line may meet two triangles of a patch at the edge between them.
    hits_.erase(std::unique(hits_.begin(), hits_.end(),
                            [](const Hit& a, const Hit& b) { return a.patch == b.patch; }),
                hits_.end());
    // "Coincident" is not transitive, so this is no order for std::sort; little is left to move.
    for (std::size_t a = 1; a < hits_.size(); ++a) {
      for (std::size_t b = a; b > 0 && above(hits_[b], hits_[b - 1]); --b) {
        std::swap(hits_[b], hits_[b - 1]);
      }
    }
  }

  /// Whether the projection of patch i holds the point. Both patches at an edge compute the same
  /// numbers, so one of two neighbours has it.
  bool contains(PatchId i, double x, double y) const {
    bool inside = false;
    const auto outline = scene_.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const auto [p, q] = std::minmax(outline[k], outline[(k + 1) % outline.size()]);
      const Vec2 a = frame_.project(scene_.point(p)), b = frame_.project(scene_.point(q));
      if ((a.y > y) == (b.y > y)) continue;
      if (x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
  }

  /// A line through the seam of two patches may meet both in float32, but only one in truth, or
  /// at a silhouette none.
  void drop_false_hits(double x, double y) {
    std::size_t kept = 0;
    for (const Hit& hit : hits_) {
      const double near = seam / embree_.scale();
      if (kept == 0 || hits_[kept - 1].height - hit.height > near) {
        hits_[kept++] = hit;
        continue;
      }
      const Hit above = hits_[kept - 1];
      const bool upper = contains(above.patch, x, y), lower = contains(hit.patch, x, y);
      const bool alike = front_facing(above.patch) == front_facing(hit.patch);
      if (!upper && !(alike && !lower)) --kept;
      if (lower) hits_[kept++] = hit;
    }
    hits_.resize(kept);
  }

  void book_line(std::size_t k) {
    if (meetings_.patches[k].empty()) return;
    sort_hits(k);
    drop_false_hits(lines_.x[k], lines_.y[k]);
    for (std::size_t n = 0; n < hits_.size(); ++n) {
      const PatchId i = hits_[n].patch;
      side(i).projected += 1;
      if (n > 0) see(i, hits_[n - 1].patch);
    }
  }

  Coverage& side(PatchId i) {
    return (front_facing(i) ? transfers_.forward
                            : transfers_.backward)[static_cast<std::size_t>(i)];
  }

  /// Books one line between patch `below` and the patch right above it.
  void see(PatchId below, PatchId above) {
    if (front_facing(below)) side(below).covered += 1;
    if (!front_facing(above)) side(above).covered += 1;
    if (front_facing(below) && !front_facing(above)) {
      transfers_.exchanges.push_back({below, above, 1});
    } else if (front_facing(below)) {
      transfers_.back_seen[static_cast<std::size_t>(above)] += 1;
    } else if (!front_facing(above)) {
      transfers_.back_seen[static_cast<std::size_t>(below)] += 1;
    }
  }

  /// One entry a pair, by receiver and source. Whole numbers: their order does not matter.
  void merge_exchanges() {
    auto& all = transfers_.exchanges;
    std::sort(all.begin(), all.end(), [](const Transfer& a, const Transfer& b) {
      return std::pair(a.receiver, a.source) < std::pair(b.receiver, b.source);
    });
    std::size_t kept = 0;
    for (const Transfer& t : all) {
      if (kept > 0 && all[kept - 1].receiver == t.receiver && all[kept - 1].source == t.source) {
        all[kept - 1].area += t.area;
      } else {
        all[kept++] = t;
      }
    }
    all.resize(kept);
    merge_at_ = std::max(merge_at_, 2 * kept);
  }

  void turn_counts_into_areas() {
    const double area = grid_.area_of_line();
    for (Transfer& t : transfers_.exchanges) t.area *= area;
    for (auto* sides : {&transfers_.forward, &transfers_.backward}) {
      for (Coverage& c : *sides) c = {c.projected * area, c.covered * area};
    }
    for (double& seen : transfers_.back_seen) seen *= area;
  }

  const Scene& scene_;
  const EmbreeScene& embree_;
  const Cancellation& cancellation_;
  bool gridded_;
  PlaneFrame frame_;
  LineGrid grid_;
  std::vector<PatchPlane> planes_;
  Transfers transfers_;  ///< numbers of lines until the end
  std::size_t merge_at_ = 1 << 20;

  // The packet at hand.
  LineGrid::Packet lines_;
  RTCRay16 rays_{};
  Meetings meetings_;
  std::vector<Hit> hits_;  ///< of one line
};

}  // namespace

TransferEngine ray_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options) {
  if (!(options.lines_per_patch > 0 && options.lines_per_patch <= 1e6)) {
    throw InputError("lines: the number of lines a patch must be larger than 0 and at most 1e6");
  }
  auto embree = std::make_shared<const EmbreeScene>(*scene);
  return [scene = std::move(scene), embree = std::move(embree), options](
             const Vec3& omega, const Cancellation& cancellation) {
    return RayPass(*scene, *embree, options, omega, cancellation).run();
  };
}

}  // namespace transillum
