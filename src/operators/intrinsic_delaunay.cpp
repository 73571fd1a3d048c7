// SPDX-License-Identifier: MIT
#include "operators/intrinsic_delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "operators/row_scaling.h"

namespace vantage {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
/// Mollification: by how much, over the mean length, two sides must be longer than the third.
constexpr double kMollified = 1e-5;
/// Cotangents that add up to more than this are Delaunay: rounding must not flip for ever.
constexpr double kTie = -1e-9;
/// Flips at most, for each side of a face; on real surfaces it takes fewer than two.
constexpr std::size_t kMostFlips = 20;

/// A side of a triangle: that opposite corner `corner` of `face`.
struct Side {
  std::uint32_t face = kNone;
  std::uint32_t corner = 0;
};

/// Triangles glued along sides, known by their lengths alone.
class IntrinsicTriangulation {
 public:
  IntrinsicTriangulation(std::span<const Vec3> positions, std::span<const Triangle> triangles)
      : triangles_(triangles.begin(), triangles.end()),
        length_(triangles.size()),
        cotangent_(triangles.size()),
        beyond_(triangles.size()) {
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      for (std::size_t c = 0; c < 3; ++c) {
        length_[f][c] =
            (positions[triangles_[f][(c + 1) % 3]] - positions[triangles_[f][(c + 2) % 3]]).norm();
      }
    }
    glue();
    mollify();
    for (std::size_t f = 0; f < size(); ++f) {
      keep_cotangents(f);
    }
  }

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

  [[nodiscard]] const Triangle& corners(std::size_t f) const { return triangles_[f]; }

  /// Of the angle at a corner; 0 in a triangle without area.
  [[nodiscard]] double cotangent(std::size_t f, std::size_t c) const { return cotangent_[f][c]; }

