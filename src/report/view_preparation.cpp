// SPDX-License-Identifier: MIT
#include "report/view_preparation.h"

#include <bit>

#include "vantage/mesh/measures.h"

#include "view/sketch_scorer.h"

namespace vantage {
namespace {

// Of a search without a prior, about; under one it asks half as many. Backs are looked for beside the
// contraction, where a core is idle.
constexpr std::size_t kEyes = 120;

/// A number that is as good as surely another one where a coordinate, a corner or a side
/// is (FNV-1a, by words).
std::uint64_t print_of(const ShapeAnalysis& shape) {
  std::uint64_t print = 0xcbf29ce484222325U;
  const auto add = [&](std::uint64_t word) { print = (print ^ word) * 0x100000001b3U; };
  add(shape.surface.positions.size());
  for (const Vec3& p : shape.surface.positions) {
    add(std::bit_cast<std::uint64_t>(p.x()));
    add(std::bit_cast<std::uint64_t>(p.y()));
    add(std::bit_cast<std::uint64_t>(p.z()));
  }
  for (const auto& [a, b, c] : shape.surface.triangles) {
    add(a);
    add(std::uint64_t{b} << 32U | c);
  }
  for (const FaceSides sides : shape.sides) {
    add(static_cast<std::uint64_t>(sides));
  }
  return print;
}

}  // namespace

Posture::Posture(const TriMesh& surface)
    : planes(mirror_planes(surface)),
      with_y_up(stance(surface, up_vector(UpAxis::Y), planes)),
      with_z_up(stance(surface, up_vector(UpAxis::Z), planes)) {}

ViewPreparation::ViewPreparation(const ShapeAnalysis& shape, const RunContext& run)
    : surface_print(print_of(shape)),
      visibility(shape.surface, shape.sides, kEyes),
      posture((run.check(), shape.surface)),
      walls((run.check(), flat_parts(shape.surface))),
      landmarks(landmark_directions(shape.surface, walls)),
      vertex_areas(vantage::vertex_areas(shape.surface)),
      coarse((run.check(), std::make_shared<SketchSurface>(sketch_surface(
                               shape.surface, shape.sides, shape.sphere,
                               sketch_options(shape.surface.positions.size()).faces)))) {}

const ViewPreparation* views_of(const ShapeAnalysis& shape) {
  return shape.views && shape.views->surface_print == print_of(shape) ? shape.views.get() : nullptr;
}

Posture posture_of(const ShapeAnalysis& shape) {
  const ViewPreparation* views = views_of(shape);
  return views != nullptr ? views->posture : Posture(shape.surface);
}

std::shared_ptr<const ViewPreparation> preparation_of(const ShapeAnalysis& shape) {
  return views_of(shape) != nullptr ? shape.views : std::make_shared<ViewPreparation>(shape);
}

std::shared_ptr<const VertexVisibility> visibility_of(const ShapeAnalysis& shape,
                                                      std::size_t eyes) {
  if (views_of(shape) != nullptr) {
    return {shape.views, &shape.views->visibility};
  }
  return std::make_shared<VertexVisibility>(shape.surface, shape.sides, eyes);
}

}  // namespace vantage
