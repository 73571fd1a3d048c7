// SPDX-License-Identifier: MIT
#include "vantage/visibility/face_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <mutex>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "visibility/closer_look.h"
#include "visibility/face_pieces.h"
#include "visibility/hiding_backs.h"
#include "visibility/seen_tally.h"
#include "visibility/sight.h"
#include "visibility/slivers.h"

namespace vantage {
namespace {

// Pieces grow when the surface is so folded that more than this many would be needed. [ours]
constexpr double kMaxPieces = 4e6;
// What was found of a piece or of a node; both: what hides one end of it ends within.
constexpr std::uint8_t kSeen = 1;
constexpr std::uint8_t kHidden = 2;
constexpr std::uint8_t kInPart = kSeen | kHidden;
// Area of a sliver over that of the rectangle along the edge that it is beside: that it is there
// matters, not how large it is. [ours]
constexpr double kSliverShare = 1.0 / 16.0;
// Of more faces a sliver weighs so little that only what lies deepest is looked for.
// [ours, by measurement]
constexpr std::size_t kAllAsked = 10000;

std::uint8_t finding(std::uint8_t seen) {
  return seen != 0 ? kSeen : kHidden;
}

/// What one look tells of all sites, of the pieces' centroids and of the nodes on edges.
struct FirstLook {
  std::vector<std::uint8_t> seen{};      // of each, in this order
  std::vector<std::uint8_t> at_sites{};  // Look::faces_at_sites()
  std::vector<double> depths{};          // of the sites
  double deepest = 0.0;                  // of those that are seen
};

/// What a second look tells, where the first left it open.
struct SecondLook {
  CloserLook parts{};
  EdgePlaces edges{};
};

/// The faces in the mesh's order; quicker than sorting, as about half of all are seen.
std::vector<SeenFace> in_order(const std::vector<SeenFace>& faces, std::size_t count) {
  constexpr std::uint32_t kUnseen = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(count, kUnseen);
  for (std::uint32_t k = 0; k < faces.size(); ++k) {
    place[faces[k].face] = k;
  }
  std::vector<SeenFace> ordered;
  ordered.reserve(faces.size());
  for (const std::uint32_t k : place) {
    if (k != kUnseen) {
      ordered.push_back(faces[k]);
    }
  }
  return ordered;
}

}  // namespace

struct FaceVisibility::Samples {
  Samples(const TriMesh& mesh, std::span<const FaceSides> sides)
      : sight(prepare_surface(mesh, sides)),
        triangles(mesh.triangles),
        sphere(enclosing_sphere(referenced_points(mesh))) {}

  Sight sight;
  std::vector<Triangle> triangles;  // of the mesh
  Sphere sphere;                    // of the mesh
  FacePieces pieces{};
  double total_area = 0.0;

  /// Cuts every face of the surface into pieces.
  void cut(double spacing) {
    const Surface& surface = sight.surface();
    const double unit = surface.frame.scale;
    for (const double twice : surface.twice_areas) {
      total_area += 0.5 * twice / (unit * unit);
    }
    // About 6 pieces a squared side.
    const double least_side = std::sqrt(6.0 * total_area / kMaxPieces);
    pieces = cut_faces(surface, unit * std::max(spacing * sphere.diameter, least_side));
  }

  /// The centroids of all pieces, to be asked about.
  [[nodiscard]] SurfacePoints points() const {
    return {.exact = pieces.places, .rounded = &pieces.rounded, .owner = pieces.owner};
  }

  const PieceNet& net() {
    std::call_once(net_once_, [&] {
      const Surface& surface = sight.surface();
      net_ = piece_net(surface, pieces);
      // Of an open surface corners do not tell enough.
      for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const bool is_plain = net_.is_plain[f] != 0 && surface.sides[f] == FaceSides::Front;
        net_.is_plain[f] = is_plain ? 1 : 0;
      }
      if (!surface.faces.empty()) {
        edges_ = surface_edges(surface);
        const CandidateScene scene(surface.sites, surface.faces);
        backs_ = hiding_backs(surface, edges_, scene);
        slivers_.emplace(surface, edges_, scene, backs_);
      }
    });
    return net_;
  }

