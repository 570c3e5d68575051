// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// A ray from `origin` in Embree's coordinates, to where there is no end.
RTCRayHit make_ray(const Vec3& origin, const Vec3& direction);
inline bool has_hit(const RTCRayHit& ray) { return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID; }

/// A scene as Embree sees it: triangles in single precision, moved and scaled into the ball of
/// radius 1 about the origin, so that float32 keeps its seven digits for any place and size.
///
/// Threads: immutable once built, so any number of threads may query it.
class EmbreeScene {
 public:
  /// Keeps a reference.
  /// @throws Canceled, std::bad_alloc, std::runtime_error where Embree fails.
  explicit EmbreeScene(const Scene& scene, const Cancellation& cancellation = {});

  /// A point of the scene in Embree's coordinates.
  Vec3 inside(const Vec3& p) const { return scale_ * (p - center_); }
  /// Embree's units a meter.
  double scale() const { return scale_; }
  PatchId patch_of(unsigned triangle) const { return patches_[triangle]; }

  /// Hears of hits as Embree finds them, in any order; lanes that it sets invalid are looked
  /// through. `data_of` gives it what the query was called with.
  using Filter = void (*)(const RTCFilterFunctionNArguments*);
  static void* data_of(const RTCFilterFunctionNArguments* hits);

  /// Shows all that 16 rays meet to `filter`, which must set all lanes invalid. `valid`: 64 bytes
  /// aligned, -1 for a ray, 0 for none. Coherent: neighbors that run along each other.
  void all_hits(const int* valid, RTCRay16& rays, bool coherent, Filter filter, void* data) const;
  /// The nearest hit of each of 16 rays that go much the same way; geomID stays
  /// RTC_INVALID_GEOMETRY_ID without.
  void first_hits(const int* valid, RTCRayHit16& rays) const;
  /// The nearest hit of one ray; with `lit_only` that on a lit side.
  void first_hit(RTCRayHit& ray, bool lit_only) const;

  bool is_lit(PatchId i, const Vec3& direction) const {
    return dot(description_.patch(i).normal, direction) < 0;
  }
  /// The patch whose lit side a ray meets where it hits `hit`: that one, or one that coincides
  /// with it, or no_patch. In Embree's coordinates.
  PatchId lit_at(PatchId hit, const Vec3& origin, const Vec3& direction, float distance) const;

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  void add_triangles();
  static void look_through_backs(const RTCFilterFunctionNArguments* hits);

  const Scene& description_;
  Vec3 center_;
  double scale_ = 1;
  std::vector<PatchId> patches_;  ///< by triangle
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace transillum
