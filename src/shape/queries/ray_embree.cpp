// Traces rays with Embree 3 (https://www.embree.org), which builds and walks the tree. Its
// coordinates are floats in the mesh's UnitFrame, at most 1 in modulus.
#include "shape/queries/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "base/cancel.h"
#include "base/chunks.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/face.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
[[noreturn]] void throw_embree_error(RTCError code, const std::string& what) {
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (code == RTC_ERROR_CANCELLED) throw Error(ErrorCode::kCancelled, what + " was cancelled");
  const bool cpu = code == RTC_ERROR_UNSUPPORTED_CPU;
  throw Error(ErrorCode::kUnsupported,
              what + " failed with Embree's error " + std::to_string(code) +
                  (cpu ? ": this processor lacks SSE4.2, which Embree 3 needs" : ""));
}

struct DeviceDeleter {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};
struct GeometryDeleter {
  void operator()(RTCGeometryTy* geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using Scene = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using Geometry = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

// Answers Embree whether to continue building. Embree also asks on threads of its own, which have
// no scope, and on threads with another caller's scope.
bool keep_building(void* scope, double) {
  return scope != cancel_scope() || static_cast<const CancelScope*>(scope)->keep_going();
}

float clamped_to_float(double x) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -kLargest, kLargest));
}

}  // namespace

struct RayScene::Impl {
  const Mesh& mesh;
  UnitFrame frame;
  double ball_radius;
  RTCBuildQuality quality;
  Device device;
  Scene scene;

  Impl(const Mesh& m, const UnitFrame& f, const Context& context, double radius, RayTree tree)
      : mesh(m),
        frame(f),
        ball_radius(radius),
        quality(tree == RayTree::kQuick ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM) {
    device.reset(rtcNewDevice(nullptr));
    if (!device) throw_embree_error(rtcGetDeviceError(nullptr), "starting the ray tracer");
    build(thread_count(context));
  }
  void build(int threads);
  Geometry make_geometry(RTCGeometryType type) const;
  Geometry make_triangles() const;
  Geometry make_balls() const;
  RTCRay ray(const Vec3& origin, const Vec3& direction, double near, double far) const;
};

Geometry RayScene::Impl::make_geometry(RTCGeometryType type) const {
  Geometry geometry(rtcNewGeometry(device.get(), type));
  if (!geometry) throw_embree_error(rtcGetDeviceError(device.get()), "making a shape for rays");
  return geometry;
}

Geometry RayScene::Impl::make_triangles() const {
  Geometry geometry = make_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.faces.size()));
  if (positions == nullptr || indices == nullptr) throw std::bad_alloc();
  CancelPoll poll;
  for (const Vec3& vertex : mesh.vertices) {
    poll();
    const Vec3 q = frame.to_local(vertex);
    for (const double x : {q.x, q.y, q.z}) *positions++ = static_cast<float>(x);
  }
  for (const Triangle& triangle : mesh.faces) {
    poll();
    indices = std::copy(triangle.begin(), triangle.end(), indices);
  }
  return geometry;
}

Geometry RayScene::Impl::make_balls() const {
  Geometry geometry = make_geometry(RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* balls = static_cast<float*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX,
                                                            0, RTC_FORMAT_FLOAT4, 4 * sizeof(float),
                                                            mesh.vertices.size()));
  if (balls == nullptr) throw std::bad_alloc();
  CancelPoll poll;
  for (const Vec3& vertex : mesh.vertices) {
    poll();
    const Vec3 q = frame.to_local(vertex);
    for (const double x : {q.x, q.y, q.z, ball_radius * frame.scale}) {
      *balls++ = static_cast<float>(x);
    }
  }
  return geometry;
}

void RayScene::Impl::build(int threads) {
  scene.reset(rtcNewScene(device.get()));
  const bool balls = ball_radius > 0;
  if (balls ? !mesh.vertices.empty() : !mesh.faces.empty()) {
    const Geometry geometry = balls ? make_balls() : make_triangles();
    rtcSetGeometryBuildQuality(geometry.get(), quality);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
  }
  // RTC_SCENE_FLAG_ROBUST: no ray slips through a shared edge. Filters are set for each query.
  rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                           RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(scene.get(), quality);
  if (const CancelScope* scope = cancel_scope()) {
    rtcSetSceneProgressMonitorFunction(scene.get(), &keep_building,
                                       const_cast<CancelScope*>(scope));
  }
  // Limits the threads: Embree's loops would look for work on every processor.
  run_limited(threads, [&] { rtcCommitScene(scene.get()); });
  const RTCError error = rtcGetDeviceError(device.get());
  if (error != RTC_ERROR_NONE) throw_embree_error(error, "building the search tree");
}

RTCRay RayScene::Impl::ray(const Vec3& origin, const Vec3& direction, double near,
                           double far) const {
  const Vec3 q = frame.to_local(origin);
  RTCRay r = {};
  r.org_x = clamped_to_float(q.x);
  r.org_y = clamped_to_float(q.y);
  r.org_z = clamped_to_float(q.z);
  r.dir_x = static_cast<float>(direction.x);
  r.dir_y = static_cast<float>(direction.y);
  r.dir_z = static_cast<float>(direction.z);
  r.tnear = clamped_to_float(std::max(near * frame.scale, 0.0));
  r.tfar = std::isinf(far) ? std::numeric_limits<float>::infinity()
                           : clamped_to_float(far * frame.scale);
  r.mask = ~0u;
  return r;
}

RayScene::RayScene(const Mesh& mesh, const Context& context, double ball_radius, RayTree tree)
    : mesh_(mesh),
      frame_(ray_frame(mesh, ball_radius)),
      impl_(std::make_unique<Impl>(mesh, frame_, context, ball_radius, tree)) {}
