// SPDX-License-Identifier: MIT
#include "visibility/slivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <tuple>

#include <Eigen/Geometry>

namespace vantage {
namespace {

// Parts of an edge shorter than this share of it are rounding: where it ends on a contour.
constexpr double kShortest = 1e-9;
// Contours compared with edges for one eye, some tenths of a second: models tried take a tenth of
// it. Where thousands of faces share a place of the picture no more is looked for.
constexpr std::size_t kPatience = 10'000'000;

/// Where the segment ab passes through the inside of a triangle, as a share of the way.
std::optional<double> piercing(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& corners,
                               const Vec3& normal) {
  const double from = normal.dot(a - corners[0]);
  const double to = normal.dot(b - corners[0]);
  if (!(from * to < 0.0)) {
    return std::nullopt;
  }
  const double share = from / (from - to);
  const Vec3 place = a + share * (b - a);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& corner = corners[k];
    if (!(normal.dot((corners[(k + 1) % 3] - corner).cross(place - corner)) > 0.0)) {
      return std::nullopt;
    }
  }
  return share;
}

}  // namespace

/// An edge past which the surface turns away.
struct SliverSearch::Contour {
  SitePicture::Box box{};               // in the picture
  std::array<std::uint32_t, 2> edge{};  // sites
  Vec3 normal = Vec3::Zero();           // of the plane through it and the eye
};

/// Contours by the cells of a grid in the picture that they pass through.
class SliverSearch::Contours {
 public:
  /// Those that may cross one of the edges.
  Contours(const SliverSearch& search, const Viewpoint& eye, const SitePicture& picture,
           std::span<const std::uint32_t> contours, std::span<const std::uint32_t> edges);

  /// Calls each(contour) for all that may cross an edge, for some more than once.
  template <typename Each>
  void near(const std::array<std::uint32_t, 2>& edge, const Each& each) const {
    over_cells(edge, [&](std::size_t cell) {
      for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
        each(all_[in_cells_[i]]);
      }
    });
  }

 private:
  [[nodiscard]] int nearest_cell(double place) const {
    return static_cast<int>(std::clamp(std::floor(place), 0.0, side_ - 1.0));
  }

  void lay_grid();
  template <typename Each>
  void over_cells(const std::array<std::uint32_t, 2>& edge, const Each& each) const;

  const SitePicture& picture_;
  SitePicture::Box box_{};  // of the edges
  std::vector<Contour> all_{};
  int side_ = 1;  // cells
  Eigen::Vector2d per_cell_ = Eigen::Vector2d::Ones();
  std::vector<std::uint32_t> first_{}, in_cells_{};  // of each cell, and one past the last
};

SliverSearch::Contours::Contours(const SliverSearch& search, const Viewpoint& eye,
                                 const SitePicture& picture,
                                 std::span<const std::uint32_t> contours,
                                 std::span<const std::uint32_t> edges)
    : picture_(picture) {
  for (const std::uint32_t e : edges) {
    box_.extend(picture.box(search.edges_.table.edges[e]));
  }
  const std::vector<Vec3>& sites = search.surface_.sites;
  for (const std::uint32_t e : contours) {
    const auto& edge = search.edges_.table.edges[e];
    const SitePicture::Box box = picture.box(edge);
    if (box.intersects(box_)) {
      const Vec3& from = sites[edge[0]];
      all_.push_back({box, edge, (sites[edge[1]] - from).cross(sight_line(from, eye))});
    }
  }
  lay_grid();
}

/// About as many cells as contours.
void SliverSearch::Contours::lay_grid() {
  side_ = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(all_.size() + 1))));
  for (int k = 0; k < 2; ++k) {
    const double extent = box_.sizes()[k];
    per_cell_[k] = extent > 0.0 ? side_ / extent : 1.0;
  }
  first_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) + 1, 0);
  for (const Contour& contour : all_) {
    over_cells(contour.edge, [&](std::size_t cell) { ++first_[cell]; });
  }
  std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
  in_cells_.resize(first_.back());
  for (std::uint32_t i = 0; i < all_.size(); ++i) {
    over_cells(all_[i].edge, [&](std::size_t cell) { in_cells_[--first_[cell]] = i; });
  }
}

