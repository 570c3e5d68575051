// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// ALGORITHM.md, oracles 1, 2, 5 and 7 on random scenes that are moved, scaled, turned, mirrored,
// reordered, split or given far triangles, along edges, axes and planes of faces: areas differ by
// no more than the rounding of the coordinates explains.
//
// The bound. A coordinate c is rounded by up to 2^-53 |c|, so a corner moves by up to
// d = sqrt(3) 2^-53 C, C being the largest coordinate of the scene, and no farther in a projection.
// A patch is then bent; its outline lies within d of its own plane, and so within 2 d of the
// outline of another rounding of it. A patch that its file has bent by more, by b, lies within b.
// Its projected area changes by 2 d times its perimeter. A part that is seen has edges of any
// patches: its area changes by 2 d times the sum of all perimeters.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "support/imperfect_scenes.h"
#include "support/random_scenes.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/engine.h"

namespace transillum::transformed_scenes_test {
namespace {

using testing::RandomScene;

/// The error that engines promise, relative to the patch's area.
constexpr double promised = 1e-10;
/// Rounding of sums and products of doubles, as a fraction of an area.
constexpr double summed = 1e-14;

Bounds bounds_of(const SceneDescription& description) {
  Bounds bounds;
  for (const Vec3& p : description.points) {
    bounds.add(p);
  }
  return bounds;
}

/// A scene, and how it came from another one.
struct Transformed {
  std::string how;
  SceneDescription description;
  std::vector<int> face;  ///< per face: the same face of the original, or the face that it is a
                          ///< part of; -1 if there is none
  std::function<Vec3(const Vec3&)> turn = [](const Vec3& p) { return p; };  ///< turns directions
  double scale = 1;
  double roundings = 1;  ///< roundings of a coordinate, in addition to the original
};

std::vector<int> same_faces(const SceneDescription& description) {
  std::vector<int> faces(description.face_count());
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

Transformed moved_by(const SceneDescription& original, const Vec3& offset) {
  return {fmt::format("moved by {},{},{}", offset.x, offset.y, offset.z),
          testing::moved(original, [&](const Vec3& p) { return p + offset; }),
          same_faces(original)};
}

Transformed scaled(const SceneDescription& original, double scale) {
  return {.how = fmt::format("scaled by {}", scale),
          .description = testing::moved(original, [&](const Vec3& p) { return scale * p; }),
          .face = same_faces(original),
          .scale = scale};
}

Transformed rotated(const SceneDescription& original, std::uint64_t seed) {
  const auto turn = testing::random_rotation(seed);
  // Three products, two sums, and the axes and the direction, which are rounded themselves.
  return {.how = fmt::format("rotated, seed {}", seed),
          .description = testing::moved(original, turn),
          .face = same_faces(original),
          .turn = [=](const Vec3& p) { return normalized(turn(p)); },
          .roundings = 8};
}

Transformed mirrored(const SceneDescription& original) {
  const auto mirror = [](const Vec3& p) { return Vec3{-p.x, p.y, p.z}; };
  Transformed result{
      .how = "mirrored", .description = {}, .face = same_faces(original), .turn = mirror};
  SceneDescription& description = result.description;
  description.points = testing::moved(original, mirror).points;
  description.materials = original.materials;
  for (std::size_t f = 0; f < original.face_count(); ++f) {
    const auto outline = original.outline(f);
    description.add_face(std::vector<PointId>(outline.rbegin(), outline.rend()),
                         original.face_material[f]);
  }
  return result;
}

Transformed permuted(const SceneDescription& original, std::uint64_t seed) {
  std::vector<int> order = same_faces(original);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
  return {fmt::format("faces permuted, seed {}", seed), testing::reordered(original, order), order};
}

/// Quadrilaterals that are convex are split along a diagonal.
Transformed split(const SceneDescription& original) {
  Transformed result{.how = "split", .description = {}, .face = {}};
  SceneDescription& description = result.description;
  description.points = original.points;
  description.materials = original.materials;
  for (std::size_t f = 0; f < original.face_count(); ++f) {
    const auto outline = original.outline(f);
    const auto corner = [&](std::size_t k) { return at(original.points, outline[k % 4]); };
    const auto turn = [&](std::size_t k) {
      return cross(corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1));
    };
    const auto add = [&](const std::vector<PointId>& part) {
      description.add_face(part, original.face_material[f]);
      result.face.push_back(static_cast<int>(f));
    };
    if (outline.size() == 4 && dot(turn(0), turn(1)) > 0 && dot(turn(1), turn(2)) > 0 &&
        dot(turn(2), turn(3)) > 0) {
      add({outline[0], outline[1], outline[2]});
      add({outline[0], outline[2], outline[3]});
    } else {
      add({outline.begin(), outline.end()});
    }
  }
  return result;
}

/// The scene with triangles of a millionth of its size, `distance` sizes away.
Transformed with_far_triangles(const SceneDescription& original, double distance,
                               std::uint64_t seed) {
  Transformed result{.how = fmt::format("with triangles {} sizes away, seed {}", distance, seed),
                     .description = original,
                     .face = same_faces(original)};
  const Bounds bounds = bounds_of(original);
  const double size = bounds.diagonal();
  const auto rotate = testing::random_rotation(seed);
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, -1, 0}}) {
    const Vec3 far = bounds.center() + distance * size * rotate(axis);
    auto& points = result.description.points;
    const auto first = static_cast<PointId>(points.size());
    // The triangles are perpendicular to the line to the scene, so that they hide next to nothing.
    points.push_back(far);
    points.push_back(far + 1e-6 * size * rotate({axis.y, axis.x, 0}));
    points.push_back(far + 1e-6 * size * rotate({0, 0, 1}));
    result.description.add_face(std::vector<PointId>{first, first + 1, first + 2}, 0);
    result.face.push_back(-1);
  }
  return result;
}

