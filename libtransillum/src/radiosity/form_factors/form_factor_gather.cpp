// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors by rays from each patch, the conventional method to compare transillumination with.
// Start points on the patch and directions about its normal come from one four-dimensional
// lattice, shifted at random for each patch, so that they are even in all four dimensions and
// still unbiased. Input: a Scene and GatherOptions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/bit_mixing.h"
#include "radiosity/form_factors/form_factor_rows.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/form_factors.h"
#include "visibility/embree/embree_scene.h"

namespace transillum {
namespace {

constexpr std::size_t packet_size = 16;
/// Height above its patch at which a ray starts, in Embree's units: a few roundings of a
/// coordinate.
constexpr double lift = 1e-6;
/// Patches per thread between reports of progress.
constexpr PatchId batch = 64;

/// Coordinates in [0,1): two of the direction, two of the point.
using Sample = std::array<float, 4>;

/// The next number of splitmix64.
std::uint64_t random_bits(std::uint64_t& state) { return mixed(state += golden_step); }

/// Position along a Z-order curve (interleaved bits of both coordinates), which keeps neighbors of
/// the square together.
std::uint32_t place_on_curve(const Sample& sample) {
  const auto x = static_cast<std::uint32_t>(sample[0] * 65536);
  const auto y = static_cast<std::uint32_t>(sample[1] * 65536);
  std::uint32_t place = 0;
  for (int bit = 0; bit < 16; ++bit) {
    place |= (x >> bit & 1U) << (2 * bit) | (y >> bit & 1U) << (2 * bit + 1);
  }
  return place;
}

/// The first points of the additive lattice of the generalized golden ratio in four dimensions
/// (Roberts), ordered so that neighbors have similar directions, which makes packets of rays
/// coherent.
std::vector<Sample> make_lattice(int count) {
  constexpr double ratio = 1.1673039782614187;  // x^5 = x + 1
  std::vector<Sample> samples(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < samples.size(); ++k) {
    double step = 1;
    for (float& coordinate : samples[k]) {
      step /= ratio;
      const double at = static_cast<double>(k + 1) * step;
      coordinate = std::min(static_cast<float>(at - std::floor(at)), 0x1.fffffep-1F);
    }
  }
  std::stable_sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return place_on_curve(a) < place_on_curve(b);
  });
  return samples;
}

/// Maps the unit square to the unit disk, continuous and area-preserving
/// (Shirley and Chiu 1997): a radius and an angle of at most 45 degrees off an axis, whose sine
/// and cosine are series accurate to the last place of float.
void to_disk(float u, float v, float& x, float& y) {
  const float a = 2 * u - 1, b = 2 * v - 1;
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const float angle = radius == 0 ? 0.0F : 0.78539816F * (wide ? b : a) / radius;
  const float q = angle * angle;
  const float sine = angle * (1 + q * (-1 / 6.0F + q * (1 / 120.0F + q * (-1 / 5040.0F))));
  const float cosine = 1 + q * (-0.5F + q * (1 / 24.0F + q * (-1 / 720.0F + q / 40320.0F)));
  x = radius * (wide ? cosine : sine);
  y = radius * (wide ? sine : cosine);
}

float shifted(float coordinate, float shift) {
  const float sum = coordinate + shift;
  return sum < 1 ? sum : sum - 1;
}

