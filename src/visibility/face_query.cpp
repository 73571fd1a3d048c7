// SPDX-License-Identifier: MIT
#include "visibility/face_query.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"

#include "spatial/segment.h"
#include "visibility/face_sums.h"

namespace vantage {
namespace {

// Cells of the picture over faces. [ours, by measurement]
constexpr double kCellsPerFace = 0.25;
// Places in cells over faces: where faces are so long or so many in one place that more would be
// needed, cells are larger.
constexpr std::size_t kMostInCells = 16;
// Steps of work for one eye, some seconds: a model of 86 000 faces takes about a two hundredth, ten
// thousand long faces before each other about all. What is not cut by then is judged by points, which
// is no faster, and wrong where strips are seen that are narrower than the parts. A step is to pass by an
// item of a cell. [ours]
constexpr std::size_t kMostSteps = 600'000'000;
constexpr std::size_t kStepsPerShadow = 16;
// Parts a side that such a face is divided into, each judged by its centroid. [ours]
constexpr int kPartsASide = 4;
// Contours before a face that it is cut along. Where there are more the shadows of all faces before it
// are taken away: in a heap of faces the first few hide most of it. [ours]
constexpr std::size_t kFewContours = 16;

class FaceQuery {
 public:
  FaceQuery(FaceScene& scene, FaceQueryMemory& memory, const Viewpoint& local,
            const RunContext& run)
      : scene_(scene),
        memory_(memory),
        surface_(scene.samples.surface()),
        local_(local),
        run_(run),
        samples_(scene.samples, local, run, scene.meetings.occluding_back_faces) {}

  SeenSurface seen(FaceDetail detail) {
    seen_ = samples_.seen_samples();
    SeenSurface result;
    result.vertices = vertices_of_samples(surface_, seen_);
    FaceSums sums(surface_, scene_.sphere, local_, memory_.along, result);
    for (std::uint32_t sample = 0; sample < seen_.size(); ++sample) {
      if (seen_[sample] != 0) {
        result.deepest = std::max(result.deepest, sums.depth(sample));
      }
    }
    result.faces.reserve(surface_.faces.size() / 2);
    if (detail == FaceDetail::ByCorners) {
      add_by_corners(sums);
    } else {
      memory_.clip.begin(surface_.samples, surface_.faces, local_);
      list_hiding();
      list_contours();
      for (std::uint32_t face = 0; face < surface_.faces.size(); ++face) {
        if (samples_.is_turned(face)) {
          add(face, sums);
        }
      }
    }
    result.faces = in_order(result.faces);
    return result;
  }

 private:
  [[nodiscard]] bool hides(std::uint32_t face) const {
    const std::uint8_t turned = samples_.turned()[face];
    return turned == 1 ||
           (turned == 2 && (!is_outside_ || scene_.meetings.occluding_back_faces[face] != 0));
  }

  /// Lists the faces that may hide others by the cells of the picture.
  void list_hiding() {
    const auto count = static_cast<std::uint32_t>(surface_.faces.size());
    const double cells = kCellsPerFace * static_cast<double>(count);
    PictureCells& picture = memory_.picture;
    picture.begin(surface_.samples, local_, static_cast<std::size_t>(cells) + 1);
    is_outside_ = picture.is_ahead();
    memory_.extents.resize(count);
    find_contours();
    while (std::max(set_extents(), set_contour_extents()) > kMostInCells * count &&
           picture.coarsen()) {
    }
    memory_.hiding.fill(picture.cell_count(), memory_.extents, [&](const auto& each) {
      for (std::uint32_t f = 0; f < count; ++f) {
        if (hides(f)) {
          picture.over_cells(surface_.faces[f], memory_.extents[f],
                             [&](std::uint32_t cell) { each(f, cell); });
        }
      }
    });
    memory_.round.assign(count, 0);
  }

  /// \return how many cells all that hides touches.
  std::size_t set_extents() {
    std::size_t sum = 0;
    for (std::uint32_t f = 0; f < surface_.faces.size(); ++f) {
      const bool is_hiding = hides(f);
      if (is_hiding || samples_.is_turned(f)) {
        const Triangle& face = surface_.faces[f];
        memory_.extents[f] = memory_.picture.extent(face);
        if (is_hiding) {
          sum += memory_.picture.count_cells(face, memory_.extents[f]);
        }
      }
    }
    return sum;
  }

  /// Whether the surface turns away past an edge: unless two faces lie beside each other there in
  /// the picture.
  [[nodiscard]] bool is_contour(std::size_t edge) const {
    const EdgePair pair = scene_.edges.pairs[edge];
    if (pair == EdgePair::None) {
      return true;
    }
    const std::uint8_t one = samples_.turned()[scene_.edges.beside[edge][0]];
    const std::uint8_t other = samples_.turned()[scene_.edges.beside[edge][1]];
    return one == 0 || other == 0 || (one == other) != (pair == EdgePair::Opposite);
  }

