// SPDX-License-Identifier: MIT
#include "results_verify.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "vantage/core/error.h"

#include "batch/confined_folder.h"
#include "batch/json_text.h"
#include "batch/result_folders.h"

namespace vantage::cli {
namespace {

namespace fs = std::filesystem;
using batch::Json;

/// Whether a picture begins and ends as one does.
bool is_whole_png(std::string_view bytes) {
  constexpr std::string_view kPngBegins = "\x89PNG\r\n\x1a\n";
  constexpr std::string_view kPngEnds = "IEND\xae\x42\x60\x82";
  return bytes.starts_with(kPngBegins) && bytes.ends_with(kPngEnds);
}

/// What is wrong with a file of results by its name; empty if nothing is.
std::string flaw_of(const std::string& name, const std::string& bytes) {
  if (bytes.empty()) {
    return "is empty";
  }
  if (name.ends_with(".png") && !is_whole_png(bytes)) {
    return "is no whole picture";
  }
  if (name.ends_with(".json") && batch::parsed_json(bytes).is_discarded()) {
    return "is no JSON";
  }
  return "";
}

class Verification {
 public:
  Verification(const std::string& folder, const RunContext& run,
               const std::function<void(const std::string&)>& take)
      : root_(folder, "verify"), run_(run), take_(take) {}

  void look_at(const batch::ModelRecord& record, batch::ResultsStore& store) {
    run_.check();
    ++counts_.records;
    if (!batch::is_sound(record)) {
      complain(record.key + ": its record is not one of ours");
      return;
    }
    if (!record.duplicate_of.empty()) {
      const std::optional<batch::ModelRecord> first = store.find_content(record);
      if (record.status == "done" && !(first && !first->folder.empty())) {
        complain(record.key + ": has the results of " + record.duplicate_of +
                 ", which has none of its content; run the batch again with " + record.key);
      }
      return;
    }
    if (record.status == "done" && record.folder.empty()) {
      complain(record.key + ": has no results; run the batch again");
      return;
    }
    if (record.status == "done") {
      known_.insert(batch::model_folder(record.folder));
      look_into(record);
    }
  }

  /// Folders of results that no record names.
  void look_for_others() {
    std::error_code error;
    if (!root_.is_folder("models")) {
      return;
    }
    const fs::path top = root_.path_of("models");
    for (fs::recursive_directory_iterator at(top, error), end; !error && at != end;
         at.increment(error)) {
      run_.check();
      if (at->path().filename() == "view.json" && at->is_regular_file(error)) {
        const std::string name =
            "models/" + at->path().parent_path().lexically_relative(top).string();
        if (known_.count(name) == 0) {
          complain(name + ": results that no record names; remove the folder");
        }
      }
    }
  }

  [[nodiscard]] const VerifyCounts& counts() const { return counts_; }

  void complain(const std::string& problem) {
    ++counts_.problems;
    take_(problem);
  }

 private:
  [[nodiscard]] std::string bytes_of(const std::string& name) const {
    return root_.content_of(name).value_or("");
  }

  void look_into(const batch::ModelRecord& record) {
    const std::string folder = batch::model_folder(record.folder);
    const Json result = batch::parsed_json(record.result);
    const Json files = result.is_object() ? result.value("files", Json::object()) : Json::object();
    const auto complain_of = [&](const std::string& file, const std::string& problem) {
      std::string text = record.key;
      complain(text.append(": ")
                   .append(folder)
                   .append("/")
                   .append(file)
                   .append(" ")
                   .append(problem)
                   .append(is_missed(record, files, file)
                               ? "; run the batch again with --verify"
                               : "; remove " + folder + " and run the batch again"));
    };
    ++counts_.folders;
    if (!root_.is_folder(folder)) {
      complain(record.key + ": its results, " + folder + ", are not there; run the batch again");
      return;
    }
    bool has_flawed_view = false;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(root_.path_of(folder), error)) {
      const std::string name = entry.path().filename().string();
      if (const std::string flaw =
              flaw_of(name, bytes_of(std::string(folder).append("/").append(name)));
          !flaw.empty()) {
        complain_of(name, flaw);
        has_flawed_view = has_flawed_view || name == "view.json";
      }
    }
    if (has_flawed_view) {
      return;
    }
    const Json view = batch::parsed_json(bytes_of(folder + "/view.json"));
    if (!view.is_object()) {
      complain_of("view.json", "is not there or damaged");
      return;
    }
    for (const char* part : {"total", "best", "worst"}) {
      if (!result.is_object() || result.value(part, Json()) != view.value(part, Json())) {
        complain_of("view.json", "is not what its record says");
        return;
      }
    }
    for (const auto& [file, size] : files.items()) {
      const std::string problem = problem_with(std::string(folder).append("/").append(file), size);
      if (file != "view.json" && !problem.empty()) {
        complain_of(file, problem);
      }
    }
  }

  /// Whether a batch with --verify sees that something is wrong with a file, and may make it anew.
  [[nodiscard]] bool is_missed(const batch::ModelRecord& record, const Json& files,
                               const std::string& file) const {
    const std::string place = batch::model_folder(record.folder) + "/" + file;
    std::error_code error;
    return files.contains(file) && batch::holds_results(root_, record.folder) &&
           (!root_.exists(place) || files[file] != fs::file_size(root_.path_of(place), error));
  }

  /// What is wrong with a file that its record names; empty if nothing is, or flaw_of() says it.
  [[nodiscard]] std::string problem_with(const std::string& file, const Json& size) const {
    if (!root_.exists(file)) {
      return "is not there";
    }
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(root_.path_of(file), error);
    if (error || size == bytes || !flaw_of(file, bytes_of(file)).empty()) {
      return "";
    }
    return "has " + std::to_string(bytes) + " bytes, not " + batch::json_text(size);
  }

  const batch::ConfinedFolder root_;
  const RunContext& run_;
  const std::function<void(const std::string&)>& take_;
  std::set<std::string> known_{};  ///< Folders that records name.
  VerifyCounts counts_{};
};

}  // namespace

VerifyCounts verify_results(const std::string& folder, batch::ResultsStore& store,
                            const RunContext& run,
                            const std::function<void(const std::string&)>& take) {
  Verification verification(folder, run, take);
  try {
    store.check_integrity();
  } catch (const IoError& error) {
    verification.complain(error.what());
  }
  store.for_each_record(
      [&](const batch::ModelRecord& record) { verification.look_at(record, store); });
  verification.look_for_others();
  return verification.counts();
}

}  // namespace vantage::cli
