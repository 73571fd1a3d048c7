// SPDX-License-Identifier: MIT
#include "spatial/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

// Boxes grow by this much on every side: far more than the float rounding (2^-24 relative, at
// coordinates up to 16) of box, origin and direction together, far less than a face of any model
// that fits into memory. In units of a UnitFrame, where the longest side is 1 to 2.
constexpr float kBoxMargin = 1e-5F;

// No configuration file of the working or home directory may change results; the instruction set
// is pinned because wider ones fuse multiply and add, which changes pictures in the last bit.
constexpr const char* kDeviceConfig = "ignore_config_files=1,verbose=0,isa=sse4.2";

/// What an error of Embree means to the caller.
[[noreturn]] void fail(const char* what, RTCError error) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw std::bad_alloc();
  }
  throw Error(std::string("the ray tracing library could not ") + what + ": error " +
              std::to_string(static_cast<int>(error)));
}

/// Owns a device and one committed scene with a single geometry.
struct Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Embree() : device(rtcNewDevice(kDeviceConfig)) {
    if (device == nullptr) {
      fail("be started", rtcGetDeviceError(nullptr));
    }
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }

  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  /// Takes the geometry over and builds the hierarchy.
  void commit(RTCGeometry geometry) const {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) {
      fail("build its search structure", error);
    }
  }
};

RTCRay ray(const Vec3f& origin, const Vec3f& direction, float tnear, float tfar) {
  RTCRay result{};
  result.org_x = origin.x();
  result.org_y = origin.y();
  result.org_z = origin.z();
  result.dir_x = direction.x();
  result.dir_y = direction.y();
  result.dir_z = direction.z();
  result.tnear = tnear;
  result.tfar = tfar;
  result.mask = ~0U;
  return result;
}

/// What travels with one query of a CandidateScene.
struct CandidateContext {
  RTCIntersectContext context{};  // first, so that a pointer to it is a pointer to this struct
  const std::function<bool(std::uint32_t)>* decide = nullptr;
};

void decide_candidate(const RTCOccludedFunctionNArguments* query) {
  if (query->valid[0] == 0) {
    return;
  }
  const auto* context = reinterpret_cast<const CandidateContext*>(query->context);
  if ((*context->decide)(query->primID)) {
    // A far end of minus infinity is how the library is told that the ray is blocked.
    RTCRayN_tfar(query->ray, query->N, 0) = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

UnitFrame unit_frame(std::span<const Vec3> points) {
  const Box box = bounding_box(points);
  const double side = box.longest_side();
  if (!(side > 0.0) || !std::isfinite(side)) {
    return {.centre = box.low, .scale = 1.0};
  }
  int exponent = 0;
  std::frexp(side, &exponent);  // side = m · 2^exponent with m in [0.5, 1)
  return {.centre = box.low + 0.5 * box.size(), .scale = std::ldexp(1.0, 1 - exponent)};
}

struct RayScene::Scene {
  Embree embree{};
  OpacityOfHit opacity{};

  static double opacity_of(const RTCFilterFunctionNArguments* query) {
    RTCHitN* hit = query->hit;
    return static_cast<const Scene*>(query->geometryUserPtr)
        ->opacity(RTCHitN_primID(hit, query->N, 0), RTCHitN_u(hit, query->N, 0),
                  RTCHitN_v(hit, query->N, 0));
  }

  static void pass_holes(const RTCFilterFunctionNArguments* query) {
    query->valid[0] = query->valid[0] != 0 && opacity_of(query) > 0.0 ? query->valid[0] : 0;
  }

  static void pass_glass(const RTCFilterFunctionNArguments* query) {
    query->valid[0] = query->valid[0] != 0 && opacity_of(query) >= 0.5 ? query->valid[0] : 0;
  }
};

RayScene::RayScene(const TriMesh& mesh, OpacityOfHit opacity) : scene_(std::make_unique<Scene>()) {
  scene_->opacity = std::move(opacity);
  const RTCGeometry geometry = rtcNewGeometry(scene_->embree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!mesh.triangles.empty()) {
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (vertices == nullptr || indices == nullptr) {
      rtcReleaseGeometry(geometry);
      throw std::bad_alloc();
    }
    for (const Vec3& p : mesh.positions) {
      vertices = std::copy_n(p.cast<float>().eval().data(), 3, vertices);
    }
    for (const Triangle& t : mesh.triangles) {
      indices = std::copy(t.begin(), t.end(), indices);
    }
  }
  if (scene_->opacity) {
    rtcSetGeometryUserData(geometry, scene_.get());
    rtcSetGeometryIntersectFilterFunction(geometry, &Scene::pass_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, &Scene::pass_glass);
  }
  scene_->embree.commit(geometry);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

RayHit RayScene::closest_hit(const Vec3f& origin, const Vec3f& direction, float tnear,
                             float tfar) const {
  RTCRayHit query{};
  query.ray = ray(origin, direction, tnear, tfar);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->embree.scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return {};
  }
  return {query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

bool RayScene::occluded(const Vec3f& origin, const Vec3f& direction, float tnear,
                        float tfar) const {
  RTCRay query = ray(origin, direction, tnear, tfar);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->embree.scene, &context, &query);
  return query.tfar < 0.0F;
}

struct CandidateScene::Scene {
  Embree embree{};
  std::vector<std::array<Vec3f, 2>> boxes{};  // low and high corner of each face

  static void bounds(const RTCBoundsFunctionArguments* query) {
    const auto& [low, high] =
        static_cast<const Scene*>(query->geometryUserPtr)->boxes[query->primID];
    RTCBounds& out = *query->bounds_o;
    out.lower_x = low.x();
    out.lower_y = low.y();
    out.lower_z = low.z();
    out.upper_x = high.x();
    out.upper_y = high.y();
    out.upper_z = high.z();
  }
};

CandidateScene::CandidateScene(std::span<const Vec3> positions, std::span<const Triangle> triangles)
    : scene_(std::make_unique<Scene>()) {
  scene_->boxes.reserve(triangles.size());
  const Vec3f margin = Vec3f::Constant(kBoxMargin);
  for (const auto& [a, b, c] : triangles) {
    const Vec3 low = positions[a].cwiseMin(positions[b]).cwiseMin(positions[c]);
    const Vec3 high = positions[a].cwiseMax(positions[b]).cwiseMax(positions[c]);
    scene_->boxes.push_back({low.cast<float>() - margin, high.cast<float>() + margin});
  }
  const RTCGeometry geometry = rtcNewGeometry(scene_->embree.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles.size()));
  rtcSetGeometryUserData(geometry, scene_.get());
  rtcSetGeometryBoundsFunction(geometry, &Scene::bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, &decide_candidate);
  scene_->embree.commit(geometry);
}

CandidateScene::~CandidateScene() = default;
CandidateScene::CandidateScene(CandidateScene&&) noexcept = default;
CandidateScene& CandidateScene::operator=(CandidateScene&&) noexcept = default;

bool CandidateScene::any(const Vec3& origin, const Vec3& direction, double tfar,
                         const std::function<bool(std::uint32_t)>& decide) const {
  // The far end moves out by a few units in the last place of a float.
  constexpr double far_slack = 1.0 + 1e-5;
  RTCRay query = ray(origin.cast<float>(), direction.cast<float>(), 0.0F,
                     static_cast<float>(tfar * far_slack));
  CandidateContext context;
  rtcInitIntersectContext(&context.context);
  context.decide = &decide;
  rtcOccluded1(scene_->embree.scene, &context.context, &query);
  return query.tfar < 0.0F;
}

}  // namespace vantage
