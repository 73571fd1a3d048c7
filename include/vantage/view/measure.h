// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/significance/mesh_saliency.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/channel.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// Measures of a view behind one interface: given the sight table of a view, a number. Those built
/// in are listed by builtin_measures(), and anybody can make another: examples/own_measure.cpp.
/// docs/measures.md defines each. ViewMeasurer looks at a model and hands what it sees to them.
/// Lengths in outlines are in diameters of the silhouette disc, the picture of the model's enclosing
/// sphere.

namespace vantage {

/// The picture of a sphere on the plane through its centre across the line of sight. In perspective
/// it is larger than the sphere's own disc; from within the sphere it is taken to be that disc.
struct SilhouetteDisc {
  Vec3 towards = Vec3::UnitZ();  ///< Unit, from the sphere's centre to the eye.
  double diameter = 1.0;         ///< Model units, on that plane; > 0.
};

/// \pre sphere.diameter > 0. An eye at the very centre looks along −z. \throw InvalidInput if a parallel
/// view has no direction
SilhouetteDisc silhouette_disc(const Sphere& sphere, const Viewpoint& eye);

/// A point of the picture in disc diameters, the disc's centre at the origin.
using PicturePoint = Eigen::Vector2d;

/// Closed polylines with the shape on their left: outer outlines run counter-clockwise, those of
/// holes clockwise. The last point is joined to the first.
using Outline = std::vector<std::vector<PicturePoint>>;

/// What outlines are measured by; all 0 without an outline.
struct OutlineMeasures {
  double length = 0.0;             ///< Of all loops, disc diameters.
  double turning_entropy = 0.0;    ///< Of the turning angles in nine bins over [−π, π], bits.
  double curvature = 0.0;          ///< Mean of |turning| a step, radians.
  double curvature_extrema = 0.0;  ///< Mean of its square, radians squared.
};

/// Steps a disc diameter that turning is measured over, on each loop as equal as it can be divided;
/// loops shorter than three steps have no turning.
inline constexpr double kTurningSteps = 256.0;

/// Places a step at which turning is measured: a corner turns in one step or in two by chance, so
/// that the mean over places is taken. [ours: trials in docs/lab]
inline constexpr int kTurningPhases = 16;

/// Measures an outline. \param phases at least 1.
OutlineMeasures measure_outline(const Outline& outline, int phases = kTurningPhases);

/// Traces outlines of one surface: not on a grid, but along the edges where layers of the surface
/// end, so that they are exact but for rounding. Holds references: the mesh must outlive it.
/// Queries are const and may run on many threads at once.
class OutlineTracer {
 public:
  /// \param sides as for VertexVisibility. \param sphere of the mesh. \throw InvalidInput
  OutlineTracer(const TriMesh& mesh, std::span<const FaceSides> sides, const Sphere& sphere);

  /// The outline of all that the eye could see. Faces that reach behind the eye are left out, and
  /// what lies outside the square around the disc, if the eye is within the sphere.
  [[nodiscard]] Outline trace(const Viewpoint& eye) const;

 private:
  [[nodiscard]] std::vector<PicturePoint> places(const Viewpoint& eye,
                                                 std::vector<std::uint8_t>& ahead) const;

