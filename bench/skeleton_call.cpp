// SPDX-License-Identifier: MIT
// Times contraction and skeleton of one mesh, reading and checking not counted, as
// peers/cgal_skeleton.cpp times CGAL's. Prints seconds, processor seconds of all threads, nodes and
// edges.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>

#include "vantage/io/model.h"
#include "vantage/pipeline/shape_analysis.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: skeleton_call MESH\n", stderr);
    return 2;
  }
  try {
    const vantage::ViewOptions options;
    vantage::ShapeAnalysis shape = vantage::prepare_surface(vantage::load_model(argv[1]));
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t begin_cpu = std::clock();
    vantage::add_history(shape, options);
    vantage::add_skeleton(shape, options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    const double cpu = static_cast<double>(std::clock() - begin_cpu) / CLOCKS_PER_SEC;
    const vantage::CurveGraph& graph = shape.skeleton.graph;
    std::printf("%g %g %zu %zu\n", took.count(), cpu, graph.nodes.size(), graph.edges.size());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[1], error.what());
    return 3;
  }
}
