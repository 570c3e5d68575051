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

/// An unbounded ray from `origin`, in Embree's coordinates.
RTCRayHit make_ray(const Vec3& origin, const Vec3& direction);
inline bool has_hit(const RTCRayHit& ray) { return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID; }

/// Embree's representation of a scene: triangles in single precision, moved and scaled into the
/// ball of radius 1 about the origin, so that float32 keeps its seven digits for scenes of any
/// position and size.
///
/// Threads: immutable once built, so any number of threads may query it.
class EmbreeScene {
 public:
  /// Keeps a reference to `scene`.
  /// @throws Canceled, std::bad_alloc, std::runtime_error if Embree fails
  explicit EmbreeScene(const Scene& scene, const Cancellation& cancellation = {});

  /// A point of the scene in Embree's coordinates.
  Vec3 inside(const Vec3& p) const { return scale_ * (p - center_); }
  /// The point of the scene at Embree's coordinates.
  Vec3 outside(const Vec3& p) const { return center_ + (1 / scale_) * p; }
  /// Embree's units per meter.
  double scale() const { return scale_; }
  PatchId patch_of(unsigned triangle) const { return patches_[triangle]; }

  /// Called for hits as Embree finds them, in any order; hits of lanes that it sets invalid are
  /// ignored. data_of() returns the `data` of the query.
  using Filter = void (*)(const RTCFilterFunctionNArguments*);
  static void* data_of(const RTCFilterFunctionNArguments* hits);

  /// Calls `filter`, which must set all lanes invalid, for all hits of 16 rays.
  /// @param valid aligned to 64 bytes; -1 for a ray, 0 for none
  /// @param coherent the rays have nearly the same origins and directions
  void all_hits(const int* valid, RTCRay16& rays, bool coherent, Filter filter, void* data) const;
  /// Finds the nearest hit of each of 16 coherent rays; geomID stays RTC_INVALID_GEOMETRY_ID if
  /// there is none.
  void first_hits(const int* valid, RTCRayHit16& rays) const;
  /// Finds the nearest hit of one ray; with `lit_only`, the nearest one on a front side.
  void first_hit(RTCRayHit& ray, bool lit_only) const;

  bool is_lit(PatchId i, const Vec3& direction) const {
    return dot(description_.patch(i).normal, direction) < 0;
  }
  /// The patch whose front side a ray meets at its hit of patch `hit`: that patch, one that
  /// coincides with it, or no_patch. In Embree's coordinates.
  PatchId lit_at(PatchId hit, const Vec3& origin, const Vec3& direction, float distance) const;

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  void add_triangles();
  static void ignore_backs(const RTCFilterFunctionNArguments* hits);

  const Scene& description_;
  Vec3 center_;
  double scale_ = 1;
  std::vector<PatchId> patches_;  ///< by triangle
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace transillum
