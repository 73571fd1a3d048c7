// SPDX-License-Identifier: MIT
#include "mesh/edge_splitting.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "vantage/mesh/topology.h"

namespace vantage {
namespace {

constexpr std::uint32_t kWhole = 0xffffffffu;  // an edge that is not split
/// Lengths closer than this are equal, relatively: rounding must not decide how a symmetric shape is
/// split.
constexpr double kTie = 1e-9;
/// Each round halves the longest edges, up to rounding: enough for edges of any finite length over D.
constexpr int kMostRounds = 40;

/// Whether both halves of an edge are clearly shorter than it is. Where its ends are but a few steps of
/// rounding apart they need not be, and splitting would never end.
bool shortens(const Vec3& a, const Vec3& middle, const Vec3& b) {
  const double most = 0.75 * (a - b).norm();
  return (a - middle).norm() <= most && (middle - b).norm() <= most;
}

/// Middle vertex of each edge that is too long, or kWhole; appends the middles to `mesh`.
std::vector<std::uint32_t> add_middles(TriMesh& mesh, const EdgeTable& table,
                                       const std::vector<double>& longest) {
  std::vector<std::uint32_t> middle(table.edges.size(), kWhole);
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const Vec3 a = mesh.positions[table.edges[e][0]];
    const Vec3 b = mesh.positions[table.edges[e][1]];
    const auto faces = table.faces_of_edge[e];
    const bool is_long = std::any_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      return (a - b).norm() > (1.0 + kTie) * longest[f];
    });
    const Vec3 m = 0.5 * (a + b);
    if (is_long && shortens(a, m, b)) {
      middle[e] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(m);
    }
  }
  return middle;
}

/// Cuts a face whose edges opposite corner c have middles m[c], kWhole if none.
void cut(const TriMesh& mesh, Triangle t, std::array<std::uint32_t, 3> m,
         std::vector<Triangle>& out) {
  const auto split = 3 - std::count(m.begin(), m.end(), kWhole);
  const auto turn = [&] {
    std::rotate(t.begin(), t.begin() + 1, t.end());
    std::rotate(m.begin(), m.begin() + 1, m.end());
  };
  if (split == 0) {
    out.push_back(t);
  } else if (split == 1) {
    while (m[0] == kWhole) {
      turn();
    }
    out.push_back({t[0], t[1], m[0]});
    out.push_back({t[0], m[0], t[2]});
  } else if (split == 2) {
    while (m[0] != kWhole) {
      turn();
    }
    // Edge t1 t2 is whole; the quadrilateral t1 t2 m1 m2 is cut along its shorter diagonal.
    out.push_back({t[0], m[2], m[1]});
    const auto& x = mesh.positions;
    if ((x[t[1]] - x[m[1]]).norm() <= (1.0 + kTie) * (x[t[2]] - x[m[2]]).norm()) {
      out.push_back({t[1], t[2], m[1]});
      out.push_back({t[1], m[1], m[2]});
    } else {
      out.push_back({t[1], t[2], m[2]});
      out.push_back({t[2], m[1], m[2]});
    }
  } else {
    out.push_back({t[0], m[2], m[1]});
    out.push_back({t[1], m[0], m[2]});
    out.push_back({t[2], m[1], m[0]});
    out.push_back({m[0], m[1], m[2]});
  }
}

}  // namespace

std::optional<TriMesh> split_long_edges(const TriMesh& mesh, std::vector<double> longest,
                                        std::size_t most_added, const RunContext& run) {
  TriMesh fine = mesh;
  for (int round = 0; round < kMostRounds; ++round) {
    run.check();
    const EdgeTable table = build_edge_table(fine);
    const std::size_t before = fine.positions.size();
    const std::vector<std::uint32_t> middle = add_middles(fine, table, longest);
    if (fine.positions.size() == before) {
      break;
    }
    if (fine.positions.size() - mesh.positions.size() > most_added) {
      return std::nullopt;
    }
    std::vector<std::array<std::uint32_t, 3>> middles(fine.triangles.size(),
                                                      {kWhole, kWhole, kWhole});
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
      const auto [a, b] = table.edges[e];
      for (const std::uint32_t f : table.faces_of_edge[e]) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::uint32_t corner = fine.triangles[f][c];
          if (corner != a && corner != b) {
            middles[f][c] = middle[e];
          }
        }
      }
    }
    std::vector<Triangle> triangles;
    std::vector<double> longest_now;
    for (std::size_t f = 0; f < fine.triangles.size(); ++f) {
      cut(fine, fine.triangles[f], middles[f], triangles);
      longest_now.resize(triangles.size(), longest[f]);
    }
    fine.triangles = std::move(triangles);
    longest = std::move(longest_now);
  }
  return fine;
}

}  // namespace vantage
