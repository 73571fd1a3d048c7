// SPDX-License-Identifier: MIT
// Any small mesh through the whole method: results without NaN or Infinity, or an error that says
// why there are none.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/report/view_report.h"

#include "small_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kLeastMeshBytes || size > kMostMeshBytes) {
    return 0;
  }
  const vantage::Model model = small_mesh(data, size);
  vantage::ViewOptions options = quick_options();
  if (data[1] % 8U == 0) {  // one input of eight is refined
    options.contraction.method = vantage::ContractionOptions{}.method;
  }
  const vantage::RunContext run{.report = {}, .stop = {}, .max_threads = 1};
  try {
    const vantage::ShapeAnalysis shape = vantage::analyse_shape(model, options, run);
    for (const double value : shape.significance) {
      if (!std::isfinite(value)) {
        std::abort();
      }
    }
    for (const vantage::Vec3& node : shape.skeleton.graph.nodes) {
      if (!node.allFinite()) {
        std::abort();
      }
    }
    const vantage::ViewReport report =
        vantage::find_views(shape, vantage::choose_frame(model, shape, options), options, run);
    for (const vantage::ReportedView* view : {&report.best, &report.worst}) {
      if (!std::isfinite(view->score) || std::abs(view->direction.norm() - 1.0) > 1e-9 ||
          !view->picture.eye.allFinite()) {
        std::abort();
      }
    }
    static_cast<void>(vantage::view_json(model, shape, report, options));
  } catch (const vantage::InvalidInput&) {
    return 0;
  }
  return 0;
}