  /// Faces whose backs are to be asked what they hide. \pre net() was asked for.
  [[nodiscard]] std::span<const std::uint8_t> backs() const { return backs_; }

  /// Looks at all sites, at the pieces' centroids and the nodes on edges. Of a plain face that
  /// turns to the eye with all faces at its corners only the corners are asked about, and the rest
  /// goes with them. Not where the surface turns away from the eye, because the faces at a corner
  /// do not hide it and might hide the face.
  [[nodiscard]] FirstLook first_look(Look& look, const Depths& depths) {
    const Surface& surface = sight.surface();
    const std::size_t sites = surface.sites.size();
    const SurfacePoints points{.sites = surface.sites,
                               .exact = net().places,
                               .rounded = &net_.rounded,
                               .owner = net_.owner,
                               .also = net_.also};
    const std::vector<std::uint8_t> at_sites = look.faces_at_sites();
    std::vector<std::uint8_t> asked(points.size(), 0);
    std::vector<std::uint8_t> is_asked(surface.faces.size(), 0);
    std::vector<std::uint32_t> goes_with_corners;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
      if (!look.is_turned(f)) {
        continue;
      }
      const auto& [a, b, c] = surface.faces[f];
      if (net_.is_plain[f] != 0 &&
          ((at_sites[a] | at_sites[b] | at_sites[c]) & Look::kNotTurned) == 0) {
        goes_with_corners.push_back(f);
      } else {
        is_asked[f] = 1;
        std::fill(asked.begin() + static_cast<std::ptrdiff_t>(sites + pieces.first[f]),
                  asked.begin() + static_cast<std::ptrdiff_t>(sites + pieces.first[f + 1]), 1);
      }
    }
    for (std::size_t site = 0; site < sites; ++site) {
      asked[site] = at_sites[site] & Look::kTurned;
    }
    const std::size_t pieces_end = pieces.places.size();
    for (std::size_t i = pieces_end; i < points.exact.size(); ++i) {
      asked[sites + i] = is_asked[points.owner[i]] | is_asked[points.also_of(i)];
    }
    std::vector<std::uint8_t> seen = look.not_hidden(points, asked);
    for (const std::uint32_t f : goes_with_corners) {
      const auto& [a, b, c] = surface.faces[f];
      const std::uint8_t all = seen[a] & seen[b] & seen[c];
      for (std::uint32_t piece = pieces.first[f]; piece < pieces.first[f + 1]; ++piece) {
        seen[sites + piece] = all;
      }
    }
    for (std::size_t i = pieces_end; i < points.exact.size(); ++i) {
      if (asked[sites + i] == 0) {
        const auto [a, b] = net_.ends[i - pieces_end];
        seen[sites + i] = seen[a] & seen[b];
      }
    }
    FirstLook first{std::move(seen), at_sites};
    first.depths.reserve(sites);
    for (std::size_t site = 0; site < sites; ++site) {
      first.depths.push_back(depths.at(surface.sites[site]));
      first.deepest = std::max(first.deepest, first.seen[site] != 0 ? first.depths[site] : 0.0);
    }
    return first;
  }

  /// Whether the face is a single piece.
  [[nodiscard]] bool is_whole(std::size_t f) const {
    return pieces.first[f + 1] - pieces.first[f] == 1;
  }

  /// What is known of the nodes. \param seen first_look().
  [[nodiscard]] std::vector<std::uint8_t> node_findings(const Look& look,
                                                        std::span<const std::uint8_t> seen) const {
    const std::size_t sites = sight.surface().sites.size();
    const std::span<const std::uint8_t> of_piece = seen.subspan(sites);
    std::vector<std::uint8_t> found(net_.node_count, 0);
    std::transform(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(sites), found.begin(),
                   finding);
    std::transform(seen.end() - static_cast<std::ptrdiff_t>(net_.also.size()), seen.end(),
                   found.begin() + static_cast<std::ptrdiff_t>(sites), finding);
    const std::size_t asked = sites + net_.also.size();
    std::size_t cut = 0;
    for (std::size_t f = 0; f + 1 < pieces.first.size(); ++f) {
      if (is_whole(f)) {
        continue;
      }
      for (std::uint32_t piece = pieces.first[f]; piece < pieces.first[f + 1]; ++piece, ++cut) {
        for (const std::uint32_t node : net_.nodes[cut]) {
          if (node >= asked && look.is_turned(f)) {
            found[node] |= finding(of_piece[piece]);
          }
        }
      }
    }
    return found;
  }

  /// Divides every piece of which, with its nodes, some was seen and some was hidden.
  [[nodiscard]] CloserLook pieces_in_part(const Look& look, const FirstLook& first) const {
    const Surface& surface = sight.surface();
    const std::vector<std::uint8_t>& seen = first.seen;
    const std::vector<std::uint8_t> found = node_findings(look, seen);
    const std::span<const std::uint8_t> of_piece = std::span(seen).subspan(surface.sites.size());
    const auto is_in_part = [&](std::uint32_t piece, const Triangle& nodes) {
      return (finding(of_piece[piece]) | found[nodes[0]] | found[nodes[1]] | found[nodes[2]]) ==
             kInPart;
    };
    const auto tip = [&](std::size_t face, std::uint32_t node) {
      if (node >= surface.sites.size()) {
        return Tip::Plain;
      }
      if (seen[node] == 0) {
        return Tip::Hidden;
      }
      const bool turns = (first.at_sites[node] & Look::kNotTurned) == 0;
      return turns && surface.sides[face] == FaceSides::Front ? Tip::Seen : Tip::Asked;
    };
    CloserLook closer;
    std::size_t cut = 0;
    for (std::uint32_t f = 0; f + 1 < pieces.first.size(); ++f) {
      const std::uint32_t begin = pieces.first[f];
      const auto& [a, b, c] = surface.faces[f];
      if (is_whole(f)) {
        const int all = seen[a] + seen[b] + seen[c] + of_piece[begin];
        if (all != 0 && all != 4 && look.is_turned(f)) {
          closer.add(begin, f, {surface.sites[a], surface.sites[b], surface.sites[c]},
                     {tip(f, a), tip(f, b), tip(f, c)}, net_.parts[begin]);
        }
        continue;
      }
      // The pieces of a plain face may never have been asked about.
      const int corners = seen[a] + seen[b] + seen[c];
      const bool all = net_.is_plain[f] != 0 && corners != 0 && corners != 3;
      for (std::uint32_t piece = begin; piece < pieces.first[f + 1]; ++piece, ++cut) {
        if (look.is_turned(f) && (all || is_in_part(piece, net_.nodes[cut]))) {
          const Triangle& nodes = net_.nodes[cut];
          closer.add(piece, f, net_.corners[cut],
                     {tip(f, nodes[0]), tip(f, nodes[1]), tip(f, nodes[2])}, net_.parts[piece]);
        }
      }
    }
    closer.end();
    return closer;
  }

  /// Edges of faces that reach deeper than all sites that were seen and, unless faces are many, of
  /// those of which no piece was.
  [[nodiscard]] EdgePlaces edges_to_ask(const Look& look, const FirstLook& first,
                                        const Viewpoint& local) const;

  /// Asks about what the first look leaves open. \pre net() was asked for.
  [[nodiscard]] SecondLook second_look(Look& look, const FirstLook& first,
                                       const Viewpoint& local) const;

  /// Adds slivers of faces of which no sample was seen.
  void add_slivers(const EdgePlaces& edges, Tally& tally) const;

 private:
  std::once_flag net_once_{};
  PieceNet net_{};
  SurfaceEdges edges_{};
  std::vector<std::uint8_t> backs_{};
  std::optional<SliverSearch> slivers_{};  // unless there are no faces
};

