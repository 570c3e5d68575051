// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast_faces.h"

#include <algorithm>
#include <limits>

#include "visibility/exact_side.h"

namespace transillum {
namespace {

using Corners = std::vector<FaceCorner>;

constexpr double thinnest = 32;                               ///< steps
constexpr std::int64_t farthest_off = std::int64_t{1} << 32;  ///< steps

/// Whether the outline turns left everywhere but for rounding: one seen within rounding of
/// edge-on may not, and takes no part.
bool is_convex(const FaceCorner* outline, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const GridPoint& a = outline[k].at;
    const GridPoint& b = outline[(k + 1) % count].at;
    const GridPoint& c = outline[(k + 2) % count].at;
    const WideInteger turn = exact_turn(a, b, c);
    if (turn >= 0) continue;
    const auto square = [](std::int64_t v) {
      return static_cast<long double>(v) * static_cast<long double>(v);
    };
    const long double size =
        square(b.x - a.x) + square(b.y - a.y) + square(c.x - b.x) + square(c.y - b.y);
    if (static_cast<long double>(turn) < -1e-14L * size) return false;
  }
  return true;
}

FaceBox box_of(const FaceCorner* outline, std::size_t count) {
  std::int64_t low[4], high[4];
  std::fill(low, low + 4, std::numeric_limits<std::int64_t>::max());
  std::fill(high, high + 4, std::numeric_limits<std::int64_t>::min());
  for (std::size_t k = 0; k < count; ++k) {
    const GridPoint& p = outline[k].at;
    const std::int64_t along[4] = {p.x, p.y, p.x + p.y, p.x - p.y};
    for (int d = 0; d < 4; ++d) {
      low[d] = std::min(low[d], along[d]);
      high[d] = std::max(high[d], along[d]);
    }
  }
  FaceBox box;
  for (std::size_t d = 0; d < 4; ++d) {
    box.ends[d] = rounded_down(static_cast<double>(low[d]));
    box.ends[d + 4] = rounded_down(static_cast<double>(-high[d]));
  }
  return box;
}

/// Turns a clockwise outline round: the edge that left a corner now arrives there.
void reverse(FaceCorner* outline, std::size_t count) {
  std::reverse(outline, outline + count);
  // Corner k now holds the edge that arrives at it.
  const LineId last_line = outline[0].line;
  const bool last_forward = outline[0].forward;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    outline[k].line = outline[k + 1].line;
    outline[k].forward = !outline[k + 1].forward;
  }
  outline[count - 1].line = last_line;
  outline[count - 1].forward = !last_forward;
}

}  // namespace

FastOutlines::FastOutlines(const BspTree& tree) : lines(tree.lines()) {
  for (const BspTree::Fragment& fragment : tree.fragments()) {
    first.push_back(static_cast<std::uint32_t>(outlines.size()));
    const auto all = tree.corners(fragment);
    std::vector<BspTree::Corner> rest(all.begin(), all.end());
    while (rest.size() > most_corners) {
      // The diagonal from the last corner of the part to the first of all closes the part, and
      // opens what is left.
      std::vector<BspTree::Corner> part(rest.begin(), rest.begin() + most_corners);
      const PointId a = part.front().point, b = part.back().point;
      const auto line = static_cast<LineId>(lines.size());
      lines.push_back({std::min(a, b), std::max(a, b)});
      rest.erase(rest.begin() + 1, rest.begin() + most_corners - 1);
      rest.front() = {a, line, a < b};
      part.back() = {b, line, b < a};
      add(fragment.patch, part);
    }
    add(fragment.patch, rest);
  }
  first.push_back(static_cast<std::uint32_t>(outlines.size()));
}

void FastOutlines::add(PatchId patch, const std::vector<BspTree::Corner>& part) {
  Outline outline{patch, static_cast<std::uint32_t>(corners.size()), 0, true};
  const auto runs_through = [this](LineId line, PointId point) {
    const BspTree::Line& points = lines[static_cast<std::size_t>(line)];
    return points.a == point || points.b == point;
  };
  for (std::size_t k = 0; k < part.size(); ++k) {
    const BspTree::Corner& corner = part[k];
    const BspTree::Corner& before = part[k > 0 ? k - 1 : part.size() - 1];
    const bool exact =
        runs_through(corner.line, corner.point) && runs_through(before.line, corner.point);
    outline.plain = outline.plain && exact && corner.line != before.line;
    corners.push_back({corner.point, corner.line, corner.forward, exact});
  }
  outline.end = static_cast<std::uint32_t>(corners.size());
  outlines.push_back(outline);
}

