// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/view/channel.h"

#include "core/parallel.h"
#include "core/shannon.h"
#include "view/channel_check.h"
#include "view/shared_logs.h"

namespace vantage {
namespace {

constexpr std::size_t kFacesPerTask = 256;
constexpr std::size_t kRowGrain = 4096;  // faces a task whose rows are filled
constexpr std::size_t kViewGrain = 16;   // views a task that are compared with their neighbours
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The channel turned round: for each face the views that see it and how much of it. FaceArea::face
/// is the index of a view here.
struct FaceRows {
  std::vector<std::size_t> offsets{};
  std::vector<FaceArea> values{};

  [[nodiscard]] std::span<const FaceArea> operator[](std::size_t face) const {
    return std::span(values).subspan(offsets[face], offsets[face + 1] - offsets[face]);
  }
};

FaceRows rows_by_face(const ViewChannel& channel, const RunContext& run) {
  FaceRows rows;
  rows.offsets.assign(channel.face_count + 1, 0);
  for (const auto& seen : channel.views) {
    for (const FaceArea& a : seen) {
      ++rows.offsets[a.face + 1];
    }
  }
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  rows.values.resize(rows.offsets.back());
  // Some thousand faces at a time: the ends of their rows stay in the second cache.
  parallel_for(run, channel.face_count, kRowGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> next(rows.offsets.begin() + static_cast<std::ptrdiff_t>(begin),
                                  rows.offsets.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::uint32_t v = 0; v < channel.views.size(); ++v) {
      const auto& seen = channel.views[v];
      const auto is_before = [](const FaceArea& a, std::size_t face) { return a.face < face; };
      auto at = std::lower_bound(seen.begin(), seen.end(), begin, is_before);
      for (; at != seen.end() && at->face < end; ++at) {
        rows.values[next[at->face - begin]++] = {v, at->area};
      }
    }
  });
  return rows;
}

/// Around a vertex of more faces than this only those count that share an edge: the tip of a fan
/// would make every face the neighbour of every other. [ours]
constexpr std::size_t kMostAtVertex = 256;

/// For each face the faces that share a vertex with it, ascending, itself left out.
IndexLists faces_around(const TriMesh& mesh) {
  const IndexLists at_vertex = vertex_faces(mesh);
  IndexLists lists;
  std::vector<std::uint32_t> around;
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    around.clear();
    for (const std::uint32_t v : mesh.triangles[f]) {
      if (at_vertex[v].size() <= kMostAtVertex) {
        around.insert(around.end(), at_vertex[v].begin(), at_vertex[v].end());
      }
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const std::uint32_t other : around) {
      if (other != f) {
        lists.values.push_back(other);
      }
    }
    lists.offsets.push_back(static_cast<std::uint32_t>(lists.values.size()));
  }
  return lists;
}

std::vector<double> face_saliency(const FaceRows& rows, const std::vector<SummedAreas>& faces,
                                  std::size_t views, const TriMesh& mesh, const RunContext& run) {
  const IndexLists around = faces_around(mesh);
  // Each pair once, at the lower face.
  std::vector<double> of_pair(around.values.size(), 0.0);
  parallel_for(run, around.size(), kFacesPerTask, [&](std::size_t begin, std::size_t end) {
    LaidOutAreas laid_out(views);
    for (std::size_t f = begin; f < end; ++f) {
      laid_out.put(rows[f]);
      for (std::uint32_t k = around.offsets[f]; k < around.offsets[f + 1]; ++k) {
        if (around.values[k] > f) {
          of_pair[k] = divergence_of(faces[f], laid_out, faces[around.values[k]]);
        }
      }
    }
  });
  std::vector<double> saliency(faces.size(), 0.0);
  for (std::uint32_t f = 0; f < saliency.size(); ++f) {
    double sum = 0.0;
    for (std::uint32_t k = around.offsets[f]; k < around.offsets[f + 1]; ++k) {
      const std::uint32_t other = around.values[k];
      if (other > f) {
        sum += of_pair[k];
      } else {
        const auto row = around[other];
        const auto at = std::lower_bound(row.begin(), row.end(), f) - row.begin();
        sum += of_pair[around.offsets[other] + static_cast<std::size_t>(at)];
      }
    }
    if (faces[f].area > 0.0 && !around[f].empty()) {
      saliency[f] = sum / static_cast<double>(around[f].size());
    }
  }
  return saliency;
}

