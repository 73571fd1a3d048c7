// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vantage/io/model.h"

namespace vantage {

/// The format the bytes plainly are, else the one the name's extension says.
struct DetectedFormat {
  ModelFormat format = ModelFormat::Obj;
  std::string note{};                       ///< Set if the bytes contradict the extension.
  const ImportFormat* import_as = nullptr;  ///< Of ModelFormat::Imported.
};

/// \param may_import whether formats of kImportFormats are read too.
/// \throw FormatError if the bytes or the extension belong to a format that is not read; it says
/// what to convert with.
DetectedFormat detect_format(std::string_view bytes, std::string_view name,
                             bool may_import = false);

/// What follows the last dot of the file's name, in lower-case ASCII; empty if there is no dot.
std::string extension_of(std::string_view name);

/// File name without folder and without extension.
std::string model_name(std::string_view path);

}  // namespace vantage
