// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lobes against random walks (ALGORITHM.md, oracle 6c): a path tracer that shares nothing with the
// solver but the scene and Embree's rays. Where a path meets a patch, it continues from a random
// point of the patch, because the radiance of a patch is its mean over the patch. The test also
// checks the rate at which the error decreases with the number of passes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "transillum/solution.h"
#include "transillum/solve_session.h"
#include "visibility/embree/picking.h"

namespace transillum::glossy_paths_test {
namespace {

using testing::Sketch;

constexpr double pi = std::numbers::pi;

double sum(const Rgb& v) { return v.r + v.g + v.b; }

/// The lobe in the limit of infinitely many directions, from its definition: s by a quadrature of
/// its own.
class Lobed {
 public:
  explicit Lobed(const Lobe& lobe) : lobe_(lobe), alpha_(lobe.roughness * lobe.roughness) {
    std::vector<double> matrix(count * count);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t m = 0; m < count; ++m) {
        double mean = 0;
        for (int a = 0; a < azimuths; ++a) {
          mean += shape(direction(angle(k), 0), direction(angle(m), 2 * pi * (a + 0.5) / azimuths));
        }
        matrix[k * count + m] =
            2 * pi * mean / azimuths * std::sin(angle(m)) * std::cos(angle(m)) * pi / 2 / count;
      }
    }
    scales_.assign(count, 1.0);
    for (int sweep = 0; sweep < 100; ++sweep) {
      std::vector<double> next(count);
      for (std::size_t k = 0; k < count; ++k) {
        double total = 0;
        for (std::size_t m = 0; m < count; ++m) {
          total += matrix[k * count + m] * scales_[m];
        }
        next[k] = std::sqrt(scales_[k] / total);
      }
      scales_ = next;
    }
  }

  /// 1/sr, of two directions above the surface with the normal (0, 0, 1).
  double value(const Vec3& a, const Vec3& b) const { return shape(a, b) * scale(a.z) * scale(b.z); }
  /// Samples b about the mirror direction of a; and the density of doing so.
  Vec3 sample(const Vec3& a, double u, double v) const {
    if (lobe_.shape == LobeShape::phong) {
      const double c = std::pow(u, 1 / (lobe_.exponent + 1));
      return around({-a.x, -a.y, a.z}, c, 2 * pi * v);
    }
    const double tangent2 = alpha_ * alpha_ * u / (1 - u);
    const Vec3 half = direction(std::atan(std::sqrt(tangent2)), 2 * pi * v);
    return 2 * dot(a, half) * half - a;
  }
  double density(const Vec3& a, const Vec3& b) const {
    if (lobe_.shape == LobeShape::phong) {
      const double c = std::max(2 * a.z * b.z - dot(a, b), 0.0);
      return (lobe_.exponent + 1) / (2 * pi) * std::pow(c, lobe_.exponent);
    }
    const Vec3 half = normalized(a + b);
    const double alpha2 = alpha_ * alpha_;
    const double base = half.z * half.z * (alpha2 - 1) + 1;
    return alpha2 * half.z / (pi * base * base) / (4 * std::abs(dot(a, half)));
  }
  const Rgb& fraction() const { return lobe_.reflectance; }

 private:
  static constexpr std::size_t count = 240;
  static constexpr int azimuths = 240;
  static double angle(std::size_t k) {
    return pi / 2 * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
  }
  static Vec3 direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  }
  static Vec3 around(const Vec3& axis, double cosine, double phi) {
    const Vec3 aside = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = normalized(cross(aside, axis)), y = cross(axis, x);
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    return sine * std::cos(phi) * x + sine * std::sin(phi) * y + cosine * axis;
  }
  double shape(const Vec3& a, const Vec3& b) const {
    if (lobe_.shape == LobeShape::phong) {
      return std::pow(std::max(2 * a.z * b.z - dot(a, b), 0.0), lobe_.exponent);
    }
    const Vec3 half = normalized(a + b);
    return std::pow(half.z * half.z * (alpha_ * alpha_ - 1) + 1, -2);
  }
  double scale(double cosine) const {
    const double place = std::acos(std::min(cosine, 1.0)) / (pi / 2) * count - 0.5;
    const double low = std::floor(std::clamp(place, 0.0, count - 2.0));
    const auto k = static_cast<std::size_t>(low);
    const double part = place - low;
    return (1 - part) * scales_[k] + part * scales_[k + 1];
  }

  Lobe lobe_;
  double alpha_;
  std::vector<double> scales_;
};

