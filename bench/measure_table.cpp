// SPDX-License-Identifier: MIT
// What all measures of all 642 views of a model cost:
//   measure_table MODEL…
// One Markdown row a model: processor seconds, of the user's and of the system's time and of all
// threads together, for what happens before views are looked at (reading, contraction, skeleton,
// maps), and for the views themselves: what every view sees of every vertex and face, all outlines,
// and every measure of `vantage measures`. And the largest memory that the process ever held.
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "vantage/io/model.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/view/measure.h"

namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

rusage usage() {
  rusage now{};
  getrusage(RUSAGE_SELF, &now);
  return now;
}

double timed(const std::function<void()>& work) {
  const rusage start = usage();
  work();
  const rusage end = usage();
  return seconds_of(end.ru_utime) + seconds_of(end.ru_stime) - seconds_of(start.ru_utime) -
         seconds_of(start.ru_stime);
}

void row_of(const std::string& path) {
  const std::vector<vantage::Measure>& measures = vantage::builtin_measures();
  const vantage::ViewOptions options;
  vantage::ShapeAnalysis shape;
  std::vector<double> saliency;
  const double before = timed([&] {
    shape = vantage::analyse_for(vantage::load_model(path), options, measures);
    saliency = vantage::vertex_map(shape, options, "mesh-saliency");
  });
  std::size_t views = 0;
  const double looking = timed([&] {
    vantage::MeasureSubject subject = vantage::measure_subject(shape, options);
    subject.saliency = saliency;
    vantage::ViewMeasurer measurer(subject, measures);
    views = measurer.set_values().front().size();
  });
  constexpr double kMegabyte = 1024.0;  // in the units of ru_maxrss
  std::printf("| %s | %zu | %zu | %zu | %zu | %.1f | %.1f | %.0f |\n", path.c_str(),
              shape.surface.positions.size(), shape.surface.triangles.size(), views,
              measures.size(), before, looking, static_cast<double>(usage().ru_maxrss) / kMegabyte);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: measure_table MODEL...\n");
    return 2;
  }
  std::printf(
      "| model | vertices | faces | views | measures | before, CPU s | views, CPU s | peak MB |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  try {
    for (int i = 1; i < argc; ++i) {
      row_of(argv[i]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
