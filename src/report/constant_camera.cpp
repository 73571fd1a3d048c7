// SPDX-License-Identifier: MIT
#include "report/constant_camera.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "vantage/spatial/directions.h"

#include "report/agreement.h"

namespace vantage {
namespace {

constexpr int kCameraLevel = 3;  ///< Of the directions tried: 642, as the measures have.

/// The camera's direction in the coordinates of a model with that up axis.
Vec3 in_model(const Vec3& camera, UpAxis up) {
  const UprightFrame frame = upright_frame(up_vector(up));
  return (camera.x() * frame.side + camera.y() * frame.up + camera.z() * frame.front).normalized();
}

/// Errors of every camera on one model, in degrees; nothing if nobody moved.
std::optional<std::vector<double>> errors_of(const std::vector<Vec3>& cameras,
                                             const RecordedModel& record, UpAxis up) {
  std::vector<double> errors;
  for (const Vec3& camera : cameras) {
    errors.push_back(agreement("", record, in_model(camera, up)).mean_folded_deg);
    if (!std::isfinite(errors.back())) {
      return std::nullopt;
    }
  }
  return errors;
}

}  // namespace

void add_constant_camera(const std::vector<RecordedModel>& records,
                         std::vector<EvaluatedModel>& results) {
  const std::vector<Vec3> cameras =
      direction_set(ViewSphereBase::Icosahedron, kCameraLevel).directions;
  std::vector<std::optional<std::vector<double>>> errors;
  std::vector<double> sums(cameras.size(), 0.0);
  std::size_t counted = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    errors.push_back(errors_of(cameras, records[i], results[i].up));
    if (errors.back()) {
      ++counted;
      for (std::size_t c = 0; c < cameras.size(); ++c) {
        sums[c] += (*errors.back())[c];
      }
    }
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::size_t others = counted - (errors[i] ? 1 : 0);
    if (others == 0 || records[i].views.empty()) {
      continue;
    }
    std::size_t best = 0;
    double least = 0.0;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      const double sum = sums[c] - (errors[i] ? (*errors[i])[c] : 0.0);
      if (c == 0 || sum < least) {
        least = sum;
        best = c;
      }
    }
    results[i].views.push_back(agreement(std::string(kConstantCamera), records[i],
                                         in_model(cameras[best], results[i].up)));
  }
}

}  // namespace vantage
