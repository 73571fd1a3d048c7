// SPDX-License-Identifier: MIT
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "core/random.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// A shape with coordinates of random magnitude, so that every digit of a double counts.
TriMesh shape(unsigned seed) {
  Pcg32 random(seed);
  TriMesh mesh;
  switch (seed % 4) {
    case 0:
      mesh = sphere(2);
      break;
    case 1:
      mesh = torus(2.0, 0.5, 12, 7);
      break;
    case 2:
      mesh = soup(box(1, 2, 3, 2));
      break;
    default:
      mesh = together(sphere(1), sheet(3, 1, 3), Vec3(5, 0, 0));
  }
  const double scale = std::pow(10.0, 40.0 * random.uniform() - 20.0);
  return moved(mesh, scale, 6.0 * random.uniform(), Vec3(1, 2, 3),
               scale * Vec3(random.uniform(), random.uniform(), random.uniform()));
}

std::string point_text(const Vec3& p) {
  return number_text(p.x()) + " " + number_text(p.y()) + " " + number_text(p.z());
}

std::string obj_text(const TriMesh& mesh) {
  std::ostringstream text;
  for (const Vec3& p : mesh.positions) {
    text << "v " << point_text(p) << "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "f " << a + 1 << " " << b + 1 << "/1 " << c + 1 << "//2\n";
  }
  return text.str();
}

std::string off_text(const TriMesh& mesh) {
  std::ostringstream text;
  text << "OFF\n" << mesh.positions.size() << " " << mesh.triangles.size() << " 0\n";
  for (const Vec3& p : mesh.positions) {
    text << point_text(p) << "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "3 " << a << " " << b << " " << c << "\n";
  }
  return text.str();
}

std::string ply_text(const TriMesh& mesh) {
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
       << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
       << mesh.triangles.size() << "\nproperty list uchar uint vertex_index\nend_header\n";
  for (const Vec3& p : mesh.positions) {
    text << point_text(p) << "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "3 " << a << " " << b << " " << c << "\n";
  }
  return text.str();
}

class RoundTrip : public testing::TestWithParam<unsigned> {};

void expect_same(const TriMesh& mesh, const std::string& bytes, const char* name) {
  const Model model = parse_model(bytes, name);
  EXPECT_EQ(model.mesh.positions, mesh.positions);
  EXPECT_EQ(model.mesh.triangles, mesh.triangles);
}

TEST_P(RoundTrip, ObjTextKeepsEveryBit) {
  expect_same(shape(GetParam()), obj_text(shape(GetParam())), "a.obj");
}

TEST_P(RoundTrip, OffTextKeepsEveryBit) {
  expect_same(shape(GetParam()), off_text(shape(GetParam())), "a.off");
}

TEST_P(RoundTrip, PlyTextKeepsEveryBit) {
  expect_same(shape(GetParam()), ply_text(shape(GetParam())), "a.ply");
}

TEST_P(RoundTrip, BinaryPlyKeepsEveryBit) {
  expect_same(shape(GetParam()), ply_bytes(shape(GetParam()), {}, {}, true), "a.ply");
}

TEST_P(RoundTrip, CutAnywhereAFileIsReadOrRefused) {
  Pcg32 random(GetParam(), 1);
  for (const std::string& whole : {obj_text(sphere(0)), off_text(sphere(0)), ply_text(sphere(0)),
                                   ply_bytes(sphere(0), {}, {}, false)}) {
    const std::size_t length = random.below(static_cast<std::uint32_t>(whole.size()));
    try {
      const Model model = parse_model(whole.substr(0, length), "a.obj");
      EXPECT_LE(model.mesh.triangles.size(), 20U);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RoundTrip, testing::Range(0U, 24U));

}  // namespace
}  // namespace vantage::test
