// SPDX-License-Identifier: MIT
#include "spatial/ray_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "mesh/copied_faces.h"

namespace vantage {
namespace {

// Boxes grow by this much on every side: far more than the float rounding (2^-24 relative, at
// coordinates up to 16) of box, origin and direction together, far less than a face of any model
// that fits into memory. In units of a UnitFrame, where the longest side is 1 to 2.
constexpr float kBoxMargin = 1e-5F;

// No configuration file of the working or home directory may change results. The instruction set has a
// bound because wider ones fuse multiply and add, which changes pictures in the last bit; those up to
// AVX give the same pictures.
constexpr const char* kDeviceConfig = "ignore_config_files=1,verbose=0,max_isa=avx";

// Whether Embree has failed in this process, for want of memory as a rule. From then on it may wait for
// itself for ever where something is given back (3.13.5), so nothing is.
std::atomic<bool> has_failed{false};

/// What an error of Embree means to the caller.
[[noreturn]] void fail(const char* what, RTCError error) {
  has_failed = true;
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
    if (!has_failed) {
      rtcReleaseScene(scene);
      rtcReleaseDevice(device);
    }
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

RTCRay ray(const RaySegment& segment) {
  RTCRay result{};
  result.org_x = segment.origin.x();
  result.org_y = segment.origin.y();
  result.org_z = segment.origin.z();
  result.dir_x = segment.direction.x();
  result.dir_y = segment.direction.y();
  result.dir_z = segment.direction.z();
  result.tnear = segment.tnear;
  result.tfar = segment.tfar;
  result.mask = ~0U;
  return result;
}

void fill(const RayPacket& rays, std::size_t count, RTCRay4& query, std::array<int, 4>& valid) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    valid[i] = i < count ? -1 : 0;
    query.org_x[i] = rays[i].origin.x();
    query.org_y[i] = rays[i].origin.y();
    query.org_z[i] = rays[i].origin.z();
    query.dir_x[i] = rays[i].direction.x();
    query.dir_y[i] = rays[i].direction.y();
    query.dir_z[i] = rays[i].direction.z();
    query.tnear[i] = rays[i].tnear;
    query.tfar[i] = rays[i].tfar;
    query.mask[i] = ~0U;
  }
}

/// What travels with one query of a RayScene.
struct PictureContext {
  RTCIntersectContext context{};  // first, so that a pointer to it is a pointer to this struct
  float width = 0.0F;

  explicit PictureContext(float ray_width) : width(ray_width) { rtcInitIntersectContext(&context); }
};

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
  std::vector<std::uint32_t> face_of_primitive{};  // empty: each is its own

  [[nodiscard]] std::uint32_t face(std::uint32_t primitive) const {
    return face_of_primitive.empty() ? primitive : face_of_primitive[primitive];
  }

  /// The triangles to trace: of many in one place only some.
  std::vector<Triangle> traced(const TriMesh& mesh) {
    const std::vector<std::uint32_t> beyond = faces_beyond_copies(mesh);
    if (beyond.empty()) {
      return mesh.triangles;
    }
    std::vector<Triangle> triangles;
    auto next = beyond.begin();
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
      if (next != beyond.end() && *next == f) {
        ++next;
      } else {
        triangles.push_back(mesh.triangles[f]);
        face_of_primitive.push_back(f);
      }
    }
    return triangles;
  }

  /// Keeps the hits at places whose opacity `keep` accepts.
  template <class Keep>
  static void filter(const RTCFilterFunctionNArguments* query, const Keep& keep) {
    const auto* scene = static_cast<const Scene*>(query->geometryUserPtr);
    const float width = reinterpret_cast<const PictureContext*>(query->context)->width;
    RTCHitN* hit = query->hit;
    for (unsigned i = 0; i < query->N; ++i) {
      if (query->valid[i] != 0 &&
          !keep(scene->opacity(scene->face(RTCHitN_primID(hit, query->N, i)),
                               RTCHitN_u(hit, query->N, i), RTCHitN_v(hit, query->N, i), width))) {
        query->valid[i] = 0;
      }
    }
  }

  static void pass_holes(const RTCFilterFunctionNArguments* query) {
    filter(query, [](double share) { return share > 0.0; });
  }

  static void pass_glass(const RTCFilterFunctionNArguments* query) {
    filter(query, [](double share) { return share >= 0.5; });
  }
};

RayScene::RayScene(const TriMesh& mesh, OpacityOfHit opacity) : scene_(std::make_unique<Scene>()) {
  scene_->opacity = std::move(opacity);
  const RTCGeometry geometry = rtcNewGeometry(scene_->embree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (const std::vector<Triangle> triangles = scene_->traced(mesh); !triangles.empty()) {
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), triangles.size()));
    if (vertices == nullptr || indices == nullptr) {
      rtcReleaseGeometry(geometry);
      throw std::bad_alloc();
    }
    for (const Vec3& p : mesh.positions) {
      vertices = std::copy_n(p.cast<float>().eval().data(), 3, vertices);
    }
    for (const Triangle& t : triangles) {
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
  query.ray = ray({origin, direction, tnear, tfar});
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  PictureContext context(0.0F);
  rtcIntersect1(scene_->embree.scene, &context.context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return {};
  }
  return {scene_->face(query.hit.primID), query.hit.u, query.hit.v, query.ray.tfar};
}

std::array<RayHit, 4> RayScene::closest_hits(const RayPacket& rays, std::size_t count,
                                             float width) const {
  RTCRayHit4 query{};
  alignas(16) std::array<int, 4> valid{};
  fill(rays, count, query.ray, valid);
  for (unsigned& geometry : query.hit.geomID) {
    geometry = RTC_INVALID_GEOMETRY_ID;
  }
  PictureContext context(width);
  context.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect4(valid.data(), scene_->embree.scene, &context.context, &query);
  std::array<RayHit, 4> hits{};
  for (std::size_t i = 0; i < count; ++i) {
    if (query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
      hits[i] = {scene_->face(query.hit.primID[i]), query.hit.u[i], query.hit.v[i],
                 query.ray.tfar[i]};
    }
  }
  return hits;
}

std::size_t RayScene::count_occluded(const RayPacket& rays, std::size_t count, float width) const {
  RTCRay4 query{};
  alignas(16) std::array<int, 4> valid{};
  fill(rays, count, query, valid);
  PictureContext context(width);
  rtcOccluded4(valid.data(), scene_->embree.scene, &context.context, &query);
  std::size_t occluded = 0;
  for (std::size_t i = 0; i < count; ++i) {
    occluded += query.tfar[i] < 0.0F ? 1 : 0;
  }
  return occluded;
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
  RTCRay query = ray(
      {origin.cast<float>(), direction.cast<float>(), 0.0F, static_cast<float>(tfar * far_slack)});
  CandidateContext context;
  rtcInitIntersectContext(&context.context);
  context.decide = &decide;
  rtcOccluded1(scene_->embree.scene, &context.context, &query);
  return query.tfar < 0.0F;
}

}  // namespace vantage
