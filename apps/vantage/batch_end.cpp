// SPDX-License-Identifier: MIT
#include "batch_end.h"

#include <cstdint>
#include <string>

#include "vantage/core/error.h"

#include "batch/overview.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

/// Models whose overview takes some seconds. [ours]
constexpr std::int64_t kSlowToShow = 2000;

}  // namespace

void forget_unlisted(Session& session, const batch::ConfinedFolder& root,
                     batch::ResultsStore& store, const batch::ListedEntries& list) {
  if (list.keys().empty() || !list.missing().empty()) {
    session.say("warning: --forget removed nothing: " +
                (list.keys().empty() ? "no models were found"
                                     : list.missing() + " could not be found or listed"));
    return;
  }
  const std::size_t count = batch::forget_others(store, root, list.keys());
  if (count > 0) {
    session.say("forgotten: " + plural(count, "model") + (count == 1 ? " that is" : " that are") +
                " not among the inputs");
  }
}

void show_what_has_ended(Session& session, const batch::ConfinedFolder& root,
                         batch::ResultsStore* store, bool wanted) {
  if (store == nullptr) {
    return;
  }
  RunContext run = session.run();
  run.stop = {};  // which is why it is written
  try {
    const batch::StatusCounts counts = store->counts();
    if (wanted && !store->has_overview() && counts.done + counts.failed > kSlowToShow) {
      session.say(
          "stopped: the overview of what has ended is being written, which takes a while; "
          "a second Ctrl-C leaves it to the next run");
    }
    batch::update_overview(root, *store, wanted, run);
  } catch (const Error& error) {
    session.say(std::string("warning: ") + error.what());
  }
}

}  // namespace vantage::cli
