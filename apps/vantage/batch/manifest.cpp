// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <utility>

#include "vantage/core/error.h"

#include "batch/entry_source.h"
#include "batch/json_text.h"
#include "batch/naming.h"
#include "batch/stoppable_bytes.h"

namespace vantage::batch {
namespace {

// A longer line is no path and no options; it is cut so that a wrong file cannot fill the memory.
constexpr std::size_t kLongestLine = 1U << 20U;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// What a manifest may say of a model.
constexpr std::array<std::string_view, 5> kManifestNames{"path", "key", "name", "up", "front"};

constexpr const char* kNoAxis = " has an \"up\" that is none of x y z -x -y -z";
constexpr const char* kNoFront = " has a \"front\" that is none of x y z -x -y -z";

enum class ManifestForm { Unknown, JsonLines, Csv, Paths };

/// Where one is in a cell of a table; Closed: behind a quote that ends it, or is one of two.
enum class CellPart { Begin, Plain, Quoted, Closed };

using Fields = std::map<std::string, std::string>;

class ManifestSource : public EntrySource {
 public:
  ManifestSource(const std::string& path, std::stop_token stop,
                 std::function<void(const std::string&)> warn)
      : manifest_(path),
        folder_(std::filesystem::path(path).parent_path()),
        bytes_(path, std::move(stop)),
        warn_(std::move(warn)),
        first_(read_next()) {}

  std::optional<Entry> next() override { return first_ ? std::exchange(first_, {}) : read_next(); }

  [[nodiscard]] bool has_more_now() const override { return first_ || bytes_.is_there(); }

 private:
  std::optional<Entry> read_next() {
    while (true) {
      std::optional<std::string> line = read_line();
      if (!line) {
        return std::nullopt;
      }
      if (kind_ == ManifestForm::Unknown && take_first(*line)) {
        continue;
      }
      if (lists_nothing(*line)) {
        continue;
      }
      Entry entry = entry_of(*line);
      entry.position = position_++;
      return entry;
    }
  }

  /// Whether it is blank, as rows below a spreadsheet's last one are, or a comment.
  [[nodiscard]] bool lists_nothing(const std::string& line) const {
    if (zero_ended_ || line.empty()) {
      return line.empty();
    }
    const std::vector<std::string> cells =
        kind_ == ManifestForm::Csv ? cells_of(line) : std::vector<std::string>{line};
    const bool has_text = std::any_of(cells.begin(), cells.end(), [](const std::string& cell) {
      return cell.find_first_not_of(" \t") != std::string::npos;
    });
    return !has_text || (kind_ == ManifestForm::Paths && line.front() == '#');
  }

  /// Tells once of names that say nothing here, as misspelt ones do.
  void warn_of_others(const std::vector<std::string>& names, const char* what) {
    std::string others;
    for (const std::string& name : names) {
      if (!name.empty() &&
          std::find(kManifestNames.begin(), kManifestNames.end(), name) == kManifestNames.end()) {
        others += (others.empty() ? "" : ", ") + name;
      }
    }
    if (!others.empty() && warn_) {
      std::exchange(warn_, {})(manifest_ + ": line " + std::to_string(line_number_) + " has " +
                               what + " that are not read: " + others +
                               "; those that are: path, key, name, up, front");
    }
  }

  /// A line without its end; line ends in quoted cells of a table belong to it.
  std::optional<std::string> read_line() {
    std::string line;
    CellPart part = CellPart::Begin;
    bool any = false;
    line_number_ += 1 + std::exchange(ends_in_cells_, 0);
    while (const std::optional<char> read = bytes_.next()) {
      const char c = *read;
      any = true;
      if (c == '\0' && (zero_ended_ || kind_ == ManifestForm::Unknown)) {
        zero_ended_ = true;
        break;
      }
      if (kind_ == ManifestForm::Csv) {
        part = part_with(part, c);
      }
      if (c == '\n' && part != CellPart::Quoted && !zero_ended_) {
        break;
      }
      ends_in_cells_ += c == '\n' && part == CellPart::Quoted ? 1 : 0;
      if (line.size() < kLongestLine) {
        line += c;
      }
    }
    if (part == CellPart::Quoted) {
      throw FormatError(manifest_, "line " + std::to_string(line_number_),
                        "opens a cell with a quote that is never closed");
    }
    if (!any) {
      return std::nullopt;
    }
    if (!line.empty() && line.back() == '\r' && !zero_ended_) {
      line.pop_back();
    }
    return line;
  }