EdgePlaces FaceVisibility::Samples::edges_to_ask(const Look& look, const FirstLook& first,
                                                 const Viewpoint& local) const {
  const Surface& surface = sight.surface();
  const std::size_t sites = surface.sites.size();
  const bool are_few = surface.faces.size() <= kAllAsked;
  const auto is_deep = [&](std::uint32_t site) { return first.depths[site] > first.deepest; };
  const auto of_piece = std::span(first.seen).subspan(sites);
  std::vector<std::uint8_t> wanted(surface.faces.size(), 0);
  for (std::size_t f = 0; f < wanted.size(); ++f) {
    const auto& [a, b, c] = surface.faces[f];
    if (!look.is_turned(f)) {
      continue;
    }
    wanted[f] = is_deep(a) || is_deep(b) || is_deep(c) ? 1 : 0;
    if (are_few && wanted[f] == 0) {
      const std::span<const std::uint8_t> seen =
          of_piece.subspan(pieces.first[f], pieces.first[f + 1] - pieces.first[f]);
      wanted[f] = std::find(seen.begin(), seen.end(), 1) == seen.end() ? 1 : 0;
    }
  }
  return slivers_ ? slivers_->places(local, {look.turned(), wanted}) : EdgePlaces{};
}

SecondLook FaceVisibility::Samples::second_look(Look& look, const FirstLook& first,
                                                const Viewpoint& local) const {
  SecondLook second{pieces_in_part(look, first), edges_to_ask(look, first, local)};
  auto& [parts, edges] = second;
  std::vector<Vec3> places = parts.places;
  places.insert(places.end(), edges.places.begin(), edges.places.end());
  std::vector<std::uint32_t> owner = parts.owner;
  owner.insert(owner.end(), edges.owner.begin(), edges.owner.end());
  std::vector<std::uint8_t> asked = parts.asked;
  asked.resize(places.size(), 1);
  const FloatPoints rounded = rounded_points(places);
  const std::vector<std::uint8_t> seen = look.not_hidden(
      {.exact = places, .rounded = &rounded, .owner = owner, .also = edges.also}, asked);
  const auto edges_begin = seen.begin() + static_cast<std::ptrdiff_t>(parts.places.size());
  std::transform(seen.begin(), edges_begin, asked.begin(), std::back_inserter(parts.seen),
                 [](std::uint8_t is_seen, std::uint8_t is_asked) {
                   return static_cast<std::uint8_t>(is_asked != 0 ? is_seen : 1);
                 });
  edges.seen.assign(edges_begin, seen.end());
  return second;
}

