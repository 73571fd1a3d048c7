// SPDX-License-Identifier: MIT
#include "core/json_reader.h"

#include <optional>
#include <set>
#include <vector>

#include "vantage/core/error.h"

namespace vantage {

namespace {

/// JSON in which no object names a member twice; discarded if it is not well formed.
JsonReader::Json parsed_once(std::string_view bytes, std::string_view name) {
  using Json = JsonReader::Json;
  std::vector<std::set<std::string>> members;  // of the objects around the place
  const auto look = [&](int /*depth*/, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) {
      members.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      members.pop_back();
    } else if (event == Json::parse_event_t::key &&
               !members.back().insert(value.get<std::string>()).second) {
      throw FormatError(name, "", "names \"" + value.get<std::string>() + "\" twice; keep one");
    }
    return true;
  };
  return Json::parse(bytes.begin(), bytes.end(), look, false);
}

}  // namespace

JsonReader::JsonReader(std::string_view bytes, std::string_view name)
    : name_(name), root_(parsed_once(bytes, name)) {
  if (root_.is_discarded()) {
    fail("is not well formed JSON");
  }
}

void JsonReader::fail(const std::string& problem) const {
  throw FormatError(name_, "", problem);
}

bool JsonReader::has(const Json& object, const char* member) {
  return object.is_object() && object.contains(member);
}

void JsonReader::require_list_of_3(const Json& value, const std::string& what) const {
  if (!value.is_array() || value.size() != 3) {
    fail(what + " is not a list of 3 numbers");
  }
}

Vec3 JsonReader::unit_vector(const Json& value, const std::string& what) const {
  require_list_of_3(value, what);
  Vec3 vector;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!value[axis].is_number()) {
      fail(what + " is not a list of 3 numbers");
    }
    vector[static_cast<Eigen::Index>(axis)] = value[axis].get<double>();
  }
  const std::optional<Vec3> unit = vantage::unit_vector(vector);
  if (!unit) {
    fail(what + " must be three finite numbers, not all zero");
  }
  return *unit;
}

}  // namespace vantage
