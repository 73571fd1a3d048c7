// SPDX-License-Identifier: MIT
#include "vantage/mesh/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/view/measure.h"

#include "support/channel_identities.h"
#include "support/many_threads.h"
#include "support/shapes.h"
#include "support/worst.h"
#include "unit/view/measure_subject.h"

namespace vantage {
namespace {

using test::Subject;

/// The unit cube, and the diameter of the sphere around it.
const double kCubeDiameter = std::sqrt(3.0);

TEST(Measures, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Measure& measure : builtin_measures()) {
    EXPECT_TRUE(names.insert(measure.name).second) << measure.name;
    EXPECT_TRUE(measure.alias.empty() || names.insert(measure.alias).second) << measure.alias;
    EXPECT_FALSE(measure.source.empty());
  }
}

TEST(Measures, AreFoundByAliasToo) {
  EXPECT_EQ(find_measure("i1").name, "vmi");
}

TEST(Measures, SayWhatIsDearestOfWhatTheyNeed) {
  EXPECT_EQ(find_measure("kssm").cost(), "kssm map");
  EXPECT_EQ(find_measure("mesh-saliency").cost(), "saliency map");
  EXPECT_EQ(find_measure("skeleton-visibility").cost(), "skeleton");
  EXPECT_EQ(find_measure("skeleton-limbs").cost(), "skeleton");
  EXPECT_EQ(find_measure("principal-axis").cost(), "vertices");
  EXPECT_EQ(find_measure("plemenos").cost(), "faces");
  EXPECT_EQ(find_measure("silhouette-entropy").cost(), "outline");
  EXPECT_EQ(find_measure("instability").cost(), "set of views");
  EXPECT_EQ(find_measure("pmi-saliency").cost(), "set of views");
  EXPECT_EQ(Measure{}.cost(), "surface");
  // No measure hides a need behind a cheaper one.
  for (const Measure& measure : builtin_measures()) {
    const bool is_plain = measure.cost() == "vertices" || measure.cost() == "faces";
    EXPECT_EQ(is_plain, !measure.needs.kssm && !measure.needs.saliency && !measure.needs.skeleton &&
                            !measure.needs.outline && !measure.needs.channel &&
                            !measure.needs.neighbours)
        << measure.name;
  }
}

TEST(Measures, ListTheNamesThereAreForAnUnknownOne) {
  try {
    find_measure("beauty");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("viewpoint-entropy"), std::string::npos);
  }
}

TEST(Measures, OfACubeSeenStraightAreThoseOfOneSide) {
  const Subject cube(test::box(1, 1, 1, 1));
  const Vec3 x = Vec3::UnitX();
  EXPECT_EQ(cube.value("visible-triangles", x), 2.0);
  EXPECT_NEAR(cube.value("visibility-ratio", x), 1.0 / 6.0, 1e-12);
  // Two halves of equal area: 1 bit; 1/2 each against 1/12: log2 6.
  EXPECT_NEAR(cube.value("viewpoint-entropy", x), 1.0, 1e-9);
  EXPECT_NEAR(cube.value("kullback-leibler", x), std::log2(6.0), 1e-6);
  const double disc = 0.25 * std::numbers::pi * 3.0;
  EXPECT_NEAR(cube.value("projected-area", x), 1.0 / disc, 1e-6);
  EXPECT_NEAR(cube.value("plemenos", x), 2.0 / 12.0 + 1.0 / 3.0, 1e-6);
}

TEST(Measures, CountFacesThatStandInOnePlaceOnce) {
  const TriMesh once = test::box(1.0, 2.0, 3.0, 2);
  TriMesh twice = once;
  twice.triangles.insert(twice.triangles.end(), once.triangles.begin(), once.triangles.end());
  for (const char* const name : {"visibility-ratio", "kullback-leibler", "plemenos",
                                 "viewpoint-entropy", "principal-axis"}) {
    EXPECT_DOUBLE_EQ(Subject(twice).value(name, Vec3(1, 2, 3)),
                     Subject(once).value(name, Vec3(1, 2, 3)))
        << name;
  }
}

