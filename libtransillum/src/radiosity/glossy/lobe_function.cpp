// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lobes as functions of two directions, and what a solve makes of a material's lobe.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/text_file.h"
#include "radiosity/glossy/lobe_kernel.h"
#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

using std::numbers::pi;

struct Node {
  double at = 0, weight = 0;
};

/// Gauss–Legendre nodes on [0, 1].
std::vector<Node> gauss_nodes(int count) {
  std::vector<Node> nodes;
  for (int k = 0; k < count; ++k) {
    double x = std::cos(pi * (k + 0.75) / (count + 0.5)), slope = 1;
    for (int step = 0; step < 20; ++step) {
      double last = 1, value = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * last) / n;
        last = value;
        value = next;
      }
      slope = count * (last - x * value) / (1 - x * x);
      x -= value / slope;
    }
    nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

/// Integrals of a kernel over the azimuth between two directions. Nodes are dense about the
/// mirror's azimuth, pi: GGX is narrow there where both directions are at grazing angles.
class Azimuth {
 public:
  Azimuth(const LobeKernel& kernel, int count) : kernel_(kernel) {
    for (const Node& node : gauss_nodes(count)) {
      cosines_.push_back(std::cos(pi * (1 - node.at * node.at)));
      weights_.push_back(4 * pi * node.at * node.weight);
    }
  }
  double integral(double theta, double other) const {
    const double cosine = std::cos(theta), other_cosine = std::cos(other);
    const double c = cosine * other_cosine, s = std::sin(theta) * std::sin(other);
    double sum = 0;
    for (std::size_t k = 0; k < cosines_.size(); ++k) {
      sum += weights_[k] * kernel_.value(cosine, other_cosine, c + s * cosines_[k]);
    }
    return sum;
  }

 private:
  const LobeKernel& kernel_;
  std::vector<double> cosines_, weights_;
};

}  // namespace

struct LobeFunction::Impl {
  Impl(const Lobe& lobe, const Cancellation& cancellation) : kernel(lobe) {
    const double root = std::sqrt(std::min(kernel.exponent(), 4e3));
    const Azimuth azimuth(kernel, 64 + static_cast<int>(8 * root));
    const std::vector<Node> nodes = gauss_nodes(48 + static_cast<int>(3 * root));
    const std::vector<double> scales = scales_at(nodes, azimuth, cancellation);
    logarithms.resize(intervals + 1);
    for (std::size_t k = 0; k <= intervals; ++k) {
      cancellation.throw_if_canceled();
      const double theta = angle_of(static_cast<double>(k) / intervals);
      double sum = 0;
      for (std::size_t m = 0; m < nodes.size(); ++m) {
        sum += weight_of(nodes[m]) * azimuth.integral(theta, angle_of(nodes[m].at)) * scales[m];
      }
      // Lobes narrower than the distance of nodes may fall between them.
      const auto nearest =
          std::min(nodes.size() - 1,
                   static_cast<std::size_t>(static_cast<double>(k * nodes.size()) / intervals));
      logarithms[k] = -std::log(std::max(sum, 0.1 / scales[nearest]));
    }
  }

  /// Angles from 0 to pi/2 by a place from 0 to 1: dense toward grazing ones, where s changes most.
  static double angle_of(double place) { return pi / 2 * (1 - (1 - place) * (1 - place)); }
  /// Weight of a node in an integral over the hemisphere with the cosine, less the azimuth.
  static double weight_of(const Node& node) {
    const double theta = angle_of(node.at);
    return pi * (1 - node.at) * node.weight * std::sin(theta) * std::cos(theta);
  }
  /// s at the nodes: s sum_m w_m p_m s_m = 1, by the damped form of Sinkhorn's iteration.
  static std::vector<double> scales_at(const std::vector<Node>& nodes, const Azimuth& azimuth,
                                       const Cancellation& cancellation) {
    const std::size_t n = nodes.size();
    std::vector<double> matrix(n * n);
    for (std::size_t k = 0; k < n; ++k) {
      cancellation.throw_if_canceled();
      for (std::size_t m = k; m < n; ++m) {
        const double value = azimuth.integral(angle_of(nodes[k].at), angle_of(nodes[m].at));
        matrix[k * n + m] = value;
        matrix[m * n + k] = value;
      }
    }
    std::vector<double> scales(n, 1.0), sums(n);
    constexpr int most_sweeps = 200;
    constexpr double tolerance = 1e-13;
    double worst = 1;
    for (int sweep = 0; sweep < most_sweeps && worst > tolerance; ++sweep) {
      worst = 0;
      for (std::size_t k = 0; k < n; ++k) {
        sums[k] = 0;
        for (std::size_t m = 0; m < n; ++m) {
          sums[k] += matrix[k * n + m] * weight_of(nodes[m]) * scales[m];
        }
      }
      for (std::size_t k = 0; k < n; ++k) {
        worst = std::max(worst, std::abs(scales[k] * sums[k] - 1));
        scales[k] = std::sqrt(scales[k] / sums[k]);
      }
    }
    return scales;
  }

