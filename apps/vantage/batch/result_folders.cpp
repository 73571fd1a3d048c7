// SPDX-License-Identifier: MIT
#include "batch/result_folders.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

#include "batch/json_text.h"
#include "result_names.h"

namespace vantage::batch {

std::string work_folder(const std::string& work_name) {
  return ".work/" + work_name;
}

std::string model_folder(const std::string& folder) {
  return "models/" + folder;
}

bool holds_results(const ConfinedFolder& root, const std::string& folder) {
  return root.beginning_of(model_folder(folder) + "/view.json", cli::kViewBegins.size()) ==
         cli::kViewBegins;
}

bool holds_named_files(const ConfinedFolder& root, const ModelRecord& record) {
  const Json result = parsed_json(record.result);
  const Json files = result.is_object() ? result.value("files", Json::object()) : Json::object();
  return std::all_of(files.items().begin(), files.items().end(), [&](const auto& file) {
    const std::string name = model_folder(record.folder) + "/" + file.key();
    std::error_code error;
    return root.exists(name) &&
           file.value() == std::filesystem::file_size(root.path_of(name), error) && !error;
  });
}

bool may_be_replaced(const ConfinedFolder& root, const std::string& folder) {
  const std::string place = model_folder(folder);
  for (std::size_t slash = place.find('/'); slash != std::string::npos;
       slash = place.find('/', slash + 1)) {
    if (const std::string above = place.substr(0, slash);
        root.exists(above) && !root.is_folder(above)) {
      return false;
    }
  }
  return !root.exists(place) || root.is_empty_folder(place) || holds_results(root, folder);
}

}  // namespace vantage::batch
