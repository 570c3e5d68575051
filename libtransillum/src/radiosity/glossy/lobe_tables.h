// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_threads.h"
#include "radiosity/glossy/lobe_kernel.h"
#include "radiosity/glossy/shot_rays.h"
#include "transillum/cancellation.h"
#include "transillum/glossy.h"
#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// A lobe on the discrete set, for surfaces of one orientation:
///   f(p, q) = kernel(p, q) scale_p scale_q + spread_p spread_q,
/// symmetric, and w sum_q f(p, q) cosine_q = 1 for every direction p, to rounding.
struct LobeTable {
  std::size_t kernel = 0;  ///< index of its shape
  Vec3 normal;
  std::vector<double> scale = {}, spread = {};                ///< by pass
  double sum_error = 0, sum_defect = 0, spread_fraction = 0;  ///< see GlossyStatistics
};

/// Reports on long work: the finished fraction, 0 to 1, and the number of tables in
/// all. On the calling thread.
using LobeReport = std::function<void(double, std::size_t)>;

/// A glossy patch.
struct LobePatch {
  Lobe lobe;
  Vec3 normal;
};

/// The lobes of all glossy patches on a set of directions: a table for each shape and orientation.
class LobeTables {
 public:
  /// @param patches the glossy ones
  /// @param before tables of the same directions, from which those that fit are copied; may be null
  /// @param report may be empty
  /// @throws Canceled
  LobeTables(std::span<const LobePatch> patches, const std::vector<Vec3>& directions,
             const LobeTables* before, WorkerThreads& workers, const Cancellation& cancellation,
             const LobeReport& report);

  /// By glossy patch.
  struct Light {
    std::span<const Rgb> arriving;  ///< and then by pass, from the first pass of these directions
    std::size_t stride;             ///< from one patch to the next
    std::span<const Rgb> direct;    ///< added to what is reflected, in the same order; may be empty
    std::span<const Rgb> fractions;  ///< k
    /// Radiance without the lobe.
    std::span<const Rgb> lambertian_before, lambertian_after;
  };
  /// The light of a first shot and of the sun.
  struct ShotLight {
    std::span<const Rgb> sources;    ///< GlossyLight::Data::ray_sources
    std::span<const Rgb> fractions;  ///< k, by glossy patch
    std::size_t stride;              ///< from one patch to the next
  };
  /// The largest change of reflected plus other radiance, and its largest new value.
  struct Change {
    double change = 0, largest = 0;
  };
  /// reflected = w sum_q f(p, q) arriving_q k for all patches and directions p.
  /// @param reflected by patch and pass, as Light::arriving
  Change reflect(const Light& light, std::span<Rgb> reflected, WorkerThreads& workers,
                 const Cancellation& cancellation, const LobeReport& report) const;
  /// reflected += what each patch reflects of the light of a first shot; its sum over the
  /// directions is the fraction k of the light, whatever the set.
  /// @param rays by glossy patch
  /// @param reflected by patch and pass, as Light::arriving
  void reflect(const ShotRays& rays, const ShotLight& light, std::span<Rgb> reflected,
               WorkerThreads& workers, const Cancellation& cancellation) const;
  /// Radiance that patch `g` reflects toward a direction above it, of the light of rays, if
  /// its lobe reflects everything; by the lobe itself instead of its values on the set.
  Rgb reflected_toward(std::span<const ShotRay> rays, const std::vector<Rgb>& sources,
                       std::size_t g, const Vec3& toward) const;
  /// The mean of what arrives at patch `g`, weighted by its lobe toward any direction above it.
  Rgb reflected_toward(const Rgb* arriving, std::size_t g, const Vec3& toward) const;

  /// Adds values about the lobes.
  void write_to(GlossyStatistics& counted) const;

 private:
  void add_patches(std::span<const LobePatch> patches);
  /// Copies tables of the same shape and orientation.
  void copy_tables(const LobeTables& before);
  class KernelRows;
  void scale(LobeTable& table, const Hemisphere& above, bool keep_rows,
             const Cancellation& cancellation) const;
  /// w sum_q kernel(p, q) scale_p scale_q cosine_q for each p
  void sums(const LobeTable& table, KernelRows& rows, std::vector<double>& result,
            const Cancellation& cancellation) const;
  double weight() const;

  std::vector<Vec3> directions_;
  std::vector<Lobe> shapes_;  ///< shapes of the kernels
  std::vector<LobeKernel> kernels_;
  std::vector<std::shared_ptr<const LobeFunction>> functions_;  ///< by shape
  std::vector<LobeTable> tables_;
  std::vector<std::size_t> table_of_;              ///< by glossy patch
  std::vector<std::vector<std::size_t>> members_;  ///< glossy patches, by table
};

}  // namespace transillum
