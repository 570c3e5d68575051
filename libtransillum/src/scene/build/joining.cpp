// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Joins the triangles of a mesh to the polygons that they were made of. A region starts at the
// largest face that is left and takes neighbors of its plane as long as its boundary is one loop
// that no corner occurs twice in, kept as a linked list over the points. Then corners inside
// straight runs of edges are removed, the same from all faces that meet there.
#include "scene/build/joining.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/invariant.h"
#include "scene/build/point_table.h"
#include "scene/build/polygon_shape.h"
#include "scene/build/precision.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Largest sine of the angle between a face and the plane of its region, when rounding explains it.
constexpr double largest_sine = 0.02;
/// The same where the coordinates are exact.
constexpr double smallest_sine = 1e-6;
constexpr std::size_t steps_between_cancellation_checks = 4096;

/// A corner of the original: where in `corners` it is.
using CornerIndex = std::uint32_t;

class Joiner {
 public:
  Joiner(const SceneDescription& original, const Cancellation& cancellation)
      : original_(original), cancellation_(cancellation), tolerance_(tolerance_of(original)) {
    weld();
    find_neighbors();
  }

  JoinedFaces join() {
    region_of_.assign(original_.face_count(), no_region);
    state_.assign(points_.size(), {});
    for (const std::int32_t seed : by_area()) {
      check_canceled();
      if (at(region_of_, seed) == no_region) {
        grow(seed);
      }
    }
    straighten();
    take_crossing_apart();
    return result();
  }

 private:
  static constexpr std::int32_t no_region = -1, no_face = -1;

  struct Face {
    CornerIndex begin = 0, end = 0;  ///< in corners_
    Vec3 doubled_area;               ///< normal, twice as long as the area
    Vec3 center;                     ///< mean of the corners
    double width = 0;                ///< twice the area over the longest edge, m
    bool can_join = false;           ///< no corner occurs twice
  };
  /// What a region has of a point.
  struct PointState {
    std::int32_t region = no_region;
    PointId next = -1, previous = -1;  ///< along the boundary; -1: inside
  };
  struct Region {
    std::vector<std::int32_t> faces;
    std::vector<PointId> outline;
  };

  static double tolerance_of(const SceneDescription& original) {
    double largest = 0;
    for (const Vec3& p : original.points) {
      largest = std::max(largest, max_abs(p));
    }
    const double rounding = original.coordinate_rounding > 0 ? original.coordinate_rounding
                                                             : coordinate_rounding(original.points);
    return std::max(64 * epsilon * largest, bend_by_rounding * rounding);
  }

  void check_canceled() {
    if (++steps_ % steps_between_cancellation_checks == 0) {
      cancellation_.throw_if_canceled();
    }
  }

  void weld() {
    PointTable table;
    std::vector<PointId> welded(original_.points.size(), -1);
    for (std::size_t f = 0; f < original_.face_count(); ++f) {
      check_canceled();
      const std::vector<PointId> outline =
          welded_outline(original_.outline(f), original_.points, welded, table);
      const auto begin = static_cast<CornerIndex>(corners_.size());
      corners_.insert(corners_.end(), outline.begin(), outline.end());
      faces_.push_back({begin, static_cast<CornerIndex>(corners_.size()), {}, {}, 0, false});
    }
    points_ = table.take();
    for (Face& face : faces_) {
      measure(face);
    }
  }

  void measure(Face& face) const {
    const std::size_t n = face.end - face.begin;
    if (n < 3) {
      return;
    }
    const Vec3 origin = point(face.begin);
    double longest = 0;
    for (CornerIndex k = face.begin; k < face.end; ++k) {
      const Vec3 here = point(k), next = point(following(face, k));
      face.doubled_area = face.doubled_area + cross(here - origin, next - origin);
      face.center = face.center + (here - origin) / static_cast<double>(n);
      longest = std::max(longest, norm(next - here));
    }
    face.center = face.center + origin;
    face.width = norm(face.doubled_area) / longest;
    std::vector<PointId> sorted(corners_.begin() + face.begin, corners_.begin() + face.end);
    std::sort(sorted.begin(), sorted.end());
    face.can_join = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() &&
                    is_finite(face.doubled_area);
  }