  static constexpr std::size_t intervals = 128;
  LobeKernel kernel;
  std::vector<double> logarithms;  ///< logarithms of s, at equal steps of the place
};

LobeFunction::LobeFunction(const Lobe& lobe, const Cancellation& cancellation)
    : impl_(std::make_unique<Impl>(lobe, cancellation)) {}
LobeFunction::~LobeFunction() = default;
LobeFunction::LobeFunction(LobeFunction&&) noexcept = default;
LobeFunction& LobeFunction::operator=(LobeFunction&&) noexcept = default;

double LobeFunction::scale(double cosine) const {
  const double rest = 1 - std::acos(std::clamp(cosine, 0.0, 1.0)) / (pi / 2);
  const double place = (1 - std::sqrt(std::max(rest, 0.0))) * static_cast<double>(Impl::intervals);
  const std::size_t k = std::min(static_cast<std::size_t>(place), Impl::intervals - 1);
  const double part = place - static_cast<double>(k);
  return std::exp((1 - part) * impl_->logarithms[k] + part * impl_->logarithms[k + 1]);
}

double LobeFunction::value(const Vec3& a, const Vec3& b, const Vec3& normal) const {
  const double cosine_a = dot(a, normal), cosine_b = dot(b, normal);
  if (!(cosine_a > 0) || !(cosine_b > 0)) {
    return 0;
  }
  return impl_->kernel.value(cosine_a, cosine_b, dot(a, b)) * scale(cosine_a) * scale(cosine_b);
}

Lobe used_lobe(const Material& material) {
  constexpr double nearly_all = 1 - 1e-6;
  Lobe lobe = material.lobe;
  const auto lower = [](double& fraction, double rho) {
    if (rho + fraction > nearly_all) {
      fraction = std::max(ReadOptions::default_max_reflectance - rho, 0.0);
    }
  };
  lower(lobe.reflectance.r, material.reflectance.r);
  lower(lobe.reflectance.g, material.reflectance.g);
  lower(lobe.reflectance.b, material.reflectance.b);
  return lobe;
}

bool has_lobes(const Scene& scene) {
  return std::any_of(scene.patches().begin(), scene.patches().end(), [&](const Patch& patch) {
    return used_lobe(at(scene.materials(), patch.material)).present();
  });
}

std::vector<PatchId> patches_with_lobes(const Scene& scene) {
  std::vector<PatchId> patches;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (used_lobe(scene.material(i)).present()) {
      patches.push_back(i);
    }
  }
  return patches;
}

double resolved_exponent(int directions) { return directions / 10.0; }

std::vector<std::string> lobe_warnings(const Scene& scene, int directions) {
  std::set<std::int32_t> used;
  for (const Patch& patch : scene.patches()) {
    used.insert(patch.material);
  }
  constexpr std::size_t most = 5;
  std::vector<std::string> warnings, narrow;
  for (const std::int32_t m : used) {
    const Material& material = at(scene.materials(), m);
    const Lobe lobe = used_lobe(material);
    const Rgb& given = material.lobe.reflectance;
    if (lobe.reflectance != given) {
      warnings.push_back(fmt::format(
          "material {}: its lobe reflects {:.3g} {:.3g} {:.3g}, which with rho is more than a "
          "surface can; lowered to {:.3g} {:.3g} {:.3g}",
          in_quotes(material.name), given.r, given.g, given.b, lobe.reflectance.r,
          lobe.reflectance.g, lobe.reflectance.b));
    }
    const double exponent = equivalent_exponent(lobe);
    if (lobe.present() && exponent > resolved_exponent(directions)) {
      narrow.push_back(fmt::format(
          "material {}: its lobe, {}, is too narrow for {} passes, which resolve exponents up to "
          "about {:.3g}; its reflections are coarse",
          in_quotes(material.name),
          lobe.shape == LobeShape::phong
              ? fmt::format("of the exponent {:g}", exponent)
              : fmt::format("of the roughness {:g} (as of the exponent {:.3g})", lobe.roughness,
                            exponent),
          directions, resolved_exponent(directions)));
    }
  }
  const auto shorten = [](std::vector<std::string>& list) {
    if (list.size() > most) {
      const std::size_t others = list.size() - most;
      list.resize(most);
      list.push_back(fmt::format("{} other materials likewise", others));
    }
  };
  shorten(warnings);
  shorten(narrow);
  warnings.insert(warnings.end(), narrow.begin(), narrow.end());
  return warnings;
}

}  // namespace transillum