/// A random number per seed and use.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : generator_(seed * 0x9e3779b97f4a7c15U + 7) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  double power_of_ten(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  std::size_t pick(std::size_t count) { return generator_() % count; }

 private:
  std::mt19937_64 generator_;
};

constexpr int transformations = 7;

/// Transformation `which` of a scene, 0 to transformations - 1, with random parameters.
Transformed transformed(const SceneDescription& original, int which, std::uint64_t seed) {
  Numbers numbers(seed);
  const double size = bounds_of(original).diagonal();
  switch (which) {
    case 0:
      return moved_by(original, numbers.power_of_ten(0, 6) * size *
                                    testing::random_rotation(seed)(normalized({3, -2, 1})));
    case 1:
      return scaled(original, numbers.power_of_ten(-6, 6));
    case 2:
      return rotated(original, seed);
    case 3:
      return mirrored(original);
    case 4:
      return permuted(original, seed);
    case 5:
      return split(original);
    default:
      return with_far_triangles(original, numbers.power_of_ten(0, 6), seed);
  }
}

/// The transfers of one direction by faces and sides of the original scene, in its unit of length.
/// A side is twice the face's number, plus 1 for the back of a two-sided face.
struct AreasOfFaces {
  std::map<std::pair<int, int>, double> exchanges;
  std::map<int, Coverage> forward, backward;
};

/// A scene and an engine of each kind, for one transformation.
class TestedScene {
 public:
  /// @param bends whether the parts of patches that their file has bent are known to that bend only
  TestedScene(const Transformed& transformed, const SceneOptions& options, bool slow,
              bool bends = false)
      : scene_(std::make_shared<const Scene>(transformed.description, options)),
        tree_(std::make_shared<const BspTree>(*scene_)),
        turn_(transformed.turn),
        scale_(transformed.scale) {
    double coordinate = 0;
    for (const Vec3& p : scene_->points()) {
      coordinate = std::max(coordinate, max_abs(p));
    }
    displacement_ = 2 * std::sqrt(3.0) * 0x1p-53 * coordinate;
    for (PatchId i = 0; i < scene_->patch_count(); ++i) {
      const Patch& patch = scene_->patch(i);
      const auto outline = scene_->outline(i);
      double perimeter = 0;
      for (std::size_t k = 0; k < outline.size(); ++k) {
        perimeter +=
            norm(scene_->point(outline[(k + 1) % outline.size()]) - scene_->point(outline[k]));
      }
      const double bend = bend_of(i);
      const double known = displacement_ + (bend > displacement_ ? bend : 0);
      rounding_.push_back(known * perimeter);
      rounding_of_parts_ += (bends ? known : displacement_) * perimeter;
      const int face = at(transformed.face, patch.face);
      const bool back = options.two_sided && dot(patch.normal, normal_of_face(transformed, i)) < 0;
      side_.push_back(face < 0 ? -1 : 2 * face + (back ? 1 : 0));
    }
    const std::size_t fragments = tree_->fragments().size();
    for (const Engine engine : {Engine::fast, Engine::local, Engine::global, Engine::exact}) {
      if (engine == Engine::fast || engine == Engine::local || (slow && fragments <= 60)) {
        engines_.emplace_back(engine, make_engine(engine, scene_, tree_));
      }
    }
  }