  /// Lists the contours, and what lies on them.
  void find_contours() {
    const std::vector<std::array<std::uint32_t, 2>>& all = scene_.edges.table.edges;
    memory_.on_contour = scene_.is_touched;
    memory_.edges.clear();
    for (std::uint32_t e = 0; e < all.size(); ++e) {
      if (is_contour(e)) {
        const auto& [a, b] = all[e];
        memory_.on_contour[a] = memory_.on_contour[b] = 1;
        memory_.edges.push_back(e);
      }
    }
  }

  /// \return how many cells all contours touch: also those of faces seen edge on, which hide nothing.
  std::size_t set_contour_extents() {
    std::size_t sum = 0;
    memory_.edge_extents.clear();
    for (const std::uint32_t e : memory_.edges) {
      const auto& edge = scene_.edges.table.edges[e];
      memory_.edge_extents.push_back(memory_.picture.extent(edge));
      sum += memory_.picture.count_cells(edge, memory_.edge_extents.back());
    }
    return sum;
  }

  /// Lists the contours of which something may be in view. What hides all of one hides what lies behind
  /// it.
  void list_contours() {
    lay_out_contours();
    memory_.seen_edges.clear();
    for (std::uint32_t k = 0; k < memory_.edges.size(); ++k) {
      if (may_be_seen(k)) {
        memory_.seen_edges.push_back(memory_.edges[k]);
      }
    }
    if (memory_.seen_edges.size() < memory_.edges.size()) {
      std::swap(memory_.edges, memory_.seen_edges);
      set_contour_extents();
      lay_out_contours();
    }
  }

  void lay_out_contours() {
    const auto& all = scene_.edges.table.edges;
    memory_.contours.fill(
        memory_.picture.cell_count(), memory_.edge_extents, [&](const auto& each) {
          for (std::uint32_t k = 0; k < memory_.edges.size(); ++k) {
            memory_.picture.over_cells(all[memory_.edges[k]], memory_.edge_extents[k],
                                       [&](std::uint32_t cell) { each(k, cell); });
          }
        });
  }

  /// Whether a contour may be in view: not if both its ends are hidden, unless it passes behind another
  /// contour or a face that it may pass through.
  [[nodiscard]] bool may_be_seen(std::uint32_t contour) {
    const std::uint32_t edge = memory_.edges[contour];
    const auto& [a, b] = scene_.edges.table.edges[edge];
    const auto& [one, other] = scene_.edges.beside[edge];
    if (seen_[a] != 0 || seen_[b] != 0 || scene_.meetings.crossed[one] != 0 ||
        scene_.meetings.crossed[other] != 0 ||
        !(samples_.is_turned(one) || samples_.is_turned(other))) {
      return true;
    }
    const std::array ends{a, b};
    return is_any_before(
        memory_.contours, ends, memory_.edge_extents[contour], [&](std::uint32_t k) {
          return is_spent() || passes_before(scene_.edges.table.edges[memory_.edges[k]], ends);
        });
  }

  /// Whether an edge crosses another one in the picture, before it.
  [[nodiscard]] bool passes_before(const std::array<std::uint32_t, 2>& edge,
                                   const std::array<std::uint32_t, 2>& other) const {
    const Vec3& a = surface_.samples[other[0]];
    const Vec3& b = surface_.samples[other[1]];
    const Vec3& c = surface_.samples[edge[0]];
    const Vec3& d = surface_.samples[edge[1]];
    const Vec3 across = (d - c).cross(sight_line(c, local_));
    const Vec3 other_across = (b - a).cross(sight_line(a, local_));
    const double of_a = across.dot(a - c);
    const double of_b = across.dot(b - c);
    const double of_c = other_across.dot(c - a);
    const double of_d = other_across.dot(d - a);
    if (!(of_a * of_b <= 0.0 && of_c * of_d <= 0.0) || of_a == of_b || of_c == of_d) {
      return false;
    }
    const Vec3 here = a + of_a / (of_a - of_b) * (b - a);
    const Vec3 there = c + of_c / (of_c - of_d) * (d - c);
    return (there - here).dot(sight_line(here, local_)) > 0.0;
  }

