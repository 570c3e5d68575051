// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Random pairs of faces in the positions in which form factors lose digits. Faces are made in
// planes of their own beside p, which is in z = 0; then everything is turned, scaled and rounded.
#include "support/pair_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace transillum::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array pair_kinds{"general",       "near-parallel", "near-perpendicular",
                                "near-coplanar", "common edge",   "common corner",
                                "cut by planes", "huge and tiny", "far"};

/// A place for a face, which is in the plane of x and y and lit from z.
struct Frame {
  Vec3 origin{}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3 at(double u, double v) const { return origin + u * x + v * y; }
  Frame turned(const Vec3& axis, double angle) const {
    const auto turn = [&](const Vec3& a) {
      return std::cos(angle) * a + std::sin(angle) * cross(axis, a) +
             ((1 - std::cos(angle)) * dot(axis, a)) * axis;
    };
    return {origin, turn(x), turn(y), turn(z)};
  }
  Frame at_place(const Vec3& place) const { return {place, x, y, z}; }
};

/// The frame of a face that shares the edge from (0, 0, 0) to (1, 0, 0) with a face in z = 0, y >
/// 0; the lit sides of both are `angle` apart.
Frame hinged(double angle) {
  const Vec3 x{-1, 0, 0}, y{0, std::cos(angle), std::sin(angle)};
  return {{1, 0, 0}, x, y, cross(x, y)};
}

class PairMaker {
 public:
  explicit PairMaker(std::uint64_t seed) : generator_(seed * 0x9e3779b97f4a7c15U + 11) {}

  PairScene make(std::size_t kind) {
    PairScene scene;
    scene.kind = pair_kinds[kind];
    scene.p = face({}, 1);
    double size = 1;
    const Frame frame = frame_of_q(kind, size);
    scene.q = face(frame, size);
    bend(scene.p, {}, 1);
    bend(scene.q, frame, size);
    return scene;
  }

  PairFace blocker(const PairScene& scene) {
    const int way = pick(6);
    const double size = uniform(0.2, 0.8);
    if (way == 0) {
      return convex(random_frame().at_place(0.5 * (middle(scene.p) + middle(scene.q))), size);
    }
    if (way <= 2) {
      const double tilt = log_uniform(1e-16, 1e-2);
      return convex(hinged(way == 1 ? uniform(0.1, 3) : pi + sign() * tilt), size);
    }
    if (way == 3) {
      return convex(random_frame(), size);
    }
    const double depth = way == 4 ? 0 : uniform(0, 0.2);
    return convex(hinged(uniform(0.5, 2.5)).at_place({uniform(0.3, 1), uniform(0.1, 0.5), -depth}),
                  size);
  }

  /// Turns, scales and rounds all faces, and divides them into parts.
  void finish(PairScene& scene, bool may_round) {
    const Frame frame = random_frame();
    const double scale = pick(3) == 0 ? log_uniform(1e-3, 1e3) : 1;
    const Vec3 offset = pick(2) == 0 ? Vec3{} : uniform(0, 10) * random_frame().x;
    const bool rounds = may_round && pick(4) == 0;
    std::vector<PairFace*> faces{&scene.p, &scene.q};
    for (PairFace& blocker : scene.blockers) {
      faces.push_back(&blocker);
    }
    for (PairFace* face : faces) {
      for (Vec3& c : face->outline) {
        c = scale * (c.x * frame.x + c.y * frame.y + c.z * frame.z + offset);
        if (rounds) {
          face->bend = std::max(face->bend, 0x1p-23 * max_abs(c) / scale);
          c = {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
        }
      }
      face->bend *= scale;
      divide(*face);
    }
  }

  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int pick(int count) { return static_cast<int>(generator_() % static_cast<unsigned>(count)); }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  double sign() { return pick(2) == 0 ? -1 : 1; }
  Frame random_frame() {
    Frame frame;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      frame = frame.turned(axis, uniform(0, 2 * pi));
    }
    return frame;
  }
  /// Lit toward a point of p, if p sees the place.
  Frame facing_frame(const Vec3& place) {
    const Frame frame = random_frame().at_place(place);
    return dot(frame.z, Vec3{0.5, 0.3, 0} - place) < 0 ? frame.turned(frame.x, pi) : frame;
  }

  Frame frame_of_q(std::size_t kind, double& size) {
    const double tiny = log_uniform(1e-16, 1e-3);
    const Vec3 aside{uniform(-1, 1), uniform(-1, 1), 0};
    switch (kind) {
      case 1:
        return hinged(tiny * sign()).at_place(aside + Vec3{1, 0, log_uniform(1e-3, 3)});
      case 2:
        return hinged(pi / 2 + tiny * sign())
            .at_place({uniform(0, 2), uniform(-0.5, 0), uniform(-0.3, 0.5)});
      case 3:
        return hinged(pi - log_uniform(1e-12, 1e-2) * sign())
            .at_place({uniform(0, 2), uniform(-1, 0), log_uniform(1e-12, 1e-2) * sign()});
      case 4: {
        const Frame frame = hinged(pick(2) == 0 ? uniform(0.05, 3.1) : pi - 10 * tiny);
        const double apart = pick(2) * log_uniform(1e-17, 1e-12);
        return frame.at_place(frame.origin + apart * random_frame().x);
      }
      case 5:
        return facing_frame({});
      case 6:
        return random_frame().at_place({uniform(0, 1), uniform(0, 0.5), uniform(-0.5, 0.5)});
      case 7:
        size = log_uniform(1e-6, 1e-2);
        return facing_frame({uniform(-0.5, 1.5), uniform(-0.5, 1), log_uniform(1e-5, 1)});
      case 8:
        size = log_uniform(1e-2, 1);
        return facing_frame(log_uniform(1e2, 1e6) * random_frame().x);
      default:
        return facing_frame({uniform(-2, 2), uniform(-2, 2), log_uniform(0.1, 4)});
    }
  }