/// Irradiance of patches and radiance toward a direction by random walks.
class PathTracer {
 public:
  PathTracer(std::shared_ptr<const Scene> scene, const Sky& sky, std::uint64_t seed)
      : scene_(std::move(scene)), sky_(sky), picker_(scene_), random_(seed) {
    for (const Material& m : scene_->materials()) {
      lobes_.push_back(m.lobe.present() ? std::make_unique<Lobed>(m.lobe) : nullptr);
    }
    pieces_.resize(scene_->patches().size());
    for (const Piece& piece : scene_->pieces()) {
      at(pieces_, piece.patch).push_back(&piece);
    }
    offset_ = 1e-5 * scene_->bounds().diagonal();
  }

  struct Estimate {
    double mean = 0, error = 0;  ///< standard error
  };
  Estimate irradiance(PatchId i, int paths) {
    return mean_of(paths, [&] {
      const Vec3 local = diffuse_direction();
      return pi * sum(arriving(i, local));
    });
  }
  /// The radiance that patch i reflects and emits toward a direction.
  Estimate radiance(PatchId i, const Vec3& toward, int paths) {
    return mean_of(paths, [&] { return sum(leaving(i, to_local(i, toward), {1, 1, 1})); });
  }

 private:
  template <class Sample>
  Estimate mean_of(int count, Sample sample) {
    double total = 0, squares = 0;
    for (int k = 0; k < count; ++k) {
      const double value = sample();
      total += value;
      squares += value * value;
    }
    const double mean = total / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / (count - 1))};
  }
  double uniform() { return std::uniform_real_distribution<double>()(random_); }
  Vec3 diffuse_direction() {
    const double r = std::sqrt(uniform()), phi = 2 * pi * uniform();
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r)};
  }
  struct Frame {
    Vec3 x, y, z;
  };
  Frame frame(PatchId i) const {
    const Vec3 z = scene_->patch(i).normal;
    const Vec3 aside = std::abs(z.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = normalized(cross(aside, z));
    return {x, cross(z, x), z};
  }
  Vec3 to_local(PatchId i, const Vec3& v) const {
    const Frame f = frame(i);
    return {dot(v, f.x), dot(v, f.y), dot(v, f.z)};
  }
  Vec3 to_world(PatchId i, const Vec3& v) const {
    const Frame f = frame(i);
    return v.x * f.x + v.y * f.y + v.z * f.z;
  }
  /// A uniform point of patch i.
  Vec3 point_of(PatchId i) {
    double rest = uniform() * scene_->patch(i).area;
    Vec3 last;
    for (const Piece* piece : at(pieces_, i)) {
      const auto corners = scene_->corners(*piece);
      for (std::size_t k = 2; k < corners.size(); ++k) {
        const Vec3 a = scene_->point(corners[0]);
        const Vec3 u = scene_->point(corners[k - 1]) - a, v = scene_->point(corners[k]) - a;
        const double area = norm(cross(u, v)) / 2;
        double s = uniform(), t = uniform();
        if (s + t > 1) {
          s = 1 - s;
          t = 1 - t;
        }
        last = a + s * u + t * v;
        if (rest < area) {
          return last;
        }
        rest -= area;
      }
    }
    return last;
  }
  /// Radiance that arrives at a random point of patch i from a direction.
  Rgb arriving(PatchId i, const Vec3& local, const Rgb& weight = {1, 1, 1}) {
    const Vec3 omega = to_world(i, local);
    const auto hit = picker_.first_hit(point_of(i) + offset_ * omega, omega);
    if (!hit) {
      return sky_.relative_radiance(omega) / pi * (weight * sky_.exitance);
    }
    if (!hit->lit_side) {
      return {};
    }
    return leaving(hit->patch, to_local(hit->patch, -omega), weight);
  }
  Rgb leaving(PatchId j, const Vec3& out, const Rgb& weight) {
    const Material& material = scene_->material(j);
    Rgb light = 1 / pi * (weight * material.exitance);
    const Lobed* lobe = at(lobes_, scene_->patch(j).material).get();
    const double part = lobe == nullptr ? 0.0 : 0.5;
    const Vec3 in =
        uniform() < part ? lobe->sample(out, uniform(), uniform()) : diffuse_direction();
    if (in.z <= 0 || out.z <= 0) {
      return light;
    }
    Rgb reflected = 1 / pi * material.reflectance;
    double density = (1 - part) * in.z / pi;
    if (lobe != nullptr) {
      reflected += lobe->value(in, out) * lobe->fraction();
      density += part * lobe->density(out, in);
    }
    const Rgb next = in.z / density * (weight * reflected);
    const double survival = std::min(max_abs(next), 1.0);
    if (uniform() < survival) {
      light += arriving(j, in, 1 / survival * next);
    }
    return light;
  }

  std::shared_ptr<const Scene> scene_;
  Sky sky_;
  Picker picker_;
  std::mt19937_64 random_;
  std::vector<std::unique_ptr<Lobed>> lobes_;
  std::vector<std::vector<const Piece*>> pieces_;
  double offset_ = 0;
};

