// SPDX-License-Identifier: MIT
#include "notes.h"

namespace vantage::cli {

void say_notes(Session& session, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    session.say("note: " + note);
  }
}

void say_warnings(Session& session, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    session.say("warning: " + warning);
  }
}

void say_notes(Session& session, const ShapeAnalysis& shape) {
  if (session.flags.verbose) {
    say_notes(session, shape.warnings);
    return;
  }
  bool has_steps = false;
  for (const std::string& note : shape.warnings) {
    if (note.starts_with("contraction")) {
      has_steps = true;
    } else {
      session.say("note: " + note);
    }
  }
  if (has_steps) {
    session.say("note: some steps of the contraction were taken with more care; -v lists them");
  }
}

}  // namespace vantage::cli