TEST(Measures, TakeTheBackgroundAsAFaceInTheEntropyOf2001) {
  const Subject cube(test::box(1, 1, 1, 1));
  // The picture is the square around the disc, 3 square units: two halves of 1/6, background 2/3.
  const double expected = 2.0 / 6.0 * std::log2(6.0) + 2.0 / 3.0 * std::log2(1.5);
  EXPECT_NEAR(cube.value("viewpoint-entropy-2001", Vec3::UnitX()), expected, 1e-6);
}

TEST(Measures, OfACubeSeenFromACornerAreThoseOfThreeSides) {
  const Subject cube(test::box(1, 1, 1, 1));
  const Vec3 corner(1, 1, 1);
  EXPECT_EQ(cube.value("visible-triangles", corner), 6.0);
  EXPECT_NEAR(cube.value("visibility-ratio", corner), 0.5, 1e-12);
  EXPECT_NEAR(cube.value("viewpoint-entropy", corner), std::log2(6.0), 1e-6);
  EXPECT_NEAR(cube.value("kullback-leibler", corner), 1.0, 1e-6);
}

TEST(Measures, SeeTheDepthOfACubesFront) {
  const Subject cube(test::box(1, 1, 1, 1));
  EXPECT_NEAR(cube.value("max-depth", Vec3::UnitX()), 0.5 - 0.5 / kCubeDiameter, 1e-6);
  EXPECT_EQ(cube.value("depth-distribution", Vec3::UnitX()), 0.0);
}

TEST(Measures, SeeTheDepthsOfASphere) {
  const Subject ball(test::sphere(5));
  EXPECT_NEAR(ball.value("max-depth", Vec3::UnitX()), 0.5, 1e-3);
  // Area seen by depth t over the diameter has density 8 (1/2 − t) on [0, 1/2], and 64 bins of
  // width 1/64 give Σ h² = 1/64 ∫ density² = 1/24.
  EXPECT_NEAR(ball.value("depth-distribution", Vec3::UnitX()), 1.0 - 1.0 / 24.0, 1e-3);
}

TEST(Measures, OfASphereFillTheDiscInEitherProjection) {
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    const Subject ball(test::sphere(6), projection);
    // Inscribed edges of 1/55 of the radius lose about 1/55² / 8 of it, and twice that of the area.
    EXPECT_NEAR(ball.value("projected-area", Vec3(1, 2, 3)), 1.0, 1e-3);
    EXPECT_NEAR(ball.value("silhouette-length", Vec3(1, 2, 3)), std::numbers::pi, 2e-3);
  }
}

TEST(Measures, TurnOnceAroundTheOutlineOfASphere) {
  const Subject ball(test::sphere(6));
  const double steps = std::round(std::numbers::pi * kTurningSteps);
  EXPECT_NEAR(ball.value("silhouette-curvature", Vec3(1, 2, 3)), 2.0 * std::numbers::pi / steps,
              2e-4);
  EXPECT_EQ(ball.value("silhouette-entropy", Vec3(1, 2, 3)), 0.0);
}

TEST(Measures, OutlineACube) {
  const Subject cube(test::box(1, 1, 1, 3));
  EXPECT_NEAR(cube.value("silhouette-length", Vec3::UnitX()), 4.0 / kCubeDiameter, 1e-12);
  // A regular hexagon of side √(2/3).
  EXPECT_NEAR(cube.value("silhouette-length", Vec3(1, 1, 1)),
              6.0 * std::sqrt(2.0 / 3.0) / kCubeDiameter, 1e-12);
}

TEST(Measures, OutlineTheHoleOfATorusToo) {
  const Subject ring(test::torus(1.0, 0.25, 128, 48));
  // Circles of radius 1.25 and 0.75, the sphere has diameter 2.5.
  EXPECT_NEAR(ring.value("silhouette-length", Vec3::UnitZ()), std::numbers::pi * 1.6, 5e-3);
}