  const TriMesh* mesh_;
  Sphere sphere_;
  std::vector<std::uint8_t> two_sided_{};              // of each face
  std::vector<std::array<std::uint32_t, 2>> edges_{};  // lower vertex first
  // Where two faces run along an edge, each in its own sense: the one in its sense, then the other.
  std::vector<std::array<std::uint32_t, 2>> beside_{};
  IndexLists faces_of_edge_{};
  std::vector<std::int8_t> follows_{};  // of each of these: 1 if it has the edge in that sense
};

/// What a view shows of a skeleton.
struct SkeletonSight {
  double share =
      0.0;  ///< Of its length, in [0, 1]; what crosses behind another branch counts half.
  double limbs = 0.0;  ///< Branches of which at least half the length is shown.
};

/// What a view sees. Parts that no measure asked for are empty.
struct SightTable {
  Viewpoint eye{};               ///< Where it is seen from.
  Vec3 towards = Vec3::UnitZ();  ///< Unit, from the centre of the sphere to the eye.
  /// Of the picture of the enclosing sphere; > 0. All areas are in FaceVisibility::area_unit().
  double disc_area = 1.0;
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
  const TriMesh* surface = nullptr;        ///< Required; welded and wound outwards.
  std::span<const FaceSides> sides{};      ///< As for VertexVisibility.
  ScoringCamera camera{};                  ///< What looks.
  Weight weight = Weight::Vertex;          ///< Of the measures that sum a map.
  std::span<const double> kssm{};          ///< One value a vertex.
  std::span<const double> saliency{};      ///< Mesh saliency; computed if needed and not given …
  MeshSaliencyOptions saliency_options{};  ///< … so.
  const CurveGraph* skeleton = nullptr;    ///< Centred.
  std::span<const std::uint32_t> node_of_vertex{};  ///< Node of `skeleton`; ~0 where none.
  /// What the set of views sees through `camera`, by FaceVisibility, if that was looked at before.
  const ViewChannel* seen_by_set = nullptr;
  const ChannelTerms* terms_of_set = nullptr;  ///< channel_terms() of that, if they are known too.
};

/// The set of views that measures are defined over, unless told otherwise: the icosahedron split this
/// often, 642 views.
inline constexpr int kMeasureSetLevel = 3;

/// What measures need of a view or of the model; only that is computed.
struct MeasureNeeds {
  bool vertices = false;  ///< SightTable::vertices.
  /// SightTable::faces, depths, sums by area; of views of the set that were seen before, see
  /// MeasureSubject::seen_by_set, no depths and no sums of maps.
  bool faces = false;
  bool outline = false;     ///< SightTable::outline.
  bool channel = false;     ///< MeasuredModel::terms: every view of the set is looked at first.
  bool neighbours = false;  ///< SightTable::neighbours and MeasuredModel::set_views.
  bool kssm = false;        ///< MeasureSubject::kssm.
  bool saliency = false;    ///< MeasuredModel::saliency.
  bool skeleton = false;    ///< MeasureSubject::skeleton.

  bool operator==(const MeasureNeeds&) const = default;
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
  /// Of those that stand in one place only the first counts, and the others have no area.
  std::size_t face_count = 0;
  std::vector<double> saliency{};                      ///< Mesh saliency of each vertex.
  std::vector<double> angle_deficits{};                ///< Of each vertex, radians.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();    ///< Second moment of the surface over A_t.
  DirectionSet set{};                                  ///< The views that channel terms are of.
  ChannelTerms terms{};                                ///< Of that set.
  std::span<const std::vector<FaceArea>> set_views{};  ///< Faces seen by each view of the set.
  std::vector<SightTable> set_sights{};  ///< What else they see: without faces and channel.
  IndexLists next_views{};               ///< Views beside each view of the set.
  /// The set one level coarser, if neighbours are looked at: its views are the first of the set.
  DirectionSet coarse_set{};
  IndexLists next_coarse_views{};     ///< Views beside each view of that.
  std::vector<double> divergences{};  ///< From these, if neighbours are looked at.
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
  /// Nearly the value, cheaper: for searches. Unset: the value.
  std::function<double(const MeasuredModel&, const SightTable&)> estimate{};

  /// What a view that sees nothing gets: 0 where more is better, else infinity.
  [[nodiscard]] double worst() const;

  /// Whether `a` is a better value than `b`.
  [[nodiscard]] bool is_better(double a, double b) const {
    return better == Better::More ? a > b : a < b;
  }

  /// Whether it is defined over a set of views, which all are looked at first.
  [[nodiscard]] bool is_of_set() const { return needs.channel || needs.neighbours; }

