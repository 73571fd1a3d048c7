// SPDX-License-Identifier: MIT
// Times CGAL::extract_mean_curvature_flow_skeleton with its default parameters on one closed
// triangle mesh (.ply, .off, .obj), reading not counted. Prints seconds, processor seconds, nodes
// and edges.
#include <chrono>
#include <ctime>
#include <iostream>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/extract_mean_curvature_flow_skeleton.h>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Skeleton = CGAL::Mean_curvature_flow_skeletonization<Mesh>::Skeleton;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: cgal_skeleton MESH\n";
    return 2;
  }
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(argv[1], mesh) || mesh.is_empty() ||
      !CGAL::is_triangle_mesh(mesh) || !CGAL::is_closed(mesh)) {
    std::cerr << argv[1] << ": not a closed triangle mesh\n";
    return 3;
  }
  Skeleton skeleton;
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t begin_cpu = std::clock();
  CGAL::extract_mean_curvature_flow_skeleton(mesh, skeleton);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const double cpu = static_cast<double>(std::clock() - begin_cpu) / CLOCKS_PER_SEC;
  std::cout << took.count() << ' ' << cpu << ' ' << num_vertices(skeleton) << ' '
            << num_edges(skeleton) << '\n';
}