/// Measures of the outline, and the largest change of each where twice as many places of each step are
/// looked at, over its range.
constexpr std::array kOutlineMembers{&OutlineMeasures::curvature,
                                     &OutlineMeasures::curvature_extrema,
                                     &OutlineMeasures::turning_entropy};

std::array<double, kOutlineMembers.size()> changes_when_halved() {
  const Subject tubes(test::y_of_tubes(0.2, 40), Projection::Perspective);
  const ScoringCamera& camera = tubes.given.camera;
  const OutlineTracer tracer(tubes.mesh, tubes.sides, camera.sphere);
  constexpr std::size_t kCount = kOutlineMembers.size();
  std::array<double, kCount> low{};
  low.fill(std::numeric_limits<double>::infinity());
  std::array<double, kCount> high{};
  std::array<double, kCount> change{};
  for (const Vec3& d : direction_set(ViewSphereBase::Icosahedron, 2).directions) {
    const Outline outline = tracer.trace(camera.viewpoint(d));
    const OutlineMeasures usual = measure_outline(outline);
    const OutlineMeasures halved = measure_outline(outline, 2 * kTurningPhases);
    for (std::size_t m = 0; m < kCount; ++m) {
      const double finer = halved.*kOutlineMembers[m];
      low[m] = test::smaller(low[m], finer);
      high[m] = test::larger(high[m], finer);
      change[m] = test::larger(change[m], std::abs(usual.*kOutlineMembers[m] - finer));
    }
  }
  for (std::size_t m = 0; m < kCount; ++m) {
    change[m] /= high[m] - low[m];
  }
  return change;
}

TEST(Measures, HaveTheOutlinesTurningConverged) {
  for (const double change : changes_when_halved()) {
    EXPECT_LT(change, 0.01);
  }
}

TEST(Measures, SpreadASphereEvenly) {
  const Subject ball(test::sphere(5));
  // Each axis has a third of r².
  EXPECT_NEAR(ball.value("principal-axis", Vec3(3, -1, 2)), 2.0 / 3.0, 1e-3);
}

TEST(Measures, SpreadARodAcross) {
  const Subject rod(test::box(10, 1, 1, 4));
  EXPECT_GT(rod.value("principal-axis", Vec3::UnitY()),
            10.0 * rod.value("principal-axis", Vec3::UnitX()));
}

TEST(Measures, CountTheCurvatureOfACubesVertices) {
  const Subject cube(test::box(1, 1, 1, 2));
  // 19 of 26 vertices are seen: 7 corners of deficit π/2, 12 flat ones.
  const double p = 7.0 / 19.0;
  EXPECT_NEAR(cube.value("curvature-entropy", Vec3(1, 1.1, 1.2)),
              -p * std::log2(p) - (1.0 - p) * std::log2(1.0 - p), 1e-12);
}

TEST(Measures, CountFlatVerticesAlikeWhateverRoundingMakesOfThem) {
  const Vec3 axis = Vec3(1, 2, 3);
  const Subject cube(test::moved(test::box(1, 1, 1, 6), 1.0, 0.7, axis, Vec3::Zero()));
  // Three sides of 49 vertices share three rows of 7 and a corner: 127, of which 7 are corners.
  const double p = 7.0 / 127.0;
  const Vec3 towards = Eigen::AngleAxisd(0.7, axis.normalized()) * Vec3(1, 1.1, 1.2);
  EXPECT_NEAR(cube.value("curvature-entropy", towards),
              -p * std::log2(p) - (1.0 - p) * std::log2(1.0 - p), 1e-12);
}

TEST(Measures, CauchysMeanShadowIsAQuarterOfTheSurface) {
  const Subject brick(test::box(1, 2, 3, 4));
  ViewMeasurer measurer(brick.given, {find_measure("projected-area")}, 4);
  const std::vector<double> fractions = measurer.set_values()[0];
  const std::vector<double> weights =
      vertex_areas({measurer.set().directions, measurer.set().triangles});
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * fractions[i];
    all += weights[i];
  }
  const double disc = 0.25 * std::numbers::pi * 14.0;  // D² = 1 + 4 + 9
  EXPECT_NEAR(sum / all * disc, 22.0 / 4.0, 1e-3 * 22.0 / 4.0);
}