  /// The first edge is along x from the origin.
  PairFace convex(const Frame& frame, double size) {
    const double height = size * uniform(0.3, 1.5), right = size * uniform(0.6, 1.3),
                 left = size * uniform(-0.3, 0.4);
    PairFace face;
    face.outline = {frame.origin, frame.at(size, 0)};
    const int corners = 3 + pick(3);
    if (corners == 5) {
      face.outline.push_back(frame.at(right + 0.2 * size, 0.8 * height));
    }
    face.outline.push_back(frame.at(corners == 5 ? 0.5 * size : right, height));
    if (corners > 3) {
      face.outline.push_back(frame.at(left, uniform(0.5, 0.8) * height));
    }
    return face;
  }
  PairFace face(const Frame& frame, double size) {
    if (pick(3) != 0) {
      return convex(frame, size);
    }
    const double in = size * uniform(0.1, 0.9), height = uniform(0.3, 1.5);
    return {{frame.origin, frame.at(size, 0), frame.at(in / 2, height * in / 2),
             frame.at(0, height * size)},
            {},
            0};
  }
  void bend(PairFace& face, const Frame& frame, double size) {
    if (face.outline.size() == 4 && pick(2) == 0) {
      face.bend = size * log_uniform(1e-16, 1e-3);
      Vec3& corner = face.outline[static_cast<std::size_t>(pick(4))];
      corner = corner + sign() * face.bend * frame.z;
    }
  }

  static Vec3 middle(const PairFace& face) {
    Vec3 sum;
    for (const Vec3& c : face.outline) {
      sum = sum + c;
    }
    return sum / static_cast<double>(face.outline.size());
  }

  /// A fan, about the reflex corner if there is one.
  static void divide(PairFace& face) {
    const auto& outline = face.outline;
    const std::size_t n = outline.size();
    if (n == 3 || face.bend == 0) {
      bool convex = true;
      for (std::size_t k = 0; k < n; ++k) {
        convex = convex && !is_reflex(outline, k);
      }
      if (convex) {
        face.parts = {outline};
        return;
      }
    }
    std::size_t first = 0;
    for (std::size_t k = 0; k < n; ++k) {
      first = is_reflex(outline, k) ? k : first;
    }
    for (std::size_t k = 1; k + 1 < n; ++k) {
      face.parts.push_back(
          {outline[first], outline[(first + k) % n], outline[(first + k + 1) % n]});
    }
  }
  static bool is_reflex(const std::vector<Vec3>& outline, std::size_t k) {
    const std::size_t n = outline.size();
    Vec3 normal;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      normal = normal + cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
    }
    const Vec3 &a = outline[(k + n - 1) % n], &b = outline[k], &c = outline[(k + 1) % n];
    return dot(normal, cross(b - a, c - b)) < 0;
  }

  std::mt19937_64 generator_;
};

}  // namespace

SceneDescription PairScene::description() const {
  SceneDescription description;
  description.materials = {{"gray", {0.5, 0.5, 0.5}, {}}};
  const auto add = [&](const PairFace& face) {
    std::vector<PointId> corners;
    for (const Vec3& c : face.outline) {
      corners.push_back(static_cast<PointId>(description.points.size()));
      description.points.push_back(c);
    }
    description.add_face(corners, 0);
  };
  add(p);
  add(q);
  for (const PairFace& blocker : blockers) {
    add(blocker);
  }
  return description;
}

PairScene random_pair(std::uint64_t seed) {
  PairMaker maker(seed);
  const std::size_t kind = seed % pair_kinds.size();
  PairScene scene = maker.make(kind);
  maker.finish(scene, kind < 7);
  return scene;
}

PairScene random_blocked_pair(std::uint64_t seed) {
  constexpr std::array<std::size_t, 4> base{0, 1, 2, 4};
  PairMaker maker(seed);
  PairScene scene = maker.make(base[seed % base.size()]);
  for (int k = 1 + maker.pick(2); k > 0; --k) {
    scene.blockers.push_back(maker.blocker(scene));
  }
  maker.finish(scene, true);
  return scene;
}

ReferenceExchange reference_exchange(const PairScene& scene, double relative, double absolute,
                                     int most_parts) {
  std::vector<ConvexPolygon> blockers;
  for (const PairFace& blocker : scene.blockers) {
    blockers.insert(blockers.end(), blocker.parts.begin(), blocker.parts.end());
  }
  ReferenceExchange sum;
  for (const ConvexPolygon& p : scene.p.parts) {
    for (const ConvexPolygon& q : scene.q.parts) {
      const ReferenceExchange part =
          reference_exchange(p, q, blockers, relative, absolute, most_parts);
      sum.area += part.area;
      sum.error += part.error;
      sum.reached = sum.reached && part.reached;
    }
  }
  return sum;
}

}  // namespace transillum::testing
