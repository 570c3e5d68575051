// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Benchmark "Lines": the time of one pass of engine fast compared with tracing 10 lines per patch
// with Embree. Of the methods to trace lines with all their hits (triangles or quads; robust or
// not; packets of 1, 8, 16 and streams; intersect or occluded; filter of the geometry or of the
// query; coherent or not) this was the fastest on an AVX-512 machine: triangles, not robust,
// 16-wide rtcOccluded on tiles of 4 x 4 lines, coherent, and a filter of the geometry that records
// each hit and rejects it, so that one traversal finds all hits.
#include <benchmark/benchmark.h>
#include <emmintrin.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "measure.h"
#include "transillum/engine.h"
#include "transillum/visibility_map.h"

namespace transillum::benchmarks {
namespace {

constexpr unsigned width = 16;
constexpr unsigned max_hits = 64;

struct LineHit {
  float distance;
  unsigned triangle;
};

#if RTC_VERSION_MAJOR >= 4
struct Query : RTCRayQueryContext {
#else
struct Query : RTCIntersectContext {
#endif
  std::array<unsigned, width> count;
  std::array<std::array<LineHit, max_hits>, width> hits;

  void record(unsigned line, float distance, unsigned triangle) {
    unsigned& n = count[line];
    if (n < max_hits) {
      hits[line][n++] = {distance, triangle};
    }
  }
};

/// The lanes of 16 with a hit, one bit each; marks all as rejected.
unsigned reject_all(int* valid) {
  unsigned lanes = 0;
  for (unsigned quarter = 0; quarter < 4; ++quarter) {
    auto* four = reinterpret_cast<__m128i*>(valid + 4 * quarter);
    lanes |= static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(_mm_loadu_si128(four))))
             << (4 * quarter);
    _mm_storeu_si128(four, _mm_setzero_si128());
  }
  return lanes;
}

void collect(const RTCFilterFunctionNArguments* found) {
  auto& query = *static_cast<Query*>(found->context);
  if (found->N == width) {
    const auto& rays = *reinterpret_cast<const RTCRay16*>(found->ray);
    const auto& hits = *reinterpret_cast<const RTCHit16*>(found->hit);
    for (unsigned lanes = reject_all(found->valid); lanes != 0; lanes &= lanes - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(lanes));
      query.record(rays.id[k], rays.tfar[k], hits.primID[k]);
    }
    return;
  }
  for (unsigned k = 0; k < found->N; ++k) {
    if (!found->valid[k]) {
      continue;
    }
    found->valid[k] = 0;
    query.record(RTCRayN_id(found->ray, found->N, k), RTCRayN_tfar(found->ray, found->N, k),
                 RTCHitN_primID(found->hit, found->N, k));
  }
}

/// Traces parallel lines on a grid over the bounding rectangle of a scene's projection.
class LineTracer {
 public:
  explicit LineTracer(const Scene& scene)
      : scene_(scene), device_(rtcNewDevice(nullptr)), embree_(rtcNewScene(device_)) {
    std::vector<unsigned> corners;
    for (const Piece& piece : scene.pieces()) {
      const auto outline = scene.corners(piece);
      for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        for (const PointId p : {outline[0], outline[k], outline[k + 1]}) {
          corners.push_back(static_cast<unsigned>(p));
        }
      }
    }
    RTCGeometry triangles = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               scene.points().size()));
    for (const Vec3& p : scene.points()) {
      for (const double x : {p.x, p.y, p.z}) {
        *points++ = static_cast<float>(x);
      }
    }
    void* indices = rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(unsigned), corners.size() / 3);
    std::memcpy(indices, corners.data(), corners.size() * sizeof(unsigned));
    rtcSetGeometryOccludedFilterFunction(triangles, collect);
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(embree_, triangles);
    rtcReleaseGeometry(triangles);
    rtcCommitScene(embree_);
  }
  ~LineTracer() {
    rtcReleaseScene(embree_);
    rtcReleaseDevice(device_);
  }
  LineTracer(const LineTracer&) = delete;
  LineTracer& operator=(const LineTracer&) = delete;

  bool native() const {
    return rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  }

  /// Traces `lines` or a few more, sorts each line's hits, and returns the number of hits. Adds the
  /// CPU time of tracing and sorting to `seconds`.
  std::size_t trace(const Vec3& omega, double lines, double& seconds) {
    const PlaneFrame frame = plane_frame(scene_, omega);
    Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    for (const Vec3& p : scene_.points()) {
      const Vec2 at = frame.project(p);
      low = {std::min(low.x, at.x), std::min(low.y, at.y)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
    const double cell = std::sqrt((high.x - low.x) * (high.y - low.y) / lines);
    const auto tiles = [&](double size) { return static_cast<int>(std::ceil(size / (4 * cell))); };
    const int columns = tiles(high.x - low.x), rows = tiles(high.y - low.y);
    const Vec3 corner = frame.origin + (low.x + cell / 2) * frame.u + (low.y + cell / 2) * frame.v +
                        scene_.bounds().diagonal() * omega;
    std::size_t hits = 0;
    seconds += seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
      set_direction(omega);
      for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
          set_origins(corner, 4.0 * column * cell, 4.0 * row * cell, cell, frame);
          trace_packet();
          hits += sort_hits();
        }
      }
    });
    return hits;
  }

 private:
  void set_direction(const Vec3& omega) {
    for (unsigned k = 0; k < width; ++k) {
      rays_.dir_x[k] = static_cast<float>(-omega.x);
      rays_.dir_y[k] = static_cast<float>(-omega.y);
      rays_.dir_z[k] = static_cast<float>(-omega.z);
      rays_.mask[k] = ~0U;
      rays_.id[k] = k;
    }
  }

  void set_origins(const Vec3& corner, double x, double y, double cell, const PlaneFrame& frame) {
    const Vec3 start = corner + x * frame.u + y * frame.v;
    const float at[3] = {static_cast<float>(start.x), static_cast<float>(start.y),
                         static_cast<float>(start.z)};
    const Vec3 u = cell * frame.u, v = cell * frame.v;
    const float along_u[3] = {static_cast<float>(u.x), static_cast<float>(u.y),
                              static_cast<float>(u.z)};
    const float along_v[3] = {static_cast<float>(v.x), static_cast<float>(v.y),
                              static_cast<float>(v.z)};
    for (unsigned k = 0; k < width; ++k) {
      const auto i = static_cast<float>(k % 4), j = static_cast<float>(k / 4);
      rays_.org_x[k] = at[0] + i * along_u[0] + j * along_v[0];
      rays_.org_y[k] = at[1] + i * along_u[1] + j * along_v[1];
      rays_.org_z[k] = at[2] + i * along_u[2] + j * along_v[2];
      rays_.tnear[k] = 0;
      rays_.tfar[k] = HUGE_VALF;
    }
  }

  void trace_packet() {
    query_.count.fill(0);
    alignas(64) std::array<int, width> valid{};
    valid.fill(-1);
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query_);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.context = &query_;
    rtcOccluded16(valid.data(), embree_, &rays_, &arguments);