  /// Flips edges until all are Delaunay.
  void flip_to_delaunay() {
    std::deque<Side> queue;
    for (std::uint32_t f = 0; f < size(); ++f) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        queue.push_back({f, c});
      }
    }
    std::size_t left = kMostFlips * queue.size();
    while (!queue.empty() && left > 0) {
      const Side side = queue.front();
      queue.pop_front();
      if (!wants_flip(side)) {
        continue;
      }
      const std::uint32_t other = beyond(side).face;
      flip(side);
      --left;
      for (std::uint32_t c = 0; c < 3; ++c) {
        queue.push_back({side.face, c});
        queue.push_back({other, c});
      }
    }
  }

 private:
  [[nodiscard]] Side beyond(Side side) const { return beyond_[side.face][side.corner]; }

  void join(Side a, Side b) {
    beyond_[a.face][a.corner] = b;
    if (b.face != kNone) {
      beyond_[b.face][b.corner] = a;
    }
  }

  /// Finds the other side of every edge of two faces that run along it in opposite directions.
  void glue() {
    struct SideEntry {
      std::uint32_t low, high;
      bool ascends;
      Side side;
    };

    std::vector<SideEntry> entries;
    entries.reserve(3 * size());
    for (std::uint32_t f = 0; f < size(); ++f) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t a = triangles_[f][(c + 1) % 3];
        const std::uint32_t b = triangles_[f][(c + 2) % 3];
        entries.push_back({std::min(a, b), std::max(a, b), a < b, {f, c}});
      }
    }
    std::stable_sort(entries.begin(), entries.end(), [](const SideEntry& a, const SideEntry& b) {
      return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    for (std::size_t i = 0; i < entries.size();) {
      std::size_t end = i + 1;
      while (end < entries.size() && entries[end].low == entries[i].low &&
             entries[end].high == entries[i].high) {
        ++end;
      }
      if (end == i + 2 && entries[i].ascends != entries[i + 1].ascends) {
        join(entries[i].side, entries[i + 1].side);
      }
      i = end;
    }
  }

  void mollify() {
    double sum = 0.0;
    for (const auto& length : length_) {
      sum += length[0] + length[1] + length[2];
    }
    const double margin = kMollified * sum / (3.0 * static_cast<double>(length_.size()));
    double missing = 0.0;
    for (const auto& l : length_) {
      const double longest = std::max({l[0], l[1], l[2]});
      missing = std::max(missing, margin + 2.0 * longest - (l[0] + l[1] + l[2]));
    }
    for (auto& l : length_) {
      for (double& side : l) {
        side += missing;
      }
    }
  }

  /// Kahan's order of Heron's formula: exact enough for needles.
  [[nodiscard]] double area(std::size_t f) const {
    std::array<double, 3> l = length_[f];
    std::sort(l.begin(), l.end(), std::greater<>());
    const double product = (l[0] + (l[1] + l[2])) * (l[2] - (l[0] - l[1])) *
                           (l[2] + (l[0] - l[1])) * (l[0] + (l[1] - l[2]));
    return product > 0.0 ? 0.25 * std::sqrt(product) : 0.0;
  }

  /// Kept because each is asked for several times before its triangle changes.
  void keep_cotangents(std::size_t f) {
    const double area4 = 4.0 * area(f);
    for (std::size_t c = 0; c < 3; ++c) {
      const double a = length_[f][c];
      const double b = length_[f][(c + 1) % 3];
      const double d = length_[f][(c + 2) % 3];
      cotangent_[f][c] = area4 > 0.0 ? (b * b + d * d - a * a) / area4 : 0.0;
    }
  }

  [[nodiscard]] bool wants_flip(Side side) const {
    const Side other = beyond(side);
    return other.face != kNone && other.face != side.face &&
           cotangent(side.face, side.corner) + cotangent(other.face, other.corner) < kTie;
  }

  /// Where the corner opposite a side lies, with the side's first end at 0 and its second at `base`
  /// on the x axis.
  [[nodiscard]] std::array<double, 2> apex(Side side, bool mirrored) const {
    const auto& l = length_[side.face];
    const double base = l[side.corner];
    const double first = l[(side.corner + (mirrored ? 1 : 2)) % 3];  // from the first end
    const double second = l[(side.corner + (mirrored ? 2 : 1)) % 3];
    return {(base * base + first * first - second * second) / (2.0 * base),
            2.0 * area(side.face) / base};
  }

  /// Faces k i j and l j i become k i l and l j k.
  void flip(Side f) {
    const Side g = beyond(f);
    const std::array<double, 2> above = apex(f, false);
    const std::array<double, 2> below = apex(g, true);
    const double diagonal = std::hypot(above[0] - below[0], above[1] + below[1]);
    const auto next = [](std::uint32_t c) { return (c + 1) % 3; };
    const std::uint32_t k = triangles_[f.face][f.corner];
    const std::uint32_t i = triangles_[f.face][next(f.corner)];
    const std::uint32_t l = triangles_[g.face][g.corner];
    const std::uint32_t j = triangles_[g.face][next(g.corner)];
    const Side f_i{f.face, next(f.corner)};
    const Side f_j{f.face, next(next(f.corner))};
    const Side g_j{g.face, next(g.corner)};
    const Side g_i{g.face, next(next(g.corner))};
    // What lies beyond the four outer sides, with sides of the two faces themselves renamed.
    const auto renamed = [&](Side s) {
      const auto is = [&](Side t) { return s.face == t.face && s.corner == t.corner; };
      return is(g_j)   ? Side{f.face, 0}
             : is(f_j) ? Side{f.face, 2}
             : is(f_i) ? Side{g.face, 0}
             : is(g_i) ? Side{g.face, 2}
                       : s;
    };
    const Side il = renamed(beyond(g_j));
    const Side ki = renamed(beyond(f_j));
    const Side jk = renamed(beyond(f_i));
    const Side lj = renamed(beyond(g_i));
    const std::array<double, 3> length_f{length_[g.face][g_j.corner], diagonal,
                                         length_[f.face][f_j.corner]};
    const std::array<double, 3> length_g{length_[f.face][f_i.corner], diagonal,
                                         length_[g.face][g_i.corner]};
    triangles_[f.face] = {k, i, l};
    triangles_[g.face] = {l, j, k};
    length_[f.face] = length_f;
    length_[g.face] = length_g;
    keep_cotangents(f.face);
    keep_cotangents(g.face);
    join({f.face, 1}, {g.face, 1});
    join({f.face, 0}, il);
    join({f.face, 2}, ki);
    join({g.face, 0}, jk);
    join({g.face, 2}, lj);
  }

  std::vector<Triangle> triangles_;
  std::vector<std::array<double, 3>> length_;
  std::vector<std::array<double, 3>> cotangent_;  ///< Of the angle at each corner.
  std::vector<std::array<Side, 3>> beyond_;
};

}  // namespace

Eigen::SparseMatrix<double> intrinsic_laplacian(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles,
                                                const LaplacianLimits& limits) {
  const auto n = static_cast<Eigen::Index>(positions.size());
  Eigen::SparseMatrix<double> L(n, n);
  if (triangles.empty()) {
    return L;
  }
  IntrinsicTriangulation surface(positions, triangles);
  surface.flip_to_delaunay();
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(6 * surface.size() + positions.size());
  for (std::size_t f = 0; f < surface.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = static_cast<int>(surface.corners(f)[(c + 1) % 3]);
      const auto j = static_cast<int>(surface.corners(f)[(c + 2) % 3]);
      if (i != j) {  // an edge that flips have led back to its own vertex pulls nowhere
        const double w = std::clamp(surface.cotangent(f, c), -limits.cotangent, limits.cotangent);
        entries.emplace_back(i, j, w);
        entries.emplace_back(j, i, w);
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 0.0);
  }
  L.setFromTriplets(entries.begin(), entries.end());
  finish_rows(L, limits);
  return L;
}

}  // namespace vantage
