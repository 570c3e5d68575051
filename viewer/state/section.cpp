// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Cuts a scene and its recorded map with a plane. Notation: n is the normal of the plane, c the
// value of dot(n, p) of its points, r and u its axes to the right and up.
#include "state/section.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/snapshot_values.h"

namespace transillum::viewer {

namespace {

/// Patches of a grid have their edges in the middle; this fraction of the size is beside them.
constexpr double beside_middle = 0.0137;
constexpr double least_sine = 0.2;  // between omega and the axis
constexpr double gap_below = 0.12;  // between the scene and the line, of the scene's height

struct Axes {
  Vec3 axis, normal, right, up;
  double c = 0;

  Vec2 in_plane(const Vec3& p) const { return {dot(p, right), dot(p, up)}; }
};

Axes axes_for(const Bounds& box, const Vec3& omega) {
  const Vec3 size = box.high - box.low;
  std::array<std::pair<double, Vec3>, 3> axes{
      {{size.x, {1, 0, 0}}, {size.y, {0, 1, 0}}, {size.z, {0, 0, 1}}}};
  std::stable_sort(axes.begin(), axes.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto found = std::find_if(axes.begin(), axes.end(), [&](const auto& axis) {
    return norm(cross(axis.second, omega)) >= least_sine;
  });
  const auto [length, axis] = *found;  // omega is along one axis at most
  Axes result;
  result.axis = axis;
  result.normal = normalized(axis - dot(axis, omega) * omega);
  if (result.normal.z > 0.9) {
    result.normal = -result.normal;  // a floor plan is seen from above
  }
  const Vec3 vertical = std::abs(result.normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  result.up = normalized(vertical - dot(vertical, result.normal) * result.normal);
  result.right = cross(result.normal, result.up);
  result.c = dot(result.normal, box.center()) + beside_middle * length;
  return result;
}

/// The places, ascending, at which a closed polygon crosses a line.
/// @param side   of each corner: the signed distance from the line
/// @param place  of each corner along the line
std::vector<double> crossings(const std::vector<double>& side, const std::vector<double>& place) {
  std::vector<double> result;
  for (std::size_t k = 0; k < side.size(); ++k) {
    const std::size_t next = (k + 1) % side.size();
    if ((side[k] < 0) != (side[next] < 0)) {
      const double fraction = side[k] / (side[k] - side[next]);
      result.push_back(place[k] + fraction * (place[next] - place[k]));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

void add_segments(Section& section, const Axes& axes, const Scene& scene, PatchId i) {
  const Vec3& normal = scene.patch(i).normal;
  const Vec3 along = cross(axes.normal, normal);
  const double sine = norm(along);
  if (sine < 1e-9) {
    return;  // the patch is parallel to the plane
  }
  const Vec3 unit = along / sine;
  std::vector<double> side, place;
  for (const PointId p : scene.outline(i)) {
    side.push_back(dot(axes.normal, scene.point(p)) - axes.c);
    place.push_back(dot(unit, scene.point(p) - scene.patch(i).center));
  }
  const std::vector<double> ends = crossings(side, place);
  // A point of the patch's plane and of the section's.
  const Vec3 down = cross(normal, unit);
  const double rest = axes.c - dot(axes.normal, scene.patch(i).center);
  const Vec3 origin = scene.patch(i).center + (rest / dot(axes.normal, down)) * down;
  const Vec2 front = axes.in_plane(normal);
  const double length = std::hypot(front.x, front.y);
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    section.segments.push_back({i,
                                axes.in_plane(origin + ends[k] * unit),
                                axes.in_plane(origin + ends[k + 1] * unit),
                                {front.x / length, front.y / length}});
  }
}

void add_intervals(Section& section, const Axes& axes, const MapRecord& record) {
  const PlaneFrame& frame = record.frame;
  const Vec3 across = cross(axes.normal, frame.omega);
  const Vec2 n{dot(axes.normal, frame.u), dot(axes.normal, frame.v)};
  const Vec2 t{dot(across, frame.u), dot(across, frame.v)};
  const double c = axes.c - dot(axes.normal, frame.origin);
  // Like segments, places are measured from the origin of space.
  const double shift = dot(across, frame.origin);
  std::vector<double> side, place;
  for (std::size_t r = 0; r < record.rows.size(); ++r) {
    side.clear();
    place.clear();
    for (const Vec2& p : record.outline(record.rows[r])) {
      side.push_back(n.x * p.x + n.y * p.y - c);
      place.push_back(t.x * p.x + t.y * p.y + shift);
    }
    const std::vector<double> ends = crossings(side, place);
    if (ends.size() >= 2 && ends.back() > ends.front()) {
      section.intervals.push_back({static_cast<std::int32_t>(r), ends.front(), ends.back()});
    }
  }
}

}  // namespace

const Section::Interval* Section::interval_of(std::int32_t row) const {
  const auto found =
      std::lower_bound(intervals.begin(), intervals.end(), row,
                       [](const Interval& interval, std::int32_t r) { return interval.row < r; });
  return found != intervals.end() && found->row == row ? &*found : nullptr;
}

Section::Box Section::box() const {
  Box box;
  const auto add = [&](const Vec2& p) {
    box.left = std::min(box.left, p.x);
    box.right = std::max(box.right, p.x);
    box.bottom = std::min(box.bottom, p.y);
    box.top = std::max(box.top, p.y);
  };
  for (const Segment& segment : segments) {
    add(segment.a);
    add(segment.b);
  }
  for (const Interval& interval : intervals) {
    add(on_line(interval.low));
    add(on_line(interval.high));
  }
  return box;
}

Section section_of(const RecordedMap& map) {
  const Scene& scene = *map.loaded->scene;
  const Vec3& omega = map.record().frame.omega;
  const Axes axes = axes_for(scene.bounds(), omega);
  Section section;
  section.right = axes.right;
  section.up = axes.up;
  section.axis = axes.axis;
  section.foot = axes.c * axes.normal;
  section.omega = axes.in_plane(omega);
  section.across = axes.in_plane(cross(axes.normal, omega));
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    add_segments(section, axes, scene, i);
  }
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Section::Segment& segment : section.segments) {
    for (const Vec2& p : {segment.a, segment.b}) {
      const double height = p.x * section.omega.x + p.y * section.omega.y;
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  section.base = section.segments.empty() ? 0 : low - gap_below * (high - low);
  add_intervals(section, axes, map.record());
  return section;
}

std::optional<SectionStrip> strip_of(const Section& section, const RecordedMap& map,
                                     const Section::Interval& interval, PatchId receiver) {
  const Scene& scene = *map.loaded->scene;
  const Vec3& omega = map.record().frame.omega;
  const Axes axes = axes_for(scene.bounds(), omega);
  const Vec3 across = cross(axes.normal, omega);
  const auto height = [&](PatchId patch, double place) -> std::optional<double> {
    const Vec3& normal = scene.patch(patch).normal;
    const double cosine = dot(normal, omega);
    if (std::abs(cosine) < 1e-9) {
      return std::nullopt;
    }
    const Vec3 foot = place * across + axes.c * axes.normal;
    return dot(normal, scene.patch(patch).center - foot) / cosine;
  };
  const PatchId source = map.row(interval.row).patch;
  SectionStrip strip;
  for (const bool end : {false, true}) {
    const double place = end ? interval.high : interval.low;
    const auto top = height(source, place);
    const auto bottom =
        receiver == no_patch ? std::optional(section.base) : height(receiver, place);
    if (!top || !bottom) {
      return std::nullopt;
    }
    strip.at(end ? 2 : 1) = section.above(place, *top);
    strip.at(end ? 3 : 0) = section.above(place, *bottom);
  }
  return strip;
}

std::optional<Vec2> place_in_section(const Callout& callout, const Section& section,
                                     const RecordedMap& map, std::int32_t step) {
  using Anchor = Callout::Anchor;
  const auto middle = [](const Vec2& a, const Vec2& b) {
    return Vec2{(a.x + b.x) / 2, (a.y + b.y) / 2};
  };
  if (callout.anchor == Anchor::point) {
    return section.in_plane(callout.point);
  }
  if (callout.anchor == Anchor::patch) {
    double longest = 0;
    std::optional<Vec2> place;
    for (const Section::Segment& segment : section.segments) {
      const double length = std::hypot(segment.b.x - segment.a.x, segment.b.y - segment.a.y);
      if (segment.patch == callout.patch && length > longest) {
        longest = length;
        place = middle(segment.a, segment.b);
      }
    }
    return place;
  }
  if (callout.anchor == Anchor::map && !section.intervals.empty()) {
    const auto [low, high] = std::minmax_element(
        section.intervals.begin(), section.intervals.end(),
        [](const auto& a, const auto& b) { return a.low + a.high < b.low + b.high; });
    return middle(section.on_line(low->low), section.on_line(high->high));
  }
  if (callout.anchor == Anchor::inside && step >= 0) {
    for (const std::int32_t r : map.history.inside_at(step)) {
      if (const Section::Interval* interval = section.interval_of(r)) {
        return middle(section.on_line(interval->low), section.on_line(interval->high));
      }
    }
  }
  return std::nullopt;
}

}  // namespace transillum::viewer
