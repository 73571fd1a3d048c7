// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "vantage/io/write.h"
#include "vantage/report/figures.h"

#include "report/csv_field.h"

namespace vantage {
namespace {

constexpr std::array<const char*, 6> kStages{"load", "contract", "skeleton",
                                             "map",  "search",   "sum"};

/// Seconds of each stage, to the millisecond.
std::array<std::string, 6> stage_texts(const StageSeconds& s) {
  const double sum = s.load + s.contract + s.skeleton + s.map + s.search;
  std::array<std::string, 6> texts;
  std::size_t next = 0;
  for (const double seconds : {s.load, s.contract, s.skeleton, s.map, s.search, sum}) {
    texts[next++] = number_text(std::round(1000.0 * seconds) / 1000.0);
  }
  return texts;
}

/// A cell of Markdown that may hold anything.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    safe += c == '|' || c == '\\' || c == '<' ? std::string{'\\', c}
            : c == '\n' || c == '\r'          ? std::string(" ")
                                              : std::string(1, c);
  }
  return safe;
}

}  // namespace

std::string times_csv(const std::vector<StageTimes>& rows) {
  std::string text = "model,vertices,faces";
  for (const char* stage : kStages) {
    text += std::string(",") + stage + "_s";
  }
  text += "\n";
  for (const StageTimes& row : rows) {
    text +=
        csv_field(row.model) + "," + std::to_string(row.vertices) + "," + std::to_string(row.faces);
    for (const std::string& seconds : stage_texts(row.seconds)) {
      text += "," + seconds;
    }
    text += "\n";
  }
  return text;
}

std::string times_markdown(const std::vector<StageTimes>& rows) {
  std::string text = "| model | vertices | faces |";
  std::string rule = "| --- | ---: | ---: |";
  for (const char* stage : kStages) {
    text += std::string(" ") + stage + ", s |";
    rule += " ---: |";
  }
  text += "\n" + rule + "\n";
  for (const StageTimes& row : rows) {
    text += "| " + cell(row.model) + " | " + std::to_string(row.vertices) + " | " +
            std::to_string(row.faces) + " |";
    for (const std::string& seconds : stage_texts(row.seconds)) {
      text += " " + seconds + " |";
    }
    text += "\n";
  }
  return text;
}

}  // namespace vantage