  const Scene& scene() const { return *scene_; }
  std::size_t engine_count() const { return engines_.size(); }
  const std::string& engine_name(std::size_t k) const { return name_of(engines_[k].first); }
  Transfers run(std::size_t k, const Vec3& omega) const {
    return engines_[k].second(turn_(omega), {});
  }
  /// Bound on the change of the projected area of patch i by rounding, m².
  double rounding(PatchId i) const { return at(rounding_, i); }
  /// The same bound for the visible area of any patch.
  double rounding_of_parts() const { return rounding_of_parts_; }
  double rounding_of_parts_in_original_units() const {
    return rounding_of_parts_ / (scale_ * scale_);
  }
  double area(PatchId i) const { return scene_->patch(i).area; }
  bool is_added(PatchId i) const { return at(side_, i) < 0; }

  AreasOfFaces by_face(const Transfers& transfers) const {
    AreasOfFaces areas;
    const double unit = scale_ * scale_;
    for (const Transfer& t : transfers.exchanges) {
      if (at(side_, t.receiver) >= 0 && at(side_, t.source) >= 0) {
        areas.exchanges[{at(side_, t.receiver), at(side_, t.source)}] += t.area / unit;
      }
    }
    for (PatchId i = 0; i < scene_->patch_count(); ++i) {
      const auto add = [&](std::map<int, Coverage>& to, const Coverage& from) {
        to[at(side_, i)].projected += from.projected / unit;
        to[at(side_, i)].covered += from.covered / unit;
      };
      if (at(side_, i) >= 0) {
        add(areas.forward, at(transfers.forward, i));
        add(areas.backward, at(transfers.backward, i));
      }
    }
    return areas;
  }
  /// Areas by side, in the original's unit.
  std::map<int, double> areas() const {
    std::map<int, double> areas;
    for (PatchId i = 0; i < scene_->patch_count(); ++i) {
      areas[at(side_, i)] += area(i) / (scale_ * scale_);
    }
    return areas;
  }

 private:
  /// Largest distance of a patch's corners from the plane of its normal through their mean, m.
  double bend_of(PatchId i) const {
    const auto outline = scene_->outline(i);
    Vec3 mean;
    for (const PointId p : outline) {
      mean = mean + scene_->point(p) / static_cast<double>(outline.size());
    }
    double bend = 0;
    for (const PointId p : outline) {
      bend = std::max(bend, std::abs(dot(scene_->patch(i).normal, scene_->point(p) - mean)));
    }
    return bend;
  }
  Vec3 normal_of_face(const Transformed& transformed, PatchId i) const {
    const auto outline =
        transformed.description.outline(static_cast<std::size_t>(scene_->patch(i).face));
    const auto corner = [&](std::size_t k) {
      return at(transformed.description.points, outline[k]);
    };
    Vec3 doubled;
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
      doubled = doubled + cross(corner(k) - corner(0), corner(k + 1) - corner(0));
    }
    return doubled;
  }

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const BspTree> tree_;
  std::function<Vec3(const Vec3&)> turn_;
  double scale_ = 1;
  double displacement_ = 0;
  std::vector<double> rounding_;
  double rounding_of_parts_ = 0;
  std::vector<int> side_;
  std::vector<std::pair<Engine, TransferEngine>> engines_;
};

/// The largest fractions of the bounds that were found, by property.
class Table : public ::testing::Environment {
 public:
  void add(const std::string& property, double fraction) {
    double& worst = worst_[property];
    worst = std::max(worst, fraction);
  }
  void TearDown() override {
    for (const auto& [property, fraction] : worst_) {
      std::cout << fmt::format("  {:<50} {:8.1e} of the bound\n", property, fraction);
    }
  }

