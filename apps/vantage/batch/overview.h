// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "vantage/core/run_context.h"

#include "batch/confined_folder.h"
#include "batch/results_store.h"

namespace vantage::batch {

/// Leaves an overview of the store as it is now, or none, in the batch's folder: index.html (a table
/// of all models with small pictures, to search and to sort, that needs nothing from outside the
/// folder; 50 000 models a file) and contact sheets (80 models each, in the table's order, for the
/// first 20 000 models). Files of those names that are not such pages and sheets are neither
/// replaced nor removed. The store notes which state is shown once all of it is written.
/// \throw IoError, also if such a file is in the way; Cancelled
void renew_overview(const ConfinedFolder& folder, ResultsStore& store, bool wanted,
                    const RunContext& run);

/// The same, if records have changed since, or there is none and it is wanted. \throw the same
void update_overview(const ConfinedFolder& folder, ResultsStore& store, bool wanted,
                     const RunContext& run);

/// The same complaint about the first page and the first sheet, before there is anything to write.
/// \throw IoError if a file of somebody else is in the way
void check_overview(const ConfinedFolder& folder);

/// One page of the table as the store is now; nothing beyond the last page. \throw IoError
std::optional<std::string> overview_page(const std::string& folder, ResultsStore& store,
                                         std::size_t page);

}  // namespace vantage::batch
