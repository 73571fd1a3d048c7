// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/channel.h"
#include "vantage/view/channel_measures.h"
#include "vantage/view/outline.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/face_visibility.h"

/// \file
/// Measures of a view behind one interface: given the sight table of a view, a number. Those built
/// in are listed by builtin_measures(), and anybody can make another: examples/own_measure.cpp.
/// docs/measures.md defines each.

namespace vantage {

/// What a view shows of a skeleton.
struct SkeletonSight {
  double share =
      0.0;  ///< Of its length, in [0, 1]; what crosses behind another branch counts half.
  double limbs = 0.0;  ///< Branches of which at least half the length is shown.
};

/// What a view sees. Parts that no measure asked for are empty.
struct SightTable {
  Viewpoint eye{};                       ///< Where it is seen from.
  Vec3 towards = Vec3::UnitZ();          ///< Unit, from the centre of the sphere to the eye.
  double disc_area = 1.0;                ///< Of the picture of the enclosing sphere; > 0.
  bool sees_vertices = false;            ///< Any, if vertices were asked for.
  std::vector<std::uint8_t> vertices{};  ///< 1 for each vertex seen.
  std::vector<FaceArea> faces{};         ///< [a_z] of the faces seen, ascending.
  double projected_area = 0.0;           ///< [a_t] Their sum.
  double kssm_sum = 0.0;                 ///< KSSM over what is seen, if weighted by area.
  double saliency_sum = 0.0;             ///< The same of mesh saliency.
  /// Projected area by depth, see SeenSurface.
  std::array<double, SeenSurface::kDepthBins> depths{};
  double deepest = 0.0;                     ///< Greatest depth seen over the sphere's diameter.
  OutlineMeasures outline{};                ///< Of the outline.
  double area_logs = 0.0;                   ///< Σ a_z log a_z.
  ChannelMeasures channel{};                ///< If the channel was asked for.
  SkeletonSight skeleton{};                 ///< If the skeleton was asked for.
  std::vector<std::uint32_t> neighbours{};  ///< Views of the set next to this one.
  std::uint32_t set_index = kOffSet;        ///< Of the view in the set, if it was taken from there.

  static constexpr std::uint32_t kOffSet = ~std::uint32_t{0};  ///< Not from the set.
};

/// A model to be measured. Refers to what must outlive it; what is left empty, measures that need
/// it refuse.
struct MeasureSubject {
  const TriMesh* surface = nullptr;      ///< Required; welded and wound outwards.
  std::span<const FaceSides> sides{};    ///< As for VertexVisibility.
  ScoringCamera camera{};                ///< What looks.
  Weight weight = Weight::Vertex;        ///< Of the measures that sum a map.
  std::span<const double> kssm{};        ///< One value a vertex.
  std::span<const double> saliency{};    ///< Mesh saliency; computed if needed and not given.
  const CurveGraph* skeleton = nullptr;  ///< Centred.
  std::span<const std::uint32_t> node_of_vertex{};  ///< Node of `skeleton`; ~0 where none.
};

/// What measures need of a view or of the model; only that is computed.
struct MeasureNeeds {
  bool vertices = false;    ///< SightTable::vertices.
  bool faces = false;       ///< SightTable::faces, depths, sums by area.
  bool outline = false;     ///< SightTable::outline.
  bool channel = false;     ///< MeasuredModel::terms: every view of the set is looked at first.
  bool neighbours = false;  ///< SightTable::neighbours and MeasuredModel::set_views.
  bool kssm = false;        ///< MeasureSubject::kssm.
  bool saliency = false;    ///< MeasuredModel::saliency.
  bool skeleton = false;    ///< MeasureSubject::skeleton.
};

/// The points p with normal · (p − centre of the enclosing sphere) = offset.
struct FacePlane {
  Vec3 normal = Vec3::Zero();  ///< As long as twice the face's area.
  double offset = 0.0;
};

/// What measures know of the model besides the view.
struct MeasuredModel {
  MeasureSubject given{};                 ///< As handed in.
  std::vector<double> face_areas{};       ///< [A_z] model units squared.
  std::vector<double> log_face_areas{};   ///< Their logarithms to base 2.
  std::vector<FacePlane> planes{};        ///< Of each face, if the skeleton is looked at.
  std::vector<double> areas_at_vertex{};  ///< Of the faces at each vertex, with the planes.
  double surface_area = 0.0;              ///< [A_t]
  std::vector<double> saliency{};         ///< Mesh saliency of each vertex.
  std::vector<double> angle_deficits{};   ///< Of each vertex, radians.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< Second moment of the surface over A_t.
  DirectionSet set{};                                ///< The views that channel terms are of.
  ChannelTerms terms{};                              ///< Of that set.
  std::vector<std::vector<FaceArea>> set_views{};    ///< Faces seen by each view of the set.
  IndexLists next_views{};                           ///< Views beside each view of the set.
  std::vector<double> divergences{};                 ///< From these, if neighbours are looked at.
};

/// Whether large or small values are good.
enum class Better { More, Less };

/// A measure of a view.
struct Measure {
  std::string name{};     ///< As on the command line.
  std::string alias{};    ///< Another name, or empty.
  std::string meaning{};  ///< One line.
  std::string source{};   ///< Who published it.
  Better better = Better::More;
  MeasureNeeds needs{};
  /// The value for a view that sees something: finite; where more is better, at least 0.
  std::function<double(const MeasuredModel&, const SightTable&)> value{};
  bool is_count = false;  ///< A number of things: it goes in steps and has no gradient.

  /// What a view that sees nothing gets: 0 where more is better, else infinity.
  [[nodiscard]] double worst() const;

  /// Whether `a` is a better value than `b`.
  [[nodiscard]] bool is_better(double a, double b) const {
    return better == Better::More ? a > b : a < b;
  }

  /// The dearest thing it needs: "surface", "vertices", "faces", "outline", "saliency map",
  /// "skeleton", "kssm map" (a skeleton and more), "set of views".
  [[nodiscard]] std::string_view cost() const;
};

/// All measures of this library, in the order of docs/measures.md.
const std::vector<Measure>& builtin_measures();

/// The measure of this name or alias. \throw InvalidInput that lists the names if there is none.
const Measure& find_measure(std::string_view name);

}  // namespace vantage
