// SPDX-License-Identifier: MIT
#include "vantage/view/channel_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"
#include "core/shannon.h"

namespace vantage {
namespace {

constexpr std::size_t kGrain = 256;  // faces a task
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The channel by face: which views see it, and how much of it.
struct FaceRows {
  std::vector<std::size_t> offsets{};
  std::vector<std::uint32_t> view{};
  std::vector<float> area{};
  std::vector<double> area_log{};  // a log a
};

FaceRows rows_by_face(const ViewChannel& channel) {
  FaceRows rows;
  rows.offsets.assign(channel.face_count + 1, 0);
  for (const auto& seen : channel.views) {
    for (const FaceArea& a : seen) {
      ++rows.offsets[a.face + 1];
    }
  }
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  rows.view.resize(rows.offsets.back());
  rows.area.resize(rows.offsets.back());
  rows.area_log.resize(rows.offsets.back());
  std::vector<std::size_t> next(rows.offsets.begin(), rows.offsets.end() - 1);
  for (std::uint32_t v = 0; v < channel.views.size(); ++v) {
    for (const FaceArea& a : channel.views[v]) {
      rows.view[next[a.face]] = v;
      rows.area_log[next[a.face]] = x_log_x(a.area);
      rows.area[next[a.face]++] = a.area;
    }
  }
  return rows;
}

/// What a pair adds to the weighted Jensen–Shannon divergence where both distributions have mass:
/// (a + b) log (a + b) − a log a − b log b; where only one has, the terms cancel. The same bits for
/// (b, a).
double shared_term(double a, double b) {
  return x_log_x(a + b) - (x_log_x(a) + x_log_x(b));
}

/// Weighted Jensen–Shannon divergence of two distributions a/A and b/B with weights A/(A+B) and
/// B/(A+B), from the sum of their shared terms:
/// ((A+B) log (A+B) − A log A − B log B − Σ shared) / (A+B).
double divergence(double a_sum, double b_sum, double shared) {
  if (!(a_sum > 0.0) || !(b_sum > 0.0)) {
    return 0.0;
  }
  const double whole = shared_term(a_sum, b_sum);
  return std::clamp((whole - shared) / (a_sum + b_sum), 0.0, 1.0);
}

double face_divergence(const FaceRows& rows, const std::vector<double>& area_of_face,
                       std::uint32_t a, std::uint32_t b) {
  double shared = 0.0;
  std::size_t i = rows.offsets[a];
  std::size_t j = rows.offsets[b];
  while (i < rows.offsets[a + 1] && j < rows.offsets[b + 1]) {
    if (rows.view[i] < rows.view[j]) {
      ++i;
    } else if (rows.view[j] < rows.view[i]) {
      ++j;
    } else {
      const double both = static_cast<double>(rows.area[i]) + static_cast<double>(rows.area[j]);
      shared += x_log_x(both) - rows.area_log[i++] - rows.area_log[j++];
    }
  }
  return divergence(area_of_face[a], area_of_face[b], shared);
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

std::vector<double> face_saliency(const FaceRows& rows, const std::vector<double>& area_of_face,
                                  const TriMesh& mesh, const RunContext& run) {
  const IndexLists around = faces_around(mesh);
  // Each pair once, at the lower face.
  std::vector<double> of_pair(around.values.size(), 0.0);
  parallel_for(run, around.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      for (std::uint32_t k = around.offsets[f]; k < around.offsets[f + 1]; ++k) {
        if (around.values[k] > f) {
          of_pair[k] =
              face_divergence(rows, area_of_face, static_cast<std::uint32_t>(f), around.values[k]);
        }
      }
    }
  });
  std::vector<double> saliency(area_of_face.size(), 0.0);
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
    if (area_of_face[f] > 0.0 && !around[f].empty()) {
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

/// a log a of each face seen.
std::vector<double> area_logs(std::span<const FaceArea> seen) {
  std::vector<double> logs;
  logs.reserve(seen.size());
  for (const FaceArea& a : seen) {
    logs.push_back(x_log_x(a.area));
  }
  return logs;
}

/// A view with what every divergence from another needs of it.
struct ViewWithLogs {
  std::span<const FaceArea> seen{};
  double area = 0.0;
  std::vector<double> logs{};
};

double divergence_of(const ViewWithLogs& a, const ViewWithLogs& b) {
  double shared = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.seen.size() && j < b.seen.size()) {
    if (a.seen[i].face < b.seen[j].face) {
      ++i;
    } else if (b.seen[j].face < a.seen[i].face) {
      ++j;
    } else {
      const double both = static_cast<double>(a.seen[i].area) + static_cast<double>(b.seen[j].area);
      shared += x_log_x(both) - (a.logs[i++] + b.logs[j++]);
    }
  }
  return divergence(a.area, b.area, shared);
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
  const FaceRows rows = rows_by_face(channel);
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
  for (std::size_t z = 0; z < faces; ++z) {
    double area = 0.0;
    double logs = 0.0;
    for (std::size_t k = rows.offsets[z]; k < rows.offsets[z + 1]; ++k) {
      area += rows.area[k];
      logs += rows.area_log[k];
    }
    if (area > 0.0) {
      // H(V|z) = log A − (1/A) Σ a log a
      const double entropy = log_2(area) - logs / area;
      terms.area_of_face[z] = area;
      terms.p_of_face[z] = area / total;
      terms.i2_of_face[z] = entropy_of_views - entropy;
      terms.entropy_of_faces -= x_log_x(area / total);
      terms.mutual_information += terms.p_of_face[z] * terms.i2_of_face[z];
    }
  }
  terms.saliency_of_face = face_saliency(rows, terms.area_of_face, mesh, run);
  terms.weighted_p = weighted_by_saliency(terms.p_of_face, terms.saliency_of_face);
  terms.log_p = logarithms(terms.p_of_face);
  terms.log_weighted_p = logarithms(terms.weighted_p);
  std::vector<double> shares = face_areas(mesh);
  const double surface = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) {
    share /= surface;
  }
  terms.log_share = logarithms(shares);
  return terms;
}

ChannelMeasures channel_measures(std::span<const FaceArea> seen, const ChannelTerms& terms,
                                 std::span<const double> face_areas) {
  ChannelMeasures m;
  m.projected_area = area_seen(seen);
  if (!(m.projected_area > 0.0)) {
    m.kullback_leibler = m.vmi = m.i2 = m.evmi = kNever;
    return m;
  }
  const double surface = std::accumulate(face_areas.begin(), face_areas.end(), 0.0);
  double seen_surface = 0.0;
  for (const FaceArea& a : seen) {
    const double p = a.area / m.projected_area;
    const double log_p = log_2(p);
    m.entropy -= p * log_p;
    m.kullback_leibler += p * (log_p - terms.log_share[a.face]);
    m.vmi += p * (log_p - terms.log_p[a.face]);
    m.i3 += p * terms.i2_of_face[a.face];
    m.evmi += p * (log_p - terms.log_weighted_p[a.face]);
    if (terms.area_of_face[a.face] > 0.0) {
      m.pmi_saliency += terms.saliency_of_face[a.face] * a.area / terms.area_of_face[a.face];
    }
    seen_surface += face_areas[a.face];
  }
  m.visible_triangles = static_cast<double>(seen.size());
  m.visibility_ratio = surface > 0.0 ? seen_surface / surface : 0.0;
  m.i2 = terms.entropy_of_faces - m.entropy;
  return m;
}

double view_divergence(std::span<const FaceArea> a, std::span<const FaceArea> b) {
  return divergence_of({a, area_seen(a), area_logs(a)}, {b, area_seen(b), area_logs(b)});
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

std::vector<double> neighbour_divergences(const std::vector<std::vector<FaceArea>>& views,
                                          const IndexLists& next, const RunContext& run) {
  std::vector<double> divergences(next.values.size(), 1.0);
  std::vector<ViewWithLogs> with_logs(views.size());
  parallel_for(run, views.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      with_logs[i] = {views[i], area_seen(views[i]), area_logs(views[i])};
    }
  });
  parallel_for(run, views.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::uint32_t k = next.offsets[i]; k < next.offsets[i + 1]; ++k) {
        const std::uint32_t j = next.values[k];
        if (j > i && !views[i].empty() && !views[j].empty()) {
          const auto back = next[j];
          const auto at = std::lower_bound(back.begin(), back.end(), i) - back.begin();
          divergences[k] = divergence_of(with_logs[i], with_logs[j]);
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
