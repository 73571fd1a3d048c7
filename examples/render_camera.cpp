// SPDX-License-Identifier: MIT
// A picture from a camera of one's own, with progress: render_camera MODEL PICTURE.png
#include <cstdio>
#include <exception>

#include "vantage/io/model.h"
#include "vantage/io/write.h"
#include "vantage/mesh/measures.h"
#include "vantage/render/render.h"

int main(int argc, char** argv) {
  using namespace vantage;
  if (argc != 3) {
    std::fputs("usage: render_camera MODEL PICTURE.png\n", stderr);
    return 2;
  }
  try {
    // Called on this thread only; what is computed does not depend on it.
    const RunContext run{.report = [](std::string_view stage, double fraction) {
      std::printf("%3.0f %% %.*s\n", 100.0 * fraction, static_cast<int>(stage.size()),
                  stage.data());
    }};
    const Model model = load_model(argv[1]);
    const Sphere sphere = enclosing_sphere(referenced_points(model.mesh));
    const Vec3 eye = sphere.centre + 2.0 * sphere.diameter * Vec3(1.0, 0.6, 1.5).normalized();
    RenderOptions options{.width = 320, .height = 240, .style = Style::Technical};
    set_background(options, "gradient");
    const Camera camera =
        frame_points(model.mesh.positions, {Projection::Perspective, eye}, sphere.centre,
                     Vec3::UnitY(), static_cast<double>(options.width) / options.height);
    write_file(argv[2], png_bytes(render(model.mesh, camera, {}, {}, options, run)));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "render_camera: %s\n", error.what());
    return 1;
  }
}
