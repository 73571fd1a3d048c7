// SPDX-License-Identifier: MIT
#include "visibility/face_look.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace vantage {
namespace {

// What was found of a piece or of a node; both: what hides one end of it ends within.
constexpr std::uint8_t kSeen = 1;
constexpr std::uint8_t kHidden = 2;
constexpr std::uint8_t kInPart = kSeen | kHidden;
// Area of a sliver that is not clipped over that of the rectangle along the edge that it is beside:
// that it is there matters, not how large it is. [ours]
constexpr double kSliverShare = 1.0 / 16.0;
// Of more faces a part of one weighs so little that samples tell enough, and of slivers only what
// lies deepest is looked for. [ours, by measurement]
constexpr std::size_t kFew = 60000;

std::uint8_t finding(std::uint8_t seen) {
  return seen != 0 ? kSeen : kHidden;
}

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

FaceLook::FaceLook(FaceSamples& samples, const Viewpoint& local, const RunContext& run)
    : samples_(samples),
      run_(run),
      known_(samples.neighbourhood()),
      surface_(samples.surface()),
      pieces_(samples.pieces()),
      net_(known_.net),
      local_(local),
      look_(samples.sight(), local, run, known_.backs),
      depths_(surface_, samples.sphere(), local),
      picture_(surface_, local),
      at_sites_(look_.faces_at_sites()),
      counted_(surface_.faces.size(), Counted::ByPieces) {
  if (surface_.faces.size() <= kFew && picture_.is_whole) {
    clip_.emplace(surface_, picture_, local_, look_.turned(), known_.backs);
  }
}

SeenSurface FaceLook::seen() {
  look_at_samples();
  list_contours();
  const std::vector<std::uint8_t> found = node_findings();
  choose_clipped(found);
  choose_parts(found);
  choose_edges();
  look_closer();
  SeenSurface result;
  result.vertices = vertices_of_sites(surface_, seen_);
  result.deepest = deepest_;
  result.faces.reserve(surface_.faces.size());
  Tally tally(surface_, depths_, local_, result);
  std::size_t next = 0;  // piece that was looked at closely
  std::size_t next_clipped = 0;
  for (std::uint32_t f = 0; f < surface_.faces.size(); ++f) {
    if (counted_[f] == Counted::Whole) {
      const auto& [a, b, c] = surface_.faces[f];
      tally.add(f, std::array{surface_.sites[a], surface_.sites[b], surface_.sites[c]}, area_of(f));
    } else if (counted_[f] == Counted::Clipped) {
      add_clipped(f, next_clipped, tally);
    } else if (look_.is_turned(f)) {
      add_pieces(f, next, tally);
    }
  }
  add_slivers(tally);
  add_past_contours(tally);
  result.faces = in_order(result.faces, samples_.triangles().size());
  return result;
}

/// Looks at all sites, at the pieces' centroids and the nodes on edges. Of a plain face that
/// turns to the eye with all faces at its corners only the corners are asked about, and the rest
/// goes with them. Not where the surface turns away from the eye, because the faces at a corner
/// do not hide it and might hide the face.
void FaceLook::look_at_samples() {
  const std::size_t sites = surface_.sites.size();
  const SurfacePoints points{.sites = surface_.sites,
                             .exact = net_.places,
                             .rounded = &net_.rounded,
                             .owner = net_.owner,
                             .also = net_.also};
  std::vector<std::uint8_t> asked(points.size(), 0);
  std::vector<std::uint8_t> is_asked(surface_.faces.size(), 0);
  std::vector<std::uint32_t> goes_with_corners;
  for (std::uint32_t f = 0; f < surface_.faces.size(); ++f) {
    if (!look_.is_turned(f)) {
      continue;
    }
    const auto& [a, b, c] = surface_.faces[f];
    if (net_.is_plain[f] != 0 &&
        ((at_sites_[a] | at_sites_[b] | at_sites_[c]) & Look::kNotTurned) == 0) {
      goes_with_corners.push_back(f);
    } else {
      is_asked[f] = 1;
      std::fill(asked.begin() + static_cast<std::ptrdiff_t>(sites + pieces_.first[f]),
                asked.begin() + static_cast<std::ptrdiff_t>(sites + pieces_.first[f + 1]), 1);
    }
  }
  for (std::size_t site = 0; site < sites; ++site) {
    asked[site] = at_sites_[site] & Look::kTurned;
  }
  const std::size_t pieces_end = pieces_.places.size();
  for (std::size_t i = pieces_end; i < points.exact.size(); ++i) {
    asked[sites + i] = is_asked[points.owner[i]] | is_asked[points.also_of(i)];
  }
  seen_ = look_.not_hidden(points, asked);
  for (const std::uint32_t f : goes_with_corners) {
    const auto& [a, b, c] = surface_.faces[f];
    const std::uint8_t all = seen_[a] & seen_[b] & seen_[c];
    for (std::uint32_t piece = pieces_.first[f]; piece < pieces_.first[f + 1]; ++piece) {
      seen_[sites + piece] = all;
    }
  }
  for (std::size_t i = pieces_end; i < points.exact.size(); ++i) {
    if (asked[sites + i] == 0) {
      const auto [a, b] = net_.ends[i - pieces_end];
      seen_[sites + i] = seen_[a] & seen_[b];
    }
  }
  site_depths_.reserve(sites);
  for (std::size_t site = 0; site < sites; ++site) {
    site_depths_.push_back(depths_.at(surface_.sites[site]));
    deepest_ = std::max(deepest_, seen_[site] != 0 ? site_depths_[site] : 0.0);
  }
}

/// What is known of the nodes.
std::vector<std::uint8_t> FaceLook::node_findings() const {
  const std::size_t sites = surface_.sites.size();
  const auto of_point = of_points();
  std::vector<std::uint8_t> found(net_.node_count, 0);
  std::transform(seen_.begin(), seen_.begin() + static_cast<std::ptrdiff_t>(sites), found.begin(),
                 finding);
  std::transform(seen_.end() - static_cast<std::ptrdiff_t>(net_.also.size()), seen_.end(),
                 found.begin() + static_cast<std::ptrdiff_t>(sites), finding);
  const std::size_t asked = sites + net_.also.size();
  for (std::size_t f = 0; f < surface_.faces.size(); ++f) {
    if (samples_.is_whole(f) || !look_.is_turned(f)) {
      continue;
    }
    std::uint32_t cut = net_.first_cut[f];
    for (std::uint32_t piece = pieces_.first[f]; piece < pieces_.first[f + 1]; ++piece, ++cut) {
      for (const std::uint32_t node : net_.nodes[cut]) {
        if (node >= asked) {
          found[node] |= finding(of_point[piece]);
        }
      }
    }
  }
  return found;
}

/// What was found of a face's corners, its pieces and their nodes.
std::uint8_t FaceLook::findings_of(std::uint32_t face, std::span<const std::uint8_t> found) const {
  const auto& [a, b, c] = surface_.faces[face];
  auto all = static_cast<std::uint8_t>(found[a] | found[b] | found[c]);
  std::uint32_t cut = net_.first_cut[face];
  for (std::uint32_t piece = pieces_.first[face]; piece < pieces_.first[face + 1]; ++piece) {
    all |= finding(of_points()[piece]);
    if (!samples_.is_whole(face)) {
      for (const std::uint32_t node : net_.nodes[cut++]) {
        all |= found[node];
      }
    }
  }
  return all;
}

/// Edges past which the surface turns away, but for those that are hidden at both ends and, where
/// faces are clipped, at some places between: what hides all of one hides what lies behind it.
void FaceLook::list_contours() {
  if (!known_.slivers || !picture_.is_whole) {
    return;
  }
  const EdgeTable& table = known_.edges.table;
  for (std::uint32_t e = 0; e < table.edges.size(); ++e) {
    const auto& [a, b] = table.edges[e];
    const bool is_asked = ((at_sites_[a] | at_sites_[b]) & Look::kTurned) != 0;
    const bool may_be_seen = !is_asked || (seen_[a] | seen_[b]) != 0;
    if ((may_be_seen || clip_) && known_.slivers->is_contour(e, look_.turned())) {
      const bool is_seen = clip_ && is_seen_past(e);
      if (is_seen || may_be_seen) {
        contours_.push_back(e);
      }
    }
  }
  std::sort(past_.begin(), past_.end());
  past_.erase(std::unique(past_.begin(), past_.end()), past_.end());
}

/// Whether an edge is seen at one of some places; lists what is seen past them.
bool FaceLook::is_seen_past(std::uint32_t edge) {
  run_.check();
  const std::array<std::uint32_t, 2>& ends = known_.edges.table.edges[edge];
  auto [beside, other] = known_.edges.beside[edge];
  if (look_.turned()[beside] == 0) {  // on edge, it is on neither side
    beside = other;
  }
  const auto& [a, b, c] = surface_.faces[beside];
  return clip_->list_past(ends, a + b + c - ends[0] - ends[1], past_);
}

/// Faces of which some was seen and some was hidden, and those seen that others pass through or a
/// contour lies before; unless too many lie before them.
void FaceLook::choose_clipped(std::span<const std::uint8_t> found) {
  if (!clip_) {
    return;
  }
  std::vector<std::uint8_t> is_seen(surface_.faces.size(), 0);
  std::vector<std::uint32_t> in_part;
  for (std::uint32_t f = 0; f < is_seen.size(); ++f) {
    const std::uint8_t all = look_.is_turned(f) ? findings_of(f, found) : kHidden;
    is_seen[f] = all == kSeen ? 1 : 0;
    if (all == kInPart || (all == kSeen && known_.slivers->crossed()[f] != 0)) {
      in_part.push_back(f);
    }
  }
  for (const std::uint32_t e : contours_) {
    clip_->list_behind(known_.edges.table.edges[e], is_seen, in_part);
  }
  for (std::size_t f = 0; f < is_seen.size(); ++f) {
    counted_[f] = is_seen[f] != 0 ? Counted::Whole : Counted::ByPieces;
  }
  std::sort(in_part.begin(), in_part.end());
  in_part.erase(std::unique(in_part.begin(), in_part.end()), in_part.end());
  for (const std::uint32_t f : in_part) {
    run_.check();
    counted_[f] = clip_->add_parts(f, clipped_) ? Counted::Clipped : Counted::ByPieces;
  }
}

/// What is known of the tip of a piece at a node.
Tip FaceLook::tip(std::uint32_t face, std::uint32_t node) const {
  if (node >= surface_.sites.size()) {
    return Tip::Plain;
  }
  if (seen_[node] == 0) {
    return Tip::Hidden;
  }
  const bool turns = (at_sites_[node] & Look::kNotTurned) == 0;
  return turns && surface_.sides[face] == FaceSides::Front ? Tip::Seen : Tip::Asked;
}

/// Divides every piece of other faces of which, with its nodes, some was seen and some was hidden.
void FaceLook::choose_parts(std::span<const std::uint8_t> found) {
  for (std::uint32_t f = 0; f < surface_.faces.size(); ++f) {
    if (look_.is_turned(f) && counted_[f] == Counted::ByPieces) {
      choose_parts_of(f, found);
    }
  }
  parts_.end();
}

void FaceLook::choose_parts_of(std::uint32_t face, std::span<const std::uint8_t> found) {
  const auto of_piece = of_points();
  const std::uint32_t begin = pieces_.first[face];
  const auto& [a, b, c] = surface_.faces[face];
  const int corners = seen_[a] + seen_[b] + seen_[c];
  if (samples_.is_whole(face)) {
    const int all = corners + of_piece[begin];
    if (all != 0 && all != 4) {
      parts_.add(begin, face, {surface_.sites[a], surface_.sites[b], surface_.sites[c]},
                 {tip(face, a), tip(face, b), tip(face, c)}, net_.parts[begin]);
    }
    return;
  }
  // The pieces of a plain face may never have been asked about.
  const bool all = net_.is_plain[face] != 0 && corners != 0 && corners != 3;
  std::uint32_t cut = net_.first_cut[face];
  for (std::uint32_t piece = begin; piece < pieces_.first[face + 1]; ++piece, ++cut) {
    const auto& [u, v, w] = net_.nodes[cut];
    if (all || (finding(of_piece[piece]) | found[u] | found[v] | found[w]) == kInPart) {
      parts_.add(piece, face, net_.corners[cut], {tip(face, u), tip(face, v), tip(face, w)},
                 net_.parts[piece]);
    }
  }
}

/// Edges of faces that reach deeper than all sites that were seen and, where faces are clipped, of
/// those of which no piece was.
void FaceLook::choose_edges() {
  if (!known_.slivers || !picture_.is_whole) {
    return;
  }
  const auto is_deep = [&](std::uint32_t site) { return site_depths_[site] > deepest_; };
  std::vector<std::uint8_t> wanted(surface_.faces.size(), 0);
  for (std::size_t f = 0; f < wanted.size(); ++f) {
    const auto& [a, b, c] = surface_.faces[f];
    if (!look_.is_turned(f)) {
      continue;
    }
    wanted[f] = is_deep(a) || is_deep(b) || is_deep(c) ? 1 : 0;
    if (clip_ && wanted[f] == 0) {
      const std::span<const std::uint8_t> seen =
          of_points().subspan(pieces_.first[f], pieces_.first[f + 1] - pieces_.first[f]);
      wanted[f] = std::find(seen.begin(), seen.end(), 1) == seen.end() ? 1 : 0;
    }
  }
  edges_ = known_.slivers->places(local_, picture_, {look_.turned(), wanted, contours_});
}

/// Asks about the parts and the edges.
void FaceLook::look_closer() {
  std::vector<Vec3> places = parts_.places;
  places.insert(places.end(), edges_.places.begin(), edges_.places.end());
  std::vector<std::uint32_t> owner = parts_.owner;
  owner.insert(owner.end(), edges_.owner.begin(), edges_.owner.end());
  std::vector<std::uint8_t> asked = parts_.asked;
  asked.resize(places.size(), 1);
  const FloatPoints rounded = rounded_points(places);
  const std::vector<std::uint8_t> seen = look_.not_hidden(
      {.exact = places, .rounded = &rounded, .owner = owner, .also = edges_.also}, asked);
  const auto edges_begin = seen.begin() + static_cast<std::ptrdiff_t>(parts_.places.size());
  std::transform(seen.begin(), edges_begin, asked.begin(), std::back_inserter(parts_.seen),
                 [](std::uint8_t is_seen, std::uint8_t is_asked) {
                   return static_cast<std::uint8_t>(is_asked != 0 ? is_seen : 1);
                 });
  edges_.seen.assign(edges_begin, seen.end());
}

void FaceLook::add_pieces(std::uint32_t face, std::size_t& next, Tally& tally) const {
  for (std::uint32_t i = pieces_.first[face]; i < pieces_.first[face + 1]; ++i) {
    if (parts_.pieces[next] != i) {
      if (of_points()[i] != 0) {
        tally.add(face, pieces_.places[i], pieces_.areas[i]);
      }
      continue;
    }
    for (std::uint32_t part = parts_.first[next]; part < parts_.first[next + 1]; ++part) {
      if (parts_.seen[part] != 0) {
        tally.add(face, parts_.places[part], pieces_.areas[i] * parts_.shares[part]);
      }
    }
    ++next;
  }
}

void FaceLook::add_clipped(std::uint32_t face, std::size_t& next, Tally& tally) const {
  for (; next < clipped_.parts.size() && clipped_.parts[next].face == face; ++next) {
    tally.add(face, clipped_.corners_of(next), clipped_.parts[next].share * area_of(face));
  }
}

/// Adds what edges show of faces of which no sample was seen.
void FaceLook::add_slivers(Tally& tally) {
  std::vector<std::array<std::uint32_t, 2>> found;  // face and place
  for (std::uint32_t i = 0; i < edges_.seen.size(); ++i) {
    if (edges_.seen[i] == 0) {
      continue;
    }
    tally.reach(edges_.places[i], edges_.halves[i]);
    if (!tally.has(edges_.owner[i])) {
      found.push_back({edges_.owner[i], i});
    }
    if (edges_.of_both[i] != 0 && !tally.has(edges_.also[i])) {
      found.push_back({edges_.also[i], i});
    }
  }
  std::sort(found.begin(), found.end());
  const double unit = surface_.frame.scale;
  const double widest = pieces_.longest / PieceNet::kMostParts;  // else a sample would have seen it
  std::size_t next = clipped_.parts.size();
  bool is_clipped = false;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto [f, i] = found[k];
    const bool is_first = k == 0 || found[k - 1][0] != f;
    if (is_first && clip_) {
      is_clipped = clip_->add_parts(f, clipped_);
      add_clipped(f, next, tally);
    }
    if (is_clipped) {
      continue;
    }
    const double length = 2.0 * edges_.halves[i].norm();
    const double area = std::min(0.5 * surface_.twice_areas[f], length * std::min(length, widest));
    tally.add(f, edges_.places[i], kSliverShare * area / (unit * unit));
  }
}

/// Adds faces of which only an inside is seen, past contours of others.
void FaceLook::add_past_contours(Tally& tally) {
  std::size_t next = clipped_.parts.size();
  for (const std::uint32_t f : past_) {
    run_.check();
    if (look_.is_turned(f) && !tally.has(f) && clip_->add_parts(f, clipped_)) {
      add_clipped(f, next, tally);
    }
  }
}

}  // namespace vantage
