// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "io/model_builder.h"

namespace vantage {

/// Receives the parts of a package, piece by piece; of each part all pieces in a row.
struct PartSink {
  /// Whether this part is wanted. \param name as part_name() gives it.
  std::function<bool(const std::string& name)> begin{};
  std::function<void(std::string_view piece)> piece{};
  std::function<void()> end{};
};

/// Whether the bytes are a ZIP archive that holds a 3MF model.
bool is_threemf(std::string_view bytes);

/// The name by which parts are compared: lower case, without a slash in front, %20 as a blank.
std::string part_name(std::string_view name);

/// Unpacks a package (a ZIP archive) in memory; nothing is ever written. What comes out is bounded
/// by a multiple of the archive's size. \throw FormatError, and what the sink throws.
void read_package(std::string_view bytes, const PartSink& sink, const ModelBuilder& builder);

}  // namespace vantage
