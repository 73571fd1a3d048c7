// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "batch/results_store.h"

namespace vantage::batch {

// What a row's last cell adds up: what there is to show.
inline constexpr int kHasThumbnail = 1;
inline constexpr int kHasPicture = 2;
inline constexpr int kHasReport = 4;
inline constexpr int kIsDoubted = 8;  ///< Its answer should not be trusted.

/// JSON text that may stand inside a script element: it cannot end it.
std::string script_safe(const std::string& json);

/// A path as part of an address: every byte but letters, digits and "-._~/" as %XX, also of no UTF-8.
std::string url_path(std::string_view path);

/// The page. \param rows JSON arrays joined by commas, script_safe(): key, name, status, key of the
/// equal model, error, url_path() of the folder, best fraction, best score, vertices, and what it
/// has. \param pages names of all pages. \param page which of them this is.
std::string index_page(const std::string& rows, const std::vector<std::string>& pages,
                       std::size_t page, const StatusCounts& counts);

}  // namespace vantage::batch