/// Calls each(cell) for the cells that an edge passes through, row by row, and for some beside
/// them.
template <typename Each>
void SliverSearch::Contours::over_cells(const std::array<std::uint32_t, 2>& edge,
                                        const Each& each) const {
  constexpr double kSlack = 1e-9;  // cells: rounding moves an edge less
  constexpr double kLevel = 1e-6;  // cells: where rows say nothing
  Eigen::Vector2d from = (picture_.places[edge[0]] - box_.min()).cwiseProduct(per_cell_);
  Eigen::Vector2d to = (picture_.places[edge[1]] - box_.min()).cwiseProduct(per_cell_);
  if (from.y() > to.y()) {
    std::swap(from, to);
  }
  const auto [left, right] = std::minmax(from.x(), to.x());
  if (right < -kSlack || left > side_ + kSlack || to.y() < -kSlack || from.y() > side_ + kSlack) {
    return;
  }
  const double rise = to.y() - from.y();
  const auto across = [&](double y) {  // where the edge is at this height, if it gets there
    return from.x() + std::clamp((y - from.y()) / rise, 0.0, 1.0) * (to.x() - from.x());
  };
  const int last = nearest_cell(to.y() + kSlack);
  for (int row = nearest_cell(from.y() - kSlack); row <= last; ++row) {
    double a = left;
    double b = right;
    if (rise > kLevel) {
      std::tie(a, b) = std::minmax({across(row), across(row + 1.0)});
    }
    const auto begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
    const int end = nearest_cell(b + kSlack);
    for (int column = nearest_cell(a - kSlack); column <= end; ++column) {
      each(begin + static_cast<std::size_t>(column));
    }
  }
}

SliverSearch::SliverSearch(const Surface& surface, const SurfaceEdges& edges,
                           const CandidateScene& scene, std::span<const std::uint8_t> backs)
    : surface_(surface), edges_(edges), crossed_(surface.faces.size(), 0) {
  // Backs hide nothing for themselves where a shell is closed and nowhere meets itself.
  const bool is_clear = std::find(backs.begin(), backs.end(), 1) == backs.end() &&
                        std::adjacent_find(edges.shell_of_face.begin(), edges.shell_of_face.end(),
                                           std::not_equal_to<>()) == edges.shell_of_face.end();
  if (is_clear) {
    first_pierced_.assign(edges.table.edges.size() + 1, 0);
  } else {
    find_pierced(scene);
  }
}

void SliverSearch::find_pierced(const CandidateScene& scene) {
  for (std::size_t e = 0; e < edges_.table.edges.size(); ++e) {
    const auto& [a, b] = edges_.table.edges[e];
    const Vec3& from = surface_.sites[a];
    const Vec3 way = surface_.sites[b] - from;
    const double length = way.norm();
    const auto add_if_pierced = [&, a = a, b = b](std::uint32_t f) {
      const Triangle& t = surface_.faces[f];
      if (std::find_if(t.begin(), t.end(), [&](std::uint32_t s) { return s == a || s == b; }) ==
          t.end()) {
        if (const auto share =
                piercing(from, surface_.sites[b],
                         {surface_.sites[t[0]], surface_.sites[t[1]], surface_.sites[t[2]]},
                         surface_.area_vectors[f])) {
          pierced_.push_back(*share);
          crossed_[f] = 1;
          for (const std::uint32_t beside : edges_.table.faces_of_edge[e]) {
            crossed_[beside] = 1;
          }
        }
      }
      return false;  // go on: all are wanted
    };
    if (length > 0.0) {
      static_cast<void>(scene.any(from, way / length, length, add_if_pierced));
    }
    first_pierced_.push_back(pierced_.size());
  }
}

/// Unless two faces lie beside each other at the edge in the picture.
bool SliverSearch::is_contour(std::size_t edge, std::span<const std::uint8_t> turned) const {
  if (edges_.pairs[edge] == EdgePair::None) {
    return true;
  }
  const std::uint8_t one = turned[edges_.beside[edge][0]];
  const std::uint8_t other = turned[edges_.beside[edge][1]];
  return one == 0 || other == 0 || (one == other) != (edges_.pairs[edge] == EdgePair::Opposite);
}