RayScene::~RayScene() = default;

// --- Rays ----------------------------------------------------------------------------------

namespace {

constexpr std::size_t kPacket = 8;  // rays in one call, as many as floats in an AVX2 vector

// Embree's context, followed by our own data for each of the rays that are traced together.
template <std::size_t kRays>
struct FirstHitContext {
  RTCIntersectContext base;
  std::array<float, kRays> distance;
  std::array<std::uint32_t, kRays> triangle = {};
  FirstHitContext() {
    rtcInitIntersectContext(&base);
    distance.fill(std::numeric_limits<float>::infinity());
  }
};

// If several triangles have the same distance (a shared edge), the smallest index wins,
// whatever the order of the tree.
template <unsigned kRays>
void prefer_smaller_index(const RTCFilterFunctionNArguments* args) {
  auto& first = *reinterpret_cast<FirstHitContext<kRays>*>(args->context);
  for (unsigned k = 0; k < kRays; ++k) {
    if (args->valid[k] == 0) continue;
    const float distance = RTCRayN_tfar(args->ray, kRays, k);
    const std::uint32_t triangle = RTCHitN_primID(args->hit, kRays, k);
    if (distance == first.distance[k] && triangle > first.triangle[k]) {
      args->valid[k] = 0;
      continue;
    }
    first.distance[k] = distance;
    first.triangle[k] = triangle;
  }
}

RTCRay8& ray_of(RTCRay8& packet) { return packet; }
RTCRay8& ray_of(RTCRayHit8& packet) { return packet.ray; }

// Calls trace(valid, packet, first, count) for the packets of a list of rays.
template <typename Packet, typename Trace>
void for_packets(std::span<const Ray> rays, const UnitFrame& frame, const Trace& trace) {
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t n = std::min(kPacket, rays.size() - first);
    alignas(32) std::array<int, kPacket> valid = {};
    Packet packet = {};
    RTCRay8& p = ray_of(packet);
    for (std::size_t k = 0; k < n; ++k) {
      const Ray& ray = rays[first + k];
      const Vec3 q = frame.to_local(ray.origin);
      valid[k] = -1;
      p.org_x[k] = clamped_to_float(q.x);
      p.org_y[k] = clamped_to_float(q.y);
      p.org_z[k] = clamped_to_float(q.z);
      p.dir_x[k] = static_cast<float>(ray.direction.x);
      p.dir_y[k] = static_cast<float>(ray.direction.y);
      p.dir_z[k] = static_cast<float>(ray.direction.z);
      p.tfar[k] = std::numeric_limits<float>::infinity();
      p.mask[k] = ~0u;
    }
    trace(valid.data(), packet, first, n);
  }
}

struct AllHitsContext {
  RTCIntersectContext base;
  std::vector<std::uint32_t> faces;
};

// Stores the triangle and rejects the hit, so that the ray continues.
void note_triangle(const RTCFilterFunctionNArguments* args) {
  auto& all = *reinterpret_cast<AllHitsContext*>(args->context);
  all.faces.push_back(reinterpret_cast<const RTCHit*>(args->hit)->primID);
  args->valid[0] = 0;
}

}  // namespace

RayHit RayScene::first_hit(const Vec3& origin, const Vec3& direction, double near,
                           double far) const {
  RTCRayHit query = {impl_->ray(origin, direction, near, far), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  FirstHitContext<1> context;
  context.base.filter = prefer_smaller_index<1>;
  rtcIntersect1(impl_->scene.get(), &context.base, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {true, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar / impl_->frame.scale};
}

bool RayScene::occluded(const Vec3& origin, const Vec3& direction, double near, double far) const {
  RTCRay query = impl_->ray(origin, direction, near, far);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene.get(), &context, &query);
  return query.tfar < 0;  // Embree's mark of an occluded ray
}

std::vector<RayHit> RayScene::first_hits(std::span<const Ray> rays) const {
  std::vector<RayHit> hits(rays.size());
  for_packets<RTCRayHit8>(
      rays, impl_->frame,
      [&](const int* valid, RTCRayHit8& packet, std::size_t first, std::size_t n) {
        std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
        FirstHitContext<kPacket> context;
        context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        context.base.filter = prefer_smaller_index<kPacket>;
        rtcIntersect8(valid, impl_->scene.get(), &context.base, &packet);
        for (std::size_t k = 0; k < n; ++k) {
          if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
          hits[first + k] = {true, packet.hit.primID[k], packet.hit.u[k], packet.hit.v[k],
                             packet.ray.tfar[k] / impl_->frame.scale};
        }
      });
  return hits;
}

std::vector<bool> RayScene::occluded(std::span<const Ray> rays) const {
  std::vector<bool> occluded(rays.size());
  for_packets<RTCRay8>(rays, impl_->frame,
                       [&](const int* valid, RTCRay8& packet, std::size_t first, std::size_t n) {
                         RTCIntersectContext context;
                         rtcInitIntersectContext(&context);
                         rtcOccluded8(valid, impl_->scene.get(), &context, &packet);
                         for (std::size_t k = 0; k < n; ++k)
                           occluded[first + k] = packet.tfar[k] < 0;
                       });
  return occluded;
}

std::vector<std::uint32_t> RayScene::triangles_met(const Vec3& origin,
                                                   const Vec3& direction) const {
  RTCRayHit query = {impl_->ray(origin, direction, 0, kInfinity), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  AllHitsContext context;
  rtcInitIntersectContext(&context.base);
  context.base.filter = note_triangle;
  rtcIntersect1(impl_->scene.get(), &context.base, &query);
  return std::move(context.faces);
}

}  // namespace rholm
