// SPDX-License-Identifier: MIT
#include "visibility/face_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace vantage {
namespace {

// A piece below this share of the area of an equilateral one of the wanted size is not cut again,
// however long: it bounds the number of pieces by area, and a fan of needles is still sampled in
// proportion to its area. [ours]
constexpr double kLeastArea = 1.0 / 4.0;

/// A piece of a face, by the barycentric coordinates of its corners.
using Piece = std::array<Vec3, 3>;

/// Cuts a face across the longest side until its pieces are small.
class Cutter {
 public:
  explicit Cutter(double longest)
      : longest_(longest), least_area_(kLeastArea * 0.25 * std::sqrt(3.0) * longest * longest) {}

  /// Calls take(piece, area) with the pieces of the triangle: the barycentric coordinates of their
  /// corners, and their areas in units of the corners.
  template <class Take>
  void cut(const std::array<Vec3, 3>& corners, double area, const Take& take) {
    stack_.assign(1, {{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, area});
    while (!stack_.empty()) {
      const auto [piece, size] = stack_.back();
      stack_.pop_back();
      const std::size_t side = longest_side(corners, piece);
      if (size <= least_area_ || length(corners, piece, side) <= longest_) {
        take(piece, size);
        continue;
      }
      const Vec3 middle = 0.5 * (piece[side] + piece[(side + 1) % 3]);
      Piece first = piece;
      Piece second = piece;
      first[side] = middle;
      second[(side + 1) % 3] = middle;
      stack_.push_back({first, 0.5 * size});
      stack_.push_back({second, 0.5 * size});
    }
  }

 private:
  static Vec3 place(const std::array<Vec3, 3>& corners, const Vec3& weights) {
    return weights.x() * corners[0] + weights.y() * corners[1] + weights.z() * corners[2];
  }

  static double length(const std::array<Vec3, 3>& corners, const Piece& piece, std::size_t side) {
    return (place(corners, piece[side]) - place(corners, piece[(side + 1) % 3])).norm();
  }

  static std::size_t longest_side(const std::array<Vec3, 3>& corners, const Piece& piece) {
    std::size_t longest = 0;
    for (const std::size_t side : {std::size_t{1}, std::size_t{2}}) {
      if (length(corners, piece, side) > length(corners, piece, longest)) {
        longest = side;
      }
    }
    return longest;
  }

  struct Part {
    Piece piece{};
    double area = 0.0;
  };

  double longest_;
  double least_area_;
  std::vector<Part> stack_{};
};

std::array<Vec3, 3> corners_of(const Surface& surface, std::size_t f) {
  const auto& [a, b, c] = surface.faces[f];
  return {surface.sites[a], surface.sites[b], surface.sites[c]};
}

/// What tells one node from another: the lowest two sites that it lies between and its share of the
/// first, or the face that it lies in and its shares. Shares are sums of powers of two, hence
/// exact.
struct NodeName {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  double share = 0.0;
  double other_share = 0.0;

  [[nodiscard]] auto key() const { return std::tie(first, second, share, other_share); }
};

NodeName name_of(const Triangle& face, std::uint32_t f, const Vec3& weights) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    if (weights[at] == 1.0) {
      return {face[k], face[k], 1.0, 0.0};
    }
    if (weights[at] == 0.0) {
      const std::size_t u = (k + 1) % 3;
      const std::size_t v = (k + 2) % 3;
      const double share = weights[static_cast<Eigen::Index>(face[u] < face[v] ? u : v)];
      if (share > 0.0 && share < 1.0) {
        return {std::min(face[u], face[v]), std::max(face[u], face[v]), share, 0.0};
      }
    }
  }
  return {Surface::kNoSite, f, weights.x(), weights.y()};
}