TEST(Measures, ShowTheSkeletonThatIsNotHidden) {
  // Two slabs one behind the other; each has a bone, and the far one is hidden from the front.
  Subject slabs(test::together(test::box(4, 1, 0.2, 8), test::box(4, 1, 0.2, 8), Vec3(0, 0, -2)));
  slabs.sides = {FaceSides::Front};
  slabs.given.sides = slabs.sides;
  slabs.graph.nodes = {{0, 0.5, 0.1}, {4, 0.5, 0.1}, {0, 0.5, -1.9}, {4, 0.5, -1.9}};
  slabs.graph.edges = {{0, 1}, {2, 3}};
  for (std::size_t v = 0; v < slabs.mesh.positions.size(); ++v) {
    const Vec3& p = slabs.mesh.positions[v];
    slabs.node_of_vertex[v] = (p.z() < -0.5 ? 2U : 0U) + (p.x() > 2.0 ? 1U : 0U);
  }
  EXPECT_NEAR(slabs.value("skeleton-visibility", Vec3::UnitZ()), 0.5, 1e-12);
  EXPECT_NEAR(slabs.value("skeleton-visibility", Vec3::UnitY()), 1.0, 1e-12);
  EXPECT_EQ(slabs.value("skeleton-limbs", Vec3::UnitZ()), 1.0);
}

TEST(Measures, CountABoneHalfThatCrossesBehindAnother) {
  TriMesh upright = test::box(0.1, 4, 0.1, 20);
  Subject cross(test::together(test::box(4, 0.1, 0.1, 20), upright, Vec3(1.95, -1.95, -1)));
  cross.graph.nodes = {{0, 0.05, 0.05}, {4, 0.05, 0.05}, {2, -1.95, -0.95}, {2, 2.05, -0.95}};
  cross.graph.edges = {{0, 1}, {2, 3}};
  for (std::size_t v = 0; v < cross.mesh.positions.size(); ++v) {
    const Vec3& p = cross.mesh.positions[v];
    cross.node_of_vertex[v] = p.z() < -0.5 ? (p.y() > 0.0 ? 3U : 2U) : (p.x() > 2.0 ? 1U : 0U);
  }
  // Both bones are as long and shown; the far one counts half.
  EXPECT_NEAR(cross.value("skeleton-visibility", Vec3::UnitZ()), 0.75, 1e-9);
}

TEST(Measures, TellInPerspectiveWhichOfTwoBonesIsNearerWhereTheyCross) {
  // One leads away from the eye: half way along it in space is further along in the picture, .59 of it, and a
  // depth that were even there would put it behind the other, which is .09 behind it.
  const std::vector<Vec3> nodes{{-1, 0, 1}, {1, 0, -1}, {0, -1, -0.09}, {0, 1, -0.09}};
  TriMesh cubes;  // one at each node: all are shown
  for (const Vec3& node : nodes) {
    cubes = test::together(cubes, test::box(0.1, 0.1, 0.1, 1), node - Vec3::Constant(0.05));
  }
  Subject cross(cubes, Projection::Perspective);
  cross.graph.nodes = nodes;
  cross.graph.edges = {{0, 1}, {2, 3}};
  for (std::size_t v = 0; v < cross.node_of_vertex.size(); ++v) {
    cross.node_of_vertex[v] = static_cast<std::uint32_t>(4 * v / cross.node_of_vertex.size());
  }
  const double leading = std::sqrt(8.0);
  EXPECT_NEAR(cross.value("skeleton-visibility", Vec3::UnitZ()), (leading + 1.0) / (leading + 2.0),
              1e-9);
}

