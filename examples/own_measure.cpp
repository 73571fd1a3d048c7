// SPDX-License-Identifier: MIT
// Adds a measure of a view and ranks views by it, beside one that is built in: own_measure MODEL
#include <algorithm>
#include <cstdio>
#include <exception>

#include "vantage/io/model.h"
#include "vantage/pipeline/measured_shape.h"

int main(int argc, char** argv) {
  using namespace vantage;
  if (argc != 2) {
    std::fputs("usage: own_measure MODEL\n", stderr);
    return 2;
  }
  try {
    // How much of its picture a view gives to its largest face: little means that nothing dominates.
    const Measure dominance{.name = "dominance",
                            .meaning = "share of the picture that the largest face takes",
                            .source = "this example",
                            .better = Better::Less,
                            .needs = {.faces = true},
                            .value = [](const MeasuredModel&, const SightTable& sight) {
                              float largest = 0.0F;
                              for (const FaceArea& seen : sight.faces) {
                                largest = std::max(largest, seen.area);
                              }
                              return static_cast<double>(largest) / sight.projected_area;
                            }};
    const Model model = load_model(argv[1]);
    const std::vector<Measure> measures{dominance, find_measure("viewpoint-entropy")};
    const ShapeAnalysis shape = analyse_for(model, {}, measures);
    ViewMeasurer measurer(measure_subject(shape, {}), measures);
    for (std::size_t m = 0; m < measures.size(); ++m) {
      const MeasuredViews views = extreme_views(measurer, m);
      const Vec3& d = views.best.direction;
      std::printf("%s: best %.4f from %.3f %.3f %.3f, worst %.4f\n", measures[m].name.c_str(),
                  views.best.value, d.x(), d.y(), d.z(), views.worst.value);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "own_measure: %s\n", error.what());
    return 1;
  }
}
