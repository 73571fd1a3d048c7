// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/channel.h"

/// \file
/// Measures of a view made of the projected areas of the faces it sees, and the terms that
/// they take from a whole set of views. Feixas, Sbert, González, "A Unified Information-Theoretic
/// Framework for Viewpoint Selection and Mesh Saliency", ACM Transactions on Applied Perception
/// 6(1), 2009; Bonaventura, Feixas, Sbert, "Viewpoint Information", 2011. docs/measures.md defines
/// each.
///
/// [a_z(v)] is the area that view v sees of face z, [a_t(v)] their sum; p(v) = a_t(v) / Σ a_t,
/// p(z|v) = a_z(v) / a_t(v), p(z) = Σ p(v) p(z|v), p(v|z) = a_z(v) / Σ_v a_z(v). All logarithms are
/// base 2, 0 · log 0 = 0.

namespace vantage {

/// What measures take from the set of views that they are defined over.
struct ChannelTerms {
  std::vector<double> area_of_view{};      ///< [a_t(v)] of each view.
  std::vector<double> area_of_face{};      ///< Σ_v a_z(v) of each face; 0 if no view sees it.
  std::vector<double> p_of_face{};         ///< [p(z)]
  std::vector<double> i2_of_face{};        ///< [I2(V;z) = H(V) − H(V|z)], bits; 0 if never seen.
  std::vector<double> saliency_of_face{};  ///< [S(z)], bits; 0 if never seen.
  std::vector<double> weighted_p{};        ///< [p'(z)] ∝ S(z) p(z); see kSaliencyFloor.
  /// Logarithms of both, those of the least where no view sees the face, and of A_z / A_t.
  std::vector<double> log_p{}, log_weighted_p{}, log_share{};
  std::vector<double> saliency_share{};  ///< S(z) / Σ_v a_z(v); 0 if never seen.
  double surface_area = 0.0;             ///< [A_t], model units squared.
  double entropy_of_faces = 0.0;         ///< [H(Z)], bits.
  double mutual_information = 0.0;       ///< [I(V;Z)], bits.
};

/// S(z) counts as at least this share of its largest value in p'(z): a face that looks exactly like
/// its neighbours from everywhere would make each view that sees it infinitely bad. [ours]
inline constexpr double kSaliencyFloor = 1e-6;

/// Computes the terms. [S(z)] is the mean over the faces that share a vertex with z, z itself left
/// out, of the Jensen–Shannon divergence of p(V|z) and p(V|z'), weighted by p(z) and p(z'); a
/// neighbour that no view sees weighs nothing and counts as divergence 0.
/// \pre mesh has channel.face_count faces. \throw InvalidInput, Cancelled
/// \complexity views · faces for the sums, times about six neighbours for the saliency.
ChannelTerms channel_terms(const ViewChannel& channel, const TriMesh& mesh,
                           const RunContext& run = {});

/// The measures of one view. A view that sees nothing has the worst value of each: 0, or infinity
/// where less is better.
struct ChannelMeasures {
  double visible_triangles = 0.0;  ///< #{z: a_z > 0}; max.
  double projected_area = 0.0;     ///< [a_t], in the channel's unit; max.
  double visibility_ratio = 0.0;   ///< Σ of A_z over seen faces / A_t; max.
  double entropy = 0.0;            ///< −Σ p(z|v) log p(z|v), bits; max.
  double kullback_leibler = 0.0;   ///< Σ p(z|v) log (p(z|v) / (A_z/A_t)), bits; min.
  double vmi = 0.0;                ///< Σ p(z|v) log (p(z|v) / p(z)), bits; min.
  double i2 = 0.0;                 ///< H(Z) − H(Z|v), bits; min.
  double i3 = 0.0;                 ///< Σ p(z|v) I2(V;z), bits; max.
  double pmi_saliency = 0.0;       ///< Σ S(z) p(v|z); max.
  double evmi = 0.0;               ///< Σ p(z|v) log (p(z|v) / p'(z)), bits; min.
};

/// Measures of a view, which need not belong to the set that the terms are of; of faces that the
/// set never sees, VMI and EVMI take the smallest p(z) of the set.
/// \param seen faces ascending, areas > 0. \param face_areas [A_z], three-dimensional, one a face.
ChannelMeasures channel_measures(std::span<const FaceArea> seen, const ChannelTerms& terms,
                                 std::span<const double> face_areas);

/// Jensen–Shannon divergence of p(Z|a) and p(Z|b), weighted by the areas the two views see: bits,
/// in [0, 1]. 0 if one of them sees nothing.
double view_divergence(std::span<const FaceArea> a, std::span<const FaceArea> b);

/// Mean of the divergences from the neighbours: `instability`, bits in [0, 1]; min. Infinite for a
/// view that sees nothing.
double instability(std::span<const FaceArea> view,
                   std::span<const std::span<const FaceArea>> neighbours);

/// Their mean; 0 of none.
double mean_divergence(std::span<const double> divergences);

/// The divergence of each view of a set from those beside it, 1 where one of both sees nothing.
/// \param next for each view the views beside it, ascending and mutual. \return one a value of
/// `next`.
/// \throw Cancelled
std::vector<double> neighbour_divergences(const std::vector<std::vector<FaceArea>>& views,
                                          const IndexLists& next, const RunContext& run = {});

/// S(z) on vertices: mean over the faces at each vertex, weighted by area; 0 where there are none.
std::vector<double> saliency_on_vertices(const TriMesh& mesh,
                                         std::span<const double> saliency_of_face);

}  // namespace vantage
