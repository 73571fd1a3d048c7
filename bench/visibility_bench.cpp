// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <benchmark/benchmark.h>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/scoring.h"

#include "spatial/ray_scene.h"
#include "support/shapes.h"

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

TriMesh shape(const benchmark::State& state) {
  return state.range(1) == 0 ? torus_of(state.range(0)) : dented_ball_of(state.range(0));
}

std::vector<Viewpoint> eyes_around(const TriMesh& mesh) {
  const Sphere sphere = enclosing_sphere(mesh.positions);
  std::vector<Viewpoint> eyes;
  for (const Vec3& d : direction_set(ViewSphereBase::Icosahedron, 1).directions) {
    eyes.push_back(
        {Projection::Perspective, sphere.centre + 0.5 * sphere.diameter * kEyeDistance * d});
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

/// What a program would do without this module: one float ray per front-facing vertex in file
/// order, lifted off the surface by an epsilon.
std::size_t plain_rays(const RayScene& scene, const TriMesh& mesh, const IndexLists& faces,
                       const Viewpoint& eye) {
  std::size_t seen = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 to_eye = eye.position - mesh.positions[v];
    bool turned = false;
    for (const std::uint32_t f : faces[v]) {
      turned = turned || area_vector(mesh, mesh.triangles[f]).dot(to_eye) > 0.0;
    }
    constexpr float lift = 1e-4F;
    seen +=
        turned && !scene.occluded(mesh.positions[v].cast<float>(), to_eye.cast<float>(), lift, 1.0F)
            ? 1U
            : 0U;
  }
  return seen;
}

void BM_VisibleVertices(benchmark::State& state) {
  const TriMesh mesh = shape(state);
  const VertexVisibility visibility(mesh, {FaceSides::Front});
  const std::vector<Viewpoint> eyes = eyes_around(mesh);
  const RunContext alone{.max_threads = 1};
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(visibility.visible_vertices(eyes[next++ % eyes.size()], alone));
  }
  state.counters["vertices/s"] = benchmark::Counter(static_cast<double>(mesh.positions.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

void BM_PlainRays(benchmark::State& state) {
  const TriMesh mesh = shape(state);
  const IndexLists faces = vertex_faces(mesh);
  const RayScene scene(mesh);
  const std::vector<Viewpoint> eyes = eyes_around(mesh);
  const VertexVisibility visibility(mesh, {FaceSides::Front});
  const std::size_t exact = count(visibility.visible_vertices(eyes[0]));
  const std::size_t plain = plain_rays(scene, mesh, faces, eyes[0]);
  // Both must do the same job, but for the vertices that the epsilon gets wrong.
  if (plain > exact + exact / 50 || exact > plain + plain / 50) {
    state.SkipWithError("the baseline and the library see different vertices");
    return;
  }
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(plain_rays(scene, mesh, faces, eyes[next++ % eyes.size()]));
  }
  state.counters["vertices/s"] = benchmark::Counter(static_cast<double>(mesh.positions.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

void BM_PrepareVisibility(benchmark::State& state) {
  const TriMesh mesh = shape(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(VertexVisibility(mesh, {FaceSides::Front}));
  }
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"vertices", "dented"})->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const int dented : {0, 1}) {
    for (const int vertices : {10000, 40000, 170000}) {
      bench->Args({vertices, dented});
    }
  }
}

BENCHMARK(BM_VisibleVertices)->Apply(sizes);
BENCHMARK(BM_PlainRays)->Apply(sizes);
BENCHMARK(BM_PrepareVisibility)->Apply(sizes);

}  // namespace
}  // namespace vantage
