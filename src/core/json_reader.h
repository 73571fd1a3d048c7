// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "vantage/core/vec3.h"

namespace vantage {

/// A small JSON file that is read strictly: whatever is not as it should be ends in one sentence
/// that names the file.
class JsonReader {
 public:
  using Json = nlohmann::json;

  /// \throw FormatError unless the bytes are well formed JSON in which no object names a member twice.
  JsonReader(std::string_view bytes, std::string_view name);

 protected:
  /// \throw FormatError, always: the name of the file and the problem.
  [[noreturn]] void fail(const std::string& problem) const;

  static bool has(const Json& object, const char* member);

  /// \throw FormatError unless the value is a list of 3. \param what names it.
  void require_list_of_3(const Json& value, const std::string& what) const;

  /// A list of three numbers as a unit vector. \throw FormatError unless it is one, and not zero.
  [[nodiscard]] Vec3 unit_vector(const Json& value, const std::string& what) const;

  [[nodiscard]] const Json& root() const { return root_; }

  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  Json root_{};
};

}  // namespace vantage