  /// Decides what the manifest is by its first line that is not blank.
  /// \return whether the line is blank or a header, and so none that lists a model
  bool take_first(std::string& line) {
    if (line_number_ == 1 && line.starts_with(kByteOrderMark)) {
      line.erase(0, kByteOrderMark.size());
    }
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos) {
      return true;
    }
    if (line[begin] == '{') {
      kind_ = ManifestForm::JsonLines;
      return false;
    }
    if (!zero_ended_ && is_json_list(line)) {
      throw FormatError(manifest_, "line " + std::to_string(line_number_),
                        "is the begin of a JSON list; write one object a line, like "
                        "{\"path\": \"a.obj\"}, without brackets and commas around them");
    }
    const bool is_table = !zero_ended_ && take_header(line);
    if (!is_table && !zero_ended_ && is_header_of_something(line)) {
      throw FormatError(manifest_, "line " + std::to_string(line_number_),
                        "is the header of a table without a column called path, which is to name "
                        "the models");
    }
    kind_ = is_table ? ManifestForm::Csv : ManifestForm::Paths;
    if (is_table) {
      warn_of_others(header_, "columns");
    }
    return is_table;
  }

  static bool is_json_list(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(" \t");
    const std::size_t next =
        begin == std::string::npos ? begin : line.find_first_not_of(" \t", begin + 1);
    return begin != std::string::npos && line[begin] == '[' &&
           (next == std::string::npos || line[next] == '{' || line[next] == '"');
  }

  /// Several words, among them one that a table of models has, and no file of that name.
  [[nodiscard]] bool is_header_of_something(const std::string& line) const {
    static const std::array<std::string_view, 9> kKnown{
        "key", "name", "up", "front", "file", "model", "filename", "mesh", "url"};
    std::error_code error;
    return header_.size() > 1 &&
           std::any_of(header_.begin(), header_.end(),
                       [](const std::string& name) {
                         return std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end();
                       }) &&
           !std::filesystem::exists(folder_ / line, error);
  }

  /// Finds by which character the columns are parted, if one of them is called path.
  bool take_header(const std::string& line) {
    std::vector<std::string> other;  // columns of which none is
    for (const char separator : {',', ';', '\t'}) {
      separator_ = separator;
      header_ = cells_of(line);
      for (std::string& name : header_) {
        std::transform(name.begin(), name.end(), name.begin(), [](char c) {
          return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        });
      }
      if (std::find(header_.begin(), header_.end(), "path") != header_.end()) {
        return true;
      }
      if (header_.size() > 1 && other.empty()) {
        other = header_;
      }
    }
    header_ = other;
    return false;
  }

  static bool is_blank(char c) { return c == ' ' || c == '\t'; }

  /// Ends a cell: blanks at its end that are not quoted are none of it. \param quoted its length up to
  /// the last quote.
  static void end_cell(std::string& cell, std::size_t quoted) {
    while (cell.size() > quoted && is_blank(cell.back())) {
      cell.pop_back();
    }
  }

  /// Where in its cell a character is, after the one before. Quotes inside a cell that does not begin with
  /// one are text, as in `5" pipe`.
  [[nodiscard]] CellPart part_with(CellPart before, char c) const {
    if (before == CellPart::Quoted) {
      return c == '"' ? CellPart::Closed : CellPart::Quoted;
    }
    if (c == separator_) {
      return CellPart::Begin;
    }
    if (c == '"' && before != CellPart::Plain) {
      return CellPart::Quoted;  // the first of a cell, or the second of two that stand for one
    }
    return before == CellPart::Begin && is_blank(c) ? CellPart::Begin : CellPart::Plain;
  }

  [[nodiscard]] std::vector<std::string> cells_of(const std::string& line) const {
    std::vector<std::string> cells(1);
    CellPart part = CellPart::Begin;
    std::size_t quoted = 0;
    for (const char c : line) {
      const CellPart before = std::exchange(part, part_with(part, c));
      if (part == CellPart::Closed) {
        quoted = cells.back().size();
      } else if (c == separator_ && part == CellPart::Begin) {
        end_cell(cells.back(), quoted);
        cells.emplace_back();
        quoted = 0;
      } else if (part != CellPart::Begin &&
                 !(before == CellPart::Begin && part == CellPart::Quoted)) {
        cells.back() += c;
      }
    }
    end_cell(cells.back(), quoted);
    return cells;
  }

  /// An entry as write_plan() put it, or nothing if the line is none.
  static std::optional<Entry> planned_entry(const std::string& line) {
    const auto json = parsed_json(line);
    if (!json.is_object() || json.value("planned", Json()) != true) {
      return std::nullopt;
    }
    const auto text = [&](const char* name) {
      return json.contains(name) && json[name].is_string() ? json[name].get<std::string>()
                                                           : std::string();
    };
    Entry entry;
    entry.path = path_of_key(text("path"));
    entry.member = path_of_key(text("member"));
    entry.key = text("key");
    entry.name = text("name");
    entry.up = text("up");
    entry.front = text("front");
    entry.problem = text("problem");
    if (entry.key.empty() || (entry.path.empty() && entry.problem.empty())) {
      return std::nullopt;
    }
    if (json.contains("shard") && json["shard"].is_number_unsigned()) {
      entry.shard = json["shard"].get<std::uint32_t>();
    }
    return entry;
  }

