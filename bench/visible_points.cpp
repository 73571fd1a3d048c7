// SPDX-License-Identifier: MIT
// What eyes see of a closed mesh's vertices, and of the same vertices as a cloud:
//   visible_points MODEL
// One line an eye: x y z, and two strings of 0 and 1 per vertex, of the mesh and of the cloud's triangles.
// The vertices come first, one a line. bench/peers/hidden_points.py compares them with Katz's operator.
#include <cstdio>
#include <exception>
#include <string>

#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/spatial/directions.h"
#include "vantage/visibility/vertex_visibility.h"

namespace {

/// Eyes stand this many radii from the centre: a field of view of 30 degrees.
constexpr double kDistance = 3.8637;

std::string digits(const std::vector<std::uint8_t>& seen) {
  std::string text;
  for (const std::uint8_t s : seen) {
    text += s != 0 ? '1' : '0';
  }
  return text;
}

void print(const std::string& path) {
  const vantage::TriMesh mesh = vantage::weld(vantage::load_model(path).mesh).mesh;
  vantage::OrientedMesh oriented = vantage::orient_shells(mesh);
  const vantage::VertexVisibility of_mesh(oriented.mesh, oriented.sides);
  const vantage::Model points{.name = path, .mesh = {.positions = mesh.positions, .triangles = {}}};
  const vantage::ShapeAnalysis cloud = vantage::prepare_surface(points);
  const vantage::VertexVisibility of_cloud(cloud.surface, cloud.sides);
  std::printf("%zu\n", mesh.positions.size());
  for (const vantage::Vec3& p : mesh.positions) {
    std::printf("%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
  }
  const vantage::Sphere sphere = vantage::enclosing_sphere(mesh.positions);
  for (const vantage::Vec3& d :
       vantage::direction_set(vantage::ViewSphereBase::Icosahedron, 0).directions) {
    const vantage::Vec3 eye = sphere.centre + 0.5 * kDistance * sphere.diameter * d;
    const vantage::Viewpoint from{.position = eye};
    std::printf("%.17g %.17g %.17g %s %s\n", eye.x(), eye.y(), eye.z(),
                digits(of_mesh.visible_vertices(from)).c_str(),
                digits(of_cloud.visible_vertices(from)).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: visible_points MODEL\n");
    return 2;
  }
  try {
    print(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
