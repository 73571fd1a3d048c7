// SPDX-License-Identifier: MIT
#include "io/gltf_uri.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/text_cursor.h"

namespace vantage {
namespace {

/// Value of a base64 digit, −1 for other characters.
int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') {
    return c - 'A';
  }
  if (c >= 'a' && c <= 'z') {
    return c - 'a' + 26;
  }
  if (c >= '0' && c <= '9') {
    return c - '0' + 52;
  }
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::optional<std::string> decode_base64(std::string_view text) {
  while (!text.empty() && text.back() == '=') {
    text.remove_suffix(1);
  }
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = base64_value(c);
    if (value < 0) {
      return std::nullopt;
    }
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>((bits >> count) & 0xFFU);
    }
  }
  return bytes;
}

/// Without "." and ".."; none if it leads out of the folder, or to the folder itself.
std::optional<std::string> normalised(std::string_view path) {
  std::vector<std::string_view> names;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view name = path.substr(begin, end - begin);
    if (name == ".." && names.empty()) {
      return std::nullopt;
    }
    if (name == "..") {
      names.pop_back();
    } else if (!name.empty() && name != ".") {
      names.push_back(name);
    }
    begin = end + 1;
  }
  std::string joined;
  for (const std::string_view name : names) {
    joined += (joined.empty() ? "" : "/") + std::string(name);
  }
  return joined.empty() ? std::nullopt : std::optional(std::move(joined));
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return lower_case(uri.substr(0, 5)) == "data:";
}

std::optional<std::string> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == std::string_view::npos) {
    return std::nullopt;
  }
  std::optional<std::string> data = decode_percent(uri.substr(comma + 1));
  return data && lower_case(uri.substr(0, comma)).ends_with(";base64") ? decode_base64(*data)
                                                                       : data;
}

std::optional<std::string> decode_percent(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (error != std::errc() || digits.size() != 2 || end != digits.data() + 2) {
      return std::nullopt;
    }
    decoded += static_cast<char>(value);
    i += 2;
  }
  return decoded;
}

std::optional<std::string> relative_path_of_uri(std::string_view uri) {
  const std::optional<std::string> path = decode_percent(uri);
  // A colon before the first slash is a scheme (http:, file:) or a drive (C:).
  if (!path || path->starts_with('/') ||
      path->substr(0, path->find('/')).find(':') != std::string::npos ||
      path->find('\\') != std::string::npos || path->find('\0') != std::string::npos) {
    return std::nullopt;
  }
  return normalised(*path);
}

}  // namespace vantage
