// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace vantage {

/// Stands for what a file does not have: null.
inline const nlohmann::json kNoJson{};

/// A member of an object; kNoJson if it is none or has none.
inline const nlohmann::json& member(const nlohmann::json& object, const char* name) {
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? kNoJson : *found;
}

/// What an extension of that name says of an object; kNoJson if nothing.
inline const nlohmann::json& extension(const nlohmann::json& object, const char* name) {
  return member(member(object, "extensions"), name);
}

}  // namespace vantage
