// SPDX-License-Identifier: MIT
// Any small mesh through the whole method: results without NaN or Infinity, or an error that says
// why there are none. Each byte triple is a vertex on a small grid, so that coincidences abound.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/report/view_report.h"

namespace {

/// The first byte tells how many vertices there are; the rest are their coordinates, then corners.
vantage::Model model_of(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostFaces = 64;
  vantage::Model model;
  model.name = "fuzz";
  const std::size_t vertices = std::min<std::size_t>(data[0] % 64U + 3U, (size - 1) / 3);
  std::size_t at = 1;
  for (std::size_t v = 0; v < vertices; ++v, at += 3) {
    model.mesh.positions.emplace_back(data[at] % 16U, data[at + 1] % 16U, data[at + 2] % 16U);
  }
  for (; at + 2 < size && model.mesh.triangles.size() < kMostFaces && vertices > 0; at += 3) {
    const auto corner = [&](std::size_t i) {
      return static_cast<std::uint32_t>(data[i] % vertices);
    };
    model.mesh.triangles.push_back({corner(at), corner(at + 1), corner(at + 2)});
  }
  // The scale must not matter: the last bit of the first byte takes it far away.
  const double scale = (data[0] & 0x80U) != 0 ? 1e60 : 1e-60;
  if ((data[0] & 0x40U) != 0) {
    for (vantage::Vec3& p : model.mesh.positions) {
      p *= scale;
    }
  }
  model.polygons = model.mesh.triangles.size();
  return model;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kLeast = 10;
  constexpr std::size_t kMost = 512;
  if (size < kLeast || size > kMost) {
    return 0;
  }
  const vantage::Model model = model_of(data, size);
  vantage::ViewOptions options;
  options.search.strategy = vantage::SearchStrategy::Rapid;
  // So few faces are all huge: refining them first takes a hundred times longer than all else. One
  // input of eight goes that way.
  if (data[1] % 8U != 0) {
    options.contraction.method = vantage::ContractionMethod::Exact;
  }
  const vantage::RunContext run{.report = {}, .stop = {}, .max_threads = 1};
  try {
    const vantage::ShapeAnalysis shape = vantage::analyse_shape(model, options, run);
    for (const double value : shape.map.of_vertex) {
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