/// Numbers the names: sites by themselves, then nodes on edges, which are to be asked about, then
/// those in faces. \param face_of of each three names. \pre net holds the corners and all
/// centroids.
void number_nodes(const std::vector<NodeName>& names, const std::vector<std::uint32_t>& face_of,
                  std::size_t sites, PieceNet& net) {
  std::vector<std::uint32_t> order(names.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple_cat(names[a].key(), std::tie(a)) <
           std::tuple_cat(names[b].key(), std::tie(b));
  });
  net.nodes.resize(face_of.size());
  net.node_count = sites;
  const NodeName* last = nullptr;
  for (const std::uint32_t i : order) {
    const NodeName& name = names[i];
    std::uint32_t& number = net.nodes[i / 3][i % 3];
    if (name.first == name.second) {
      number = name.first;
      continue;
    }
    const bool is_new = last == nullptr || last->key() != name.key();
    const bool on_edge = name.first != Surface::kNoSite;
    net.node_count += is_new ? 1 : 0;
    number = static_cast<std::uint32_t>(net.node_count - 1);
    if (on_edge && is_new) {
      net.places.push_back(net.corners[i / 3][i % 3]);
      net.owner.push_back(face_of[i / 3]);
      net.also.push_back(face_of[i / 3]);
      net.ends.push_back({name.first, name.second});
    } else if (on_edge && face_of[i / 3] != net.owner.back()) {
      net.also.back() = face_of[i / 3];
    }
    last = &name;
  }
}

double longest_of(const std::array<Vec3, 3>& corners) {
  return std::sqrt(
      std::max({(corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
                (corners[0] - corners[2]).squaredNorm()}));
}

}  // namespace

FacePieces cut_faces(const Surface& surface, double longest) {
  FacePieces pieces;
  pieces.longest = longest;
  const double unit = surface.frame.scale;
  Cutter cutter(longest);
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    pieces.first.push_back(static_cast<std::uint32_t>(pieces.places.size()));
    const std::array<Vec3, 3> corners = corners_of(surface, f);
    cutter.cut(corners, 0.5 * surface.twice_areas[f], [&](const Piece& piece, double area) {
      const Vec3 w = (piece[0] + piece[1] + piece[2]) / 3.0;
      pieces.places.emplace_back(w.x() * corners[0] + w.y() * corners[1] + w.z() * corners[2]);
      pieces.owner.push_back(f);
      pieces.weights.push_back(w);
      pieces.areas.push_back(area / (unit * unit));
    });
  }
  pieces.first.push_back(static_cast<std::uint32_t>(pieces.places.size()));
  pieces.rounded = rounded_points(pieces.places);
  return pieces;
}

PieceNet piece_net(const Surface& surface, const FacePieces& pieces) {
  PieceNet net;
  net.places = pieces.places;
  net.owner = pieces.owner;
  net.parts.reserve(pieces.places.size());
  const auto count = static_cast<double>(surface.faces.size());
  const double closer = std::clamp(PieceNet::kCloser * std::sqrt(PieceNet::kFewFaces / count),
                                   PieceNet::kLeastParts, PieceNet::kMostParts);
  const double plain =
      std::clamp(std::sqrt(count / PieceNet::kManyFaces), 1.0, PieceNet::kLongestPlain);
  const auto divide = [&](const std::array<Vec3, 3>& corners) {
    const double wanted = closer * longest_of(corners) / pieces.longest;
    net.parts.push_back(static_cast<std::uint8_t>(
        std::clamp(std::round(wanted), PieceNet::kLeastParts, std::round(closer))));
  };
  std::vector<NodeName> names;
  std::vector<std::uint32_t> face_of;
  Cutter cutter(pieces.longest);
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    const std::array<Vec3, 3> corners = corners_of(surface, f);
    net.first_cut.push_back(static_cast<std::uint32_t>(net.corners.size()));
    net.is_plain.push_back(longest_of(corners) <= plain * pieces.longest ? 1 : 0);
    if (pieces.first[f + 1] - pieces.first[f] == 1) {
      divide(corners);
      continue;
    }
    cutter.cut(corners, 0.5 * surface.twice_areas[f], [&](const Piece& piece, double /*area*/) {
      std::array<Vec3, 3> places;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& w = piece[k];
        places[k] = w.x() * corners[0] + w.y() * corners[1] + w.z() * corners[2];
        names.push_back(name_of(surface.faces[f], f, w));
      }
      net.corners.push_back(places);
      face_of.push_back(f);
      divide(places);
    });
  }
  number_nodes(names, face_of, surface.sites.size(), net);
  net.rounded = rounded_points(net.places);
  return net;
}

}  // namespace vantage
