// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/contraction/contraction.h"
#include "vantage/core/run_context.h"
#include "vantage/io/model.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/orientation/orientation.h"
#include "vantage/pipeline/view_options.h"
#include "vantage/significance/kssm.h"
#include "vantage/skeleton/skeleton.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// From a model to its significance map, in the order of the paper's steps: repair, contract,
/// extract the skeleton, add up the distances. Each step is also a function of its own module.

namespace vantage {

/// Wall-clock seconds of each stage. Who fills in one adds to it: a stage may have several parts.
struct StageSeconds {
  double load = 0.0;      ///< Reading the file, and repairs.
  double contract = 0.0;  ///< Contraction.
  double skeleton = 0.0;  ///< Surgery, centring, pruning.
  double map = 0.0;       ///< Distances and their sum.
  double search = 0.0;    ///< Both views, and what they wait for of a set of views.
  double render = 0.0;    ///< Pictures.
  double total = 0.0;     ///< Of everything.
};

/// What a point cloud needs besides a surface.
struct CloudAnalysis {
  std::vector<std::uint8_t> outlier{};  ///< One entry per vertex of the surface.
  PointContraction contraction{};       ///< Its history of all points moves to the analysis.
};

/// What views of a surface are looked for with, whatever its map; not for callers to look into.
struct ViewPreparation;

/// The surface as the method works on it, and what it found out about its shape.
struct ShapeAnalysis {
  TriMesh surface{};                            ///< Welded, closed shells turned outwards.
  std::vector<FaceSides> sides{};               ///< One per component of `surface`, or one for all.
  std::vector<std::uint32_t> surface_vertex{};  ///< For each input vertex its one in `surface`.
  MeshReport check{};                           ///< Of the welded surface.
  TextureFlow flow{};                           ///< How pictures lie on it.
  Sphere sphere{};                              ///< Smallest around all that pictures show.
  ContractionHistory history{};                 ///< Filled by add_history().
  Skeleton skeleton{};                          ///< Filled by add_skeleton().
  KssmMap kssm{};                               ///< Filled by add_map().
  /// |V| values ≥ 0 that scores add up, filled by add_map(): KSSM, or another map by options.method.
  std::vector<double> significance{};
  /// Vertices of the object that alone counts, and on which pictures are framed; empty: all.
  std::vector<std::uint32_t> focus{};
  std::vector<std::string> warnings{};   ///< Every repair and uncertainty, one sentence each.
  std::optional<CloudAnalysis> cloud{};  ///< Set if the model has no faces.
  /// Of `surface`, filled by analyse_shape() for views. Where it is missing, what looks for views
  /// makes it; whoever changes `surface` resets it.
  std::shared_ptr<const ViewPreparation> views{};
};

/// Welds and orients the model's surface; the only place that repairs, and it lists every repair.
/// Leaves history, skeleton and map empty.
/// The points of a model without faces are joined by their local Delaunay rings.
/// \throw InvalidInput if the model has no extent, or a coordinate that is not finite; Cancelled
ShapeAnalysis prepare_surface(const Model& model, const RunContext& run = {});

/// The same with the object that options.focus names as its focus. A vertex that two objects share
/// belongs to both. \throw InvalidInput if there is no such object
ShapeAnalysis prepare_surface(const Model& model, const ViewOptions& options,
                              const RunContext& run = {});

/// Adds the contraction history to a prepared surface. \throw Cancelled
void add_history(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});
/// Adds the skeleton. \pre history is there. \throw Cancelled
void add_skeleton(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});
/// Adds as much of the skeleton as the map needs: the finished graph only where the options have KSSM
/// measure to that, or a measure may look at it. \pre history is there. \throw Cancelled
void add_curve(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});
/// Adds KSSM, and as significance the map that options.method sums: KSSM itself, unless it is
/// mesh-saliency or pmi-saliency; what shape.focus leaves out gets 0 there, not in KSSM.
/// \pre skeleton or curve is there. \throw Cancelled
void add_map(ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});

/// What an analysis is made for.
enum class AnalysisUse {
  Views,    ///< Views will be looked for: what that needs is made beside the contraction.
  Picture,  ///< Views likewise, but nothing will be said of the skeleton: add_curve() is enough.
  Map,      ///< The map and the skeleton are all that is wanted.
};

/// All of the above; `seconds` receives the stage times if not null.
ShapeAnalysis analyse_shape(const Model& model, const ViewOptions& options,
                            const RunContext& run = {}, StageSeconds* seconds = nullptr,
                            AnalysisUse use = AnalysisUse::Views);

/// The same from what prepare_surface() gave. options.focus is not looked at: shape.focus is.
ShapeAnalysis analyse_surface(ShapeAnalysis shape, const ViewOptions& options,
                              const RunContext& run = {}, StageSeconds* seconds = nullptr,
                              AnalysisUse use = AnalysisUse::Views);

/// A per-vertex field of the surface carried to the input's vertices; isolated ones get 0.
/// \throw InvalidInput unless it has one value per vertex of the surface.
std::vector<double> on_input_vertices(const ShapeAnalysis& shape, std::span<const double> field);

/// Why contraction and skeleton should not be trusted, one sentence each; empty almost always.
/// `ViewReport::reliability_warnings` has these and what there is to say of the views.
std::vector<std::string> skeleton_warnings(const ShapeAnalysis& shape);

/// Skeleton node of each input vertex; −1 where none stands for it: a vertex without faces, an outlier
/// of a cloud.
std::vector<std::int64_t> nodes_of_input_vertices(const ShapeAnalysis& shape);

/// An object of a scene.
struct SceneObject {
  std::string name{};                     ///< As in the file; empty for an unnamed component.
  std::size_t faces = 0;                  ///< Triangles of it in the file.
  std::vector<std::uint32_t> vertices{};  ///< Of the surface, ascending.
};

/// The objects of a scene, numbered from 0: where the file names at least two (OBJ groups and
/// objects, glTF nodes, solids of STL) these, those of one name together and faces before the first
/// name as an object without one; else the components of the surface, by lowest vertex.
/// \pre shape is prepare_surface(model) or more. \throw InvalidInput if a part goes beyond the faces
std::vector<SceneObject> list_objects(const Model& model, const ShapeAnalysis& shape);

/// The object of this name, or else of this number.
/// \throw InvalidInput that says what there is if there is none such.
const SceneObject& find_object(const std::vector<SceneObject>& objects, std::string_view focus);

}  // namespace vantage
