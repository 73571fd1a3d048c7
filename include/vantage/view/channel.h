// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/view/visible_sets.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// The channel from views to faces, and two published ways to choose several views on it:
/// Vázquez, Feixas, Sbert, Heidrich, "Automatic View Selection Using Viewpoint Entropy and its
/// Application to Image-Based Modelling", Computer Graphics Forum 22(4), 2003;
/// Feixas, Sbert, González, "A Unified Information-Theoretic Framework for Viewpoint Selection and
/// Mesh Saliency", ACM Transactions on Applied Perception 6(1), 2009.
/// Logarithms are base 2: entropies and informations are in bits.

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

/// A channel from vertex visibility alone, approximate and quick: a face turned to the eye counts its projected
/// area (perspective: its solid angle) times the share of its corners that are visible.
/// \param sides as for VertexVisibility. \param sets row i belongs to eyes[i].
/// \throw InvalidInput, Cancelled
ViewChannel channel_table(const TriMesh& mesh, std::span<const FaceSides> sides,
                          const VisibleSets& sets, std::span<const Viewpoint> eyes,
                          const RunContext& run = {});

/// The channel of what is seen of each face, however little and whether a corner is seen or not: the
/// projected areas that FaceVisibility measures. \param face_count faces of its mesh.
/// \throw Cancelled
ViewChannel channel_table(const FaceVisibility& faces, std::size_t face_count,
                          std::span<const Viewpoint> eyes, const RunContext& run = {});

}  // namespace vantage
