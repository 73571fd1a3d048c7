// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "vantage/core/error.h"
#include "vantage/view/view_set.h"

#include "core/parallel.h"

namespace vantage {
namespace {

// Directions a batch: a bar that moves, and a stop that is heard.
constexpr std::size_t kBatch = 64;

/// \param seen_from what is seen from a viewpoint, one byte a bit.
template <class SeenFrom>
VisibleSets sets_of(const ScoringCamera& camera, std::span<const Vec3> directions, std::size_t bits,
                    const RunContext& run, const SeenFrom& seen_from) {
  VisibleSets sets(directions.size(), bits);
  const RunContext quiet = run.quiet();
  const RunContext alone = run.alone();
  for (std::size_t first = 0; first < directions.size(); first += kBatch) {
    run.advance("views", static_cast<double>(first) / static_cast<double>(directions.size()));
    const std::size_t count = std::min(kBatch, directions.size() - first);
    parallel_for(quiet, count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i) {
        sets.set(i, seen_from(camera.viewpoint(directions[i]), alone));
      }
    });
  }
  run.advance("views", 1.0);
  return sets;
}

}  // namespace

void VisibleSets::set(std::size_t view, std::span<const std::uint8_t> visible) {
  if (visible.size() != vertices_) {
    throw InvalidInput("a view's visible vertices are " + std::to_string(visible.size()) +
                       " flags, but the surface has " + std::to_string(vertices_) + " vertices");
  }
  std::uint64_t* words = bits_.data() + view * words_;
  std::fill(words, words + words_, 0);
  for (std::size_t v = 0; v < visible.size(); ++v) {
    words[v / 64] |= std::uint64_t{visible[v] != 0 ? 1U : 0U} << (v % 64);
  }
}

VisibleSets visible_sets(const VertexVisibility& visibility, const ScoringCamera& camera,
                         std::span<const Vec3> directions, std::size_t vertex_count,
                         const RunContext& run) {
  return sets_of(camera, directions, vertex_count, run,
                 [&](const Viewpoint& eye, const RunContext& alone) {
                   return visibility.visible_vertices(eye, alone);
                 });
}

VisibleSets visible_sets(const FaceVisibility& faces, const ScoringCamera& camera,
                         std::span<const Vec3> directions, const RunContext& run) {
  const std::size_t bits = faces.face_count() * kBitsAFace;
  return sets_of(camera, directions, bits, run, [&](const Viewpoint& eye, const RunContext& alone) {
    std::vector<std::uint8_t> seen(bits, 0);
    for (const SeenFace& face : faces.seen_faces(eye, alone)) {
      const double share = face.visible_area / faces.face_area(face.face);
      const auto count = static_cast<std::size_t>(std::llround(share * kBitsAFace));
      std::fill_n(seen.begin() + static_cast<std::ptrdiff_t>(face.face * kBitsAFace),
                  std::min(count, kBitsAFace), 1);
    }
    return seen;
  });
}

}  // namespace vantage
