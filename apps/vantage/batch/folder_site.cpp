// SPDX-License-Identifier: MIT
#include "batch/folder_site.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

#include "vantage/core/error.h"

#include "batch/index_page.h"
#include "batch/json_text.h"
#include "batch/overview.h"
#include "batch/results_store.h"
#include "batch/thumbnail.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;

/// How deep results are looked for.
constexpr int kDepth = 4;
/// At most so many are listed; a batch is the way to hold more.
constexpr std::size_t kMostResults = 20'000;
/// view.json is a few kB; more is somebody else's file.
constexpr std::uintmax_t kLargestJson = 16U << 20U;
constexpr std::string_view kModels = "/models/";

struct MediaType {
  std::string_view extension;
  const char* type;
};

/// What results are made of.
constexpr std::array<MediaType, 14> kMediaTypes{{{".html", "text/html; charset=utf-8"},
                                                 {".png", "image/png"},
                                                 {".webp", "image/webp"},
                                                 {".json", "application/json"},
                                                 {".csv", "text/csv; charset=utf-8"},
                                                 {".txt", "text/plain; charset=utf-8"},
                                                 {".svg", "image/svg+xml"},
                                                 {".ply", "application/octet-stream"},
                                                 {".obj", "text/plain; charset=utf-8"},
                                                 {".gltf", "model/gltf+json"},
                                                 {".glb", "model/gltf-binary"},
                                                 {".swc", "text/plain; charset=utf-8"},
                                                 {".graphml", "application/xml"},
                                                 {".jsonl", "application/x-ndjson"}}};

bool is_hidden(std::string_view path) {
  return path.find("/.") != std::string_view::npos || path.find('\0') != std::string_view::npos ||
         path.find('\\') != std::string_view::npos;
}

/// No links: they might lead to what is hidden.
bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(path, error));
}

/// A view.json of ours; nothing if it is not one.
std::optional<Json> read_result(const fs::path& folder) {
  const fs::path path = folder / "view.json";
  std::error_code error;
  if (!is_file(path) || fs::file_size(path, error) > kLargestJson || error) {
    return std::nullopt;
  }
  std::ifstream stream(path, std::ios::binary);
  Json json = parsed_json(std::string{std::istreambuf_iterator<char>(stream), {}});
  const bool ours = json.is_object() && json.contains("vantage") && json.contains("model") &&
                    json["model"].is_object() && json.contains("best") && json["best"].is_object();
  return ours ? std::optional(std::move(json)) : std::nullopt;
}

Json number_or_null(const Json& object, const char* member) {
  const auto found = object.find(member);
  return found != object.end() && found->is_number() ? *found : Json(nullptr);
}

/// \param inside path of the folder in that which is shown, empty for itself.
Json row_of(const Json& result, const fs::path& folder, const std::string& inside) {
  const auto doubts = result.find("doubts");
  const int has = (is_file(folder / "best.png") ? kHasThumbnail | kHasPicture : 0) |
                  (is_file(folder / "report.html") ? kHasReport : 0) |
                  (doubts != result.end() && !doubts->empty() ? kIsDoubted : 0);
  const Json& best = result["best"];
  const auto title = result["model"].find("name");
  const bool named = title != result["model"].end() && title->is_string();
  const std::string name = inside.empty() ? folder.filename().string() : inside;
  return Json::array({name, named ? *title : Json(name), "done", "", "", url_path(inside),
                      number_or_null(best, "score_fraction"), number_or_null(best, "score"),
                      number_or_null(result["model"], "vertices"), has});
}

