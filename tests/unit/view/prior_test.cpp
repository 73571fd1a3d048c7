// SPDX-License-Identifier: MIT
#include "vantage/view/prior.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "vantage/core/error.h"
#include "vantage/spatial/directions.h"

namespace vantage::test {
namespace {

const UprightFrame kFrame{};
constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<Vec3> sphere() {
  return direction_set(ViewSphereBase::Icosahedron, 3).directions;
}

/// From the azimuth, measured from the front toward the side, and the elevation.
Vec3 direction_at(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree;
  const double e = elevation_deg * kDegree;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

std::string problem_of(std::string_view text) {
  try {
    parse_prior(text, "my.json");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "none";
}

TEST(UprightPrior, IsPositiveAndAtMostOne) {
  for (const Vec3& d : sphere()) {
    const double p = upright_prior().factor(kFrame, d);
    EXPECT_GT(p, 0.0);
    EXPECT_LE(p, 1.0);
  }
}

TEST(UprightPrior, PrefersTheRightByItsSideTermAlone) {
  for (const Vec3& d : sphere()) {
    const double left = upright_prior().factor(kFrame, Vec3(-d.x(), d.y(), d.z()));
    EXPECT_NEAR(upright_prior().factor(kFrame, d) / left, std::exp(2.0 * d.x() * 0.040), 1e-12);
  }
}

TEST(UprightPrior, IsSmooth) {
  // The exponent is a polynomial of degree 4 in the direction: with q the corner term's 2sf, its
  // gradient on the unit sphere is at most 2·K·(1 + |u0|) + C·2|q|·2 + T + S, for |q| ≤ 1.
  const UprightPrior c;
  const double steepest = 2.0 * c.elevation_strength * (1.0 + std::abs(c.elevation_sine)) +
                          4.0 * c.corner_strength + c.front_strength + c.side_strength;
  const double step = 1e-4;
  for (const Vec3& d : sphere()) {
    const Vec3 near = (d + step * d.unitOrthogonal()).normalized();
    EXPECT_LE(std::abs(std::log(upright_prior().factor(kFrame, d)) -
                       std::log(upright_prior().factor(kFrame, near))),
              steepest * step);
  }
}

TEST(UprightPrior, IsLargestAtAThreeQuarterViewFromAboveTheFront) {
  Vec3 best = Vec3::UnitX();
  for (const Vec3& d : direction_set(ViewSphereBase::Icosahedron, 5).directions) {
    if (upright_prior().factor(kFrame, d) > upright_prior().factor(kFrame, best)) {
      best = d;
    }
  }
  const double elevation = std::asin(best.y()) / kDegree;
  const double azimuth = std::atan2(std::abs(best.x()), best.z()) / kDegree;
  EXPECT_THAT(elevation, testing::AllOf(testing::Gt(10.0), testing::Lt(25.0)));
  EXPECT_THAT(azimuth, testing::AllOf(testing::Gt(35.0), testing::Lt(47.0)));
}

TEST(UprightPrior, PrefersAboveToBelowAndTheFrontToTheBackByLittle) {
  const ViewPrior prior = upright_prior();
  EXPECT_GT(prior.factor(kFrame, direction_at(45, 20)),
            prior.factor(kFrame, direction_at(45, -20)));
  EXPECT_GT(prior.factor(kFrame, direction_at(45, 20)), prior.factor(kFrame, direction_at(0, 90)));
  const double front = prior.factor(kFrame, direction_at(45, 20));
  const double back = prior.factor(kFrame, direction_at(135, 20));
  // 2 · cos 45° · cos 20° · front_strength: a back worth a ninth more wins.
  EXPECT_NEAR(front / back, std::exp(2.0 * std::cos(45 * kDegree) * std::cos(20 * kDegree) * 0.080),
              1e-12);
}

TEST(UprightPrior, TurnsWithTheFrame) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const UprightFrame turned{turn * kFrame.side, turn * kFrame.up, turn * kFrame.front};
  for (const Vec3& d : sphere()) {
    EXPECT_NEAR(upright_prior().factor(turned, turn * d), upright_prior().factor(kFrame, d), 1e-13);
  }
}

TEST(UprightFrame, IsRightHandedForEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vec3 up = sign * Vec3::Unit(axis);
      const UprightFrame frame = upright_frame(up);
      EXPECT_EQ(frame.up, up);
      EXPECT_EQ(frame.up.cross(frame.front), frame.side);
      EXPECT_DOUBLE_EQ(frame.side.norm(), 1.0);
    }
  }
}

TEST(UprightFrame, FacesPlusZForYUpAndMinusYForZUp) {
  EXPECT_EQ(upright_frame(Vec3::UnitY()).front, Vec3::UnitZ());
  EXPECT_EQ(upright_frame(Vec3::UnitY()).side, Vec3::UnitX());
  EXPECT_EQ(upright_frame(Vec3::UnitZ()).front, Vec3(-Vec3::UnitY()));
  EXPECT_EQ(upright_frame(Vec3::UnitZ()).side, Vec3::UnitX());
}

TEST(NoPrior, IsOneEverywhere) {
  for (const Vec3& d : sphere()) {
    EXPECT_EQ(no_prior().factor(kFrame, d), 1.0);
  }
}

TEST(PriorFile, OfConstantsAloneIsTheUprightPriorWithThem) {
  const ViewPrior read = parse_prior(
      R"({"vantage_prior": 1, "upright": {"elevation_sine": 0.315, "elevation_strength": 8.481,
          "corner_strength": 1.171, "front_strength": 0.08, "side_strength": 0.04}})",
      "folder/my.json");
  EXPECT_EQ(read.name, "my.json");
  for (const Vec3& d : sphere()) {
    EXPECT_EQ(read.factor(kFrame, d), upright_prior().factor(kFrame, d));
  }
}

