// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

#include "mesh/handle_guard.h"
#include "mesh/place_order.h"

namespace vantage {

/// What clusters and the edges between them make.
struct ClusterGraph {
  CurveGraph graph{};
  std::vector<std::uint32_t> node_of_vertex{};
};

/// The contracted surface while it is collapsed to a graph: clusters of vertices, the edges that
/// join neighbouring clusters, and the triangles among three clusters. Collapsing an edge keeps
/// one edge between two clusters and one triangle among three.
class ClusterComplex {
 public:
  /// \param positions contracted position of each vertex. \param weights share of each vertex in
  /// the position of its cluster, > 0.
  ClusterComplex(const TriMesh& mesh, std::vector<Vec3> positions, std::vector<double> weights);

  /// A neighbouring cluster and the edge to it.
  struct Link {
    std::uint32_t cluster;
    std::uint32_t edge;
  };

  [[nodiscard]] std::size_t edge_count() const { return ends_.size(); }

  [[nodiscard]] std::size_t cluster_count() const { return position_.size(); }

  [[nodiscard]] std::size_t face_count() const { return live_faces_; }  ///< Triangles left.

  [[nodiscard]] const Vec3& position(std::uint32_t cluster) const { return position_[cluster]; }

  /// By what edges of equal length are told apart: the vertices' places at the start.
  [[nodiscard]] const PlaceOrder& order() const { return order_; }

  [[nodiscard]] const std::vector<Link>& links(std::uint32_t cluster) const {
    return links_[cluster];
  }

  [[nodiscard]] bool edge_is_live(std::uint32_t edge) const {
    return ends_[edge][0] != ends_[edge][1];
  }

  [[nodiscard]] const std::array<std::uint32_t, 2>& ends(std::uint32_t edge) const {
    return ends_[edge];
  }

  [[nodiscard]] std::uint32_t faces_at(std::uint32_t edge) const { return edge_faces_[edge]; }

  [[nodiscard]] double length(std::uint32_t edge) const;

  /// Clusters that neighbour both ends of `edge` without a triangle among the three: collapsing the
  /// edge would pinch the loop through them.
  [[nodiscard]] std::vector<std::uint32_t> pinched_by(std::uint32_t edge) const;

  /// Whether collapsing the edge loses no handle. Remembers why not: many edges are asked for again and again.
  [[nodiscard]] bool keeps_handles(std::uint32_t edge);

  /// Independent loops that collapses have pinched so far, of those that carry handles.
  [[nodiscard]] std::size_t dead_loops() const { return guard_.dead_count(); }

  /// Splits edges next to `edge`, so that collapsing it pinches no loop that the handles need: the
  /// sampling gets finer where it was too coarse for a handle.
  void make_room(std::uint32_t edge);

  /// Merges both ends of `edge` into the one with more links (ties: the lower one), which moves to
  /// their weighted mean. Returns it.
  std::uint32_t collapse(std::uint32_t edge);

  /// Cluster that stands for a vertex now.
  [[nodiscard]] std::uint32_t cluster_of(std::uint32_t vertex);

  /// The live clusters and edges as a graph, and the node of each of the |V| vertices.
  ClusterGraph graph();

 private:
  ClusterComplex(const TriMesh& mesh, const EdgeTable& table, std::vector<Vec3> positions,
                 std::vector<double> weights);
  [[nodiscard]] const Link* find(std::uint32_t cluster, std::uint32_t neighbour) const;
  /// Class of the loop over the ends of `edge` and their common neighbour `third`, in normal form.
  [[nodiscard]] Bits loop_class(std::uint32_t edge, std::uint32_t third) const;
  /// Whether the loop for which an edge was refused is still there and crosses the dead one that it did.
  [[nodiscard]] bool is_still_refused(std::uint32_t edge) const;
  /// Whether a loop may be pinched together with others, then one of them.
  /// \param crossed of the others: HandleGuard::crossed_by().
  bool may_pinch(const Bits& loop, std::vector<Bits>& crossed) const;
  void kill_pinched_loops(std::uint32_t edge);
  [[nodiscard]] std::uint32_t sparser(std::uint32_t edge, std::uint32_t other) const;
  void split(std::uint32_t edge);
  std::uint32_t add_edge(std::uint32_t a, std::uint32_t b, const Bits& annotation);
  void absorb_faces(std::uint32_t keep, std::uint32_t gone);
  void absorb_links(std::uint32_t keep, std::uint32_t gone, std::uint32_t edge);
  void remove_face(std::uint32_t face);
  [[nodiscard]] bool has_face(std::uint32_t cluster, std::uint32_t x, std::uint32_t y) const;

  std::vector<Vec3> position_;
  PlaceOrder order_;
  std::vector<double> weight_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::vector<Link>> links_;              ///< Sorted by cluster.
  std::vector<std::vector<std::uint32_t>> faces_of_;  ///< Live faces at each cluster.
  std::vector<Triangle> faces_;
  std::vector<std::array<std::uint32_t, 2>> ends_;  ///< Equal ends: the edge is gone.
  std::vector<std::uint32_t> edge_faces_;
  std::size_t vertex_count_ = 0;  ///< Clusters beyond were made by splits.
  std::size_t live_faces_ = 0;
  HandleGuard guard_;

  /// Why an edge was refused: the loop through a neighbour of both ends crosses a dead one.
  struct Refusal {
    std::uint32_t third;
    std::size_t dead;
  };

  std::vector<std::optional<Refusal>> refusal_{};  ///< Of each edge; may be shorter.
  std::vector<std::uint64_t> annotation_;  ///< In normal form; kept up to date as edges move.
};

}  // namespace vantage
