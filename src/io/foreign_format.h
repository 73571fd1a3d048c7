// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "vantage/io/import_stream.h"

/// \file
/// Formats that are not read here: how they give themselves away, and what to do about them.

namespace vantage {

/// Whether files of that extension (lower case, without the dot) are known not to be ours.
bool is_foreign_extension(std::string_view extension);

/// What the bytes say. \param may_import whether there is a ReadOptions::importer.
/// \return the format to import them as; null if they do not give themselves away.
/// \throw FormatError if they are of a format that is not read; it says what to convert with.
const ImportFormat* check_foreign_bytes(std::string_view bytes, std::string_view extension,
                                        std::string_view name, bool may_import);

/// The same for a name alone, where the bytes say nothing.
const ImportFormat& check_foreign_extension(std::string_view extension, std::string_view name,
                                            bool may_import);

}  // namespace vantage
