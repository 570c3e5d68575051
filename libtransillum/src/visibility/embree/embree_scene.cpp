// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Triangulates a scene for Embree and wraps its ray queries. Embree 3 and 4 have different names
// for the same things; the differences are confined to this file.
#include "visibility/embree/embree_scene.h"

#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>

namespace transillum {
namespace {

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// A query's context followed by the caller's data, so that filters can find it.
struct Query : Context {
  explicit Query(void* caller_data) : data(caller_data) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(this);
#else
    rtcInitIntersectContext(this);
#endif
  }
  void* data;
};

#if RTC_VERSION_MAJOR >= 4

template <class Arguments>
void fill(Arguments& arguments, Query& query, bool coherent, EmbreeScene::Filter filter) {
  const int flags = (coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT) |
                    (filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : RTC_RAY_QUERY_FLAG_NONE);
  arguments.flags = static_cast<RTCRayQueryFlags>(flags);
  arguments.context = &query;
  arguments.filter = filter;
}

RTCIntersectArguments intersect_arguments(Query& query, bool coherent, EmbreeScene::Filter filter) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  fill(arguments, query, coherent, filter);
  return arguments;
}

constexpr RTCSceneFlags filter_flag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

#else

void prepare(Query& query, bool coherent, EmbreeScene::Filter filter) {
  query.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  query.filter = filter;
}

constexpr RTCSceneFlags filter_flag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

#endif

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) {
    return;
  }
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw std::bad_alloc();
  }
  throw std::runtime_error("Embree failed with error " + std::to_string(static_cast<int>(error)));
}

/// Addresses that Embree's device and a small scene take, mostly 128 MB that are not used.
constexpr std::size_t embree_bytes = std::size_t{144} << 20;

/// Embree 3.13.5 ends the program, or reports an unknown error, where it has no memory for a scene.
/// @throws std::bad_alloc where it would have none
RTCDevice make_device() {
  void* const room = ::mmap(nullptr, embree_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) {
    throw std::bad_alloc();
  }
  ::munmap(room, embree_bytes);
  // No configuration string: "threads=1" would limit the threads of the whole process.
  return rtcNewDevice(nullptr);
}

}  // namespace

RTCRayHit make_ray(const Vec3& origin, const Vec3& direction) {
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(origin.x);
  ray.ray.org_y = static_cast<float>(origin.y);
  ray.ray.org_z = static_cast<float>(origin.z);
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.dir_z = static_cast<float>(direction.z);
  ray.ray.tfar = HUGE_VALF;
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

EmbreeScene::EmbreeScene(const Scene& scene, const Cancellation& cancellation)
    : description_(scene),
      center_(scene.bounds().center()),
      scale_(2 / scene.bounds().diagonal()),
      device_(make_device()) {
  if (!device_) {
    check(nullptr);
  }
  scene_.reset(rtcNewScene(device_.get()));
  // Robust: no line passes between two adjacent triangles.
  rtcSetSceneFlags(scene_.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | filter_flag));
  add_triangles();
  const auto keep_building = [](void* cancellation_pointer, double) {
    return !static_cast<const Cancellation*>(cancellation_pointer)->canceled();
  };
  rtcSetSceneProgressMonitorFunction(scene_.get(), keep_building,
                                     const_cast<Cancellation*>(&cancellation));
  rtcCommitScene(scene_.get());
  rtcSetSceneProgressMonitorFunction(scene_.get(), nullptr, nullptr);
  cancellation.throw_if_canceled();
  check(device_.get());
}

void EmbreeScene::add_triangles() {
  std::vector<unsigned> corners;
  for (const Piece& piece : description_.pieces()) {
    const auto outline = description_.corners(piece);
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
      for (const PointId p : {outline[0], outline[k], outline[k + 1]}) {
        corners.push_back(static_cast<unsigned>(p));
      }
      patches_.push_back(piece.patch);
    }
  }
  RTCGeometry triangles = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             description_.points().size()));
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), patches_.size()));
  if (points && indices) {
    for (const Vec3& p : description_.points()) {
      const Vec3 q = inside(p);
      for (const double coordinate : {q.x, q.y, q.z}) {
        *points++ = static_cast<float>(coordinate);
      }
    }
    std::copy(corners.begin(), corners.end(), indices);
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(scene_.get(), triangles);
  }
  rtcReleaseGeometry(triangles);
  check(device_.get());
}

void* EmbreeScene::data_of(const RTCFilterFunctionNArguments* hits) {
  return static_cast<Query*>(hits->context)->data;
}

void EmbreeScene::ignore_backs(const RTCFilterFunctionNArguments* hits) {
  const auto& scene = *static_cast<const EmbreeScene*>(data_of(hits));
  for (unsigned k = 0; k < hits->N; ++k) {
    if (!hits->valid[k]) {
      continue;
    }
    const Vec3 direction{RTCRayN_dir_x(hits->ray, hits->N, k), RTCRayN_dir_y(hits->ray, hits->N, k),
                         RTCRayN_dir_z(hits->ray, hits->N, k)};
    const PatchId patch = scene.patch_of(RTCHitN_primID(hits->hit, hits->N, k));
    if (!scene.is_lit(patch, direction)) {
      hits->valid[k] = 0;
    }
  }
}

PatchId EmbreeScene::lit_at(PatchId hit, const Vec3& origin, const Vec3& direction,
                            float distance) const {
  if (is_lit(hit, direction)) {
    return hit;
  }
  constexpr float rounding = 2e-6F;  // bound on the error of a distance
  RTCRayHit ray = make_ray(origin, direction);
  ray.ray.tnear = std::max(distance - rounding, 0.0F);
  ray.ray.tfar = distance + rounding;
  first_hit(ray, true);
  return has_hit(ray) ? patch_of(ray.hit.primID) : no_patch;
}

#if RTC_VERSION_MAJOR >= 4

void EmbreeScene::all_hits(const int* valid, RTCRay16& rays, bool coherent, Filter filter,
                           void* data) const {
  Query query(data);
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  fill(arguments, query, coherent, filter);
  rtcOccluded16(valid, scene_.get(), &rays, &arguments);
}

void EmbreeScene::first_hits(const int* valid, RTCRayHit16& rays) const {
  Query query(nullptr);
  RTCIntersectArguments arguments = intersect_arguments(query, true, nullptr);
  rtcIntersect16(valid, scene_.get(), &rays, &arguments);
}

void EmbreeScene::first_hit(RTCRayHit& ray, bool lit_only) const {
  Query query(const_cast<EmbreeScene*>(this));
  RTCIntersectArguments arguments =
      intersect_arguments(query, false, lit_only ? ignore_backs : nullptr);
  rtcIntersect1(scene_.get(), &ray, &arguments);
}

#else

void EmbreeScene::all_hits(const int* valid, RTCRay16& rays, bool coherent, Filter filter,
                           void* data) const {
  Query query(data);
  prepare(query, coherent, filter);
  rtcOccluded16(valid, scene_.get(), &query, &rays);
}

void EmbreeScene::first_hits(const int* valid, RTCRayHit16& rays) const {
  Query query(nullptr);
  prepare(query, true, nullptr);
  rtcIntersect16(valid, scene_.get(), &query, &rays);
}

void EmbreeScene::first_hit(RTCRayHit& ray, bool lit_only) const {
  Query query(const_cast<EmbreeScene*>(this));
  prepare(query, false, lit_only ? ignore_backs : nullptr);
  rtcIntersect1(scene_.get(), &query, &ray);
}

#endif

}  // namespace transillum
