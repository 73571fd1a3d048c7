// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

#include "core/parallel.h"
#include "spatial/ray_scene.h"
#include "support/shapes.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// sin of half the scoring camera's field of view of 30°: the eye's distance in sphere radii.
const double kEyeDistance = 1.0 / std::sin(15.0 * std::numbers::pi / 180.0);

/// A torus of about `vertices` vertices with square faces: 4 : 1 segments at radii 1 and 0.25.
TriMesh torus_of(std::int64_t vertices) {
  const int minor = static_cast<int>(std::lround(std::sqrt(static_cast<double>(vertices) / 4.0)));
  return test::torus(1.0, 0.25, 4 * minor, minor);
}

/// A dented ball: the same density, and hollows that hide vertices.
TriMesh dented_ball_of(std::int64_t vertices) {
  const int minor = static_cast<int>(std::lround(std::sqrt(static_cast<double>(vertices) / 2.0)));
  TriMesh mesh = test::torus(1.0, 0.9, 2 * minor, minor);
  for (Vec3& p : mesh.positions) {
    p *= 1.0 + 0.1 * std::sin(9.0 * p.x()) * std::sin(9.0 * p.y()) * std::sin(9.0 * p.z());
  }
  return mesh;
}

/// A named input: a torus, a dented ball, or a file of the folder that VANTAGE_DATA names.
struct Subject {
  std::string name{};
  std::function<TriMesh()> make{};
};

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const int vertices : {10000, 40000, 170000}) {
    all.push_back({"torus_" + std::to_string(vertices), [=] { return torus_of(vertices); }});
    all.push_back({"dented_" + std::to_string(vertices), [=] { return dented_ball_of(vertices); }});
  }
  const char* folder = std::getenv("VANTAGE_DATA");
  if (folder != nullptr) {
    const std::string base = folder;
    for (const char* name : {"rocker-arm_10044.off", "rockerarm_40177.ply", "horse_48485.obj",
                             "venus_igea_134345.ply", "armadillo_172966_loop.ply"}) {
      all.push_back({name, [path = base + "/paper/" + name] { return load_model(path).mesh; }});
    }
  }
  return all;
}

std::vector<Viewpoint> eyes_around(const TriMesh& mesh, Projection projection) {
  const Sphere sphere = enclosing_sphere(referenced_points(mesh));
  std::vector<Viewpoint> eyes;
  for (const Vec3& d : direction_set(ViewSphereBase::Icosahedron, 1).directions) {
    eyes.push_back({projection, projection == Projection::Orthographic
                                    ? d
                                    : sphere.centre + 0.5 * sphere.diameter * kEyeDistance * d});
  }
  return eyes;
}

std::size_t count(const std::vector<std::uint8_t>& visible) {
  std::size_t sum = 0;
  for (const std::uint8_t v : visible) {
    sum += v;
  }
  return sum;
}

/// Embree as it comes: its fastest instructions, no robust mode. Ours is neither, so that pictures
/// do not depend on the machine.
class PlainScene {
 public:
  explicit PlainScene(const TriMesh& mesh) : device_(rtcNewDevice(nullptr)) {
    scene_ = rtcNewScene(device_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, sizeof(Vec3f),
                                                               mesh.positions.size()));
    for (const Vec3& p : mesh.positions) {
      points = std::copy_n(p.cast<float>().eval().data(), 3, points);
    }
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(Triangle), mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles) {
      corners = std::copy(t.begin(), t.end(), corners);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }

  PlainScene(const PlainScene&) = delete;
  PlainScene& operator=(const PlainScene&) = delete;

  ~PlainScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  [[nodiscard]] bool occluded(const Vec3f& origin, const Vec3f& direction, float tnear,
                              float tfar) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = origin.x();
    ray.org_y = origin.y();
    ray.org_z = origin.z();
    ray.dir_x = direction.x();
    ray.dir_y = direction.y();
    ray.dir_z = direction.z();
    ray.tnear = tnear;
    ray.tfar = tfar;
    ray.mask = ~0U;
    rtcOccluded1(scene_, &context, &ray);
    return ray.tfar < 0.0F;
  }

 private:
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

/// What a program would do without this module: one float ray per front-facing vertex in file
/// order, lifted off the surface by an epsilon. The mesh is in a frame of size about 1.
class PlainRays {
 public:
  explicit PlainRays(const TriMesh& mesh) : mesh_(mesh), faces_(vertex_faces(mesh)), scene_(mesh) {
    for (const Triangle& t : mesh.triangles) {
      normals_.push_back(area_vector(mesh, t).cast<float>());
    }
    for (const Vec3& p : mesh.positions) {
      points_.emplace_back(p.cast<float>());
    }
  }