TEST(PriorFile, OfNothingIsOneEverywhere) {
  const ViewPrior read = parse_prior(R"({"vantage_prior": 1})", "my.json");
  for (const Vec3& d : sphere()) {
    EXPECT_EQ(read.factor(kFrame, d), 1.0);
  }
}

TEST(PriorFile, LobesAddToOneWithTheGivenHeightAndWidth) {
  const ViewPrior read = parse_prior(
      R"({"vantage_prior": 1, "lobes": [{"direction": [0, 0, 2], "weight": 3, "width_deg": 30}]})",
      "my.json");
  EXPECT_NEAR(read.factor(kFrame, Vec3::UnitZ()), 1.0 + 3.0, 1e-12);
  const double width = 30.0 * kDegree;
  EXPECT_NEAR(read.factor(kFrame, Vec3::UnitX()), 1.0 + 3.0 * std::exp(-1.0 / (width * width)),
              1e-12);
}

TEST(PriorFile, ProblemsAreNamedInOneSentence) {
  EXPECT_EQ(problem_of("{"), "my.json: is not well formed JSON");
  EXPECT_EQ(problem_of("[]"), "my.json: is no prior: expected an object with \"vantage_prior\": 1");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 2})"),
            "my.json: has a vantage_prior other than 1, the only version there is");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "lobe": []})"),
            "my.json: has a member \"lobe\" that priors do not have");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "upright": 3})"),
            "my.json: upright is not an object");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "upright": {"corner_strength": -1}})"),
            "my.json: upright.corner_strength is not a number between 0.0 and 100.0");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "upright": {"elevation_sine": 1e999}})"),
            "my.json: is not well formed JSON");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "lobes": {}})"),
            "my.json: lobes is not a list of at most 10000 objects");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "lobes": [{}]})"),
            "my.json: lobes[0] is not an object with a direction");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "lobes": [{"direction": [0, 1]}]})"),
            "my.json: lobes[0].direction is not a list of 3 numbers");
  EXPECT_EQ(problem_of(R"({"vantage_prior": 1, "lobes": [{"direction": [0, 0, 0]}]})"),
            "my.json: lobes[0].direction must be three finite numbers, not all zero");
  EXPECT_EQ(
      problem_of(R"({"vantage_prior": 1, "lobes": [{"direction": [0, 0, 1], "width_deg": 0}]})"),
      "my.json: lobes[0].width_deg is not a number between 1.0 and 180.0");
}

}  // namespace
}  // namespace vantage::test
