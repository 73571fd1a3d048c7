// SPDX-License-Identifier: MIT
#include "io/side_files.h"

#include "vantage/core/error.h"

#include "io/files.h"

namespace vantage {

namespace fs = std::filesystem;

fs::path place_beside(const std::string& model_path, const std::string& relative,
                      std::error_code& error) {
  const fs::path folder = fs::canonical(fs::absolute(model_path).parent_path(), error);
  const fs::path wanted = error ? fs::path() : fs::canonical(folder / relative, error);
  const fs::path inside = wanted.lexically_relative(folder);
  return inside.empty() || *inside.begin() == ".." ? fs::path() : wanted;
}

SideFile side_file(const std::string& model_path, const std::string& relative) {
  std::error_code error;
  const fs::path wanted = place_beside(model_path, relative, error);
  if (error) {
    return {std::nullopt, "cannot be opened"};
  }
  if (wanted.empty()) {
    return {std::nullopt, "lies outside the model's folder"};
  }
  try {
    return {read_file(wanted.string()), {}};
  } catch (const IoError&) {  // the model is sound without it
    return {std::nullopt, "cannot be read"};
  }
}

}  // namespace vantage
