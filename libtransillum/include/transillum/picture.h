// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Pictures of a result as a camera sees it. The light of sources is computed at every point that a
// pixel sees, exactly and with its shadows; only the rest, which has been reflected before, comes
// from the result (final gathering; decisions/0086-pictures.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/solution.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// How a camera maps directions to a picture.
enum class CameraProjection {
  perspective,   ///< seen as by an eye
  orthographic,  ///< parallel rays
  panorama,      ///< all directions: longitude across, latitude upward (equirectangular)
};

/// A camera without a lens: everything is sharp.
struct Camera {
  Vec3 eye;                               ///< m; orthographic: rays start in the plane through it
  Vec3 target;                            ///< the point in the middle of the picture, m
  std::optional<Vec3> up = std::nullopt;  ///< direction that is up in the picture; +z if unset
  CameraProjection projection = CameraProjection::perspective;  ///< how directions become pixels
  /// Vertical angle of view of a perspective, degrees, above 0 and below 180. Unset: the whole
  /// scene, up to 75 degrees.
  std::optional<double> field_of_view = std::nullopt;
  /// Height that an orthographic picture shows, m, > 0. Unset: the whole scene.
  std::optional<double> height = std::nullopt;
};

/// Options of a picture.
struct PictureOptions {
  /// Largest width and height, pixels.
  static constexpr int largest_size = 32767;
  /// Largest number of samples a pixel.
  static constexpr int most_samples = 4096;
  /// Largest number of rays a sample.
  static constexpr int most_rays = 65536;

  int width = 1280;  ///< pixels, at least 1
  int height = 960;  ///< pixels, at least 1
  int samples = 4;   ///< points at which a pixel is sampled, at least 1
  /// Rays from each sample that gather the reflected light. 0 means that it is interpolated between
  /// points of the surfaces, which gather it by many rays.
  int gather = 0;
  /// The picture shows the irradiance H of surfaces: a pixel is H / pi, the radiance that a white
  /// diffuse surface would reflect; 0 where nothing is.
  bool irradiance = false;
  /// The picture has its coverage, and the sky is not shown behind surfaces.
  bool transparent = false;
  int threads = 0;  ///< 0 uses all cores; the result does not depend on it

  /// @throws InputError naming the value and its range.
  void validate() const;
};

/// A picture.
struct Picture {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  /// Radiance toward the camera, W/(m² sr), mean over each pixel; row by row from the top, from
  /// left to right.
  std::vector<Rgb> radiance;
  /// Emitting faces whose light was gathered by rays, with their noise: the weakest, past the
  /// number that can be treated exactly, and those without a ten-thousandth of all power; of more
  /// than 64 faces also the dim, whose exitance is at most four times the mean irradiance.
  int gathered_lamps = 0;
  /// Fraction of the samples of each pixel that show a surface, in the order of `radiance`, to
  /// which the others contribute 0; empty without PictureOptions::transparent.
  std::vector<float> coverage{};
};

/// How precisely reflected light is interpolated. More precise queries use what others have
/// computed.
struct Interpolation {
  /// Least size of structures that are asked for, m; 0 means all.
  double detail = 0;
  /// Largest difference that is accepted between gathered and interpolated light where both are
  /// compared, as a fraction of all light there, > 0; more where that is only noise.
  double tolerance = 0.004;
};

