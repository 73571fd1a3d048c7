// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/mtl.h"
#include "io/named_path.h"
#include "io/readers.h"

namespace vantage {

/// The material libraries that an OBJ names, and where these and their pictures are.
class ObjLibraries {
 public:
  /// \param files, exists must outlive this; empty: there are none.
  ObjLibraries(const SideFileSource& files, const SideFileCheck& exists)
      : files_(files), exists_(exists) {}

  /// The rest of a mtllib line: one name, which may hold spaces, or several without.
  void add(std::string_view names);

  /// Reads what was added. Of several materials of one name the first counts.
  void read();

  /// By name; paths of pictures are relative to the model's folder, or of their author's disk.
  [[nodiscard]] const std::map<std::string, MtlMaterial, std::less<>>& materials() const {
    return materials_;
  }

  /// The material of this name, or of what stands before a comment in it; null if there is none.
  [[nodiscard]] const MtlMaterial* find(std::string_view name) const;

  /// Paths of the libraries that were read, in the order in which they are named.
  [[nodiscard]] const std::vector<std::string>& paths() const { return paths_; }

  /// Paths of libraries that could not be read.
  [[nodiscard]] std::vector<std::string> unread_paths() const;

  /// What mtllib lines say of which nothing could be read.
  [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }

  /// Why, after "it".
  [[nodiscard]] std::string_view problem() const {
    return files_ ? "cannot be read in the model's folder"
                  : "cannot be found without the model's folder; name the model by its path";
  }

  /// Where a material's picture is, relative to the model's folder; nothing if nowhere inside.
  [[nodiscard]] std::optional<std::string> place_of(const std::string& picture) const {
    return place_of_picture(picture, exists_);
  }

 private:
  [[nodiscard]] bool read_library(std::string_view name);
  [[nodiscard]] bool read_once(const std::string& path);
  [[nodiscard]] bool read_materials(const std::string& path);

  const SideFileSource& files_;
  const SideFileCheck& exists_;
  std::vector<std::string> named_{};            ///< As named, each once, in order.
  std::set<std::string, std::less<>> known_{};  ///< The same.
  std::map<std::string, bool> is_read_{};       ///< Of each path that was tried.
  std::vector<std::string> paths_{};
  std::vector<std::string> missing_{};
  std::map<std::string, MtlMaterial, std::less<>> materials_{};
};

}  // namespace vantage