 private:
  std::map<std::string, double> worst_;
};
auto* const table = static_cast<Table*>(::testing::AddGlobalTestEnvironment(new Table));

void expect_near(const char* property, double value, double expected, double bound,
                 const std::function<std::string()>& where) {
  const double fraction = bound > 0           ? std::abs(value - expected) / bound
                          : value == expected ? 0
                                              : 2;
  table->add(property, fraction);
  EXPECT_LE(fraction, 1) << property << ": " << value << ", expected " << expected << " within "
                         << bound << ", " << where();
}

/// The projection of each patch follows from its normal; nothing is less than 0 or covered twice.
void expect_possible_areas(const TestedScene& tested, const Transfers& transfers,
                           const std::string& engine, bool closed, const std::string& context) {
  const Scene& scene = tested.scene();
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto where = [&] { return fmt::format("{}, patch {}, {}", engine, i, context); };
    const double area = tested.area(i), cosine = dot(scene.patch(i).normal, transfers.direction);
    for (const double side : {1.0, -1.0}) {
      const Coverage& c = at(side > 0 ? transfers.forward : transfers.backward, i);
      EXPECT_GE(c.projected, 0) << where();
      EXPECT_GE(c.covered, 0) << where();
      EXPECT_LE(c.projected, area * (1 + summed) + tested.rounding(i)) << where();
      expect_near("projected area", c.projected, std::max(side * cosine, 0.0) * area,
                  tested.rounding(i) + summed * area, where);
      const double closure = promised * area + tested.rounding_of_parts();
      expect_near("covered twice", std::max(c.covered - c.projected, 0.0), 0, closure, where);
      if (closed && !tested.is_added(i)) {
        expect_near("closure", c.covered, c.projected, closure, where);
      }
    }
    EXPECT_GE(at(transfers.back_seen, i), 0) << where();
  }
  for (const Transfer& t : transfers.exchanges) {
    EXPECT_GT(t.area, 0) << engine << ", A(" << t.receiver << ',' << t.source << "), " << context;
  }
}

/// Two results for the same faces, the second one perhaps with forward and backward exchanged.
void expect_same(const char* property, const AreasOfFaces& a, const AreasOfFaces& b,
                 const std::map<int, double>& areas, double rounding, const std::string& context) {
  auto differences = a.exchanges;
  for (const auto& [pair, area] : b.exchanges) {
    differences[pair] -= area;
  }
  for (const auto& [pair, difference] : differences) {
    const auto where = [&, p = pair] {
      return fmt::format("A({},{}), {}", p.first, p.second, context);
    };
    expect_near(property, difference, 0,
                promised * std::min(areas.at(pair.first), areas.at(pair.second)) + rounding, where);
  }
  for (const auto side : {&AreasOfFaces::forward, &AreasOfFaces::backward}) {
    for (const auto& [face, coverage] : a.*side) {
      const auto where = [&, f = face] { return fmt::format("face {}, {}", f, context); };
      const auto other = (b.*side).find(face);
      const Coverage there = other == (b.*side).end() ? Coverage{} : other->second;
      const double bound = promised * areas.at(face) + rounding;
      expect_near(property, coverage.projected, there.projected, bound, where);
      expect_near(property, coverage.covered, there.covered, bound, where);
    }
  }
}

AreasOfFaces from_other_side(const AreasOfFaces& areas) {
  AreasOfFaces result{{}, areas.backward, areas.forward};
  for (const auto& [pair, area] : areas.exchanges) {
    result.exchanges[{pair.second, pair.first}] = area;
  }
  return result;
}

/// Directions along two edges and in two planes of faces of the original, in addition to its own
/// directions.
std::vector<Vec3> directions_of(const RandomScene& random, Numbers numbers) {
  std::vector<Vec3> directions = random.directions;
  const SceneDescription& description = random.description;
  for (int n = 0; n < 2; ++n) {
    const auto outline = description.outline(numbers.pick(description.face_count()));
    const std::size_t k = numbers.pick(outline.size());
    const auto corner = [&](std::size_t m) {
      return at(description.points, outline[(k + m) % outline.size()]);
    };
    const Vec3 edge = normalized(corner(1) - corner(0));
    directions.push_back(edge);
    directions.push_back(
        normalized(normalized(corner(2) - corner(0)) + numbers.uniform(-1, 1) * edge));
  }
  return directions;
}