  /// Whether is_wanted(item) answers true of one of those listed that may lie before an edge or a face;
  /// asks about some more than once.
  template <std::size_t Count, typename IsWanted>
  bool is_any_before(const CellLists& lists, const std::array<std::uint32_t, Count>& samples,
                     const PictureCells::Extent& extent, const IsWanted& is_wanted) {
    bool is_found = false;
    memory_.picture.over_sides(samples, extent, [&](const PictureCells::CellRange& cells) {
      for (std::uint32_t row = cells.bottom; row <= cells.top && !is_found; ++row) {
        const std::uint32_t first = memory_.picture.cell(cells.left, row);
        const std::uint32_t last = memory_.picture.cell(cells.right, row);
        steps_ += lists.count(first, last);
        is_found = lists.is_any_before(first, last, extent, is_wanted);
      }
    });
    return is_found;
  }

  /// Whether no more than points can be looked at.
  [[nodiscard]] bool is_spent() const { return steps_ > kMostSteps; }

  /// Adds each face that is turned to the eye and of which two corners are seen, whole.
  void add_by_corners(FaceSums& sums) {
    for (std::uint32_t face = 0; face < surface_.faces.size(); ++face) {
      const auto& [a, b, c] = surface_.faces[face];
      if (seen_[a] + seen_[b] + seen_[c] >= 2 && samples_.is_turned(face)) {
        sums.begin(face);
        sums.add_whole();
      }
    }
  }

  void add(std::uint32_t face, FaceSums& sums) {
    if (scene_.meetings.crossed[face] != 0 || is_spent() || !find_few_contours(face)) {
      run_.check();
      add_parts(clipped(face), sums, face);
      return;
    }
    const auto& [a, b, c] = surface_.faces[face];
    const int seen = seen_[a] + seen_[b] + seen_[c];
    // Corners exactly behind a contour are hidden though the face beside it may be seen, and what touches
    // a corner does not hide it.
    const bool do_corners_tell =
        before_.empty() && (seen == 3 || (seen == 0 && !is_beside_contour_)) &&
        (memory_.on_contour[a] & memory_.on_contour[b] & memory_.on_contour[c]) == 0;
    if (!do_corners_tell) {
      run_.check();
      add_parts(seen_between_contours(face), sums, face);
    } else if (seen == 3) {
      sums.begin(face);
      sums.add_whole();
    }
  }

  void take(std::uint32_t face) {
    memory_.clip.take(face, surface_.area_vectors[face] / surface_.twice_areas[face]);
  }

  static void add_parts(const Polygons& parts, FaceSums& sums, std::uint32_t face) {
    if (parts.size() > 0) {
      sums.begin(face);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      sums.add(parts[i]);
    }
  }

  /// Finds the contours that may be in view and pass before a face, and whether one touches it in the
  /// picture. \return false if they are too many, or too much work.
  [[nodiscard]] bool find_few_contours(std::uint32_t face) {
    before_.clear();
    is_beside_contour_ = false;
    std::optional<PictureCells::Outline> outline;
    const auto takes_too_many = [&](std::uint32_t k) {
      if (!outline) {
        outline.emplace(memory_.picture, surface_.faces[face]);
      }
      const auto& edge = scene_.edges.table.edges[memory_.edges[k]];
      if (!outline->is_beside(edge)) {
        if (!std::exchange(is_beside_contour_, true)) {
          take(face);
        }
        if (memory_.clip.is_behind(edge) &&
            std::find(before_.begin(), before_.end(), k) == before_.end()) {
          before_.push_back(k);
        }
      }
      return is_spent() || before_.size() > kFewContours;
    };
    return !is_any_before(memory_.contours, surface_.faces[face], memory_.extents[face],
                          takes_too_many);
  }

  /// What is seen of a face that nothing passes through: between contours all of it is seen or hidden.
  [[nodiscard]] const Polygons& seen_between_contours(std::uint32_t face) {
    take(face);
    FaceClip& clip = memory_.clip;
    for (const std::uint32_t k : before_) {
      clip.cut_along(scene_.edges.table.edges[memory_.edges[k]]);
    }
    seen_parts_.shrink_to(0);
    for (std::size_t i = 0; i < clip.parts().size(); ++i) {
      if (!is_hidden(face, clip.middle(clip.parts()[i]))) {
        seen_parts_.add(clip.parts()[i]);
      }
    }
    return seen_parts_;
  }

  /// Whether another face hides a place on a face.
  [[nodiscard]] bool is_hidden(std::uint32_t face, const Vec3& place) {
    if (!memory_.picture.is_flat()) {
      return scene_.samples.hides_place(place, face, local_);
    }
    const Segment segment = segment_to(place, local_);
    const PictureCells::Extent at = memory_.picture.extent_of(place);
    const std::uint32_t cell = memory_.picture.cell(at.cells.left, at.cells.bottom);
    steps_ += memory_.hiding.count(cell, cell);
    return memory_.hiding.is_any_before(cell, cell, at, [&](std::uint32_t other) {
      const auto& [a, b, c] = surface_.faces[other];
      return other != face && segment.crosses(surface_.samples[a], surface_.samples[b],
                                              surface_.samples[c], surface_.twice_areas[other]);
    });
  }

