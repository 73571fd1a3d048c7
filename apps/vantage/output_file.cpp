// SPDX-License-Identifier: MIT
#include "output_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <system_error>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "batch/results_store.h"
#include "output_folder.h"

namespace vantage::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kPictureNames{".png", ".webp"};
constexpr std::array<std::string_view, 3> kShapes{".swc", ".graphml", ".npy"};
/// How tables of ours begin. Other CSV files may be directions, eyes or choices of people.
constexpr std::array<std::string_view, 9> kTableHeads{
    "method,dx,dy,dz,score\n",      "method,x,y,z,score\n", "method,model,mean_deg,",
    "map,model,correlation,",       "goal,step,level,",     "model,vertices,faces,",
    "| model | vertices | faces |", "Made by vantage ",     "key,name,status,"};
/// In PLY and OBJ files, which are models too.
constexpr std::string_view kMark = " written by vantage\n";

/// Options and arguments that name files to read.
constexpr std::array<std::string_view, 5> kInputs{"MODEL", "DATASET", "directions", "eyes",
                                                  "camera"};

/// Refuses to write where one of the inputs is, under whichever name.
void refuse_inputs(const std::string& path, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;
    if (fs::is_regular_file(path, error) && fs::equivalent(path, input, error)) {
      throw CLI::ValidationError(path, "is the file that is read; give the output another name");
    }
  }
}

bool is_model_name(const std::string& path) {
  const std::string suffix = suffix_of(path);
  const auto endings = model_endings();
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view ending) { return suffix == "." + std::string(ending); });
}

/// Nothing is to be replaced for the sake of an input that is not there, or is no model.
void blame_inputs(const std::string& path, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;
    if (input != "-" && !fs::exists(input, error)) {
      throw FormatError(input, "", "cannot be opened: there is no such file");
    }
    if (input != "-" && is_model_name(path) && !is_model_name(input)) {
      throw IoError(path, "is a model, and " + input + " is none; are the arguments swapped?");
    }
  }
}

bool is_only_written(const fs::path& path, OutputKind kind) {
  const std::span<const std::string_view> extensions =
      kind == OutputKind::Picture ? std::span<const std::string_view>(kPictureNames)
      : kind == OutputKind::Shape ? std::span<const std::string_view>(kShapes)
                                  : std::span<const std::string_view>();
  return std::find(extensions.begin(), extensions.end(), path.extension().string()) !=
         extensions.end();
}

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Tables, and lines of JSON as `results export` writes them.
bool is_table(std::string_view head) {
  return std::any_of(kTableHeads.begin(), kTableHeads.end(),
                     [&](std::string_view known) { return head.starts_with(known); }) ||
         (head.starts_with("{\"key\":") && contains(head, ",\"duplicate_of\":"));
}

/// Other JSON may be a glTF, cameras, a manifest or options of people: a skeleton says which vertex is
/// of which node.
bool is_skeleton(const fs::path& path, std::string_view head) {
  if (!head.starts_with("{\n  \"nodes\": [")) {
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return contains(text, "\n  \"vertex_node\": [");
}

bool is_ours(const fs::path& path, std::string_view head, OutputKind kind) {
  if (kind == OutputKind::Picture) {
    return head.starts_with("\x89PNG\r\n") ||
           (head.starts_with("RIFF") && head.substr(8).starts_with("WEBP"));
  }
  if (kind == OutputKind::Shape) {
    return contains(head, kMark) || is_skeleton(path, head);
  }
  return is_table(head);
}

/// The first bytes of a regular file; nothing if there is none.
std::optional<std::string> head_of(const fs::path& path) {
  constexpr std::size_t kHead = 1 << 14;  // a row of an export begins with the path of a model
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    return std::nullopt;
  }
  std::string head(kHead, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

}  // namespace

std::string suffix_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::vector<std::string> named_inputs(CLI::App& command) {
  std::vector<std::string> files;
  for (const CLI::Option* option : command.get_options({})) {
    const std::string name = option->get_single_name();
    if (std::find(kInputs.begin(), kInputs.end(), name) != kInputs.end()) {
      files.insert(files.end(), option->results().begin(), option->results().end());
    }
  }
  for (CLI::App* group :
       command.get_subcommands([](const CLI::App* below) { return below->get_name().empty(); })) {
    const std::vector<std::string> more = named_inputs(*group);
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

void add_force_flag(CLI::App& app, CommonFlags& flags) {
  app.add_flag("--force", flags.force, "replace files that were not written by vantage too")
      ->configurable(false)
      ->group("Common");
}

void require_distinct(const std::vector<NamedOutput>& outputs) {
  std::map<std::string, std::string_view> option_of_file;
  for (const auto& [option, path] : outputs) {
    std::error_code error;
    if (path.empty() || fs::is_character_file(path, error)) {  // /dev/null takes all
      continue;
    }
    const fs::path place =
        path == "-" ? fs::path(path) : fs::weakly_canonical(fs::absolute(path), error);
    const auto [known, is_new] = option_of_file.try_emplace(error ? path : place.string(), option);
    if (!is_new) {
      throw CLI::ValidationError(std::string(option), "is " + path + ", the file of " +
                                                          std::string(known->second) +
                                                          ", too; give each its own name");
    }
  }
}

void check_output(const std::string& path, OutputKind kind, const CommonFlags& flags) {
  std::error_code error;  // a link counts as what it leads to
  const fs::path target = fs::weakly_canonical(path, error);
  if (target.filename() == batch::ResultsStore::kFileName &&
      head_of(path).value_or("").starts_with("SQLite format 3")) {
    throw IoError(path, "holds the results of a batch; choose another name");
  }
  if (path == "-") {
    return;
  }
  refuse_inputs(path, flags.inputs);
  if (flags.force || is_only_written(target, kind)) {
    return;
  }
  const std::optional<std::string> head = head_of(path);
  if (head && !head->empty() && !is_ours(path, *head, kind)) {
    blame_inputs(path, flags.inputs);
    throw IoError(
        path,
        "is there already, and does not say that vantage wrote it; choose another name, or say "
        "--force to replace it");
  }
}

void check_result(const std::string& path, OutputKind kind, const CommonFlags& flags) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) {
    check_output(path, kind, flags);
  }
}

void check_levels(const std::string& folder, const std::vector<NamedOutput>& others,
                  const CommonFlags& flags) {
  if (folder.empty()) {
    return;
  }
  const OutputFolder output(folder, kLevelResults);
  output.refuse_inputs(flags.inputs);
  for (const auto& [option, path] : others) {
    output.refuse_own_name(path, std::string(option));
  }
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with("level-") && name.ends_with(".ply")) {
      check_result(entry->path().string(), OutputKind::Shape, flags);
    }
  }
}

void write_output(const std::string& path, std::string_view bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (path == "-" || (fs::exists(status) && !fs::is_regular_file(status))) {
    const Abandonable abandonable;
    write_named_file(path, bytes);
  } else {
    if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) {
      fs::create_directories(folder, error);  // if that fails, so does writing, and says why
    }
    write_named_file(path, bytes);
  }
}

bool is_already(const std::string& path, std::string_view bytes) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != bytes.size()) {
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string held{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return held == bytes;
}

}  // namespace vantage::cli
