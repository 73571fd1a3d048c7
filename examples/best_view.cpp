// SPDX-License-Identifier: MIT
// Reads a model, finds its best view and takes a picture: best_view MODEL PICTURE.png
#include <cstdio>
#include <exception>

#include "vantage/io/model.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/report/view_report.h"

int main(int argc, char** argv) {
  using namespace vantage;
  if (argc != 3) {
    std::fputs("usage: best_view MODEL PICTURE.png\n", stderr);
    return 2;
  }
  try {
    const Model model = load_model(argv[1]);
    const ViewOptions options;
    const ShapeAnalysis shape = analyse_shape(model, options);
    const ViewReport views = find_views(shape, choose_frame(model, shape, options), options);
    write_file(argv[2],
               png_bytes(take_picture(shape, views.best.picture, Picture::Plain, options)));
    const Vec3& d = views.best.direction;
    std::printf("best view from %.3f %.3f %.3f sees %.1f %% of the significance\n", d.x(), d.y(),
                d.z(), 100.0 * views.best.score_fraction);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "best_view: %s\n", error.what());
    return 1;
  }
}
