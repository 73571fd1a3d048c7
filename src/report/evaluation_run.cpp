// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/core/version.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"
#include "vantage/report/evaluation.h"

#include "core/fingerprint.h"
#include "core/json_text.h"
#include "core/loaded_code.h"
#include "core/parallel.h"
#include "io/files.h"
#include "io/model_format.h"
#include "report/constant_camera.h"

namespace vantage {
namespace {

using Json = OrderedJson;

// Columns of a row behind its two names, in the order in which the journal lists them.
constexpr std::array kViewColumns{&ViewAgreement::mean_deg, &ViewAgreement::mean_folded_deg,
                                  &ViewAgreement::all_folded_deg, &ViewAgreement::within_45,
                                  &ViewAgreement::percentile};
constexpr std::array kGazeColumns{&GazeAgreement::correlation, &GazeAgreement::rank,
                                  &GazeAgreement::area,        &GazeAgreement::chance_adjusted,
                                  &GazeAgreement::normalised,  &GazeAgreement::z_score};

template <class Row, class Columns>
Json rows_json(const std::vector<Row>& rows, std::string Row::*name, const Columns& columns) {
  Json list = Json::array();
  for (const Row& row : rows) {
    Json cells = Json::array({row.*name, row.model});
    for (const auto column : columns) {
      cells.push_back(std::isfinite(row.*column) ? Json(row.*column) : Json(nullptr));
    }
    list.push_back(std::move(cells));
  }
  return list;
}

template <class Row, class Columns>
std::vector<Row> rows_from(const Json& list, std::string Row::*name, const Columns& columns) {
  std::vector<Row> rows;
  for (const Json& cells : list) {
    Row row;
    row.*name = cells.at(0).template get<std::string>();
    row.model = cells.at(1).template get<std::string>();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const Json& cell = cells.at(k + 2);
      row.*columns[k] =
          cell.is_null() ? std::numeric_limits<double>::quiet_NaN() : cell.template get<double>();
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The axis of a row, or any; nothing if it is neither.
std::optional<UpAxis> up_from(const Json& json) {
  for (int axis = 0; axis <= static_cast<int>(UpAxis::Any); ++axis) {
    if (json == axis) {
      return static_cast<UpAxis>(axis);
    }
  }
  return std::nullopt;
}

[[noreturn]] void refuse_journal(const std::string& file, std::size_t at) {
  throw FormatError(file, "after byte " + std::to_string(at),
                    "is no row of vantage eval; move the file away, or name another folder");
}

/// Adds text, and where it ends.
void add_text(Fingerprint& to, std::string_view text) {
  to.add(text);
  to.add(std::to_string(text.size()));
}

void add_vector(Fingerprint& to, const Vec3& v) {
  for (const double x : {v.x(), v.y(), v.z()}) {
    add_text(to, number_text(x));
  }
}

/// Of all that a record's rows depend on; the program itself too, whose version stays the same while
/// it is worked on.
std::string key_of(const RecordedModel& record, const ViewOptions& options,
                   const std::vector<Measure>& measures, const RunContext& run) {
  Fingerprint print;
  add_text(print, version());
  add_text(print, library_versions());
  add_text(print, std::to_string(loaded_code()));
  add_text(print, options_hash(options));
  add_text(print, record.name);
  add_text(print, read_file(record.path));
  const std::string extension = extension_of(record.path);
  if (extension == "gltf" || extension == "glb") {  // whose mesh may be in other files
    const TriMesh mesh = load_model(record.path, run).mesh;
    for (const Vec3& p : mesh.positions) {
      add_vector(print, p);
    }
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t v : triangle) {
        add_text(print, std::to_string(v));
      }
    }
  }
  for (const Measure& measure : measures) {
    add_text(print, measure.name);
  }
  for (const ChosenByPerson& view : record.views) {
    add_vector(print, view.direction);
    add_text(print, view.moved ? "moved" : "kept");
  }
  for (const MirrorPlane& plane : record.planes) {
    add_vector(print, plane.normal);
  }
  for (const double seconds : record.gaze) {
    add_text(print, number_text(seconds));
  }
  return std::to_string(print.value());
}

ViewOptions options_for(const RecordedModel& record, ViewOptions options) {
  options.up = record.up ? record.up : options.up;
  return options;
}

EvaluatedModel evaluate(const RecordedModel& record, const ViewOptions& options,
                        const std::vector<Measure>& measures, const RunContext& run) {
  const Model model = load_model(record.path, run);
  EvaluatedModel rows;
  rows.up = options.up.value_or(default_up(model));
  if (!record.views.empty()) {
    rows.views = evaluate_views(record, model, options, measures, run);
  }
  if (!record.gaze.empty()) {
    rows.gaze = evaluate_gaze(record, model, options, run);
  }
  return rows;
}

/// Records that are still to do, the largest file first.
std::vector<std::size_t> by_size(const std::vector<RecordedModel>& records,
                                 std::vector<std::size_t> left) {
  std::vector<std::uintmax_t> size(records.size(), 0);
  for (const std::size_t i : left) {
    std::error_code error;
    const std::uintmax_t found = std::filesystem::file_size(records[i].path, error);
    size[i] = error ? 0 : found;
  }
  std::stable_sort(left.begin(), left.end(),
                   [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  return left;
}

}  // namespace

struct EvaluationJournal::State {
  std::string file{};
  std::map<std::string, EvaluatedModel> rows{};
  std::mutex mutex{};
};

EvaluationJournal::EvaluationJournal(std::string file) : state_(std::make_unique<State>()) {
  state_->file = std::move(file);
  std::error_code error;
  if (!std::filesystem::exists(state_->file, error)) {
    return;
  }
  const std::string text = read_file(state_->file);
  std::istringstream lines(text);
  std::string whole;
  for (std::string line; std::getline(lines, line);) {
    try {
      const Json json = parsed_json(line);
      const std::optional<UpAxis> up = up_from(json.at("up"));
      if (!up) {
        refuse_journal(state_->file, whole.size());
      }
      EvaluatedModel rows{*up, rows_from(json.at("views"), &ViewAgreement::method, kViewColumns),
                          rows_from(json.at("gaze"), &GazeAgreement::map, kGazeColumns)};
      state_->rows[json.at("key").get<std::string>()] = std::move(rows);
      whole += line + '\n';
    } catch (const Json::exception&) {
      // One of an older program is left out, and one that was cut as its program was killed.
      const Json found = parsed_json(line);
      const bool is_row = found.is_object() && found.contains("key") && found.contains("views");
      if (!is_row && !lines.eof()) {
        refuse_journal(state_->file, whole.size());
      }
    }
  }
  if (text.size() != whole.size()) {
    write_file(state_->file, whole);
  }
}

EvaluationJournal::EvaluationJournal() = default;
EvaluationJournal::~EvaluationJournal() = default;

const EvaluatedModel* EvaluationJournal::find(const std::string& key) const {
  if (!state_) {
    return nullptr;
  }
  const auto found = state_->rows.find(key);
  return found == state_->rows.end() ? nullptr : &found->second;
}

void EvaluationJournal::add(const std::string& key, const EvaluatedModel& rows) {
  if (!state_) {
    return;
  }
  const Json json{{"key", key},
                  {"up", static_cast<int>(rows.up)},
                  {"views", rows_json(rows.views, &ViewAgreement::method, kViewColumns)},
                  {"gaze", rows_json(rows.gaze, &GazeAgreement::map, kGazeColumns)}};
  const std::string line = json_text(json) + '\n';
  const std::lock_guard lock(state_->mutex);
  constexpr mode_t kMode = 0644;
  const int file =
      ::open(state_->file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, kMode);
  if (file < 0) {
    throw IoError(state_->file, "cannot be written", errno);
  }
  const off_t before = ::lseek(file, 0, SEEK_END);
  const ssize_t written = ::write(file, line.data(), line.size());
  const bool is_whole = written == static_cast<ssize_t>(line.size());
  const bool is_written = is_whole && (::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP);
  const int problem = is_written ? 0 : written >= 0 && !is_whole ? ENOSPC : errno;
  if (!is_written && before >= 0) {
    // No part of a row stays, to which the next one would be joined.
    static_cast<void>(::ftruncate(file, before) == 0);
  }
  ::close(file);
  if (!is_written) {
    throw IoError(state_->file, "cannot be written", problem);
  }
}

std::vector<EvaluatedModel> evaluate_records(const std::vector<RecordedModel>& records,
                                             const ViewOptions& options,
                                             const std::vector<Measure>& measures,
                                             EvaluationJournal& journal, std::size_t& known,
                                             const RunContext& run) {
  std::vector<EvaluatedModel> results(records.size());
  std::vector<std::string> keys;
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < records.size(); ++i) {
    keys.push_back(key_of(records[i], options_for(records[i], options), measures, run.quiet()));
    if (const EvaluatedModel* found = journal.find(keys[i])) {
      results[i] = *found;
    } else {
      left.push_back(i);
    }
  }
  known = records.size() - left.size();
  left = by_size(records, left);
  const std::size_t threads = run.max_threads > 0
                                  ? static_cast<std::size_t>(run.max_threads)
                                  : std::max(1U, std::thread::hardware_concurrency());
  const std::size_t workers = std::max<std::size_t>(1, std::min(threads, left.size()));
  // Models side by side need no threads of their own; few models share the cores.
  const RunContext within{.stop = run.stop, .max_threads = static_cast<int>(threads / workers)};
  const RunContext beside = run.quiet();
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> next{0};
  parallel_for(beside, workers, 1, [&](std::size_t /*begin*/, std::size_t /*end*/) {
    for (std::size_t k = next++; k < left.size(); k = next++) {
      if (std::this_thread::get_id() == caller) {
        run.advance("models", static_cast<double>(k) / static_cast<double>(left.size()));
      }
      const std::size_t i = left[k];
      results[i] = evaluate(records[i], options_for(records[i], options), measures, within);
      journal.add(keys[i], results[i]);
    }
  });
  add_constant_camera(records, results);
  return results;
}

}  // namespace vantage