/// Adds where the edge passes behind a contour. \return how many contours it was compared with.
std::size_t SliverSearch::add_crossings(std::size_t edge, const Viewpoint& eye,
                                        const SitePicture& picture, const Contours& contours,
                                        std::vector<double>& cuts) const {
  std::size_t compared = 0;
  const auto& ends = edges_.table.edges[edge];
  const Vec3& a = surface_.sites[ends[0]];
  const Vec3& b = surface_.sites[ends[1]];
  const SitePicture::Box box = picture.box(ends);
  const Vec3 normal = (b - a).cross(sight_line(a, eye));
  contours.near(ends, [&](const Contour& contour) {
    ++compared;
    if (!box.intersects(contour.box)) {
      return;
    }
    const Vec3& c = surface_.sites[contour.edge[0]];
    const Vec3& d = surface_.sites[contour.edge[1]];
    const double of_a = contour.normal.dot(a - c);
    const double of_b = contour.normal.dot(b - c);
    const double of_c = normal.dot(c - a);
    const double of_d = normal.dot(d - a);
    if (!(of_a * of_b < 0.0 && of_c * of_d < 0.0)) {
      return;
    }
    const double share = of_a / (of_a - of_b);
    const Vec3 here = a + share * (b - a);
    const Vec3 there = c + of_c / (of_c - of_d) * (d - c);
    if ((there - here).dot(sight_line(here, eye)) > 0.0) {
      cuts.push_back(share);
    }
  });
  return compared;
}

/// Adds the middle of each part of an edge, if a wanted face is in view beside it where it is in
/// view.
/// \param cuts in any order.
void SliverSearch::add_places(std::size_t edge, const Viewpoint& eye, const Asked& asked,
                              std::vector<double>& cuts, EdgePlaces& result) const {
  auto [owner, also] = edges_.beside[edge];
  bool of_both = owner != also;
  if (owner != also && is_contour(edge, asked.turned)) {
    // Both on one side: the one that lies behind the other's plane is hidden by it.
    const auto [s, t] = edges_.table.edges[edge];
    const Triangle& corners = surface_.faces[also];
    const auto third = std::find_if(corners.begin(), corners.end(),
                                    [s = s, t = t](std::uint32_t v) { return v != s && v != t; });
    const Vec3& normal = surface_.area_vectors[owner];
    const Vec3& on_edge = surface_.sites[s];
    const double of_eye = normal.dot(sight_line(on_edge, eye));
    if (third != corners.end() && of_eye * normal.dot(surface_.sites[*third] - on_edge) > 0.0) {
      std::swap(owner, also);
    }
    of_both = false;
  }
  if (asked.wanted[owner] == 0 && !(of_both && asked.wanted[also] != 0)) {
    return;
  }
  cuts.push_back(0.0);
  cuts.push_back(1.0);
  std::sort(cuts.begin(), cuts.end());
  const Vec3& from = surface_.sites[edges_.table.edges[edge][0]];
  const Vec3 way = surface_.sites[edges_.table.edges[edge][1]] - from;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    if (cuts[k] - cuts[k - 1] > kShortest) {
      result.places.emplace_back(from + 0.5 * (cuts[k - 1] + cuts[k]) * way);
      result.owner.push_back(owner);
      result.also.push_back(also);
      result.of_both.push_back(of_both ? 1 : 0);
      result.halves.emplace_back(0.5 * (cuts[k] - cuts[k - 1]) * way);
    }
  }
}

EdgePlaces SliverSearch::places(const Viewpoint& eye, const SitePicture& picture,
                                const Asked& asked) const {
  EdgePlaces result;
  std::vector<std::uint32_t> edges;
  for (std::size_t f = 0; f < asked.wanted.size(); ++f) {
    if (asked.wanted[f] != 0) {
      edges.insert(edges.end(), edges_.of_face[f].begin(), edges_.of_face[f].end());
    }
  }
  if (edges.empty()) {
    return result;
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const Contours contours(*this, eye, picture, asked.contours, edges);
  std::vector<double> cuts;
  std::size_t compared = 0;
  for (const std::uint32_t e : edges) {
    if (compared > kPatience) {
      break;
    }
    if (edges_.table.faces_of_edge[e].size() > 2) {
      continue;
    }
    cuts.assign(pierced_.begin() + static_cast<std::ptrdiff_t>(first_pierced_[e]),
                pierced_.begin() + static_cast<std::ptrdiff_t>(first_pierced_[e + 1]));
    compared += add_crossings(e, eye, picture, contours, cuts);
    if (!cuts.empty()) {  // else the ends tell
      add_places(e, eye, asked, cuts, result);
    }
  }
  return result;
}

}  // namespace vantage