/// p' ∝ max(S, floor) p.
std::vector<double> weighted_by_saliency(const std::vector<double>& p,
                                         const std::vector<double>& saliency) {
  const double highest =
      saliency.empty() ? 0.0 : *std::max_element(saliency.begin(), saliency.end());
  // Without any saliency all faces are alike, and p' is p.
  const double floor = highest > 0.0 ? kSaliencyFloor * highest : 1.0;
  std::vector<double> weighted(p.size());
  double sum = 0.0;
  for (std::size_t z = 0; z < p.size(); ++z) {
    weighted[z] = std::max(saliency[z], floor) * p[z];
    sum += weighted[z];
  }
  for (double& w : weighted) {
    w = sum > 0.0 ? w / sum : 0.0;
  }
  return weighted;
}

double area_seen(std::span<const FaceArea> seen) {
  double sum = 0.0;
  for (const FaceArea& a : seen) {
    sum += a.area;
  }
  return sum;
}

/// One more than the last place of an ascending list.
std::size_t places_of(std::span<const FaceArea> list) {
  return list.empty() ? 0 : std::size_t{list.back().face} + 1;
}

/// Whether `a` is the one to lay out of two lists, so that a divergence has the same bits either
/// way.
bool is_first(std::span<const FaceArea> a, std::span<const FaceArea> b) {
  const auto key = [](const FaceArea& entry) { return std::pair(entry.face, entry.area); };
  return std::lexicographical_compare(
      a.begin(), a.end(), b.begin(), b.end(),
      [&](const FaceArea& x, const FaceArea& y) { return key(x) < key(y); });
}

SummedAreas summed(std::span<const FaceArea> list) {
  return {list, area_seen(list), sum_of_logs(list)};
}

/// Logarithms, that of the least positive value for those that are not positive.
std::vector<double> logarithms(const std::vector<double>& values) {
  double least = kNever;
  for (const double value : values) {
    least = value > 0.0 ? std::min(least, value) : least;
  }
  std::vector<double> logs;
  logs.reserve(values.size());
  for (const double value : values) {
    logs.push_back(log_2(value > 0.0 ? value : least));
  }
  return logs;
}

}  // namespace

ChannelTerms channel_terms(const ViewChannel& channel, const TriMesh& mesh, const RunContext& run) {
  if (mesh.triangles.size() != channel.face_count) {
    throw InvalidInput("the channel does not belong to this mesh");
  }
  check_channel(channel);
  const FaceRows rows = rows_by_face(channel, run);
  ChannelTerms terms;
  double total = 0.0;
  for (const auto& seen : channel.views) {
    terms.area_of_view.push_back(area_seen(seen));
    total += terms.area_of_view.back();
  }
  double entropy_of_views = 0.0;
  for (const double area : terms.area_of_view) {
    entropy_of_views -= total > 0.0 ? x_log_x(area / total) : 0.0;
  }
  const std::size_t faces = channel.face_count;
  terms.area_of_face.assign(faces, 0.0);
  terms.p_of_face.assign(faces, 0.0);
  terms.i2_of_face.assign(faces, 0.0);
  std::vector<SummedAreas> sums;
  sums.reserve(faces);
  for (std::size_t z = 0; z < faces; ++z) {
    sums.push_back(summed(rows[z]));
    const double area = sums.back().area;
    if (area > 0.0) {
      // H(V|z) = log A − (1/A) Σ a log a
      const double entropy = log_2(area) - sums.back().logs / area;
      terms.area_of_face[z] = area;
      terms.p_of_face[z] = area / total;
      terms.i2_of_face[z] = entropy_of_views - entropy;
      terms.entropy_of_faces -= x_log_x(area / total);
      terms.mutual_information += terms.p_of_face[z] * terms.i2_of_face[z];
    }
  }
  terms.saliency_of_face = face_saliency(rows, sums, channel.views.size(), mesh, run);
  terms.saliency_share = terms.saliency_of_face;
  for (std::size_t z = 0; z < faces; ++z) {
    terms.saliency_share[z] /= terms.area_of_face[z] > 0.0 ? terms.area_of_face[z] : 1.0;
  }
  terms.weighted_p = weighted_by_saliency(terms.p_of_face, terms.saliency_of_face);
  terms.log_p = logarithms(terms.p_of_face);
  terms.log_weighted_p = logarithms(terms.weighted_p);
  return terms;
}