FastFaces::FastFaces(const Scene& scene, const BspTree& tree, const FastOutlines& outlines,
                     const Vec3& omega, const Cancellation& cancellation)
    : grid(scene, tree, omega) {
  cancellation.throw_if_cancelled();
  boxes.reserve(outlines.outlines.size());
  faces.reserve(outlines.outlines.size());
  corners.reserve(outlines.corners.size());
  for (const FragmentId f : tree.order(omega)) {
    if (faces.size() % 4096 == 0) cancellation.throw_if_cancelled();
    const auto fragment = static_cast<std::size_t>(f);
    for (std::uint32_t k = outlines.first[fragment]; k < outlines.first[fragment + 1]; ++k) {
      if (!add(outlines, outlines.outlines[k])) {
        corners.resize(faces.empty() ? 0 : faces.back().end);
      }
    }
  }
}

/// Returns false, and leaves corners behind, where the outline is seen edge-on.
bool FastFaces::add(const FastOutlines& outlines, const FastOutlines::Outline& outline) {
  const auto begin = static_cast<std::uint32_t>(corners.size());
  for (std::uint32_t k = outline.begin; k < outline.end; ++k) {
    const FastOutlines::Corner& corner = outlines.corners[k];
    corners.push_back({grid.points[static_cast<std::size_t>(corner.point)],
                       corner.exact ? corner.point : FaceCorner::no_point, corner.line,
                       corner.forward});
  }
  FaceCorner* const first = corners.data() + begin;
  const std::size_t count = corners.size() - begin;

  WideInteger twice_area = 0;
  for (std::size_t k = 2; k < count; ++k) {
    twice_area += exact_turn(first[0].at, first[k - 1].at, first[k].at);
  }
  if (twice_area == 0) return false;
  const bool front = twice_area > 0;
  if (!front) {
    twice_area = -twice_area;
    reverse(first, count);
  }
  const FaceBox box = box_of(first, count);
  const double area = 0.5 * static_cast<double>(twice_area);
  const double width = -static_cast<double>(box.ends[4]) - static_cast<double>(box.ends[0]);
  const double height = -static_cast<double>(box.ends[5]) - static_cast<double>(box.ends[1]);
  const double size = width * width + height * height;
  // What is thinner than the steps that corners are rounded to is seen edge-on.
  if (area < thinnest * std::sqrt(size)) return false;
  const bool needle = area < 0x1p-11 * size;
  if (needle && !is_convex(first, count)) return false;
  boxes.push_back(box);
  faces.push_back({begin, static_cast<std::uint32_t>(corners.size()), outline.patch, front,
                   outline.plain, needle, area});
  if (needle && !outline.plain) faces.back().area = needle_area(outlines, faces.back());
  return true;
}

FastFaces::Place FastFaces::place_of(const FastOutlines& outlines, const Face& face,
                                     std::uint32_t corner, const GridPoint& origin) const {
  const FaceCorner& leaving = corners[corner];
  const Place rounded{static_cast<long double>(leaving.at.x - origin.x),
                      static_cast<long double>(leaving.at.y - origin.y)};
  if (!face.needle || leaving.point != FaceCorner::no_point) return rounded;
  const FaceCorner& arriving = corners[corner > face.begin ? corner - 1 : face.end - 1];
  const Meeting meeting =
      exact_meeting(line_of(outlines, arriving), line_of(outlines, leaving), leaving.at);
  // Lines that all but coincide may meet anywhere.
  const auto most = static_cast<long double>(farthest_off);
  if (meeting.parallel || std::abs(meeting.x) > most || std::abs(meeting.y) > most) return rounded;
  return {rounded.x + meeting.x, rounded.y + meeting.y};
}

double FastFaces::needle_area(const FastOutlines& outlines, const Face& face) const {
  const GridPoint& origin = corners[face.begin].at;
  const Place first = place_of(outlines, face, face.begin, origin);
  Place before = place_of(outlines, face, face.begin + 1, origin);
  long double twice = 0;
  for (std::uint32_t k = face.begin + 2; k < face.end; ++k) {
    const Place place = place_of(outlines, face, k, origin);
    twice +=
        (before.x - first.x) * (place.y - first.y) - (before.y - first.y) * (place.x - first.x);
    before = place;
  }
  return static_cast<double>(twice / 2);
}

}  // namespace transillum
