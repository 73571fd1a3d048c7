// SPDX-License-Identifier: MIT
// Any bytes as the tables of recorded views (up to the first zero byte) and of mirror planes (the
// rest) of a data set: directions of length 1, or an error that says why not.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/report/evaluation.h"

#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ScratchFolder folder;
  static const std::string model = folder.write("models/a.off", "OFF\n0 0 0\n");
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\0'), size);
  folder.write("views.csv", text.substr(0, end));
  folder.write("mirror_planes.csv", text.substr(std::min(end + 1, size)));
  try {
    for (const vantage::RecordedModel& record : vantage::read_records(folder.path().string())) {
      if (record.path != model) {
        std::abort();  // a name led out of the folder
      }
      for (const vantage::ChosenByPerson& view : record.views) {
        if (!(std::abs(view.direction.norm() - 1.0) < 1e-9)) {
          std::abort();
        }
      }
      for (const vantage::MirrorPlane& plane : record.planes) {
        if (!(std::abs(plane.normal.norm() - 1.0) < 1e-9)) {
          std::abort();
        }
      }
    }
  } catch (const vantage::Error&) {
    return 0;
  }
  return 0;
}
