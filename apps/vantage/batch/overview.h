// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "vantage/core/run_context.h"

#include "batch/confined_folder.h"
#include "batch/results_store.h"

namespace vantage::batch {

/// What write_overview() wrote.
struct Overview {
  std::size_t pages = 0;   ///< index.html, index-2.html, …
  std::size_t sheets = 0;  ///< contact-sheet-0001.png, …
};

/// Writes index.html (a table of all models with small pictures, to search and to sort, that needs
/// nothing from outside the folder; 50 000 models a file) and contact sheets (80 models each, in
/// the table's order, for the first 20 000 models) into the batch's folder. Files of those names
/// that are not such pages and sheets are neither replaced nor removed.
/// \throw IoError, also if such a file is in the way; Cancelled
Overview write_overview(const ConfinedFolder& folder, ResultsStore& store, const RunContext& run);

/// The same complaint about the first page and the first sheet, before there is anything to write.
/// \throw IoError if such a file is in the way
void check_overview(const ConfinedFolder& folder);

/// Leaves an overview of the store as it is now, or none. \throw IoError, Cancelled
void renew_overview(const ConfinedFolder& folder, ResultsStore& store, bool wanted,
                    const RunContext& run);

/// One page of the table as the store is now; nothing beyond the last page. \throw IoError
std::optional<std::string> overview_page(const std::string& folder, ResultsStore& store,
                                         std::size_t page);

}  // namespace vantage::batch