/// Whether the order or the size of faces decides which of coincident ones is seen; sizes may
/// differ by rounding only.
bool has_coincident_faces(const RandomScene& random) {
  return random.kind == "coincident faces" || random.kind == "stacks of tiles" ||
         random.kind == "snapped to a grid";
}

/// Tests one transformation of a scene along some directions of the original.
/// @param same whether areas are compared with the original
/// @param bends as for TestedScene
void expect_invariance(const RandomScene& random, const Transformed& changed,
                       const std::vector<Vec3>& directions, bool slow, bool same = true,
                       bool bends = false) {
  const TestedScene before({"", random.description, same_faces(random.description)}, random.options,
                           slow);
  const TestedScene after(changed, random.options, slow, bends);
  const std::map<int, double> areas = before.areas();
  const double rounding =
      before.rounding_of_parts() + changed.roundings * after.rounding_of_parts_in_original_units();
  for (const Vec3& omega : directions) {
    const std::string context = fmt::format("{}, {}, direction {},{},{}", random.description.name,
                                            changed.how, omega.x, omega.y, omega.z);
    std::vector<AreasOfFaces> found;
    for (std::size_t k = 0; k < after.engine_count(); ++k) {
      const std::string& engine = after.engine_name(k);
      const Transfers transfers = after.run(k, omega);
      expect_possible_areas(after, transfers, engine, random.closed, context);
      const std::string engine_in_context = fmt::format("{}, {}", engine, context);
      found.push_back(after.by_face(transfers));
      expect_same("reciprocity", found.back(), from_other_side(after.by_face(after.run(k, -omega))),
                  areas, after.rounding_of_parts_in_original_units(), engine_in_context);
      expect_same("agreement", found.front(), found.back(), areas,
                  after.rounding_of_parts_in_original_units(), engine_in_context);
      if (same && !has_coincident_faces(random) && k < before.engine_count()) {
        expect_same("invariance", found.back(), before.by_face(before.run(k, omega)), areas,
                    rounding, engine_in_context);
      }
    }
  }
}

void expect_invariance_of(std::uint64_t first, std::uint64_t count, std::uint64_t slow_every) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const RandomScene random = testing::random_scene(seed);
    const std::vector<Vec3> directions = directions_of(random, Numbers(seed));
    // Every second transformation moves the scene: moving matters most.
    const auto which = static_cast<int>(seed / 10 % (2 * (transformations - 1)));
    const int transformation = which % 2 == 0 ? 0 : 1 + which / 2;
    expect_invariance(random, transformed(random.description, transformation, seed), directions,
                      seed % slow_every == 0);
    if (::testing::Test::HasFailure()) {
      return;
    }
  }
}

class TransformedScenes : public ::testing::TestWithParam<int> {};
TEST_P(TransformedScenes, HaveTheSameAreas) {
  expect_invariance_of(static_cast<std::uint64_t>(GetParam()) * 60, 60, 61);
}
INSTANTIATE_TEST_SUITE_P(Sixties, TransformedScenes, ::testing::Range(0, 5));

class NightlyTransformedScenes : public ::testing::TestWithParam<int> {};
TEST_P(NightlyTransformedScenes, HaveTheSameAreas) {
  expect_invariance_of(static_cast<std::uint64_t>(GetParam()) * 500, 500, 11);
}
INSTANTIATE_TEST_SUITE_P(FiveHundreds, NightlyTransformedScenes, ::testing::Range(0, 20));

/// Directions along all edges.
std::vector<Vec3> edges_of(const SceneDescription& description) {
  std::vector<Vec3> edges;
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const auto outline = description.outline(f);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      edges.push_back(normalized(at(description.points, outline[(k + 1) % outline.size()]) -
                                 at(description.points, outline[k])));
    }
  }
  return edges;
}