  [[nodiscard]] std::size_t seen(const Viewpoint& eye, const RunContext& run) const {
    constexpr float lift = 1e-4F;
    const Vec3f at = eye.position.cast<float>();
    const bool bounded = eye.projection == Projection::Perspective;
    const float reach = bounded ? 1.0F : std::numeric_limits<float>::infinity();
    std::atomic<std::size_t> total{0};
    parallel_for(run, points_.size(), 2048, [&](std::size_t begin, std::size_t end) {
      std::size_t sum = 0;
      for (std::size_t v = begin; v < end; ++v) {
        const Vec3f to_eye = bounded ? Vec3f(at - points_[v]) : at;
        bool turned = false;
        for (const std::uint32_t f : faces_[v]) {
          turned = turned || normals_[f].dot(to_eye) > 0.0F;
        }
        sum += turned && !scene_.occluded(points_[v], to_eye, lift, reach) ? 1U : 0U;
      }
      total += sum;
    });
    return total;
  }

 private:
  const TriMesh& mesh_;
  IndexLists faces_;
  PlainScene scene_;
  std::vector<Vec3f> normals_{};
  std::vector<Vec3f> points_{};
};

TriMesh in_unit_frame(TriMesh mesh) {
  const UnitFrame frame = unit_frame(referenced_points(mesh));
  for (Vec3& p : mesh.positions) {
    p = frame.to_frame(p);
  }
  return mesh;
}

struct Spent {
  double wall = 0.0;       // seconds
  double processor = 0.0;  // seconds of all threads: steadier on a busy machine
};

Spent& operator+=(Spent& sum, const Spent& more) {
  sum.wall += more.wall;
  sum.processor += more.processor;
  return sum;
}

Spent spent_on(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t ticks = std::clock();
  work();
  const auto seconds = std::chrono::steady_clock::now() - start;
  return {std::chrono::duration<double>(seconds).count(),
          static_cast<double>(std::clock() - ticks) / CLOCKS_PER_SEC};
}

/// One view by the library and the same view by plain rays, in turn: the time of the iteration is
/// ours, and `rays/ours` says how many times longer the rays took: by the clock, and in processor time.
void compare(benchmark::State& state, const Subject& subject, Projection projection, int threads) {
  const TriMesh mesh = in_unit_frame(subject.make());
  const PlainRays rays(mesh);
  const VertexVisibility visibility(mesh, {FaceSides::Front});
  const std::vector<Viewpoint> eyes = eyes_around(mesh, projection);
  const RunContext run{.max_threads = threads};
  const std::size_t exact = count(visibility.visible_vertices(eyes[0], run));
  const std::size_t plain = rays.seen(eyes[0], run);
  // Both must do the same job, but for the vertices that the epsilon gets wrong.
  if (plain > exact + exact / 50 || exact > plain + plain / 50) {
    state.SkipWithError("the baseline and the library see different vertices");
    return;
  }
  std::size_t next = 0;
  Spent ours;
  Spent theirs;
  for (auto _ : state) {
    const Viewpoint& eye = eyes[next++ % eyes.size()];
    theirs += spent_on([&] { benchmark::DoNotOptimize(rays.seen(eye, run)); });
    const Spent now =
        spent_on([&] { benchmark::DoNotOptimize(visibility.visible_vertices(eye, run)); });
    ours += now;
    state.SetIterationTime(now.wall);
  }
  state.counters["vertices"] = static_cast<double>(mesh.positions.size());
  state.counters["rays/ours"] = theirs.wall / ours.wall;
  state.counters["cpu_ms"] = 1e3 * ours.processor / static_cast<double>(next);
  state.counters["cpu_rays/ours"] = theirs.processor / ours.processor;
}

void BM_PrepareVisibility(benchmark::State& state) {
  const TriMesh mesh = dented_ball_of(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(VertexVisibility(mesh, {FaceSides::Front}));
  }
}

void BM_VisibleArea(benchmark::State& state) {
  const TriMesh mesh = test::box(1.0, 2.0, 3.0, static_cast<int>(state.range(0)));
  const FaceVisibility visibility(mesh, {FaceSides::Front});
  const std::vector<Viewpoint> eyes = eyes_around(mesh, Projection::Perspective);
  const RunContext alone{.max_threads = 1};
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(visibility.seen_faces(eyes[next++ % eyes.size()], alone));
  }
  state.counters["faces"] = static_cast<double>(visibility.face_count());
}

BENCHMARK(BM_PrepareVisibility)->Arg(170000)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_VisibleArea)->Arg(1)->Arg(100)->Unit(benchmark::kMillisecond);

[[maybe_unused]] const bool kRegistered = [] {
  for (const Subject& subject : subjects()) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
      for (const int threads : {1, 2}) {
        const std::string name =
            "BM_VisibleVertices/" + subject.name +
            (projection == Projection::Perspective ? "/perspective/" : "/orthographic/") +
            std::to_string(threads);
        benchmark::RegisterBenchmark(
            name.c_str(),
            [=](benchmark::State& state) { compare(state, subject, projection, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace vantage