TEST(Measures, TakeThePerspectiveEyeInsideAsABlindView) {
  // From inside a closed shell only backs are turned to the eye.
  const Subject cube(test::box(1, 1, 1, 4), Projection::Perspective);
  const ViewMeasurer measurer(cube.given, builtin_measures(), 1);
  const std::vector<Viewpoint> inside{{Projection::Perspective, Vec3(0.4, 0.5, 0.6)}};
  const MeasureValues values = measurer.values(inside);
  for (std::size_t m = 0; m < values.size(); ++m) {
    EXPECT_EQ(values[m][0], measurer.measures()[m].worst()) << measurer.measures()[m].name;
  }
}

TEST(Measures, StayFiniteOnTheSetOfViews) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  ViewMeasurer measurer(ring.given, builtin_measures(), 2);
  for (const std::vector<double>& row : measurer.set_values()) {
    for (const double value : row) {
      EXPECT_TRUE(std::isfinite(value));
    }
  }
}

TEST(Measures, KeepTheIdentitiesOfTheChannel) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  ViewMeasurer measurer(ring.given, test::channel_measures(), 2);
  test::expect_channel_identities(measurer);
  test::expect_merging_tells_no_more(measurer.model());
}

TEST(Measures, OfTheSetAreThoseOfTheSameDirectionsAskedForAlone) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  ViewMeasurer measurer(ring.given, builtin_measures(), 1);
  const MeasureValues of_set = measurer.set_values();
  const MeasureValues again = measurer.values(measurer.set().directions);
  EXPECT_EQ(of_set, again);
}

TEST(Measures, OfTheSetDoNotLookWhereTheSubjectBringsWhatTheSetSees) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  std::vector<Viewpoint> eyes;
  for (const Vec3& direction : direction_set(ViewSphereBase::Icosahedron, 2).directions) {
    eyes.push_back(ring.given.camera.viewpoint(direction));
  }
  const FaceVisibility faces(ring.mesh, ring.sides);
  ViewChannel seen = channel_table(faces, eyes);
  MeasureSubject given = ring.given;
  given.seen_by_set = &seen;
  std::vector<Measure> measures = test::channel_measures();
  std::erase_if(measures, [](const Measure& measure) { return !measure.is_of_set(); });
  ASSERT_GE(measures.size(), 3U);
  EXPECT_EQ(ViewMeasurer(given, measures, 2).set_values(),
            ViewMeasurer(ring.given, measures, 2).set_values());
  ChannelTerms terms = channel_terms(seen, ring.mesh);
  given.terms_of_set = &terms;
  EXPECT_EQ(ViewMeasurer(given, measures, 2).set_values(),
            ViewMeasurer(ring.given, measures, 2).set_values());
  // It is what is brought that is measured.
  terms.entropy_of_faces = 10.0;
  EXPECT_EQ(ViewMeasurer(given, measures, 2).model().terms.entropy_of_faces, 10.0);
  given.terms_of_set = nullptr;
  seen.views[5] = seen.views[6];
  ViewMeasurer changed(given, measures, 2);
  EXPECT_EQ(changed.set_values()[0][5], changed.set_values()[0][6]);
  // Not for another set.
  EXPECT_EQ(ViewMeasurer(given, measures, 1).set_values(),
            ViewMeasurer(ring.given, measures, 1).set_values());
  // Not for measures that look at more.
  measures.push_back(find_measure("max-depth"));
  EXPECT_EQ(ViewMeasurer(given, measures, 2).set_values(),
            ViewMeasurer(ring.given, measures, 2).set_values());
}

TEST(Measures, AreSurveyedByEstimatesWhereTheseCostLess) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  for (const char* name : {"projected-area", "view-likelihood", "vmi", "silhouette-length"}) {
    ViewMeasurer measurer(ring.given, {find_measure(name)}, 2);
    const SetSurvey survey = measurer.survey_of(0);
    const std::vector<double> exact = measurer.set_values()[0];
    const double most = *std::max_element(exact.begin(), exact.end());
    EXPECT_EQ(survey.is_exact, survey.values == exact) << name;
    EXPECT_EQ(survey.is_exact,
              name == std::string_view("vmi") || name == std::string_view("silhouette-length"));
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_NEAR(survey.values[i], exact[i], 0.15 * most) << name << ' ' << i;
    }
    EXPECT_TRUE(measurer.survey_of(0).is_exact) << "the set's values are there by now";
  }
}

