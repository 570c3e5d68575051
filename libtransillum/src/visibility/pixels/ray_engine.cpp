// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Engine rays: parallel lines through the scene, intersected by Embree with all hits reported. Each
// line represents an area of the plane; successive patches on it that face each other exchange that
// area. Embree finds which patches a line meets; the heights at which it meets them are recomputed
// in double precision, because float32 does not separate close surfaces
// (decisions/0010-rays-are-counted.md).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/bit_mixing.h"
#include "transillum/errors.h"
#include "transillum/visibility_map.h"
#include "visibility/embree/embree_scene.h"
#include "visibility/pixels/counted_transfers.h"
#include "visibility/pixels/discrete_engines.h"
#include "visibility/pixels/pixel_engines.h"
#include "visibility/pixels/pixel_grid.h"

namespace transillum {
namespace {

constexpr std::size_t packet_size = 16;
/// Hits nearer to each other than this fraction of the scene's radius may be one common edge hit
/// twice.
constexpr double edge_distance = 1e-5;

std::uint64_t bits_of(double x) {
  x += 0.0;  // -0 and 0 are the same direction
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

std::uint64_t key_of(const Vec3& omega, std::uint64_t seed) {
  std::uint64_t key = mixed(seed + 1);
  for (const double x : {omega.x, omega.y, omega.z}) {
    key = mixed(key ^ bits_of(x));
  }
  return key;
}

/// The points at which the lines of one direction cross the plane: in the bounding box of the
/// projected scene; jittered on a grid, or random.
class LineGrid {
 public:
  struct Packet {
    std::array<double, packet_size> x, y;
    std::array<int, packet_size> row, column;
    alignas(64) std::array<int, packet_size> valid;
  };

  LineGrid(const PlaneWindow& window, double lines, bool gridded, std::uint64_t key)
      : low_(window.low), size_(window.size()), gridded_(gridded), key_(key) {
    lines = std::ceil(lines);
    if (!(size_.x > 0) || !(size_.y > 0)) {
      return;  // all patches are edge-on
    }
    const double cell = std::sqrt(size_.x * size_.y / lines);
    const double rows = gridded ? std::clamp(std::round(size_.y / cell), 1.0, lines) : 1.0;
    rows_ = static_cast<std::int64_t>(rows);
    columns_ = static_cast<std::int64_t>(std::ceil(lines / rows));
    count_packets();
  }
  /// One line per pixel.
  LineGrid(const PixelGrid& pixels, bool gridded, std::uint64_t key)
      : low_(pixels.corner()),
        size_{pixels.columns() * pixels.side(), pixels.rows() * pixels.side()},
        gridded_(gridded),
        key_(key),
        rows_(gridded ? pixels.rows() : 1),
        columns_(std::int64_t{pixels.columns()} * (gridded ? 1 : pixels.rows())) {
    count_packets();
  }

  std::int64_t packets() const { return packets_; }
  bool gridded() const { return gridded_; }
  /// Area that one line represents, m².
  double area_of_line() const { return size_.x * size_.y / (rows() * columns()); }

  /// Sets the lines of a packet. On the grid a packet is a tile of 4 x 4 cells.
  void place_lines(std::int64_t packet, Packet& lines) const {
    const std::int64_t row = packet / tile_columns_, column = packet % tile_columns_;
    for (std::size_t k = 0; k < packet_size; ++k) {
      const auto lane = static_cast<std::int64_t>(k);
      const std::int64_t i = gridded_ ? 4 * column + lane % 4 : 16 * column + lane;
      const std::int64_t j = gridded_ ? 4 * row + lane / 4 : 0;
      lines.valid[k] = i < columns_ && j < rows_ ? -1 : 0;
      lines.row[k] = static_cast<int>(j);
      lines.column[k] = static_cast<int>(i);
      const std::uint64_t number = static_cast<std::uint64_t>(j * columns_ + i);
      const std::uint64_t random = mixed(key_ + number * golden_step);
      const double u = fraction(random >> 32), v = fraction(random & 0xffffffffU);
      lines.x[k] = low_.x + size_.x * (gridded_ ? (static_cast<double>(i) + u) / columns() : u);
      lines.y[k] = low_.y + size_.y * (gridded_ ? (static_cast<double>(j) + v) / rows() : v);
    }
  }

 private:
  void count_packets() {
    tile_columns_ = gridded_ ? (columns_ + 3) / 4 : (columns_ + 15) / 16;
    packets_ = tile_columns_ * (gridded_ ? (rows_ + 3) / 4 : 1);
  }
  /// A 32-bit number as a fraction in (0, 1).
  static double fraction(std::uint64_t bits) { return (static_cast<double>(bits) + 0.5) * 0x1p-32; }
  double columns() const { return static_cast<double>(columns_); }
  double rows() const { return static_cast<double>(rows_); }

  Vec2 low_, size_;
  bool gridded_;
  std::uint64_t key_;
  std::int64_t rows_ = 1, columns_ = 1, tile_columns_ = 1, packets_ = 0;
};

/// The patches that Embree finds on each line of a packet.
struct PacketHits {
  const EmbreeScene& embree;
  std::array<std::vector<PatchId>, packet_size> patches;

  static void collect(const RTCFilterFunctionNArguments* hits) {
    auto& all = *static_cast<PacketHits*>(EmbreeScene::data_of(hits));
    for (unsigned k = 0; k < hits->N; ++k) {
      if (!hits->valid[k]) {
        continue;
      }
      hits->valid[k] = 0;
      all.patches[RTCRayN_id(hits->ray, hits->N, k)].push_back(
          all.embree.patch_of(RTCHitN_primID(hits->hit, hits->N, k)));
    }
  }
};

/// A scene along one direction.
struct RayScene {
  const Scene& scene;
  const EmbreeScene& embree;
  const PlaneFrame& frame;
  const PatchHeights& heights;
  const ProcessedFragments* processed = nullptr;  ///< all there is; null: the whole scene
};

/// All lines of one direction.
class RayPass {
 public:
  RayPass(const RayScene& view, const LineGrid& grid, VisibilitySink& sink,
          const Cancellation& cancellation)
      : scene_(view.scene),
        embree_(view.embree),
        cancellation_(cancellation),
        frame_(view.frame),
        grid_(grid),
        heights_(view.heights),
        processed_(view.processed),
        sink_(sink),
        packet_hits_{view.embree, {}} {
    set_directions();
  }

  void run() {
    for (std::int64_t packet = 0; packet < grid_.packets(); ++packet) {
      if (packet % 256 == 0) {
        cancellation_.throw_if_canceled();
      }
      grid_.place_lines(packet, lines_);
      trace();
      for (std::size_t k = 0; k < packet_size; ++k) {
        // Where the processor lacks AVX-512, Embree also reports hits of invalid lanes.
        if (lines_.valid[k] != 0) {
          record_line(k);
        }
      }
    }
  }

 private:
  using Hit = PatchHeights::HeightSample;

  /// All rays go along -omega, from above the ball that contains the scene.
  void set_directions() {
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
      packet_hits_.patches[k].clear();
    }
    embree_.all_hits(lines_.valid.data(), rays_, grid_.gridded(), PacketHits::collect,
                     &packet_hits_);
  }

  /// Sets hits_ to the hits of line k, sorted from above, each patch once.
  void sort_hits(std::size_t k) {
    hits_.clear();
    for (const PatchId i : packet_hits_.patches[k]) {
      if (heights_.edge_on(i)) {
        continue;
      }
      if (processed_ != nullptr && !processed_->covers(i, {lines_.x[k], lines_.y[k]})) {
        continue;
      }
      hits_.push_back({i, heights_.height(i, {lines_.x[k], lines_.y[k]})});
    }
    heights_.sort(hits_);
  }

  bool contains(PatchId i, double x, double y) const {
    return contains_point(scene_.outline(i), scene_.points(), frame_, {x, y});
  }

  /// In float32, a line near the common edge of two patches may hit both, although it meets only
  /// one, or none at a silhouette.
  void drop_false_hits(double x, double y) {
    std::size_t kept = 0;
    for (const Hit& hit : hits_) {
      const double near = edge_distance / embree_.scale();
      if (kept == 0 || hits_[kept - 1].height - hit.height > near) {
        hits_[kept++] = hit;
        continue;
      }
      const Hit above = hits_[kept - 1];
      const bool upper = contains(above.patch, x, y), lower = contains(hit.patch, x, y);
      const bool alike = heights_.front_facing(above.patch) == heights_.front_facing(hit.patch);
      if (!upper && !(alike && !lower)) {
        --kept;
      }
      if (lower) {
        hits_[kept++] = hit;
      }
    }
    hits_.resize(kept);
  }

  void record_line(std::size_t k) {
    if (packet_hits_.patches[k].empty()) {
      return;
    }
    sort_hits(k);
    drop_false_hits(lines_.x[k], lines_.y[k]);
    PatchId above = no_patch;
    for (const Hit& hit : hits_) {
      sink_.record(lines_.row[k], lines_.column[k], lines_.column[k] + 1, hit.patch, above);
      above = hit.patch;
    }
  }

  const Scene& scene_;
  const EmbreeScene& embree_;
  const Cancellation& cancellation_;
  const PlaneFrame& frame_;
  const LineGrid& grid_;
  const PatchHeights& heights_;
  const ProcessedFragments* processed_;
  VisibilitySink& sink_;

  // The current packet.
  LineGrid::Packet lines_;
  RTCRay16 rays_{};
  PacketHits packet_hits_;
  std::vector<Hit> hits_;  ///< hits of one line
};

}  // namespace

void trace_lines(std::uint64_t seed, const PixelScene& view, const ProcessedFragments* processed,
                 VisibilitySink& sink, const Cancellation& cancellation) {
  const EmbreeScene embree(view.scene, cancellation);
  const PlaneFrame& frame = view.grid.frame();
  const LineGrid lines(view.grid, true, key_of(frame.omega, seed));
  RayPass({view.scene, embree, frame, view.heights, processed}, lines, sink, cancellation).run();
}

TransferEngine ray_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options) {
  if (!(options.lines_per_patch > 0 && options.lines_per_patch <= 1e6)) {
    throw InputError(fmt::format("lines per patch: {} is not greater than 0 and at most 1e6",
                                 options.lines_per_patch));
  }
  auto embree = std::make_shared<const EmbreeScene>(*scene);
  return [scene = std::move(scene), embree = std::move(embree), options](
             const Vec3& omega, const Cancellation& cancellation) {
    const PlaneFrame frame = plane_frame(*scene, omega);
    const PatchHeights heights(*scene, frame);
    CountedTransfers counted(*scene, heights, cancellation);
    const std::uint64_t key = key_of(omega, options.seed);
    const LineGrid grid =
        options.resolution > 0
            ? LineGrid(PixelGrid(*scene, omega, options.resolution), options.gridded, key)
            : LineGrid(plane_window(*scene, frame), options.lines_per_patch * scene->patch_count(),
                       options.gridded, key);
    RayPass({*scene, *embree, frame, heights}, grid, counted, cancellation).run();
    return counted.finish(omega, grid.area_of_line());
  };
}

}  // namespace transillum
