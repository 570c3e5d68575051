// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: one direction with all exact engines. An input defines a scene of a few polygons,
// most of them on a coarse grid, and a direction. The engines must agree, and their transfers must
// have the properties that hold for every scene.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "fuzz/byte_source.h"
#include "fuzz/require.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/engine.h"
#include "transillum/errors.h"

namespace transillum::fuzz {
namespace {

constexpr unsigned max_polygons = 12;
constexpr unsigned grid_size = 8;
/// Relative to the patch's area; guaranteed by every engine (ALGORITHM.md, oracle 7).
constexpr double tolerance = 1e-10;
/// With more fragments the engine exact is too slow for a fuzz target.
constexpr std::size_t max_fragments_of_exact = 10;

/// A scene and a direction.
struct Case {
  std::shared_ptr<const Scene> scene;
  Vec3 omega;
  /// Whether an inward-facing box encloses the scene, so that every line of sight ends at a patch.
  bool closed = false;
};

double grid_value(ByteSource& bytes) { return bytes.below(grid_size); }

Vec3 grid_point(ByteSource& bytes) {
  const double x = grid_value(bytes), y = grid_value(bytes), z = grid_value(bytes);
  return {x, y, z};
}

Vec3 free_point(ByteSource& bytes) {
  const double x = bytes.fraction(), y = bytes.fraction(), z = bytes.fraction();
  return (grid_size - 1) * Vec3{x, y, z};
}

/// A rectangle perpendicular to an axis.
std::vector<Vec3> take_rectangle(ByteSource& bytes) {
  const unsigned axis = bytes.below(3);
  const double level = grid_value(bytes);
  const double a = grid_value(bytes), b = grid_value(bytes);
  const double c = a + 1 + bytes.below(4), d = b + 1 + bytes.below(4);
  std::vector<Vec3> outline;
  for (const auto& [u, v] : {std::pair{a, b}, {c, b}, {c, d}, {a, d}}) {
    outline.push_back(axis == 0   ? Vec3{level, u, v}
                      : axis == 1 ? Vec3{v, level, u}
                                  : Vec3{u, v, level});
  }
  return outline;
}

/// A horizontal polygon with many corners.
std::vector<Vec3> take_disc(ByteSource& bytes) {
  const Vec3 center = grid_point(bytes);
  const double radius = 1 + grid_value(bytes) / 2;
  const unsigned count = 5 + bytes.below(76);
  std::vector<Vec3> outline;
  for (unsigned k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    outline.push_back(center + radius * Vec3{std::cos(angle), std::sin(angle), 0});
  }
  return outline;
}

/// One more outline; `before` contains the previous ones.
std::vector<Vec3> take_outline(ByteSource& bytes, const std::vector<std::vector<Vec3>>& before) {
  std::vector<Vec3> outline;
  switch (bytes.below(8)) {
    case 0:
      return take_rectangle(bytes);
    case 1:  // a triangle of the grid
      for (int k = 0; k < 3; ++k) {
        outline.push_back(grid_point(bytes));
      }
      return outline;
    case 2: {  // a parallelogram of the grid
      const Vec3 a = grid_point(bytes), b = grid_point(bytes), c = grid_point(bytes);
      return {a, b, c, c - b + a};
    }
    case 3:  // a triangle anywhere
      for (int k = 0; k < 3; ++k) {
        outline.push_back(free_point(bytes));
      }
      return outline;
    case 4: {  // possibly concave or with straight corners, in the plane of three grid points
      const Vec3 o = grid_point(bytes), u = grid_point(bytes) - o, v = grid_point(bytes) - o;
      const unsigned count = 4 + bytes.below(5);
      for (unsigned k = 0; k < count; ++k) {
        const double s = bytes.below(4), t = bytes.below(4);
        outline.push_back(o + 0.25 * s * u + 0.25 * t * v);
      }
      return outline;
    }
    case 5:
      return take_disc(bytes);
    default:  // a previous one again, in place or moved by a large or very small distance
      if (before.empty()) {
        return take_rectangle(bytes);
      }
      outline = before[bytes.below(static_cast<unsigned>(before.size()))];
      if (bytes.flag()) {
        const Vec3 shift = grid_point(bytes);
        const double fraction = std::ldexp(0.5, -static_cast<int>(bytes.below(20)));
        for (Vec3& p : outline) {
          p = p + fraction * shift;
        }
      }
      return outline;
  }
}

Vec3 take_direction(ByteSource& bytes) {
  const bool is_free = bytes.flag();
  Vec3 omega = is_free ? free_point(bytes) : grid_point(bytes);
  if (bytes.flag()) {
    omega.x = -omega.x;
  }
  if (bytes.flag()) {
    omega.y = -omega.y;
  }
  if (bytes.flag()) {
    omega.z = -omega.z;
  }
  return norm(omega) > 0 ? normalized(omega) : Vec3{0, 0, 1};
}

/// @throws InputError for invalid scenes, such as without a face that has an area
Case take_case(ByteSource& bytes) {
  Case made;
  made.omega = take_direction(bytes);
  enum { open, two_sided, closed };
  const unsigned kind = bytes.below(3);
  made.closed = kind == closed;
  testing::Sketch sketch("case");
  const std::array materials{sketch.material(0.5, 0), sketch.material(0, 1)};
  std::vector<std::vector<Vec3>> outlines;
  for (unsigned remaining = 1 + bytes.below(max_polygons); remaining > 0 && !bytes.empty();
       --remaining) {
    const unsigned variant = bytes.byte();
    std::vector<Vec3> outline = take_outline(bytes, outlines);
    if ((variant & 1u) != 0) {
      std::reverse(outline.begin(), outline.end());
    }
    sketch.face(outline, materials[variant >> 1 & 1u]);
    outlines.push_back(std::move(outline));
  }
  // Parallelograms and moved polygons may extend to three times the grid size.
  if (made.closed) {
    sketch.box({-100, -100, -100}, {100, 100, 100}, true, materials[0]);
  }
  made.scene = sketch.scene({.two_sided = kind == two_sided});
  return made;
}

using Areas = std::map<std::pair<PatchId, PatchId>, double>;
Areas areas_of(const Transfers& transfers) {
  Areas areas;
  for (const Transfer& t : transfers.exchanges) {
    areas[{t.receiver, t.source}] = t.area;
  }
  return areas;
}

/// Tolerance for areas at patch i, m²: the guarantee of the engines, plus the rounding of
/// coordinates, which matters for needles across the scene.
double slack_of(const Scene& scene, PatchId i) {
  Bounds box;
  for (const PointId p : scene.outline(i)) {
    box.add(scene.point(p));
  }
  const double farthest = std::max(max_abs(box.low), max_abs(box.high));
  return tolerance * scene.patch(i).area + 16 * 0x1p-52 * farthest * box.diagonal();
}

/// Checks the properties that the transfers of each engine must have.
void check(const Case& from, const Transfers& transfers, const std::string& engine) {
  const Scene& scene = *from.scene;
  const auto patches = static_cast<std::size_t>(scene.patch_count());
  require(transfers.forward.size() == patches && transfers.backward.size() == patches &&
              transfers.back_seen.size() == patches,
          engine + ": one entry per patch");
  std::vector<double> received(patches), sent(patches);
  std::pair<PatchId, PatchId> last{no_patch, no_patch};
  for (const Transfer& t : transfers.exchanges) {
    require(std::isfinite(t.area) && t.area > 0, engine + ": areas are finite and > 0");
    require(last < std::pair(t.receiver, t.source), engine + ": sorted, one entry per pair");
    last = {t.receiver, t.source};
    at(received, t.receiver) += t.area;
    at(sent, t.source) += t.area;
  }
  for (std::size_t i = 0; i < patches; ++i) {
    const double area = scene.patches()[i].area;
    const double cosine = dot(scene.patches()[i].normal, from.omega);
    const double slack = slack_of(scene, static_cast<PatchId>(i));
    const auto check_side = [&](const Coverage& side, double exchanged, double toward) {
      const std::string context = fmt::format(
          "{}: patch {} of {} m2, cosine {}: projected {}, covered {}, exchanged {}: ", engine, i,
          area, cosine, side.projected, side.covered, exchanged);
      require(std::abs(side.projected - std::max(0.0, toward) * area) <= slack,
              context + "the projection follows the cosine");
      require(side.covered <= side.projected + slack, context + "nothing is covered twice");
      require(exchanged <= side.covered + slack, context + "exchanged areas are covered");
      if (from.closed) {
        require(side.covered >= side.projected - slack,
                context + "everything is covered in a closed scene");
      }
    };
    check_side(transfers.forward[i], received[i], cosine);
    check_side(transfers.backward[i], sent[i], -cosine);
    require(std::isfinite(transfers.back_seen[i]) && transfers.back_seen[i] >= 0 &&
                transfers.back_seen[i] <= area + slack,
            engine + ": at most the whole back is seen");
  }
}

/// Checks that areas are equal within the tolerance; a missing entry counts as 0.
void require_equal(const Scene& scene, Areas expected, const Areas& found,
                   const std::string& what) {
  for (const auto& [pair, area] : found) {
    expected.try_emplace(pair, 0.0);
    expected[pair] -= area;
  }
  for (const auto& [pair, difference] : expected) {
    const double area = scene.patch(pair.first).area;
    require(std::abs(difference) <= slack_of(scene, pair.first),
            fmt::format("{}: {} from {} differ by {} of the receiver's area", what, pair.first,
                        pair.second, difference / area));
  }
}

/// Areas with receiver and source exchanged, as along the opposite direction.
Areas transposed(const Areas& areas) {
  Areas result;
  for (const auto& [pair, area] : areas) {
    result[{pair.second, pair.first}] = area;
  }
  return result;
}

void run(const Case& from) {
  const auto tree = std::make_shared<const BspTree>(*from.scene);
  const auto transfers_by = [&](Engine engine) {
    Transfers transfers = make_engine(engine, from.scene, tree)(from.omega, {});
    check(from, transfers, name_of(engine));
    return areas_of(transfers);
  };
  const Areas local = transfers_by(Engine::local);
  const Transfers back = make_engine(Engine::local, from.scene, tree)(-from.omega, {});
  require_equal(*from.scene, local, transposed(areas_of(back)), "local, along omega and -omega");
  require_equal(*from.scene, local, transfers_by(Engine::fast), "local and fast");
  if (tree->fragments().size() > max_fragments_of_exact) {
    return;
  }
  require_equal(*from.scene, local, transfers_by(Engine::exact), "local and exact");
}

}  // namespace
}  // namespace transillum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace transillum;
  fuzz::ByteSource bytes(data, size);
  fuzz::Case from;
  try {
    from = fuzz::take_case(bytes);
  } catch (const InputError&) {
    return 0;
  }
  fuzz::run(from);
  return 0;
}