  const Vec3& point(CornerIndex k) const { return at(points_, at(corners_, k)); }
  static CornerIndex following(const Face& face, CornerIndex k) {
    return k + 1 < face.end ? k + 1 : face.begin;
  }

  /// The face across each edge, where the edge has two faces, in opposite directions.
  void find_neighbors() {
    struct Edge {
      PointId low, high;
      bool forward;
      std::int32_t face;
      CornerIndex corner;
    };
    std::vector<Edge> edges;
    edges.reserve(corners_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face& face = faces_[f];
      for (CornerIndex k = face.begin; face.can_join && k < face.end; ++k) {
        const PointId a = at(corners_, k), b = at(corners_, following(face, k));
        edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<std::int32_t>(f), k});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
    });
    across_.assign(corners_.size(), no_face);
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      check_canceled();
      while (end < edges.size() && edges[end].low == edges[begin].low &&
             edges[end].high == edges[begin].high) {
        ++end;
      }
      const Edge &a = edges[begin], &b = edges[end - 1];
      if (end - begin == 2 && a.forward != b.forward && a.face != b.face &&
          are_alike(a.face, b.face)) {
        across_[a.corner] = b.face;
        across_[b.corner] = a.face;
      }
    }
  }

  bool are_alike(std::int32_t a, std::int32_t b) const {
    const auto f = static_cast<std::size_t>(a), g = static_cast<std::size_t>(b);
    return original_.face_material[f] == original_.face_material[g] &&
           original_.group_of(f) == original_.group_of(g) &&
           original_.is_two_sided(f) == original_.is_two_sided(g);
  }

  /// The largest first: its normal is the most precise.
  std::vector<std::int32_t> by_area() const {
    std::vector<double> area(faces_.size());
    std::transform(faces_.begin(), faces_.end(), area.begin(),
                   [](const Face& face) { return dot(face.doubled_area, face.doubled_area); });
    std::vector<std::int32_t> order(faces_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return at(area, a) > at(area, b) || (at(area, a) == at(area, b) && a < b);
    });
    return order;
  }

  void grow(std::int32_t seed) {
    const auto number = static_cast<std::int32_t>(regions_.size());
    regions_.emplace_back();
    start(seed, number);
    std::vector<std::int32_t>& faces = regions_.back().faces;
    // A face that cannot be taken yet is met again when another of its neighbors is taken.
    for (std::size_t next = 0; next < faces.size(); ++next) {
      check_canceled();
      const Face& face = at(faces_, faces[next]);
      for (CornerIndex k = face.begin; k < face.end; ++k) {
        const std::int32_t candidate = at(across_, k);
        if (candidate != no_face && at(region_of_, candidate) == no_region &&
            is_in_plane(at(faces_, candidate)) && take(at(faces_, candidate), number)) {
          at(region_of_, candidate) = number;
          faces.push_back(candidate);
        }
      }
    }
    finish(number);
  }

  void start(std::int32_t seed, std::int32_t number) {
    const Face& face = at(faces_, seed);
    at(region_of_, seed) = number;
    regions_.back().faces.push_back(seed);
    doubled_area_ = face.doubled_area;
    const double size = norm(face.doubled_area);
    origin_ = face.center;
    weight_ = size;
    normal_ = size > 0 ? face.doubled_area / size : Vec3{};
    if (!face.can_join) {
      return;
    }
    for (CornerIndex k = face.begin; k < face.end; ++k) {
      link(at(corners_, k), at(corners_, following(face, k)), number);
    }
  }

  void link(PointId from, PointId to, std::int32_t number) {
    claim(from, number).next = to;
    claim(to, number).previous = from;
  }
  PointState& claim(PointId p, std::int32_t number) {
    PointState& state = at(state_, p);
    if (state.region != number) {
      state = {number, -1, -1};
    }
    return state;
  }

  bool is_in_plane(const Face& face) const {
    const double size = norm(face.doubled_area);
    if (!(dot(face.doubled_area, normal_) > 0)) {
      return false;
    }
    const double sine = norm(cross(face.doubled_area, normal_)) / size;
    if (sine > std::min(largest_sine, smallest_sine + 2 * tolerance_ / face.width)) {
      return false;
    }
    for (CornerIndex k = face.begin; k < face.end; ++k) {
      if (!(std::abs(dot(normal_, point(k) - origin_)) <= tolerance_)) {
        return false;
      }
    }
    return true;
  }

  /// Whether the boundary has the edge between corner k of `face` and the next, in the opposite
  /// direction.
  bool fractions(const Face& face, CornerIndex k, std::int32_t number) const {
    const PointState& end = at(state_, at(corners_, following(face, k)));
    return end.region == number && end.next == at(corners_, k);
  }

  /// Adds a face if its shared edges are one chain and its other corners are new to the region.
  bool take(const Face& face, std::int32_t number) {
    const CornerIndex n = face.end - face.begin;
    const auto corner = [&](CornerIndex k) { return at(corners_, face.begin + k % n); };
    const auto shared = [&](CornerIndex k) { return fractions(face, face.begin + k % n, number); };
    CornerIndex first = 0;  // of the chain: shared, the one before is not
    while (first < n && !(shared(first) && !shared(first + n - 1))) {
      ++first;
    }
    if (first == n) {
      return false;
    }
    CornerIndex last = first;  // one past the chain's edges
    while (shared(last)) {
      ++last;
    }
    for (CornerIndex k = last + 1; k < first + n; ++k) {
      if (at(state_, corner(k)).region == number) {
        return false;
      }
    }
    for (CornerIndex k = first + 1; k < last; ++k) {
      PointState& inside = at(state_, corner(k));
      inside.next = inside.previous = -1;
    }
    for (CornerIndex k = last; k < first + n; ++k) {
      link(corner(k), corner(k + 1), number);
    }
    const double size = norm(face.doubled_area);
    doubled_area_ = doubled_area_ + face.doubled_area;
    normal_ = normalized(doubled_area_);
    weight_ += size;
    origin_ = origin_ + (size / weight_) * (face.center - origin_);
    return true;
  }

  /// Reads the boundary; takes the region apart if it is not planar after all.
  void finish(std::int32_t number) {
    Region& region = regions_.back();
    if (region.faces.size() > 1) {
      const PointId first = first_of_boundary(region, number);
      PointId p = first;
      do {
        region.outline.push_back(p);
        p = at(state_, p).next;
      } while (p != first);
      const bool planar = std::all_of(region.outline.begin(), region.outline.end(), [&](PointId q) {
        return std::abs(dot(normal_, at(points_, q) - origin_)) <= 2 * tolerance_;
      });
      if (planar) {
        return;
      }
    }
    const std::vector<std::int32_t> faces = std::move(region.faces);
    regions_.pop_back();
    for (const std::int32_t f : faces) {
      at(region_of_, f) = static_cast<std::int32_t>(regions_.size());
      const Face& face = at(faces_, f);
      regions_.push_back({{f}, {corners_.begin() + face.begin, corners_.begin() + face.end}});
    }
  }

  /// A corner of the first face that is on the boundary; if none is, of another.
  PointId first_of_boundary(const Region& region, std::int32_t number) const {
    for (const std::int32_t f : region.faces) {
      const Face& face = at(faces_, f);
      for (CornerIndex k = face.begin; k < face.end; ++k) {
        const PointState& state = at(state_, at(corners_, k));
        if (state.region == number && state.next >= 0) {
          return at(corners_, k);
        }
      }
    }
    TRANSILLUM_INVARIANT(false, "a region has a boundary");
    return at(corners_, at(faces_, region.faces.front()).begin);
  }

  // Straight runs ---------------------------------------------------------------------------

  /// The two neighbors of a point, the smaller first, if they are the same in all outlines.
  struct Neighbors {
    PointId low = -1, high = -1;
    bool same = true;
  };

  void straighten() {
    std::vector<Neighbors> neighbors(points_.size());
    for (const Region& region : regions_) {
      const std::size_t n = region.outline.size();
      for (std::size_t k = 0; k < n; ++k) {
        Neighbors& of = at(neighbors, region.outline[k]);
        const auto [low, high] =
            std::minmax(region.outline[(k + n - 1) % n], region.outline[(k + 1) % n]);
        of.same = of.same && (of.low < 0 || (of.low == low && of.high == high)) && low != high;
        of.low = low;
        of.high = high;
      }
    }
    std::vector<char> straight(points_.size(), 0);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const Neighbors& of = neighbors[p];
      straight[p] =
          of.same && of.low >= 0 &&
          is_between(points_[p], at(points_, of.low), at(points_, of.high), tolerance_ / 2);
    }
    for (Region& region : regions_) {
      check_canceled();
      simplify(region.outline, straight);
    }
  }

  static bool is_between(const Vec3& p, const Vec3& a, const Vec3& b, double tolerance) {
    const Vec3 along = b - a;
    const double squared = dot(along, along);
    if (!(dot(p - a, along) > 0 && dot(b - p, along) > 0)) {
      return false;
    }
    return norm(cross(p - a, along)) <= tolerance * std::sqrt(squared);
  }

  /// Removes corners of straight runs. A chain between two others is the same in all outlines that
  /// have it, and treated from the end with the smaller number.
  void simplify(std::vector<PointId>& outline, const std::vector<char>& straight) const {
    const auto bend = std::find_if(outline.begin(), outline.end(),
                                   [&](PointId p) { return at(straight, p) == 0; });
    if (bend == outline.end()) {
      return;
    }
    std::rotate(outline.begin(), bend, outline.end());
    std::vector<PointId> kept, chain;
    outline.push_back(outline.front());
    for (const PointId p : outline) {
      chain.push_back(p);
      if (chain.size() == 1 || at(straight, p) != 0) {
        continue;
      }
      const bool reversed = chain.front() > chain.back();
      if (reversed) {
        std::reverse(chain.begin(), chain.end());
      }
      std::vector<PointId> bends = bends_of(chain);
      if (reversed) {
        std::reverse(bends.begin(), bends.end());
      }
      kept.insert(kept.end(), bends.begin(), bends.end() - 1);
      chain = {p};
    }
    outline = kept;
  }

  /// The chain's ends and those corners between them without which it would not be straight.
  std::vector<PointId> bends_of(const std::vector<PointId>& chain) const {
    std::vector<PointId> bends{chain.front()};
    std::size_t from = 0;
    // The farthest end of a straight part is found by doubling and halving its length.
    while (from + 1 < chain.size()) {
      std::size_t good = from + 1;
      for (std::size_t step = 1; step > 0;) {
        const std::size_t to = std::min(good + step, chain.size() - 1);
        const bool farther = to > good && is_straight(chain, from, to);
        good = farther ? to : good;
        step = farther ? 2 * step : step / 2;
      }
      bends.push_back(chain[good]);
      from = good;
    }
    return bends;
  }
  bool is_straight(const std::vector<PointId>& chain, std::size_t from, std::size_t to) const {
    for (std::size_t k = from + 1; k < to; ++k) {
      if (!is_between(at(points_, chain[k]), at(points_, chain[from]), at(points_, chain[to]),
                      tolerance_ / 2)) {
        return false;
      }
    }
    return true;
  }

  /// Regions around points that are nearly, but not quite, one can have outlines that cross or
  /// touch themselves: they become the faces that they were joined from.
  void take_crossing_apart() {
    std::vector<Region> kept;
    for (Region& region : regions_) {
      check_canceled();
      if (region.faces.size() == 1 || is_simple_outline(region.outline)) {
        kept.push_back(std::move(region));
        continue;
      }
      for (const std::int32_t f : region.faces) {
        const Face& face = at(faces_, f);
        kept.push_back({{f}, {corners_.begin() + face.begin, corners_.begin() + face.end}});
      }
    }
    regions_ = std::move(kept);
  }
  bool is_simple_outline(const std::vector<PointId>& outline) const {
    const PolygonShape shape = transillum::measure(points_, outline);
    return !shape.degenerate && is_simple(drop_axis(points_, outline, shape.normal));
  }

  // Result ----------------------------------------------------------------------------------

  JoinedFaces result() {
    std::vector<std::int32_t> first(regions_.size());
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      first[r] = *std::min_element(regions_[r].faces.begin(), regions_[r].faces.end());
    }
    std::vector<std::int32_t> order(regions_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::int32_t a, std::int32_t b) { return at(first, a) < at(first, b); });

    JoinedFaces joined;
    joined.face_of.assign(original_.face_count(), no_face);
    SceneDescription& d = joined.description;
    d.name = original_.name;
    d.materials = original_.materials;
    d.groups = original_.groups;
    d.notes = original_.notes;
    d.files = original_.files;
    d.coordinate_rounding = original_.coordinate_rounding;
    std::vector<PointId> number(points_.size(), -1);
    std::vector<PointId> outline;
    for (const std::int32_t r : order) {
      check_canceled();
      const Region& region = at(regions_, r);
      const auto f = static_cast<std::size_t>(at(first, r));
      outline.clear();
      for (const PointId p : region.outline) {
        if (at(number, p) < 0) {
          at(number, p) = static_cast<PointId>(d.points.size());
          d.points.push_back(at(points_, p));
        }
        outline.push_back(at(number, p));
      }
      for (const std::int32_t part : region.faces) {
        at(joined.face_of, part) = static_cast<std::int32_t>(d.face_count());
      }
      d.add_face(outline, original_.face_material[f], original_.face_line[f],
                 original_.group_of(f));
      d.face_number.push_back(original_.face_number.empty() ? at(first, r)
                                                            : original_.face_number[f]);
      if (!original_.face_two_sided.empty()) {
        d.face_two_sided.resize(d.face_count());
        d.face_two_sided.back() = original_.face_two_sided[f];
      }
    }
    set_numbers(joined);
    return joined;
  }
  /// SceneDescription::joined_to; of a face in several regions, its own number is preferred.
  void set_numbers(JoinedFaces& joined) const {
    SceneDescription& d = joined.description;
    if (d.face_count() == original_.face_count()) {
      return;
    }
    const auto last = static_cast<std::size_t>(original_.number_of(original_.face_count() - 1));
    d.joined_to.assign(last + 1, no_face);
    for (std::size_t f = 0; f < original_.face_count(); ++f) {
      const std::int32_t before = original_.number_of(f),
                         now = d.number_of(static_cast<std::size_t>(at(joined.face_of, f)));
      std::int32_t& to = at(d.joined_to, before);
      to = to == no_face || now == before ? now : to;
    }
  }

  const SceneDescription& original_;
  const Cancellation& cancellation_;
  const double tolerance_;  ///< m
  std::size_t steps_ = 0;
  std::vector<Vec3> points_;             ///< welded
  std::vector<PointId> corners_;         ///< of all faces, welded
  std::vector<Face> faces_;              ///< by face of the original
  std::vector<std::int32_t> across_;     ///< by corner: the face across the edge that begins there
  std::vector<std::int32_t> region_of_;  ///< by face of the original
  std::vector<PointState> state_;        ///< by point, of the region that grows
  std::vector<Region> regions_;
  // The plane of the region that grows.
  Vec3 doubled_area_, normal_, origin_;
  double weight_ = 0;
};

}  // namespace

JoinedFaces join_faces(const SceneDescription& original, const Cancellation& cancellation) {
  return Joiner(original, cancellation).join();
}

}  // namespace transillum
