// SPDX-License-Identifier: MIT
// A list of models as paths, as CSV and as JSON lines: the same entries in the same order, whatever is
// quoted or escaped in them.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "batch/entry_source.h"
#include "choices.h"
#include "memory_file.h"

namespace {

using ManifestRow = std::map<std::string, std::string>;
using vantage::batch::Entry;

constexpr std::array<const char*, 5> kManifestColumns{"path", "key", "name", "up", "front"};

ManifestRow manifest_row(Choices& choices) {
  constexpr std::array<const char*, 12> kWords{"a.obj", "a b.obj",  "b/../c.off", "a,b",
                                               "\"",    "\xC3\xA9", "..",         "{",
                                               " a",    "/a/b.stl", "\xFF",       "a\xE2\x80\xAE"};
  constexpr std::array<const char*, 9> kAxes{"", "x", "y", "z", "-x", "-y", "-z", "+x", "Z"};
  ManifestRow row;
  row["path"] = choices.once_in(16) ? "" : choices.of(kWords);
  row["key"] = choices.below(3) == 1 ? choices.of(kWords) : "";
  row["name"] = choices.below(3) == 1 ? choices.of(kWords) : "";
  row["up"] = choices.of(kAxes);
  row["front"] = choices.of(kAxes);
  return row;
}

std::string as_csv(const std::vector<ManifestRow>& rows, Choices& choices) {
  constexpr std::array<const char*, 2> kEnds{"\n", "\r\n"};
  const std::string end = choices.of(kEnds);
  std::string text = choices.below(4) == 1 ? "\xEF\xBB\xBF" : "";
  for (const char* const column : kManifestColumns) {
    text += std::string(column) + ",";
  }
  text += "other" + end;
  for (const ManifestRow& row : rows) {
    for (const char* const column : kManifestColumns) {
      text += '"';
      for (const char c : row.at(column)) {
        text += c == '"' ? "\"\"" : std::string(1, c);
      }
      text += "\",";
    }
    text += end;
  }
  return text;
}

std::string as_json_lines(const std::vector<ManifestRow>& rows, Choices& choices) {
  std::string text;
  for (const ManifestRow& row : rows) {
    nlohmann::ordered_json line;
    for (const char* const column : kManifestColumns) {
      line[column] = row.at(column);
    }
    text += line.dump(-1, ' ', choices.below(2) == 1) + "\n";
  }
  return text;
}

/// Whether a table passes over it as blank.
bool lists_nothing(const ManifestRow& row) {
  return std::all_of(row.begin(), row.end(), [](const auto& cell) {
    return cell.second.find_first_not_of(" \t") == std::string::npos;
  });
}

std::vector<Entry> manifest_entries(const std::string& text) {
  const MemoryFile file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  const auto source = vantage::batch::entries_of_manifest(file.path());
  std::vector<Entry> entries;
  while (const std::optional<Entry> entry = source->next()) {
    entries.push_back(*entry);
  }
  return entries;
}

bool is_same_entry(const Entry& a, const Entry& b) {
  return a.name == b.name && a.up == b.up && a.front == b.front && a.position == b.position &&
         a.problem.empty() == b.problem.empty() && a.path == b.path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  std::vector<ManifestRow> rows(1 + choices.below(6));
  bool is_utf8 = true;
  for (ManifestRow& row : rows) {
    row = manifest_row(choices);
    if (lists_nothing(row)) {
      row["path"] = "a.off";
    }
    for (const auto& [column, value] : row) {
      is_utf8 = is_utf8 && value.find('\xFF') == std::string::npos;
    }
  }
  const std::vector<Entry> entries = manifest_entries(as_csv(rows, choices));
  if (entries.size() != rows.size()) {
    std::abort();
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_done = entries[i].problem.empty();
    if (is_done && (rows[i]["path"].empty() || entries[i].path.empty() || entries[i].key.empty())) {
      std::abort();
    }
  }
  if (!is_utf8) {
    return 0;  // which JSON cannot say
  }
  const std::vector<Entry> other = manifest_entries(as_json_lines(rows, choices));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // One without a path has its line's number for a key, which a header shifts.
    if (other.size() != rows.size() || !is_same_entry(entries[i], other[i]) ||
        (entries[i].key != other[i].key && !rows[i]["path"].empty())) {
      std::abort();
    }
  }
  return 0;
}
