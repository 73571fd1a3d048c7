// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/view_set.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// The channel from views to faces: two published ways to choose several views on it, and measures
/// of a view with the terms that they take from a whole set of views. Vázquez, Feixas, Sbert, Heidrich,
/// "Automatic View Selection Using Viewpoint Entropy and its Application to Image-Based Modelling",
/// Computer Graphics Forum 22(4), 2003; Feixas, Sbert, González, "A Unified Information-Theoretic
/// Framework for Viewpoint Selection and Mesh Saliency", ACM Transactions on Applied Perception 6(1),
/// 2009; Bonaventura, Feixas, Sbert, "Viewpoint Information", 2011. docs/measures.md defines each.
///
/// [a_z(v)] is the area that view v sees of face z, [a_t(v)] their sum; p(v) = a_t(v) / Σ a_t,
/// p(z|v) = a_z(v) / a_t(v), p(z) = Σ p(v) p(z|v), p(v|z) = a_z(v) / Σ_v a_z(v). All logarithms are
/// base 2, so entropies and informations are in bits; 0 · log 0 = 0.

namespace vantage {

/// The projected area that a view sees of a face.
struct FaceArea {
  std::uint32_t face = 0;  ///< Index.
  float area = 0.0F;       ///< [a_z(v)], > 0, in any unit common to all views.
};

/// For each view the faces it sees. Faces that no view sees do not take part.
struct ViewChannel {
  std::size_t face_count = 0;                  ///< |F|.
  std::vector<std::vector<FaceArea>> views{};  ///< Of each view: faces ascending, areas > 0.
};

/// A view of a selection and what it was chosen for.
struct ChannelPick {
  std::uint32_t view = 0;  ///< Index into the channel's views.
  double value = 0.0;      ///< Bits: what the selection compared, see each function.
};

/// Vázquez's greedy choice: the view of greatest entropy over the faces not yet seen, until `count`
/// views are chosen or no view is left whose entropy is above 0. The terms −p log p of faces
/// already seen are dropped while p stays a share of all that the view sees, so that a view of two
/// last slivers does not count as much as one of half the model. `value` is that entropy; of equals
/// the lower index.
/// \throw InvalidInput if the channel is malformed. \throw Cancelled
std::vector<ChannelPick> greedy_entropy_views(const ViewChannel& channel, std::size_t count,
                                              const RunContext& run = {});

/// A way over the view sphere from view to view beside it.
struct Exploration {
  std::vector<std::uint32_t> views{};  ///< Indices of the channel's views; the first is the start.
  /// Share of all that any view sees, Σ a_z over all views, that is of faces seen on the way, [0, 1].
  double coverage = 0.0;
};

/// Vázquez's exploration: from a view always to the one beside it of greatest entropy over the faces
/// not yet seen, as greedy_entropy_views() measures it, until `coverage` is reached. Where no view
/// beside it shows anything new, to the nearest that does. Of equals the lower index.
/// \param next for each view the views beside it, ascending and mutual. \param start a view.
/// \param coverage in [0, 1]. \throw InvalidInput if the channel is malformed, or next or start do
/// not belong to it. \throw Cancelled
Exploration explore_by_entropy(const ViewChannel& channel, const IndexLists& next,
                               std::uint32_t start, double coverage, const RunContext& run = {});

/// Result of merge_views().
struct MergedViews {
  std::vector<ChannelPick> picks{};  ///< `value` is I(v̂;Z) with this view merged in.
  double channel_information = 0.0;  ///< I(V;Z) of the whole channel, bits.
};

/// Feixas's greedy merge into one view v̂ with p(Z|v̂) = Σ p(v_i) p(Z|v_i) / p(v̂): first the view
/// of least VMI, then always the view that makes I(v̂;Z) smallest, until `count` views are merged
/// or I(v̂;Z) ≤ ratio · I(V;Z). Of equals the lower index. Views that see nothing are never chosen.
/// \param ratio in [0, 1]; 0 stops by count alone.
/// \throw InvalidInput if the channel is malformed or ratio is out of range. \throw Cancelled
MergedViews merge_views(const ViewChannel& channel, std::size_t count, double ratio = 0.0,
                        const RunContext& run = {});

/// The channel of what is seen of each face, however little and whether a corner is seen or not: the
/// projected areas that FaceVisibility measures, in its area_unit(). \throw InvalidInput if an eye is not
/// finite, Cancelled
ViewChannel channel_table(const FaceVisibility& faces, std::span<const Viewpoint> eyes,
                          const RunContext& run = {});

/// What measures take from the set of views that they are defined over.
struct ChannelTerms {
  std::vector<double> area_of_view{};      ///< [a_t(v)] of each view.
  std::vector<double> area_of_face{};      ///< Σ_v a_z(v) of each face; 0 if no view sees it.
  std::vector<double> p_of_face{};         ///< [p(z)]
  std::vector<double> i2_of_face{};        ///< [I2(V;z) = H(V) − H(V|z)], bits; 0 if never seen.
  std::vector<double> saliency_of_face{};  ///< [S(z)], bits; 0 if never seen.
  std::vector<double> weighted_p{};        ///< [p'(z)] ∝ S(z) p(z); see kSaliencyFloor.
  /// Logarithms of both, those of the least where no view sees the face.
  std::vector<double> log_p{}, log_weighted_p{};
  std::vector<double> saliency_share{};  ///< S(z) / Σ_v a_z(v); 0 if never seen.
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

/// The measures of one view that ask what other views see of its faces. A view that sees nothing has the
/// worst value of each: 0, or infinity where less is better.
struct ChannelMeasures {
  double vmi = 0.0;           ///< Σ p(z|v) log (p(z|v) / p(z)), bits; min.
  double i3 = 0.0;            ///< Σ p(z|v) I2(V;z), bits; max.
  double pmi_saliency = 0.0;  ///< Σ S(z) p(v|z); max.
  double evmi = 0.0;          ///< Σ p(z|v) log (p(z|v) / p'(z)), bits; min.
};

/// Measures of a view, which need not belong to the set that the terms are of; of faces that the
/// set never sees, VMI and EVMI take the smallest p(z) of the set.
/// \param seen faces ascending, areas > 0.
ChannelMeasures channel_measures(std::span<const FaceArea> seen, const ChannelTerms& terms);

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
std::vector<double> neighbour_divergences(std::span<const std::vector<FaceArea>> views,
                                          const IndexLists& next, const RunContext& run = {});

/// S(z) on vertices: mean over the faces at each vertex, weighted by area; 0 where there are none.
std::vector<double> saliency_on_vertices(const TriMesh& mesh,
                                         std::span<const double> saliency_of_face);

}  // namespace vantage