Lobe phong(const Rgb& fraction, double exponent) {
  Lobe lobe{.reflectance = fraction};
  lobe.exponent = exponent;
  return lobe;
}

Lobe ggx(const Rgb& fraction, double roughness) {
  Lobe lobe{.reflectance = fraction, .shape = LobeShape::ggx};
  lobe.roughness = roughness;
  return lobe;
}

struct Problem {
  std::shared_ptr<const Scene> scene;
  Sky sky = {};
};

/// A room lit by the middle of its ceiling, with a shining floor.
Problem shining_floor() {
  Sketch sketch("shining floor");
  const int wall = sketch.material(0.6, 0), lamp = sketch.material(0.3, 5);
  const int floor = sketch.material(0.2, 0);
  const Vec3 x{2, 0, 0}, y{0, 3, 0}, z{0, 0, 1.5};
  sketch.grid({}, x, y, 3, [=](double, double) { return floor; });
  sketch.grid({0, 0, 1.5}, y, x, 3, [=](double s, double t) {
    return std::abs(s - 0.5) < 0.2 && std::abs(t - 0.5) < 0.2 ? lamp : wall;
  });
  for (const auto& [corner, u, v] :
       {std::tuple{Vec3{}, y, z}, {Vec3{2, 0, 0}, z, y}, {Vec3{}, z, x}, {Vec3{0, 3, 0}, x, z}}) {
    sketch.grid(corner, u, v, 2, [=](double, double) { return wall; });
  }
  SceneDescription d = sketch.description();
  at(d.materials, wall).reflectance = {0.7, 0.5, 0.3};
  at(d.materials, floor).lobe = phong({0.6, 0.6, 0.7}, 20);
  return {std::make_shared<const Scene>(d)};
}

/// A metal box in a room with one glossy wall.
Problem metal_box() {
  Sketch sketch("metal box");
  const int wall = sketch.material(0.5, 0), lamp = sketch.material(0, 3);
  const int metal = sketch.material(0, 0), shining = sketch.material(0.1, 0);
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  sketch.grid({}, x, y, 2, [=](double, double) { return wall; });
  sketch.grid(z, y, x, 2, [=](double s, double) { return s < 0.5 ? lamp : wall; });
  sketch.grid({}, y, z, 2, [=](double, double) { return shining; });
  sketch.grid(x, z, y, 2, [=](double, double) { return wall; });
  sketch.grid({}, z, x, 2, [=](double, double) { return wall; });
  sketch.grid(y, x, z, 2, [=](double, double) { return wall; });
  sketch.box({0.35, 0.3, 0.2}, {0.65, 0.75, 0.6}, false, metal);
  SceneDescription d = sketch.description();
  at(d.materials, metal).lobe = ggx({0.9, 0.7, 0.4}, 0.6);
  at(d.materials, shining).lobe = phong({0.5, 0.6, 0.4}, 6);
  return {std::make_shared<const Scene>(d)};
}

/// Two shining boards and a block under an overcast sky.
Problem outside() {
  Sketch sketch("outside");
  const int ground = sketch.material(0.3, 0), board = sketch.material(0.1, 0);
  const int block = sketch.material(0.5, 1);
  sketch.grid({}, {2, 0, 0}, {0, 2, 0}, 3, [=](double, double) { return ground; });
  sketch.grid({0, 0, 0.02}, {0, 2, 0}, {0, 0, 1}, 2, [=](double, double) { return board; });
  sketch.box({1.2, 0.6, 0.1}, {1.7, 1.4, 0.5}, false, block);
  SceneDescription d = sketch.description();
  at(d.materials, ground).lobe = phong({0.3, 0.3, 0.5}, 12);
  at(d.materials, board).lobe = ggx({0.8, 0.8, 0.8}, 0.55);
  Sky sky;
  sky.exitance = {2, 3, 4};
  sky.model = SkyModel::cie_overcast;
  return {std::make_shared<const Scene>(d), sky};
}