/// Scenes to which engine fast gave areas below 0, or covered twice, far from the origin.
struct MovedScene {
  std::uint64_t seed;
  Vec3 offset;
};
class MovedScenes : public ::testing::TestWithParam<MovedScene> {};
TEST_P(MovedScenes, HaveTheSameAreasAlongAllTheirEdges) {
  const RandomScene random = testing::random_scene(GetParam().seed);
  const Transformed moved = moved_by(random.description, GetParam().offset);
  std::vector<Vec3> directions = random.directions;
  for (const Vec3& edge : edges_of(moved.description)) {
    directions.push_back(edge);
  }
  expect_invariance(random, moved, directions, false);
}
INSTANTIATE_TEST_SUITE_P(
    Regression, MovedScenes,
    ::testing::Values(
        MovedScene{104, {44.69400923835078, 65.441156811422914, 38.158402999011656}},
        MovedScene{106, {1e6, 2e6, -1e6}}, MovedScene{117, {1, 2, -1}},
        MovedScene{144, {997831.11148009857, 838303.99048117095, -603466.89003737469}},
        MovedScene{334, {-2454.8225405398675, 4048.7631957959388, 2787.441043730762}},
        MovedScene{508, {805413.78943060453, 941781.9160890832, -902433.37368576945}}),
    [](const auto& moved) { return std::to_string(moved.param.seed); });

/// Scenes as files have them, moved. Whether a bent face is one patch depends on the digits of its
/// coordinates, which a shift changes: they are not compared with the originals.
void expect_possible_areas_moved(std::uint64_t seed, double sizes, bool along_all_edges,
                                 bool slow) {
  const RandomScene random = testing::random_imperfect_scene(seed);
  std::vector<Vec3> directions = directions_of(random, Numbers(seed));
  for (const Vec3& edge : along_all_edges ? edges_of(random.description) : std::vector<Vec3>{}) {
    directions.push_back(edge);
    directions.push_back(normalized(edge + 1e-6 * normalized(cross(edge, {.3, .5, .2}))));
  }
  const Vec3 offset = sizes * bounds_of(random.description).diagonal() *
                      testing::random_rotation(seed)(normalized({3, -2, 1}));
  expect_invariance(random, moved_by(random.description, offset), directions, slow, false,
                    !along_all_edges);
}

/// Moved by 100 sizes and more: nearer, what is not promised along the edges of rounded scenes is
/// more than the roundings explain. Without the truss, whose triangles meet in their tips: where
/// they are closer to each other than planes are thick, their order is not promised (ALGORITHM.md,
/// section 8).
void expect_possible_areas_of_moved(std::uint64_t first, std::uint64_t count) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    if (testing::random_imperfect_scene(seed).kind == "truss") {
      continue;
    }
    expect_possible_areas_moved(seed, Numbers(seed).power_of_ten(2, 6), false, seed % 11 == 0);
    if (::testing::Test::HasFailure()) {
      return;
    }
  }
}

class MovedImperfectScenes : public ::testing::TestWithParam<int> {};
TEST_P(MovedImperfectScenes, HavePossibleAreas) {
  expect_possible_areas_of_moved(static_cast<std::uint64_t>(GetParam()) * 10, 10);
}
INSTANTIATE_TEST_SUITE_P(Tens, MovedImperfectScenes, ::testing::Range(3000, 3004));

class NightlyMovedImperfectScenes : public ::testing::TestWithParam<int> {};
TEST_P(NightlyMovedImperfectScenes, HavePossibleAreas) {
  expect_possible_areas_of_moved(static_cast<std::uint64_t>(GetParam()) * 250, 250);
}
INSTANTIATE_TEST_SUITE_P(TwoHundredFifties, NightlyMovedImperfectScenes,
                         ::testing::Range(120, 128));

/// Edges seen along their lengths: their directions are rounding, and whole faces were lost, of
/// 1.2e-6 m² where roundings explain 1e-6 m², of 0.086 m² of beams of 1,000 m.
TEST(MovedImperfectScenesRegression, HavePossibleAreasAlongAllTheirEdges) {
  for (const std::uint64_t seed : {31081, 31093}) {
    expect_possible_areas_moved(seed, 7e5, true, false);
  }
  expect_possible_areas_moved(30241, 4e5, true, false);
}

}  // namespace
}  // namespace transillum::transformed_scenes_test