  /// The faces in the mesh's order; quicker than sorting, as about half of all are seen.
  [[nodiscard]] std::vector<SeenFace> in_order(const std::vector<SeenFace>& faces) {
    constexpr std::uint32_t kUnseen = ~std::uint32_t{0};
    memory_.order.assign(scene_.triangles.size(), kUnseen);
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
      memory_.order[faces[k].face] = k;
    }
    std::vector<SeenFace> ordered;
    ordered.reserve(faces.size());
    for (const std::uint32_t k : memory_.order) {
      if (k != kUnseen) {
        ordered.push_back(faces[k]);
      }
    }
    return ordered;
  }

  /// What is seen of a face, whatever lies before it or passes through it.
  [[nodiscard]] const Polygons& clipped(std::uint32_t face) {
    FaceClip& clip = memory_.clip;
    ++round_;
    memory_.round[face] = round_;
    take(face);
    const PictureCells::Outline outline(memory_.picture, surface_.faces[face]);
    bool is_hidden = false;
    is_any_before(memory_.hiding, surface_.faces[face], memory_.extents[face],
                  [&](std::uint32_t other) {
                    if (std::exchange(memory_.round[other], round_) != round_ &&
                        !outline.is_beside(surface_.faces[other])) {
                      steps_ += kStepsPerShadow;
                      is_hidden = clip.add_shadow(other);
                    }
                    return is_hidden || is_spent();
                  });
    if (is_hidden) {
      return none_;
    }
    return !is_spent() && clip.subtract(steps_, kMostSteps) ? clip.parts() : judged_by_points(face);
  }

  /// The same by points, where all that lies before it is too much to be looked at. \pre the clip has
  /// taken the face.
  [[nodiscard]] const Polygons& judged_by_points(std::uint32_t face) {
    by_points_.shrink_to(0);
    const double step = 1.0 / kPartsASide;
    const auto add_if_seen = [&](const std::array<Eigen::Vector2d, 3>& part) {
      if (!scene_.samples.hides_place(memory_.clip.middle(part), face, local_)) {
        by_points_.add(part);
      }
    };
    for (int i = 0; i < kPartsASide; ++i) {
      for (int j = 0; i + j < kPartsASide; ++j) {
        const Eigen::Vector2d low(i * step, j * step);
        const Eigen::Vector2d high(low.array() + step);
        add_if_seen({low, Eigen::Vector2d(high.x(), low.y()), Eigen::Vector2d(low.x(), high.y())});
        if (i + j + 1 < kPartsASide) {
          add_if_seen(
              {high, Eigen::Vector2d(low.x(), high.y()), Eigen::Vector2d(high.x(), low.y())});
        }
      }
    }
    return by_points_;
  }

  FaceScene& scene_;
  FaceQueryMemory& memory_;
  const Surface& surface_;
  const Viewpoint& local_;
  const RunContext& run_;
  SampleQuery samples_;
  bool is_outside_ = true;
  std::vector<std::uint8_t> seen_{};  // of each sample
  std::size_t steps_ = 0;             // of all work so far
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> before_{};  // contours before the face at hand
  bool is_beside_contour_ = false;       // that face
  Polygons none_{}, by_points_{}, seen_parts_{};
};

/// The sum of the faces' areas, model units squared.
double area_of(const Surface& surface) {
  double twice = 0.0;
  for (const double of_face : surface.twice_areas) {
    twice += of_face;
  }
  return 0.5 * twice / (surface.frame.scale * surface.frame.scale);
}

}  // namespace

FaceScene::FaceScene(const TriMesh& mesh, std::span<const FaceSides> sides)
    : samples(visibility_surface(mesh, sides)),
      triangles(mesh.triangles),
      face_of_mesh(mesh.triangles.size(), kNoFace),
      sphere(enclosing_sphere(referenced_points(mesh))),
      total_area(area_of(samples.surface())) {
  const Surface& surface = samples.surface();
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    face_of_mesh[surface.face_of_mesh[f]] = f;
  }
  if (!surface.faces.empty()) {
    const TriMesh framed{surface.samples, surface.faces};
    edges = surface_edges(framed);
    meetings = find_meetings(framed, edges);
    for (const std::uint32_t fans : count_fans(framed)) {
      is_touched.push_back(fans > 1 ? 1 : 0);
    }
  }
}

SeenSurface see_faces(FaceScene& scene, const Viewpoint& local, FaceDetail detail,
                      const RunContext& run) {
  const LentMemory<FaceQueryMemory>::Loan memory(scene.memory);
  return FaceQuery(scene, *memory, local, run).seen(detail);
}

}  // namespace vantage