/// The light that points of a result's surfaces receive and send, computed when it is asked for;
/// what is computed for one query serves the next.
///
/// Threads: any number may query; a value does not depend on the order of queries. A query may take
/// seconds; each checks its own cancellation, and what a canceled one has computed serves the next.
class SurfaceLight {
 public:
  /// @param solution with its scene; B of another solve's materials gives their light.
  /// @param gather PictureOptions::gather
  /// @throws Canceled
  explicit SurfaceLight(std::shared_ptr<const Solution> solution, int gather = 0,
                        const Cancellation& cancellation = {});
  ~SurfaceLight();
  /// The moved-from object may only be destroyed or assigned to.
  SurfaceLight(SurfaceLight&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  SurfaceLight& operator=(SurfaceLight&&) noexcept;

  /// B at a point of a patch, W/m²: E + rho H, with the reflectance of lobes in a glossy solve.
  /// @param point on the patch, m.
  /// @throws Canceled
  Rgb radiosity(PatchId patch, const Vec3& point, const Cancellation& cancellation = {},
                const Interpolation& precision = {}) const;
  /// Irradiance by sources alone at a point of a patch, W/m², exact but for a sky.
  /// @throws Canceled
  Rgb direct_irradiance(PatchId patch, const Vec3& point,
                        const Cancellation& cancellation = {}) const;
  /// Radiance that arrives at `origin` from `direction`, W/(m² sr). Backs are transparent; where
  /// nothing is met it is the sky's.
  /// @param direction of any length but 0.
  /// @param salt makes the sequences of rays differ between samples of a pixel.
  /// @throws Canceled
  Rgb radiance(const Vec3& origin, const Vec3& direction, std::uint64_t salt = 0,
               const Cancellation& cancellation = {}) const;
  /// Irradiance of what radiance() meets, W/m²; 0 where nothing is met.
  /// @throws Canceled
  Rgb irradiance(const Vec3& origin, const Vec3& direction, std::uint64_t salt = 0,
                 const Cancellation& cancellation = {}) const;
  /// Whether a ray meets the lit side of a surface, whose light radiance() gives.
  bool meets_surface(const Vec3& origin, const Vec3& direction) const;
  /// Picture::gathered_lamps
  int gathered_lamps() const;

 private:
  friend class LightByPicker;  // makes one with a picker that exists
  struct Impl;
  explicit SurfaceLight(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

/// The rays of a camera's pixels.
class CameraRays {
 public:
  /// @throws InputError where the target is the eye, or a value of the camera or a size is not in
  /// its range.
  CameraRays(const Scene& scene, const Camera& camera, int width, int height);

  /// A half-line.
  struct Ray {
    Vec3 origin;     ///< start, m
    Vec3 direction;  ///< any length but 0
  };
  /// @param column, row position in pixels from the upper left corner of the picture
  Ray at(double column, double row) const;

 private:
  CameraProjection projection_;
  Vec3 eye_, forward_, right_, above_;  ///< along the picture's half width and half height
  double width_, height_;
};

/// One of the samples of a pixel.
struct PixelSample {
  int column = 0;  ///< from the left, 0 first
  int row = 0;     ///< from the top, 0 first
  int number = 0;  ///< below `count`
  int count = 1;   ///< number of samples of the pixel
};
/// The ray of a sample.
struct SampleRay {
  CameraRays::Ray ray;  ///< the ray
  std::uint64_t salt;   ///< for SurfaceLight::radiance()
};
/// All samples of a pixel are spread evenly about its middle.
SampleRay sample_ray(const CameraRays& rays, const PixelSample& sample);
/// The mean radiance of `count` samples of a pixel, W/(m² sr).
/// @throws Canceled
Rgb pixel_radiance(const SurfaceLight& light, const CameraRays& rays, int column, int row,
                   int count, const Cancellation& cancellation = {});

/// The radiosity of a result on grids of points of its surfaces, as one picture for linear
/// filtering.
///
/// Threads: immutable once made.
class LightMap {
 public:
  /// Largest width and height, texels.
  static constexpr int largest_side = 16384;

  /// Options of a map of exact light.
  struct Options {
    /// Texels per meter, > 0; 0 means 1,024 along the diagonal of the scene's bounding box.
    double density = 0;
    double tolerance = Interpolation().tolerance;  ///< Interpolation::tolerance
    int threads = 0;  ///< 0 uses all cores; the result does not depend on it
  };

  /// B of the solution: a square of 4 by 4 texels for each patch. Filtering gives its function and
  /// no other; where it is constant, filtering of the first reduction does, too.
  /// @throws InputError where the map would be larger than largest_side
  explicit LightMap(const Solution& solution);
  /// Light computed at each texel. Patches of one plane and material that touch share a rectangle,
  /// so that there are no seams between them; each rectangle continues by a texel beyond its edges.
  /// @param progress as make_picture()
  /// @throws InputError where the map would be larger than largest_side; Canceled
  LightMap(const Scene& scene, const SurfaceLight& light, const Options& options,
           const Cancellation& cancellation = {}, const std::function<void(double)>& progress = {});
  ~LightMap();

  int width() const;   ///< texels
  int height() const;  ///< texels
  /// B, W/m², red, green and blue; row by row from the top. 0 where no surface is.
  const std::vector<std::array<float, 3>>& radiosity() const;
  /// Place of a point of a patch in the map: texels from its left and its upper edge.
  std::array<double, 2> place(PatchId patch, const Vec3& point) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// Checks that the eye is not inside a solid: that backs of faces do not surround it.
/// @throws InputError, Canceled
void check_eye(const std::shared_ptr<const Scene>& scene, const Camera& camera,
               const Cancellation& cancellation = {});

/// Makes a picture.
/// @param solution B of all patches, of any kind of solve.
/// @param camera the camera.
/// @param options size and samples.
/// @param cancellation checked all the time.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws InputError, Canceled
Picture make_picture(std::shared_ptr<const Solution> solution, const Camera& camera,
                     const PictureOptions& options = {}, const Cancellation& cancellation = {},
                     const std::function<void(double)>& progress = {});

}  // namespace TRANSILLUM_API transillum