void FaceVisibility::Samples::add_slivers(const EdgePlaces& edges, Tally& tally) const {
  const Surface& surface = sight.surface();
  std::vector<std::array<std::uint32_t, 2>> found;  // face and place
  for (std::uint32_t i = 0; i < edges.seen.size(); ++i) {
    if (edges.seen[i] == 0) {
      continue;
    }
    tally.reach(edges.places[i], edges.halves[i]);
    if (!tally.has(edges.owner[i])) {
      found.push_back({edges.owner[i], i});
    }
    if (edges.of_both[i] != 0 && !tally.has(edges.also[i])) {
      found.push_back({edges.also[i], i});
    }
  }
  std::sort(found.begin(), found.end());
  const double unit = surface.frame.scale;
  const double widest = pieces.longest / PieceNet::kMostParts;  // else a sample would have seen it
  for (const auto& [f, i] : found) {
    const double length = 2.0 * edges.halves[i].norm();
    const double area = std::min(0.5 * surface.twice_areas[f], length * std::min(length, widest));
    tally.add(f, edges.places[i], kSliverShare * area / (unit * unit));
  }
}

double FaceVisibility::enough_spacing(const TriMesh& mesh) {
  constexpr double kEnough = 8e4;     // [ours, by measurement]
  constexpr double kPerSquare = 6.0;  // pieces of a squared side, about
  const double side = kSpacing * enclosing_sphere(referenced_points(mesh)).diameter;
  double pieces = 0.0;
  for (const Triangle& face : mesh.triangles) {
    const double area = 0.5 * area_vector(mesh, face).norm();
    pieces += side > 0.0 ? std::max(1.0, kPerSquare * area / (side * side)) : 1.0;
  }
  return kSpacing / std::clamp(std::sqrt(kEnough / std::max(pieces, 1.0)), 1.0, 2.0);
}

FaceVisibility::FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides)
    : FaceVisibility(mesh, std::move(sides), enough_spacing(mesh)) {}

