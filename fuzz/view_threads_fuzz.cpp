// SPDX-License-Identifier: MIT
// Any small mesh through the whole of view with one thread and with two: the same bytes of the map, the
// skeleton, view.json and a picture, or the same refusal.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/report/view_report.h"

#include "small_mesh.h"

namespace {

template <class Values>
std::string bytes_of(const Values& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])};
}

/// Everything that a run gives, or why it gives nothing.
std::string view_with_threads(const vantage::Model& model, int threads) {
  constexpr int kPictureSide = 24;
  vantage::ViewOptions options = quick_options();
  options.width = kPictureSide;
  options.height = kPictureSide;
  const vantage::RunContext run{.report = {}, .stop = {}, .max_threads = threads};
  try {
    const vantage::ShapeAnalysis shape = vantage::analyse_shape(model, options, run);
    const vantage::ViewReport report =
        vantage::find_views(shape, vantage::choose_frame(model, shape, options), options, run);
    const vantage::Image picture =
        vantage::draw_picture(shape, report.best.picture, vantage::Picture::Map, options, {}, run);
    return bytes_of(shape.significance) + bytes_of(shape.skeleton.graph.nodes) +
           bytes_of(shape.skeleton.node_of_vertex) + bytes_of(picture.rgba) +
           vantage::view_json(model, shape, report, options);
  } catch (const vantage::InvalidInput& refusal) {
    return refusal.what();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kLeastMeshBytes || size > kMostMeshBytes) {
    return 0;
  }
  const vantage::Model model = data[1] % 4U == 0 ? small_star(data, size) : small_mesh(data, size);
  if (view_with_threads(model, 1) != view_with_threads(model, 2)) {
    std::abort();
  }
  return 0;
}