  static bool is_axis(const std::string& up) {
    static const char* const kAxes[] = {"", "x", "y", "z", "-x", "-y", "-z"};
    return std::find(std::begin(kAxes), std::end(kAxes), up) != std::end(kAxes);
  }

  [[nodiscard]] std::string place() const {
    return "line " + std::to_string(line_number_) + " of the manifest";
  }

  Fields fields_of(const std::string& line, std::string& problem) {
    Fields fields;
    if (kind_ == ManifestForm::Paths) {
      fields["path"] = line;
    } else if (kind_ == ManifestForm::Csv) {
      const std::vector<std::string> cells = cells_of(line);
      for (std::size_t i = 0; i < std::min(cells.size(), header_.size()); ++i) {
        fields[header_[i]] = cells[i];
      }
    } else {
      const auto json = parsed_json(line);
      if (!json.is_object()) {
        problem = " is not a JSON object";
        return fields;
      }
      std::vector<std::string> names;
      for (const auto& [key, value] : json.items()) {
        names.push_back(key);
        if (value.is_string()) {
          fields[key] = value.get<std::string>();
        } else if (std::find(kManifestNames.begin(), kManifestNames.end(), key) !=
                   kManifestNames.end()) {
          problem = " has a \"" + key + "\" that is no text";
        }
      }
      warn_of_others(names, "members");
    }
    return fields;
  }

  static void write_axes_small(Fields& fields) {
    for (const char* const axis : {"up", "front"}) {
      std::string& name = fields[axis];
      std::transform(name.begin(), name.end(), name.begin(), [](char c) {
        return c >= 'X' && c <= 'Z' ? static_cast<char>(c - 'X' + 'x') : c;
      });
    }
  }

  void check_axes(Entry& planned) const {
    if (!is_axis(planned.up)) {
      planned.problem = place() + kNoAxis;
      planned.up.clear();
    }
    if (!is_axis(planned.front)) {
      planned.problem = place() + kNoFront;
      planned.front.clear();
    }
  }

  Entry entry_of(const std::string& line) {
    if (kind_ == ManifestForm::JsonLines) {
      if (std::optional<Entry> planned = planned_entry(line)) {
        check_axes(*planned);
        return *planned;
      }
    }
    std::string problem;
    Fields fields = fields_of(line, problem);
    if (problem.empty() && fields["path"].empty()) {
      problem = " names no path";
    }
    write_axes_small(fields);
    const std::string& up = fields["up"];
    if (problem.empty() && !is_axis(up)) {
      problem = kNoAxis;
    }
    const std::string& front = fields["front"];
    if (problem.empty() && !is_axis(front)) {
      problem = kNoFront;
    }
    Entry entry;
    if (!problem.empty()) {
      const std::string shown = key_of_path(fields["path"]);
      const std::string key = key_of_path(fields["key"]);
      const bool names_both = !key.empty() && !shown.empty();
      entry.problem = place() + (names_both ? " (" + shown + ")" : "") + problem;
      entry.key = !key.empty() ? key : !shown.empty() ? shown : place();
      return entry;
    }
    const std::filesystem::path path(fields["path"]);
    entry.path = path.is_absolute() || folder_.empty() ? path.string() : (folder_ / path).string();
    entry.key = key_of_path(fields["key"].empty() ? fields["path"] : fields["key"]);
    entry.name = fields["name"];
    entry.up = up;
    entry.front = front;
    return entry;
  }

  std::string manifest_;
  std::filesystem::path folder_;
  StoppableBytes bytes_;
  std::function<void(const std::string&)> warn_;  ///< Empty once it was told.
  ManifestForm kind_ = ManifestForm::Unknown;
  bool zero_ended_ = false;
  std::vector<std::string> header_{};  ///< In small letters.
  char separator_ = ',';
  std::int64_t line_number_ = 0;    ///< Where the line read last begins.
  std::int64_t ends_in_cells_ = 0;  ///< Line ends in its quoted cells.
  std::int64_t position_ = 0;
  /// Read ahead, as it shows what the manifest is. The last member, as reading uses all others.
  std::optional<Entry> first_;
};

}  // namespace

std::unique_ptr<EntrySource> entries_of_manifest(
    const std::string& path, std::stop_token stop,
    std::function<void(const std::string& warning)> warn) {
  return std::make_unique<ManifestSource>(path, std::move(stop), std::move(warn));
}

}  // namespace vantage::batch