TEST(Measures, CompareAViewOffTheSetWithTheCornersOfItsTriangle) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  const ViewMeasurer measurer(ring.given, {find_measure("instability")}, 2);
  const auto& [a, b, c] = measurer.set().triangles[17];
  const auto& directions = measurer.set().directions;
  const Vec3 inside = (2.0 * directions[a] + directions[b] + directions[c]).normalized();
  std::vector<FaceArea> seen;
  const FaceVisibility faces(ring.mesh, ring.sides);
  for (const SeenFace& face : faces.seen_faces(ring.given.camera.viewpoint(inside))) {
    seen.push_back({face.face, static_cast<float>(face.projected_area / faces.area_unit())});
  }
  double sum = 0.0;
  for (const std::uint32_t view : {a, b, c}) {
    sum += view_divergence(seen, measurer.model().set_views[view]);
  }
  EXPECT_NEAR(measurer.values(std::vector<Vec3>{inside})[0][0], sum / 3.0, 1e-12);
}

TEST(Measures, DoNotDependOnTheNumberOfThreads) {
  const Subject ring(test::torus(1.0, 0.4, 24, 12), Projection::Perspective);
  const auto all = [&](int threads) {
    const RunContext run{.max_threads = threads};
    ViewMeasurer measurer(ring.given, builtin_measures(), 2, run);
    return measurer.set_values(run);
  };
  EXPECT_EQ(all(1), test::with_many_threads([&] { return all(3); }));
}

TEST(Measures, DoNotDependOnPlaceAndSize) {
  const TriMesh shape = test::torus(1.0, 0.4, 48, 24);
  const Vec3 direction = Vec3(1, 2, 2) / 3.0;
  const Subject here(shape);
  for (const double scale : {1e-8, 1e8}) {
    const Subject there(test::moved(shape, scale, 0.0, Vec3::UnitX(), Vec3(1, -2, 3) * scale));
    // The saliency is handed in: on a shape this even its local maxima are ties.
    MeasureSubject given_here = here.given;
    MeasureSubject given_there = there.given;
    given_here.saliency = given_there.saliency = here.kssm;
    const ViewMeasurer a(given_here, builtin_measures(), 1);
    const ViewMeasurer b(given_there, builtin_measures(), 1);
    const MeasureValues of_a = a.values(std::vector<Vec3>{direction});
    const MeasureValues of_b = b.values(std::vector<Vec3>{direction});
    for (std::size_t m = 0; m < of_a.size(); ++m) {
      if (a.measures()[m].name != "skeleton-visibility") {  // its bone does not scale here
        EXPECT_NEAR(of_a[m][0], of_b[m][0], 1e-3 * (std::abs(of_a[m][0]) + 1e-6))
            << a.measures()[m].name;
      }
    }
  }
}

TEST(Measures, SumsByAreaAreWhatTheScorerSays) {
  Subject rings(test::torus(1.0, 0.4, 24, 12));
  rings.given.weight = Weight::Area;
  ViewMeasurer measurer(rings.given, {find_measure("kssm")}, 1);
  const FaceVisibility faces(rings.mesh, rings.sides);
  const ViewScorer scorer(faces, rings.kssm, rings.given.camera);
  EXPECT_EQ(measurer.set_values()[0], scorer.score_all(measurer.set().directions));
}

TEST(Measures, RefuseAModelWithoutTheMapTheyNeed) {
  Subject cube(test::box(1, 1, 1, 1));
  cube.given.kssm = {};
  EXPECT_THROW(ViewMeasurer(cube.given, {find_measure("kssm")}), InvalidInput);
}

}  // namespace
}  // namespace vantage