#else
    rtcInitIntersectContext(&query_);
    query_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid.data(), embree_, &query_, &rays_);
#endif
  }

  std::size_t sort_hits() {
    std::size_t all = 0;
    for (unsigned k = 0; k < width; ++k) {
      auto& hits = query_.hits[k];
      all += query_.count[k];
      for (unsigned a = 1; a < query_.count[k]; ++a) {
        const LineHit hit = hits[a];
        unsigned b = a;
        for (; b > 0 && hits[b - 1].distance > hit.distance; --b) {
          hits[b] = hits[b - 1];
        }
        hits[b] = hit;
      }
    }
    benchmark::DoNotOptimize(query_.hits);
    return all;
  }

  const Scene& scene_;
  RTCDevice device_;
  RTCScene embree_;
  RTCRay16 rays_{};
  Query query_{};
};

void PassOverTenLinesPerPatch(benchmark::State& state) {
  constexpr int trials = 5;
  const auto scene = load_scene("sphere-flake");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(Engine::fast, scene, tree);
  LineTracer lines(*scene);
  const auto directions = some_directions(16);
  const double count = 10.0 * scene->patch_count();
  double pass = HUGE_VAL, traced = HUGE_VAL;
  std::size_t hits = 0, exchanges = 0;
  for (auto _ : state) {
    // Alternates the two methods, so that other load affects both, and takes the best round of
    // each.
    for (int trial = 0; trial < trials; ++trial) {
      double passes = 0, traces = 0;
      hits = exchanges = 0;
      for (const Vec3& omega : directions) {
        passes += seconds_of(CLOCK_THREAD_CPUTIME_ID,
                             [&] { exchanges += engine(omega, {}).exchanges.size(); });
        hits += lines.trace(omega, count, traces);
      }
      pass = std::min(pass, passes / static_cast<double>(directions.size()));
      traced = std::min(traced, traces / static_cast<double>(directions.size()));
    }
  }
  const double per_direction = 1.0 / static_cast<double>(directions.size());
  fmt::print(
      "lines ratio = {:.2f}: one pass {:.2f} ms ({:.0f} exchanges), 10 lines per patch {:.2f} ms "
      "({:.0f} hits), {} patches{}\n",
      pass / traced, 1e3 * pass, static_cast<double>(exchanges) * per_direction, 1e3 * traced,
      static_cast<double>(hits) * per_direction, scene->patch_count(),
      lines.native() ? "" : "; packets of 16 are not native here");
  state.counters["lines_ratio"] = pass / traced;
  state.counters["pass_ms"] = 1e3 * pass;
  state.counters["lines_ms"] = 1e3 * traced;
}
BENCHMARK(PassOverTenLinesPerPatch)->Name("Lines")->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace transillum::benchmarks