ChannelMeasures channel_measures(std::span<const FaceArea> seen, const ChannelTerms& terms) {
  ChannelMeasures m;
  const double area = area_seen(seen);
  if (!(area > 0.0)) {
    m.vmi = m.evmi = kNever;
    return m;
  }
  // Σ p log (p / q) = (Σ a log a − Σ a log q) / A − log A
  const double logs = sum_of_logs(seen);
  double log_p = 0.0;
  double log_weighted_p = 0.0;
  for (const FaceArea& a : seen) {
    log_p += a.area * terms.log_p[a.face];
    log_weighted_p += a.area * terms.log_weighted_p[a.face];
    m.i3 += a.area * terms.i2_of_face[a.face];
    m.pmi_saliency += a.area * terms.saliency_share[a.face];
  }
  const double log_area = log_2(area);
  m.vmi = (logs - log_p) / area - log_area;
  m.evmi = (logs - log_weighted_p) / area - log_area;
  m.i3 /= area;
  return m;
}

double view_divergence(std::span<const FaceArea> a, std::span<const FaceArea> b) {
  const auto& [first, second] = is_first(a, b) ? std::pair(a, b) : std::pair(b, a);
  LaidOutAreas laid_out(std::max(places_of(a), places_of(b)));
  laid_out.put(first);
  return divergence_of(summed(first), laid_out, summed(second));
}

double instability(std::span<const FaceArea> view,
                   std::span<const std::span<const FaceArea>> neighbours) {
  if (view.empty()) {
    return kNever;
  }
  std::vector<double> divergences;
  for (const auto& other : neighbours) {
    // A neighbour that sees nothing shares nothing with this view.
    divergences.push_back(other.empty() ? 1.0 : view_divergence(view, other));
  }
  return mean_divergence(divergences);
}

double mean_divergence(std::span<const double> divergences) {
  const double sum = std::accumulate(divergences.begin(), divergences.end(), 0.0);
  return divergences.empty() ? 0.0 : sum / static_cast<double>(divergences.size());
}

std::vector<double> neighbour_divergences(std::span<const std::vector<FaceArea>> views,
                                          const IndexLists& next, const RunContext& run) {
  std::vector<double> divergences(next.values.size(), 1.0);
  std::vector<SummedAreas> sums(views.size());
  std::size_t places = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    sums[i] = summed(views[i]);
    places = std::max(places, places_of(views[i]));
  }
  parallel_for(run, views.size(), kViewGrain, [&](std::size_t begin, std::size_t end) {
    LaidOutAreas laid_out(places);
    for (std::size_t i = begin; i < end; ++i) {
      laid_out.put(views[i]);
      for (std::uint32_t k = next.offsets[i]; k < next.offsets[i + 1]; ++k) {
        const std::uint32_t j = next.values[k];
        const bool is_here =
            is_first(views[i], views[j]) || (i < j && !is_first(views[j], views[i]));
        if (is_here && !views[i].empty() && !views[j].empty()) {
          const auto back = next[j];
          const auto at = std::lower_bound(back.begin(), back.end(), i) - back.begin();
          divergences[k] = divergence_of(sums[i], laid_out, sums[j]);
          divergences[next.offsets[j] + static_cast<std::size_t>(at)] = divergences[k];
        }
      }
    }
  });
  return divergences;
}

std::vector<double> saliency_on_vertices(const TriMesh& mesh,
                                         std::span<const double> saliency_of_face) {
  const std::vector<double> areas = face_areas(mesh);
  std::vector<double> sum(mesh.positions.size(), 0.0);
  std::vector<double> weight(mesh.positions.size(), 0.0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      sum[v] += areas[f] * saliency_of_face[f];
      weight[v] += areas[f];
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    sum[v] = weight[v] > 0.0 ? sum[v] / weight[v] : 0.0;
  }
  return sum;
}

}  // namespace vantage
