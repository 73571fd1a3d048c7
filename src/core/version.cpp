// SPDX-License-Identifier: MIT
#include "vantage/core/version.h"

#include <Eigen/Core>
#include <embree3/rtcore_config.h>
#include <oneapi/tbb/version.h>

#include "core/version_config.h"

namespace vantage {

std::string_view version() {
  return VANTAGE_VERSION;
}

std::string library_versions() {
  return "Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." +
         std::to_string(EIGEN_MAJOR_VERSION) + "." + std::to_string(EIGEN_MINOR_VERSION) +
         ", oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR) +
         ", Embree " + RTC_VERSION_STRING;
}

}  // namespace vantage