  /// The dearest thing it needs: "surface", "vertices", "faces", "outline", "saliency map",
  /// "skeleton", "kssm map" (a skeleton and more), "set of views".
  [[nodiscard]] std::string_view cost() const;
};

/// All measures of this library, in the order of docs/measures.md.
const std::vector<Measure>& builtin_measures();

/// The measure of this name or alias. \throw InvalidInput that lists the names if there is none.
const Measure& find_measure(std::string_view name);

/// One measure over the set of views.
struct SetSurvey {
  std::vector<double> values{};  ///< Of each view of the set.
  bool is_exact = true;          ///< Or else estimates.
};

/// Values of several measures: values[m][i] is that of measure m in view i.
using MeasureValues = std::vector<std::vector<double>>;

/// Measures views of one model by several measures, looking once for all of them. Holds references:
/// what the subject refers to must outlive it. Results do not depend on the number of threads.
/// All that asks for values throws InvalidInput for one that is no number.
class ViewMeasurer {
 public:
  /// \param level the set of views: the icosahedron split this often, 0–6. It is part of the
  ///              definition of measures that need the channel; these look at all of it here.
  /// \throw InvalidInput if a measure has no value, or needs what the subject lacks. \throw Cancelled
  ViewMeasurer(const MeasureSubject& subject, std::vector<Measure> measures,
               int level = kMeasureSetLevel, const RunContext& run = {});
  ~ViewMeasurer();
  ViewMeasurer(ViewMeasurer&&) noexcept;             ///< Leaves the other unusable.
  ViewMeasurer& operator=(ViewMeasurer&&) noexcept;  ///< The same.

  [[nodiscard]] const std::vector<Measure>& measures() const;  ///< As given.
  /// measures()[m]. \throw InvalidInput if there is none, as all do that take an index of a measure.
  [[nodiscard]] const Measure& measure(std::size_t m) const;
  [[nodiscard]] const MeasuredModel& model() const;  ///< What is known of the model.
  [[nodiscard]] const DirectionSet& set() const;     ///< The set of views.
  [[nodiscard]] int set_level() const;               ///< How often it was split.

  /// Values over the set; computed once. \throw Cancelled
  const MeasureValues& set_values(const RunContext& run = {});

  /// Values of any views: eyes inside the model and views that see nothing too. \throw Cancelled
  [[nodiscard]] MeasureValues values(std::span<const Viewpoint> eyes,
                                     const RunContext& run = {}) const;

  /// The same of directions of any length, through the subject's camera. \throw InvalidInput for one that
  /// is zero or not finite, as all that take directions; Cancelled
  [[nodiscard]] MeasureValues values(std::span<const Vec3> directions,
                                     const RunContext& run = {}) const;

  /// Values of one measure alone, which looks at no more than it needs. \throw Cancelled
  [[nodiscard]] std::vector<double> values_of(std::size_t m, std::span<const Vec3> directions,
                                              const RunContext& run = {}) const;

  /// The same values. What a look tells of the other measures at little cost is kept as well, so that
  /// asked about them the measurer need not look again. \throw Cancelled
  std::vector<double> kept_values_of(std::size_t m, std::span<const Vec3> directions,
                                     const RunContext& run = {});

  /// Whether the measure looks at faces and can be estimated by FaceDetail::ByCorners. What it takes
  /// from the set of views stays exact.
  [[nodiscard]] bool has_estimates(std::size_t m) const;

  /// These estimates. \pre has_estimates(m). \throw Cancelled
  [[nodiscard]] std::vector<double> estimates_of(std::size_t m, std::span<const Vec3> directions,
                                                 const RunContext& run = {}) const;

  /// One measure over the set: estimates where these cost less. \throw Cancelled
  [[nodiscard]] SetSurvey survey_of(std::size_t m, const RunContext& run = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