struct Float3 {
  float x, y, z;
};
Float3 single(const Vec3& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// A triangle of a patch to sample: points corner + u·a + v·b with u + v <= 1.
struct SampledTriangle {
  float fraction_below;  ///< fraction of the patch's area in the triangles before this one
  float fraction;
  Float3 corner, a, b;
};

/// Shared by all rows; immutable.
struct Gathering {
  const Scene& scene;
  EmbreeScene embree;
  std::vector<Sample> lattice;
  std::uint64_t seed;
  std::vector<std::vector<std::uint32_t>> pieces_of;  ///< by patch

  Gathering(const Scene& gathered, const GatherOptions& options, const Cancellation& cancellation)
      : scene(gathered),
        embree(gathered, cancellation),
        lattice(make_lattice(options.rays_per_patch)),
        seed(options.seed),
        pieces_of(gathered.patches().size()) {
    for (std::size_t p = 0; p < scene.pieces().size(); ++p) {
      at(pieces_of, scene.pieces()[p].patch).push_back(static_cast<std::uint32_t>(p));
    }
  }
};

/// Computes rows of the matrix; one object per thread.
class RowGatherer {
 public:
  explicit RowGatherer(const Gathering& all) : all_(all), counts_(all.scene.patches().size()) {}

  FormFactorRow gather(PatchId i) {
    patch_ = i;
    set_frame();
    cut_into_triangles();
    for (std::size_t first = 0; first < all_.lattice.size(); first += packet_size) {
      trace(first);
    }
    return take_row();
  }

 private:
  /// Sets the frame and the lattice shift of the current patch.
  void set_frame() {
    const Vec3& n = all_.scene.patch(patch_).normal;
    const Vec3 u = normalized(cross(std::abs(n.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n));
    normal_ = single(n);
    u_ = single(u);
    v_ = single(cross(n, u));
    std::uint64_t state = all_.seed;
    state = random_bits(state) + static_cast<std::uint64_t>(patch_);
    for (float& shift : shift_) {
      shift = static_cast<float>(random_bits(state) >> 40) * 0x1p-24F;
    }
  }

  void cut_into_triangles() {
    const Vec3 up = lift * all_.scene.patch(patch_).normal;
    triangles_.clear();
    double total = 0;
    for (const std::uint32_t p : at(all_.pieces_of, patch_)) {
      const auto outline = all_.scene.corners(all_.scene.pieces()[p]);
      const auto at = [&](std::size_t k) {
        return all_.embree.inside(all_.scene.point(outline[k]));
      };
      for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        const Vec3 a = at(k) - at(0), b = at(k + 1) - at(0);
        const double area = norm(cross(a, b));
        triangles_.push_back({static_cast<float>(total), static_cast<float>(area),
                              single(at(0) + up), single(a), single(b)});
        total += area;
      }
    }
    for (SampledTriangle& triangle : triangles_) {
      triangle.fraction_below /= static_cast<float>(total);
      triangle.fraction /= static_cast<float>(total);
    }
  }

  /// A point of the patch. `s` selects the triangle; its position within the triangle's fraction is
  /// used again as a coordinate.
  Float3 point(float s, float t) const {
    std::size_t k = triangles_.size() - 1;
    while (k > 0 && s < triangles_[k].fraction_below) {
      --k;
    }
    const SampledTriangle& triangle = triangles_[k];
    const float root = std::sqrt(std::min((s - triangle.fraction_below) / triangle.fraction, 1.0F));
    const float a = root * (1 - t), b = root * t;
    return {triangle.corner.x + a * triangle.a.x + b * triangle.b.x,
            triangle.corner.y + a * triangle.a.y + b * triangle.b.y,
            triangle.corner.z + a * triangle.a.z + b * triangle.b.z};
  }

  /// Traces one packet: lattice points from `first` on.
  void trace(std::size_t first) {
    const std::size_t count = std::min(packet_size, all_.lattice.size() - first);
    alignas(64) std::array<int, packet_size> valid{};
    RTCRay16& rays = packet_.ray;
    for (std::size_t k = 0; k < count; ++k) {
      const Sample& sample = all_.lattice[first + k];
      float x = 0, y = 0;
      to_disk(shifted(sample[0], shift_[0]), shifted(sample[1], shift_[1]), x, y);
      const float z = std::sqrt(std::max(1 - x * x - y * y, 0.0F));
      const Float3 start = point(shifted(sample[2], shift_[2]), shifted(sample[3], shift_[3]));
      valid[k] = -1;
      rays.org_x[k] = start.x;
      rays.org_y[k] = start.y;
      rays.org_z[k] = start.z;
      rays.dir_x[k] = x * u_.x + y * v_.x + z * normal_.x;
      rays.dir_y[k] = x * u_.y + y * v_.y + z * normal_.y;
      rays.dir_z[k] = x * u_.z + y * v_.z + z * normal_.z;
      rays.tnear[k] = 0;
      rays.tfar[k] = HUGE_VALF;
      rays.mask[k] = ~0U;
      packet_.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    all_.embree.first_hits(valid.data(), packet_);
    for (std::size_t k = 0; k < count; ++k) {
      accumulate(k);
    }
  }

  void accumulate(std::size_t k) {
    if (packet_.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) {
      return;
    }
    const RTCRay16& rays = packet_.ray;
    const Vec3 direction{rays.dir_x[k], rays.dir_y[k], rays.dir_z[k]};
    const PatchId hit =
        all_.embree.lit_at(all_.embree.patch_of(packet_.hit.primID[k]),
                           {rays.org_x[k], rays.org_y[k], rays.org_z[k]}, direction, rays.tfar[k]);
    if (hit == no_patch || hit == patch_) {
      return;
    }
    if (at(counts_, hit)++ == 0) {
      seen_.push_back(hit);
    }
  }

  FormFactorRow take_row() {
    std::sort(seen_.begin(), seen_.end());
    const auto rays = static_cast<double>(all_.lattice.size());
    FormFactorRow row;
    row.reserve(seen_.size());
    for (const PatchId j : seen_) {
      row.emplace_back(j, std::exchange(at(counts_, j), 0U) / rays);
    }
    seen_.clear();
    return row;
  }

  const Gathering& all_;
  std::vector<std::uint32_t> counts_;  ///< by patch, of the current row
  std::vector<PatchId> seen_;          ///< patches with a count above 0
  PatchId patch_ = no_patch;
  Float3 normal_{}, u_{}, v_{};
  std::array<float, 4> shift_{};
  std::vector<SampledTriangle> triangles_;
  RTCRayHit16 packet_{};
};

}  // namespace

void GatherOptions::validate() const {
  if (rays_per_patch < 1 || rays_per_patch > 1 << 24) {
    throw InputError(fmt::format("rays: {} is not in the range 1 to {}", rays_per_patch, 1 << 24));
  }
  if (threads < 0 || threads > 4096) {
    throw InputError(fmt::format("threads: {} is not in the range 0 to 4096", threads));
  }
}

FormFactors gather_form_factors(const Scene& scene, const GatherOptions& options,
                                const Cancellation& cancellation,
                                const std::function<void(double)>& progress) {
  options.validate();
  const Gathering all(scene, options, cancellation);
  return gather_rows(
      {scene.patch_count(), options.threads, batch, std::numeric_limits<std::uint64_t>::max()},
      [&all] { return RowGatherer(all); }, cancellation, progress);
}

}  // namespace transillum
