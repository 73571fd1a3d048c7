// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <locale>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/report/evaluation.h"

#include "io/files.h"
#include "io/text_cursor.h"
#include "report/evaluation_manifest.h"

namespace vantage {
namespace {

namespace fs = std::filesystem;

double number_of(const std::string& text, const fs::path& file, std::size_t line) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !std::isfinite(value) || !(stream >> std::ws).eof()) {
    throw FormatError(file.string(), "line " + std::to_string(line),
                      "expected a number, found '" + text.substr(0, 40) + "'");
  }
  return value;
}

/// Rows of a CSV file without quotes, by the names of its header.
class Table {
 public:
  /// \param needed names of the columns that will be asked for.
  Table(const fs::path& file, std::string needed) : file_(file), needed_(std::move(needed)) {
    const std::string bytes = read_file(file.string());
    std::istringstream lines{std::string(without_bom(bytes))};
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
      if (!line.empty() && line.back() == '\r') {
        line.pop_back();
      }
      std::vector<std::string> cells;
      std::istringstream stream(line.empty() ? line : line + ',');  // the last cell may be empty
      for (std::string cell; std::getline(stream, cell, ',');) {
        cells.push_back(cell);
      }
      if (number == 1) {
        header_ = cells;
      } else if (!cells.empty()) {
        rows_.push_back({number, cells});
      }
    }
  }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const {
    const auto at = std::find(header_.begin(), header_.end(), column);
    const auto index = static_cast<std::size_t>(at - header_.begin());
    if (at == header_.end()) {
      throw FormatError(file_.string(), "line 1",
                        "has no column '" + column + "'; needed are " + needed_);
    }
    if (index >= rows_[row].cells.size()) {
      throw FormatError(file_.string(), "line " + std::to_string(rows_[row].line),
                        "has no value for column '" + column + "'");
    }
    return rows_[row].cells[index];
  }

  [[nodiscard]] Vec3 direction(std::size_t row, const std::array<const char*, 3>& columns) const {
    Vec3 v = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      v[static_cast<Eigen::Index>(k)] = number_of(text(row, columns[k]), file_, rows_[row].line);
    }
    const std::optional<Vec3> unit = unit_vector(v);
    if (!unit) {
      throw FormatError(file_.string(), "line " + std::to_string(rows_[row].line),
                        "a direction must be neither zero nor longer than a number can be");
    }
    return *unit;
  }

 private:
  struct Row {
    std::size_t line = 0;
    std::vector<std::string> cells{};
  };

  fs::path file_;
  std::string needed_;
  std::vector<std::string> header_{};
  std::vector<Row> rows_{};
};

void read_views(const fs::path& folder, std::vector<RecordedModel>& records) {
  std::map<std::string, RecordedModel> by_name;
  const Table views(folder / "views.csv", "model,vx,vy,vz,status");
  for (std::size_t i = 0; i < views.size(); ++i) {
    by_name[views.text(i, "model")].views.push_back(
        {views.direction(i, {"vx", "vy", "vz"}), views.text(i, "status") == "moved"});
  }
  if (fs::exists(folder / "mirror_planes.csv")) {
    const Table planes(folder / "mirror_planes.csv", "model,nx,ny,nz");
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const auto found = by_name.find(planes.text(i, "model"));
      if (found != by_name.end()) {
        found->second.planes.push_back({.normal = planes.direction(i, {"nx", "ny", "nz"})});
      }
    }
  }
  for (auto& [name, record] : by_name) {
    if (fs::path(name).filename() != name) {
      throw FormatError((folder / "views.csv").string(), "column 'model'",
                        "'" + name.substr(0, 40) + "' is no name of a file in models/");
    }
    record.name = name;
    record.path = (folder / "models" / name).string();
    if (fs::is_regular_file(record.path)) {
      records.push_back(std::move(record));
    }
  }
}

void read_gaze(const fs::path& folder, std::vector<RecordedModel>& records) {
  std::vector<fs::path> meshes;
  for (const auto& entry : fs::directory_iterator(folder / "meshes")) {
    meshes.push_back(entry.path());
  }
  std::sort(meshes.begin(), meshes.end());
  for (const fs::path& mesh : meshes) {
    const fs::path file = folder / "gaze" / (mesh.stem().string() + ".vertex");
    if (!fs::exists(file)) {
      continue;
    }
    records.push_back({.name = mesh.filename().string(), .path = mesh.string()});
    records.back().gaze = read_gaze_values(file);
  }
}

/// Models of different folders may have one name: their folders then become a part of it.
/// \param folder_of of each record.
void tell_apart(std::vector<RecordedModel>& records, const std::vector<std::string>& folder_of) {
  std::map<std::pair<std::string, bool>, int> count;
  const auto key = [](const RecordedModel& r) { return std::pair(r.name, r.views.empty()); };
  for (const RecordedModel& record : records) {
    ++count[key(record)];
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (count[key(records[i])] > 1) {
      records[i].name = folder_of[i] + "/" + records[i].name;
    }
  }
}

bool read_folder(const fs::path& folder, std::vector<RecordedModel>& records) {
  if (fs::exists(folder / "views.csv")) {
    read_views(folder, records);
    return true;
  }
  if (fs::is_directory(folder / "gaze") && fs::is_directory(folder / "meshes")) {
    read_gaze(folder, records);
    return true;
  }
  return false;
}

}  // namespace

std::vector<double> read_gaze_values(const fs::path& file) {
  std::vector<double> values;
  std::istringstream lines(read_file(file.string()));
  for (std::string line; std::getline(lines, line);) {
    values.push_back(number_of(line, file, values.size() + 1));
  }
  return values;
}

std::vector<RecordedModel> read_records(const std::string& folder) {
  std::vector<RecordedModel> records;
  std::error_code error;
  if (fs::is_regular_file(folder, error) && fs::path(folder).extension() == ".json") {
    return read_manifest(folder);
  }
  if (!fs::is_directory(folder, error)) {
    throw IoError(folder, "is neither a folder with recorded views or gaze nor a .json manifest");
  }
  if (!read_folder(folder, records)) {
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_directory()) {
        parts.push_back(entry.path());
      }
    }
    std::sort(parts.begin(), parts.end());
    std::vector<std::string> folder_of;
    for (const fs::path& part : parts) {
      read_folder(part, records);
      folder_of.resize(records.size(), part.filename().string());
    }
    tell_apart(records, folder_of);
  }
  if (records.empty()) {
    throw InvalidInput(
        folder +
        ": holds no models with views.csv or gaze/; docs/evidence.md says what a data set "
        "looks like");
  }
  return records;
}

}  // namespace vantage
