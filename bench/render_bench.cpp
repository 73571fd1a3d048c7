// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "vantage/mesh/measures.h"
#include "vantage/render/render.h"

#include "render/corner_normals.h"
#include "support/shapes.h"

namespace vantage {
namespace {

Camera camera_for(const TriMesh& mesh) {
  const Sphere sphere = enclosing_sphere(mesh.positions);
  const Vec3 eye = sphere.centre + 2.0 * sphere.diameter * Vec3(0.5, 0.4, 0.77).normalized();
  return frame_points(mesh.positions, {Projection::Perspective, eye}, sphere.centre, Vec3::UnitY(),
                      1.0);
}

/// Icospheres of levels 4 to 7: 2 562, 10 242, 40 962 and 163 842 vertices.
TriMesh sphere_of_level(const benchmark::State& state) {
  return test::sphere(static_cast<int>(state.range(0)));
}

void run_render(benchmark::State& state, const TriMesh& mesh, const RenderOptions& options) {
  const Camera camera = camera_for(mesh);
  if (render(mesh, camera, {}, {}, options).pixel(options.width / 2, options.height / 2)[3] !=
      255) {
    state.SkipWithError("the middle of the picture is not covered");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(render(mesh, camera, {}, {}, options).rgba.data());
  }
  const double pixels = static_cast<double>(options.width) * options.height;
  state.counters["vertices"] = static_cast<double>(mesh.positions.size());
  state.counters["pixels/s"] =
      benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate);
}

void BM_Picture(benchmark::State& state) {
  run_render(state, sphere_of_level(state), {.width = 512, .height = 512, .samples = 16});
}

void BM_Thumbnail(benchmark::State& state) {
  run_render(state, sphere_of_level(state), {.width = 256, .height = 256, .samples = 9});
}

void BM_PictureWithOcclusion(benchmark::State& state) {
  run_render(state, sphere_of_level(state),
             {.width = 512, .height = 512, .samples = 16, .ambient_rays = 16});
}

/// What a further view of a surface costs: rays alone, in the three paints of a result.
void BM_ThreePaintsOfAPictureSurface(benchmark::State& state) {
  const TriMesh mesh = sphere_of_level(state);
  const Camera camera = camera_for(mesh);
  const std::vector<Rgb8> colours(mesh.positions.size(), Rgb8{200, 40, 40});
  const CurveGraph graph{{mesh.positions[0], mesh.positions[1]}, {{0, 1}}};
  const std::vector<Paint> paints{
      {}, {colours, {}, nullptr}, {{}, {.graph = &graph, .radius = 0.01}, nullptr}};
  const RenderOptions options{.width = 512, .height = 512, .samples = 16, .ambient_rays = 16};
  const PictureSurface surface(mesh);
  if (surface.render(camera, paints, options).size() != paints.size()) {
    state.SkipWithError("a picture is missing");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(surface.render(camera, paints, options).data());
  }
}

void BM_CornerNormals(benchmark::State& state) {
  const TriMesh mesh = sphere_of_level(state);
  const Crease crease{0.5, 0.9};
  for (auto _ : state) {
    benchmark::DoNotOptimize(corner_normals(mesh, crease).data());
  }
  state.counters["faces/s"] = benchmark::Counter(static_cast<double>(mesh.triangles.size()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

void BM_FramePoints(benchmark::State& state) {
  const TriMesh mesh = sphere_of_level(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera_for(mesh).fov_y_deg);
  }
}

BENCHMARK(BM_Thumbnail)
    ->ArgName("level")
    ->DenseRange(4, 7)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Picture)
    ->ArgName("level")
    ->DenseRange(4, 7)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_PictureWithOcclusion)
    ->ArgName("level")
    ->Arg(6)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ThreePaintsOfAPictureSurface)
    ->ArgName("level")
    ->Arg(6)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_CornerNormals)
    ->ArgName("level")
    ->DenseRange(4, 7)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_FramePoints)
    ->ArgName("level")
    ->DenseRange(4, 7)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vantage
