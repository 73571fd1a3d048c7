// SPDX-License-Identifier: MIT
// Any XML, in pieces of any size, gives a part with valid indices and finite numbers, or a FormatError.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/core/run_context.h"

#include "io/model_builder.h"
#include "io/threemf_parts.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  static_cast<void>(vantage::threemf_root(bytes));
  const vantage::RunContext run;
  const vantage::ModelBuilder builder(vantage::ModelFormat::Threemf, "fuzz.3mf", run, 0);
  try {
    std::size_t records_left = 100'000;
    const std::string name = "fuzz.model";
    vantage::ThreemfPartReader reader(name, builder, records_left);
    const std::size_t half = size / 2;
    reader.add(bytes.substr(0, half));
    reader.add(bytes.substr(half));
    const vantage::PlatePart part = reader.finish();
    for (const auto& [id, object] : part.objects) {
      for (const vantage::Triangle& t : object.triangles) {
        if (std::max({t[0], t[1], t[2]}) >= object.points.size()) {
          std::abort();
        }
      }
      if (object.materials.size() != object.triangles.size()) {
        std::abort();
      }
    }
  } catch (const vantage::FormatError&) {
    return 0;
  }
  return 0;
}