/// Folders inside `root`, itself included, sorted by path; hidden ones and links left out.
std::vector<fs::path> folders_in(const fs::path& root) {
  std::vector<fs::path> folders{root};
  std::error_code error;
  fs::recursive_directory_iterator walk(root, fs::directory_options::skip_permission_denied, error);
  for (; !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
    std::error_code ignored;
    const bool folder = walk->is_directory(ignored) && !walk->is_symlink(ignored);
    const std::string name = walk->path().filename().string();
    if (!folder || name.starts_with('.') || walk.depth() + 1 >= kDepth) {
      walk.disable_recursion_pending();
    }
    if (folder && !name.starts_with('.')) {
      folders.push_back(walk->path());
    }
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace

FolderSite::FolderSite(const std::string& folder, std::stop_token stop) : stop_(std::move(stop)) {
  std::error_code error;
  root_ = fs::canonical(folder, error);
  if (error || !fs::is_directory(root_, error)) {
    throw IoError(folder, "is not a folder", error.value());
  }
  is_batch_ = is_file(root_ / ResultsStore::kFileName);
  if (is_batch_) {
    const ResultsStore store(root_.string(), Database::Mode::Read);  // or says why not
    return;
  }
  const std::vector<fs::path> folders = folders_in(root_);
  if (std::none_of(folders.begin(), folders.end(),
                   [](const fs::path& f) { return read_result(f).has_value(); })) {
    throw IoError(folder, "holds no results; make some with vantage view or vantage batch");
  }
}

std::string FolderSite::results_index() const {
  std::string rows;
  StatusCounts counts;
  for (const fs::path& folder : folders_in(root_)) {
    if (stop_.stop_requested() || counts.done == static_cast<std::int64_t>(kMostResults)) {
      break;
    }
    const std::optional<Json> result = read_result(folder);
    if (!result) {
      continue;
    }
    ++counts.done;
    const std::string inside = folder == root_ ? "" : folder.lexically_relative(root_).string();
    const std::string row = json_text(row_of(*result, folder, inside));
    rows += (rows.empty() ? "" : ",\n") + script_safe(row);
  }
  return index_page(rows, {"index.html"}, 0, counts);
}

std::optional<SitePage> FolderSite::index(std::size_t page) const {
  SitePage made{.type = kMediaTypes[0].type};
  if (is_batch_) {
    ResultsStore store(root_.string(), Database::Mode::Read);
    std::optional<std::string> body = overview_page(root_.string(), store, page);
    if (!body) {
      return std::nullopt;
    }
    made.body = std::move(*body);
    return made;
  }
  if (page > 0) {
    return std::nullopt;
  }
  made.body = results_index();
  return made;
}

std::optional<SitePage> FolderSite::find(std::string_view path) const {
  if (!path.starts_with('/') || is_hidden(path)) {
    return std::nullopt;
  }
  if (path == "/" || path == "/index.html") {
    return index(0);
  }
  constexpr std::string_view kFurther = "/index-";
  if (path.starts_with(kFurther) && path.ends_with(".html")) {
    const std::string_view digits = path.substr(kFurther.size(), path.size() - kFurther.size() - 5);
    std::size_t page = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), page);
    const bool good = error == std::errc{} && end == digits.data() + digits.size() && page > 1;
    return good ? index(page - 1) : std::nullopt;
  }
  fs::path file = path.substr(1);
  if (!is_batch_ && path.starts_with(kModels)) {  // where the index looks for results
    file =
        fs::path(path.substr(kModels.size())).relative_path();  // "models//" is the folder itself
    if (file.filename() == kThumbnailFile && !is_file(root_ / file)) {
      file.replace_filename("best.png");
    }
  }
  const std::string extension = file.extension().string();
  const auto* const kind =
      std::find_if(kMediaTypes.begin(), kMediaTypes.end(),
                   [&](const MediaType& k) { return k.extension == extension; });
  if (kind == kMediaTypes.end() || file.is_absolute()) {
    return std::nullopt;
  }
  SitePage page{.type = kind->type, .file = ServedFile::open(root_, file)};
  page.is_report = file.filename() == "report.html";
  return page.file ? std::optional(std::move(page)) : std::nullopt;
}

}  // namespace vantage::batch
