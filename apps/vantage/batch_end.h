// SPDX-License-Identifier: MIT
#pragma once

#include "batch/confined_folder.h"
#include "batch/forget.h"
#include "batch/results_store.h"
#include "session.h"

namespace vantage::cli {

/// Forgets the models that are not listed, and says so. Nothing is forgotten where the list of inputs may
/// not be whole. \throw IoError
void forget_unlisted(Session& session, const batch::ConfinedFolder& root,
                     batch::ResultsStore& store, const batch::ListedEntries& list);

/// After a signal: leaves an overview of what has ended, or none if it is not wanted. It takes its time, since only
/// a second signal ends it. What keeps it from being written is said; the next run makes up for it.
/// \param store none for a shard, of which there is no overview.
void show_what_has_ended(Session& session, const batch::ConfinedFolder& root,
                         batch::ResultsStore* store, bool wanted);

}  // namespace vantage::cli