/// Compares by patch: each difference over its standard error has mean square 1 where both agree.
void expect_agreement(const Problem& problem, int directions, int paths) {
  const Solution solution =
      solve(problem.scene,
            {.directions = directions, .tolerance = 1e-8, .sky = problem.sky, .glossy = true});
  ASSERT_NE(solution.glossy, nullptr);
  PathTracer tracer(problem.scene, problem.sky, 12345);
  const Vec3 eye = problem.scene->bounds().center() + Vec3{0.13, 0.21, 0.37};
  double squares = 0, worst = 0, error = 0, size = 0;
  int compared = 0;
  const auto compare = [&](double ours, const PathTracer::Estimate& theirs) {
    if (theirs.error == 0) {
      EXPECT_NEAR(ours, theirs.mean, 1e-12);
      return;
    }
    const double ratio = (ours - theirs.mean) / theirs.error;
    squares += ratio * ratio;
    worst = std::max(worst, std::abs(ratio));
    error += theirs.error;
    size += theirs.mean;
    ++compared;
  };
  for (PatchId i = 0; i < problem.scene->patch_count(); ++i) {
    compare(sum(at(solution.irradiance, i)), tracer.irradiance(i, paths));
    const Vec3 toward = normalized(eye - problem.scene->patch(i).center);
    if (solution.glossy->is_glossy(i) && dot(toward, problem.scene->patch(i).normal) > 0.1) {
      compare(sum(solution.glossy->radiance(i, toward)), tracer.radiance(i, toward, paths));
    }
  }
  ASSERT_GT(compared, 20);
  ::testing::Test::RecordProperty("values", compared);
  std::printf(
      "%s: %d values, standard error %.2f %%, RMS of difference over it %.3f, largest %.2f\n",
      problem.scene->name().c_str(), compared, 100 * error / size, std::sqrt(squares / compared),
      worst);
  // 99.9 % quantiles of both, for errors of the walks alone.
  EXPECT_LE(squares / compared, 1 + 3.1 * std::sqrt(2.0 / compared));
  EXPECT_LE(worst, 4.5);
}

TEST(GlossyPaths, AgreeInARoomWithAShiningFloor) {
  expect_agreement(shining_floor(), 2048, 200'000);
}
TEST(GlossyPaths, AgreeWithAMetalBox) { expect_agreement(metal_box(), 2048, 50'000); }
TEST(GlossyPaths, AgreeUnderASky) { expect_agreement(outside(), 2048, 50'000); }

/// RMS error of B against 4,096 passes of another rotation: as for diffuse light, nearly as 1/M.
TEST(GlossyConvergence, ErrorsDecreaseWithTheNumberOfPasses) {
  const Problem problem = shining_floor();
  const auto solved = [&](int directions, std::uint64_t rotation) {
    return solve(
               problem.scene,
               {.directions = directions, .rotation = rotation, .tolerance = 1e-9, .glossy = true})
        .radiosity;
  };
  const std::vector<Rgb> reference = solved(4096, 99);
  std::vector<double> errors;
  for (const int directions : {32, 128, 512}) {
    double mean = 0, size = 0;
    constexpr int rotations = 3;
    for (std::uint64_t r = 1; r <= rotations; ++r) {
      const std::vector<Rgb> b = solved(directions, r);
      for (std::size_t i = 0; i < b.size(); ++i) {
        mean += std::pow(sum(b[i] - reference[i]), 2) / rotations;
        size += std::pow(sum(reference[i]), 2) / rotations;
      }
    }
    errors.push_back(std::sqrt(mean / size));
    std::printf("M = %d: %.3e\n", directions, errors.back());
  }
  const double slope = std::log(errors[2] / errors[0]) / std::log(16.0);
  std::printf("slope %.2f\n", slope);
  EXPECT_LE(slope, -0.75);
}

}  // namespace
}  // namespace transillum::glossy_paths_test
