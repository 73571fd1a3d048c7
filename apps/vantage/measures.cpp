// SPDX-License-Identifier: MIT
#include <algorithm>

#include "vantage/view/measure.h"

#include "batch/json_text.h"
#include "commands.h"
#include "method_flags.h"
#include "output_file.h"

namespace vantage::cli {
namespace {

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

struct MeasuresCommand {
  void add_flags(CLI::App& app, Session& session) { add_common_flags(app, session.flags); }

  void run(Session& session) {
    if (session.flags.json) {
      auto rows = batch::Json::array();
      for (const Measure& m : builtin_measures()) {
        rows.push_back({{"name", m.name},
                        {"alias", m.alias.empty() ? batch::Json(nullptr) : batch::Json(m.alias)},
                        {"best", m.better == Better::More ? "max" : "min"},
                        {"cost", m.cost()},
                        {"meaning", m.meaning},
                        {"source", m.source}});
      }
      write_output("-", batch::json_text(rows, 2) + "\n");
      return;
    }
    constexpr std::size_t kNameWidth = 30;
    constexpr std::size_t kCostWidth = 14;
    session.tell(padded("name", kNameWidth) + "best  " + padded("looks at", kCostWidth) +
                 "meaning; source");
    for (const Measure& m : builtin_measures()) {
      session.tell(padded(m.name, kNameWidth) + (m.better == Better::More ? "max   " : "min   ") +
                   padded(std::string(m.cost()), kCostWidth) + m.meaning + "; " + m.source +
                   (m.alias.empty() ? "" : "; also " + m.alias));
    }
  }
};

}  // namespace

void add_measures_command(CLI::App& program, Session& session) {
  add_command<MeasuresCommand>(program, session, "measures", "list the measures of a view",
                               "Examples:\n"
                               "  vantage measures\n"
                               "  vantage measures --json | jq '.[].name'");
}

}  // namespace vantage::cli
