// SPDX-License-Identifier: MIT
#include "contraction/history_summary.h"

#include <algorithm>
#include <string>

#include "core/counted.h"

namespace vantage {
namespace {

/// Warnings about remedies at most.
constexpr std::size_t kMostRemedies = 5;

std::string words_of(const ContractionStrategy& strategy) {
  const auto refined = [](std::size_t vertices) {
    return vertices > 0 ? "refined " + std::to_string(vertices) + ", " : "";
  };
  const bool is_whole = strategy.refined_to == 0 && strategy.finer_copy == 0;
  std::string words = refined(strategy.refined_to);
  words += strategy.method == "direct" && !is_whole ? "" : strategy.method + ", ";
  words += refined(strategy.finer_copy);
  words += strategy.is_thinned ? "thinned, " : "";
  words.resize(words.size() - 2);
  return words;
}

/// What was not done as defined, one sentence each; of many components only the first.
void add_remedies(ContractionHistory& history) {
  std::size_t told = 0;
  std::size_t untold = 0;
  for (std::size_t c = 0; c < history.components.size(); ++c) {
    for (const std::string& remedy : history.components[c].remedies) {
      if (++told > kMostRemedies) {
        ++untold;
        continue;
      }
      history.warnings.push_back(
          "contraction" +
          (history.components.size() > 1 ? " of component " + std::to_string(c + 1) : "") + ": " +
          remedy);
    }
  }
  if (untold > 0) {
    history.warnings.push_back("contraction: " + std::to_string(untold) +
                               " more warnings like these are left out");
  }
}

}  // namespace

void summarise(std::span<const ComponentHistory> parts, ContractionHistory& history) {
  std::size_t failed = 0;
  history.shrinkage.assign(history.levels.size(), 0.0);
  double vertices = 0.0;
  for (const ComponentHistory& part : parts) {
    const auto weight = static_cast<double>(part.summary.vertices);
    vertices += weight;
    for (std::size_t level = 0; level < history.levels.size(); ++level) {
      history.shrinkage[level] +=
          weight * part.shrinkage[std::min(level, part.shrinkage.size() - 1)];
    }
    failed += part.summary.stop == ContractionStop::SolverFailed ? 1 : 0;
    history.components.push_back(part.summary);
    history.components.back().strategy = words_of(part.strategy);
    history.components.back().shrinkage = part.shrinkage.back();
  }
  for (double& a : history.shrinkage) {
    a = vertices > 0.0 ? a / vertices : 1.0;
  }
  add_remedies(history);
  if (failed > 0) {
    history.warnings.push_back("the contraction of " +
                               counted(failed, "component", "components",
                                       " ended early because a system could not be solved"));
  }
}

}  // namespace vantage