FaceVisibility::FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides, double spacing)
    : samples_(std::make_unique<Samples>(mesh, sides)) {
  if (!(spacing > 0.0 && spacing <= 1.0)) {
    throw InvalidInput("the spacing of samples must be above 0 and at most 1");
  }
  samples_->cut(spacing);
}

FaceVisibility::~FaceVisibility() = default;
FaceVisibility::FaceVisibility(FaceVisibility&&) noexcept = default;
FaceVisibility& FaceVisibility::operator=(FaceVisibility&&) noexcept = default;

double FaceVisibility::total_area() const {
  return samples_->total_area;
}

std::size_t FaceVisibility::sample_count() const {
  return samples_->pieces.places.size();
}

std::vector<SeenFace> FaceVisibility::seen_faces(const Viewpoint& eye,
                                                 const RunContext& run) const {
  return seen_surface(eye, run).faces;
}

SeenSurface FaceVisibility::seen_surface(const Viewpoint& eye, const RunContext& run) const {
  const Surface& surface = samples_->sight.surface();
  const FacePieces& pieces = samples_->pieces;
  const Viewpoint local = eye_in_frame(eye, surface.frame);
  samples_->net();
  Look look(samples_->sight, local, run, samples_->backs());
  const Depths depths(surface, samples_->sphere, local);
  const FirstLook first = samples_->first_look(look, depths);
  const auto [closer, edges] = samples_->second_look(look, first, local);
  SeenSurface result;
  result.vertices = vertices_of_sites(surface, first.seen);
  result.deepest = first.deepest;
  const auto of_piece = std::span(first.seen).subspan(surface.sites.size(), sample_count());
  Tally tally(surface, depths, local, result);
  std::size_t next = 0;  // piece that was looked at closely
  result.faces.reserve(surface.faces.size());
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    if (!look.is_turned(f)) {
      continue;
    }
    for (std::uint32_t i = pieces.first[f]; i < pieces.first[f + 1]; ++i) {
      if (closer.pieces[next] != i) {
        if (of_piece[i] != 0) {
          tally.add(f, pieces.places[i], pieces.areas[i]);
        }
        continue;
      }
      for (std::uint32_t part = closer.first[next]; part < closer.first[next + 1]; ++part) {
        if (closer.seen[part] != 0) {
          tally.add(f, closer.places[part], pieces.areas[i] * closer.shares[part]);
        }
      }
      ++next;
    }
  }
  samples_->add_slivers(edges, tally);
  result.faces = in_order(result.faces, samples_->triangles.size());
  return result;
}

std::vector<std::uint8_t> FaceVisibility::visible_vertices(const Viewpoint& eye,
                                                           const RunContext& run) const {
  const Surface& surface = samples_->sight.surface();
  Look look(samples_->sight, eye_in_frame(eye, surface.frame), run);
  return vertices_of_sites(surface, look.seen_sites());
}

std::vector<double> FaceVisibility::integrals(std::span<const double> of_vertex) const {
  const FacePieces& pieces = samples_->pieces;
  std::vector<double> result;
  result.reserve(sample_count());
  for (std::size_t i = 0; i < sample_count(); ++i) {
    const auto& [a, b, c] =
        samples_->triangles[samples_->sight.surface().face_of_mesh[pieces.owner[i]]];
    const Vec3& w = pieces.weights[i];
    result.push_back(pieces.areas[i] *
                     (w.x() * of_vertex[a] + w.y() * of_vertex[b] + w.z() * of_vertex[c]));
  }
  return result;
}

std::vector<std::uint8_t> FaceVisibility::seen_samples(const Viewpoint& eye,
                                                       const RunContext& run) const {
  Look look(samples_->sight, eye_in_frame(eye, samples_->sight.surface().frame), run);
  return look.seen_points(samples_->points());
}

double FaceVisibility::visible_sum(std::span<const double> of_sample, const Viewpoint& eye,
                                   const RunContext& run) const {
  const std::vector<std::uint8_t> seen = seen_samples(eye, run);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    sum += seen[i] != 0 ? of_sample[i] : 0.0;
  }
  return sum;
}

}  // namespace vantage
