// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "core/random.h"
#include "support/shapes.h"
#include "unit/io/error_text.h"

namespace vantage::test {
namespace {

using testing::StartsWith;

/// Files are cut in as many shares of places: all places in all.
constexpr unsigned kSeeds = 24;

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

/// Expects the first `whole_records` of what the whole file holds, and at most one beyond: the one
/// that was cut, whose last number may lack digits.
template <class Record>
void expect_start(const std::vector<Record>& read, const std::vector<Record>& of_whole,
                  std::size_t whole_records) {
  ASSERT_GE(read.size(), whole_records);
  EXPECT_LE(read.size(), std::min(whole_records + 1, of_whole.size()));
  EXPECT_TRUE(std::equal(read.begin(), read.begin() + static_cast<std::ptrdiff_t>(whole_records),
                         of_whole.begin()));
}

TEST_P(RoundTrip, CutAnywhereAnObjFileIsReadUpToThereUnlessThatIsInAVertex) {
  const TriMesh mesh = sphere(0);
  const std::string whole = obj_text(mesh);
  for (std::size_t length = GetParam(); length < whole.size(); length += kSeeds) {
    SCOPED_TRACE("the first " + std::to_string(length) + " bytes");
    const std::string cut = whole.substr(0, length);
    const std::string last_line = cut.substr(cut.find_last_of('\n') + 1);
    if (const std::string problem = error_text(cut, "a.obj"); problem != "nothing") {
      EXPECT_THAT(problem, StartsWith("a.obj"));
      EXPECT_TRUE(length == 0 || last_line.starts_with("v")) << problem;
      continue;
    }
    const TriMesh read = parse_model(cut, "a.obj").mesh;
    const auto lines = static_cast<std::size_t>(std::count(cut.begin(), cut.end(), '\n'));
    const std::size_t points = std::min(lines, mesh.positions.size());
    expect_start(read.positions, mesh.positions, points);
    expect_start(read.triangles, mesh.triangles, lines - points);
  }
}

/// Cuts a file that says how much it holds. It is refused where anything is missing but digits of
/// its last number, of which the first `enough` bytes have at least one.
void expect_all_or_nothing(const std::string& name, const std::string& whole, std::size_t enough,
                           unsigned seed) {
  const TriMesh mesh = sphere(0);
  for (std::size_t length = seed; length < whole.size(); length += kSeeds) {
    SCOPED_TRACE(name + ", the first " + std::to_string(length) + " bytes");
    const std::string cut = whole.substr(0, length);
    if (length < enough) {
      EXPECT_THAT(error_text(cut, name), StartsWith(name));
      continue;
    }
    const TriMesh read = parse_model(cut, name).mesh;
    EXPECT_EQ(read.positions, mesh.positions);
    EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
    expect_start(read.triangles, mesh.triangles, mesh.triangles.size() - 1);
  }
}

TEST_P(RoundTrip, CutAnywhereAFileThatSaysHowMuchItHoldsIsRefused) {
  for (const auto& [name, text] :
       {std::pair("a.off", off_text(sphere(0))), std::pair("a.ply", ply_text(sphere(0)))}) {
    expect_all_or_nothing(name, text, text.find_last_of(' ') + 2, GetParam());
  }
  const std::string binary = ply_bytes(sphere(0), {}, {}, false);
  expect_all_or_nothing("a.ply", binary, binary.size(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Seeds, RoundTrip, testing::Range(0U, kSeeds));

}  // namespace
}  // namespace vantage::test
