// SPDX-License-Identifier: MIT
#include "contraction/area_ratios.h"

#include <cstddef>
#include <cstdint>

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

/// Faces that begin smaller than this fraction of the mean area say nothing by their ratio.
constexpr double kTinyFace = 1e-6;

}  // namespace

AreaRatios::AreaRatios(const TriMesh& start, const EvenShares& shares)
    : start_(face_areas(start)), faces_of_vertex_(vertex_faces(start)), shares_(shares) {
  double mean = 0.0;
  for (const double area : start_) {
    mean += area;
  }
  mean /= static_cast<double>(start_.size());
  smallest_ = kTinyFace * mean;
  mean_area_ = mean;
}

std::pair<std::vector<double>, double> AreaRatios::of_vertices(const TriMesh& now) const {
  const std::vector<double> areas = face_areas(now);
  std::vector<double> ratio(faces_of_vertex_.size(), -1.0);
  double sum = 0.0;
  double counted = 0.0;
  for (std::size_t v = 0; v < ratio.size(); ++v) {
    double now_area = 0.0;
    double start_area = 0.0;
    double ratios = 0.0;
    int faces = 0;
    for (const std::uint32_t f : faces_of_vertex_[v]) {
      if (start_[f] >= smallest_) {
        ratios += areas[f] / start_[f];
        now_area += areas[f];
        start_area += start_[f];
        ++faces;
      }
    }
    if (faces > 0) {
      const double count = shares_.empty() ? 1.0 : shares_.count[v];
      ratio[v] = shares_.empty() ? ratios / faces : now_area / start_area;
      sum += count * ratio[v];
      counted += count;
    }
  }
  const double mean = counted > 0.0 ? sum / counted : 0.0;
  for (double& r : ratio) {
    r = r < 0.0 ? mean : r;
  }
  return {std::move(ratio), mean};
}

}  // namespace vantage
