// SPDX-License-Identifier: MIT
#include "visibility/slivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "spatial/ray_scene.h"

namespace vantage {
namespace {

// Parts of an edge shorter than this share of it are rounding: where it ends on a contour.
constexpr double kShortest = 1e-9;

/// From a place to the eye, or towards it.
Vec3 sight_line(const Vec3& place, const Viewpoint& eye) {
  return eye.projection == Projection::Perspective ? Vec3(eye.position - place) : eye.position;
}

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

/// Where the sites are on a plane across the line of sight.
struct SliverSearch::Picture {
  std::vector<double> x{}, y{};
  bool is_whole = true;  // all of them are ahead of the eye

  Picture(const Surface& surface, const Viewpoint& eye) {
    const bool is_perspective = eye.projection == Projection::Perspective;
    const Vec3 towards = eye.position.normalized();
    const Vec3 right = towards.unitOrthogonal();
    const Vec3 up = towards.cross(right);
    x.reserve(surface.sites.size());
    y.reserve(surface.sites.size());
    for (const Vec3& site : surface.sites) {
      const double depth = is_perspective ? (eye.position - site).dot(towards) : 1.0;
      is_whole = is_whole && depth > 0.0;
      x.push_back(site.dot(right) / depth);
      y.push_back(site.dot(up) / depth);
    }
  }
};

/// An edge past which the surface turns away.
struct SliverSearch::Contour {
  double left = 0.0, right = 0.0, low = 0.0, high = 0.0;  // in the picture
  std::uint32_t c = 0, d = 0;                             // sites
  Vec3 normal = Vec3::Zero();                             // of the plane through it and the eye
};

SliverSearch::SliverSearch(const Surface& surface)
    : surface_(&surface), table_(build_edge_table({surface.sites, surface.faces})) {
  const CandidateScene candidates(surface.sites, surface.faces);
  for (const auto& [a, b] : table_.edges) {
    const Vec3& from = surface.sites[a];
    const Vec3 way = surface.sites[b] - from;
    const double length = way.norm();
    const auto add_if_pierced = [&, a = a, b = b](std::uint32_t f) {
      const Triangle& t = surface.faces[f];
      if (std::find_if(t.begin(), t.end(), [&](std::uint32_t s) { return s == a || s == b; }) ==
          t.end()) {
        if (const auto share =
                piercing(from, surface.sites[b],
                         {surface.sites[t[0]], surface.sites[t[1]], surface.sites[t[2]]},
                         surface.area_vectors[f])) {
          pierced_.push_back(*share);
        }
      }
      return false;  // go on: all are wanted
    };
    if (length > 0.0) {
      static_cast<void>(candidates.any(from, way / length, length, add_if_pierced));
    }
    first_pierced_.push_back(pierced_.size());
  }
}

/// On which side of the edge the face lies in the picture, 1 or −1, 0 if it is seen edge on.
int SliverSearch::side_in_picture(std::size_t edge, std::uint32_t face,
                                  std::span<const std::uint8_t> turned) const {
  const Triangle& t = surface_->faces[face];
  const auto at =
      static_cast<std::size_t>(std::find(t.begin(), t.end(), table_.edges[edge][0]) - t.begin());
  const int along = t[(at + 1) % 3] == table_.edges[edge][1] ? 1 : -1;
  return turned[face] == 1 ? along : turned[face] == 2 ? -along : 0;
}

bool SliverSearch::is_contour(std::size_t edge, std::span<const std::uint8_t> turned) const {
  const auto faces = table_.faces_of_edge[edge];
  return faces.size() != 2 ||
         side_in_picture(edge, faces[0], turned) * side_in_picture(edge, faces[1], turned) != -1;
}

std::vector<SliverSearch::Contour> SliverSearch::contours(
    const Viewpoint& eye, const Picture& picture, std::span<const std::uint8_t> turned) const {
  std::vector<Contour> found;
  for (std::size_t e = 0; e < table_.edges.size(); ++e) {
    if (is_contour(e, turned)) {
      const auto [c, d] = table_.edges[e];
      const Vec3& from = surface_->sites[c];
      const auto [left, right] = std::minmax(picture.x[c], picture.x[d]);
      const auto [low, high] = std::minmax(picture.y[c], picture.y[d]);
      found.push_back(
          {left, right, low, high, c, d, (surface_->sites[d] - from).cross(sight_line(from, eye))});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Contour& a, const Contour& b) { return a.left < b.left; });
  return found;
}

/// Adds where the edge passes behind a contour.
void SliverSearch::add_crossings(std::size_t edge, const Viewpoint& eye, const Picture& picture,
                                 std::span<const Contour> contours,
                                 std::vector<double>& cuts) const {
  const auto [s, t] = table_.edges[edge];
  const Vec3& a = surface_->sites[s];
  const Vec3& b = surface_->sites[t];
  const auto [left, right] = std::minmax(picture.x[s], picture.x[t]);
  const auto [low, high] = std::minmax(picture.y[s], picture.y[t]);
  const Vec3 normal = (b - a).cross(sight_line(a, eye));
  for (const Contour& contour : contours) {
    if (contour.left >= right) {
      break;
    }
    if (contour.right <= left || contour.low >= high || contour.high <= low) {
      continue;
    }
    const Vec3& c = surface_->sites[contour.c];
    const Vec3& d = surface_->sites[contour.d];
    const double of_a = contour.normal.dot(a - c);
    const double of_b = contour.normal.dot(b - c);
    const double of_c = normal.dot(c - a);
    const double of_d = normal.dot(d - a);
    if (!(of_a * of_b < 0.0 && of_c * of_d < 0.0)) {
      continue;
    }
    const double share = of_a / (of_a - of_b);
    const Vec3 here = a + share * (b - a);
    const Vec3 there = c + of_c / (of_c - of_d) * (d - c);
    if ((there - here).dot(sight_line(here, eye)) > 0.0) {
      cuts.push_back(share);
    }
  }
}

/// Adds the middle of each part of an edge, if a wanted face is in view beside it where it is in
/// view.
/// \param cuts in any order.
void SliverSearch::add_places(std::size_t edge, const Viewpoint& eye, const Asked& asked,
                              std::vector<double>& cuts, EdgePlaces& result) const {
  const auto faces = table_.faces_of_edge[edge];
  std::uint32_t owner = faces[0];
  std::uint32_t also = faces.back();
  bool of_both = owner != also;
  if (owner != also && is_contour(edge, asked.turned)) {
    // Both on one side: the one that lies behind the other's plane is hidden by it.
    const auto [s, t] = table_.edges[edge];
    const Triangle& corners = surface_->faces[also];
    const auto third = std::find_if(corners.begin(), corners.end(),
                                    [s = s, t = t](std::uint32_t v) { return v != s && v != t; });
    const Vec3& normal = surface_->area_vectors[owner];
    const Vec3& on_edge = surface_->sites[s];
    const double of_eye = normal.dot(sight_line(on_edge, eye));
    if (third != corners.end() && of_eye * normal.dot(surface_->sites[*third] - on_edge) > 0.0) {
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
  const Vec3& from = surface_->sites[table_.edges[edge][0]];
  const Vec3 way = surface_->sites[table_.edges[edge][1]] - from;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    if (cuts[k] - cuts[k - 1] > kShortest) {
      result.places.emplace_back(from + 0.5 * (cuts[k - 1] + cuts[k]) * way);
      result.owner.push_back(owner);
      result.also.push_back(also);
      result.of_both.push_back(of_both ? 1 : 0);
      result.lengths.push_back((cuts[k] - cuts[k - 1]) * way.norm());
    }
  }
}

EdgePlaces SliverSearch::places(const Viewpoint& eye, const Asked& asked) const {
  EdgePlaces result;
  const Picture picture(*surface_, eye);
  if (!picture.is_whole) {
    return result;
  }
  const std::vector<Contour> all = contours(eye, picture, asked.turned);
  std::vector<double> cuts;
  for (std::size_t e = 0; e < table_.edges.size(); ++e) {
    const auto faces = table_.faces_of_edge[e];
    const bool is_wanted = std::any_of(faces.begin(), faces.end(),
                                       [&](std::uint32_t f) { return asked.wanted[f] != 0; });
    if (!is_wanted || faces.size() > 2) {
      continue;
    }
    cuts.assign(pierced_.begin() + static_cast<std::ptrdiff_t>(first_pierced_[e]),
                pierced_.begin() + static_cast<std::ptrdiff_t>(first_pierced_[e + 1]));
    add_crossings(e, eye, picture, all, cuts);
    if (!cuts.empty()) {  // else the ends tell
      add_places(e, eye, asked, cuts, result);
    }
  }
  return result;
}

}  // namespace vantage
