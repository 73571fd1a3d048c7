// SPDX-License-Identifier: MIT
#include "batch/naming.h"

#include <array>
#include <functional>
#include <optional>

#include "vantage/core/error.h"

#include "batch/content_hash.h"

namespace vantage::batch {
namespace {

// File systems allow 255 bytes; the rest is for temporary names beside it.
constexpr std::size_t kLongestPart = 150;

/// Bytes of the UTF-8 sequence that begins at `at`; 0 if there is none.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at);
  if (first < 0x80) {
    return 1;
  }
  const std::size_t length = first >= 0xF0 && first <= 0xF4   ? 4
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xC2 && first <= 0xDF ? 2
                                                              : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) {
      return 0;
    }
  }
  const unsigned second = byte(at + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool surrogate = first == 0xED && second >= 0xA0;
  const bool beyond = first == 0xF4 && second >= 0x90;
  return overlong || surrogate || beyond ? 0 : length;
}

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

/// One part of a path that no file system and no shell takes amiss. One that is too long is cut, and
/// ends with digits of the whole text's hash, so that different ones stay different.
std::string safe_part(std::string_view text, std::size_t longest = kLongestPart) {
  constexpr std::size_t kDigits = 8;
  std::string part;
  std::size_t kept = 0;  // bytes of the part before which it is cut, if it must be
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    // C1 control characters drive terminals just as C0 ones do.
    const bool c1 =
        length == 2 && text[i] == '\xC2' && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    const bool keep = length > 1 ? !c1 : is_plain(text[i]);
    const std::size_t step = length == 0 ? 1 : length;
    if (part.size() + (keep ? step : 1) > longest) {
      part = part.substr(0, kept) + "-" + text_hash(text).substr(0, kDigits);
      break;
    }
    part += keep ? std::string(text.substr(i, step)) : std::string("_");
    i += step;
    kept = part.size() + kDigits + 1 <= longest ? part.size() : kept;
  }
  if (!part.empty() && (part[0] == '.' || part[0] == '-')) {
    part[0] = '_';
  }
  return part.empty() ? "_" : part;
}

std::string_view file_name(std::string_view path) {
  return path.substr(path.find_last_of('/') + 1);
}

std::string_view parent_name(std::string_view path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string_view::npos ? std::string_view{} : file_name(path.substr(0, slash));
}

std::size_t dot_of(std::string_view file) {
  const std::size_t dot = file.find_last_of('.');
  return dot == 0 || dot == std::string_view::npos ? file.size() : dot;
}

// Room for a hash, a parent and separators beside the longest text field.
constexpr std::size_t kLongestField = 100;

std::optional<std::string> field_value(std::string_view field, const NameFields& of) {
  const std::string_view file = file_name(of.path);
  const std::string_view stem = file.substr(0, dot_of(file));
  if (field == "stem") {
    return safe_part(stem, kLongestField);
  }
  if (field == "name") {
    return safe_part(of.name.empty() ? stem : of.name, kLongestField);
  }
  if (field == "ext") {
    return safe_part(dot_of(file) < file.size() ? file.substr(dot_of(file) + 1) : "none",
                     kLongestField);
  }
  if (field == "parent") {
    const std::string_view parent = parent_name(of.path);
    return safe_part(parent.empty() ? "_" : parent, kLongestField);
  }
  if (field == "hash2" || field == "hash8" || field == "hash16" || field == "hash") {
    const std::string_view digits = field.substr(4);
    const std::size_t count = digits.empty() ? 64 : digits == "2" ? 2 : digits == "8" ? 8 : 16;
    return std::string(of.content.substr(0, count));
  }
  if (field == "key8") {
    return text_hash(of.key).substr(0, 8);
  }
  return std::nullopt;
}

/// The template with its fields replaced by `value`.
std::string expanded(std::string_view text,
                     const std::function<std::string(std::string_view)>& value) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = text[i] == '{' ? text.find('}', i) : std::string_view::npos;
    if (text[i] == '{' && end == std::string_view::npos) {
      throw InvalidInput("--name: a { without its } in '" + std::string(text) + "'");
    }
    if (text[i] != '{') {
      result += text[i];
      continue;
    }
    result += value(text.substr(i + 1, end - i - 1));
    i = end;
  }
  return result;
}

}  // namespace

std::string key_of_path(std::string_view path) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string key;
  for (std::size_t i = 0; i < path.size();) {
    const std::size_t length = utf8_length(path, i);
    const auto byte = static_cast<unsigned char>(path[i]);
    if (length == 0) {
      key += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
    } else if (byte == '\\') {
      key += "\\\\";
    } else {
      key += path.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return key;
}

std::string path_of_key(std::string_view key) {
  const auto digit = [](char c) {
    return static_cast<unsigned>(c >= 'a' ? c - 'a' + 10 : c - '0') & 15U;
  };
  std::string path;
  for (std::size_t i = 0; i < key.size(); ++i) {
    if (key[i] != '\\') {
      path += key[i];
    } else if (i + 3 < key.size() && key[i + 1] == 'x') {
      path += static_cast<char>(digit(key[i + 2]) * 16U + digit(key[i + 3]));
      i += 3;
    } else {
      path += '\\';
      ++i;
    }
  }
  return path;
}

void check_template(std::string_view text, bool among_shards) {
  bool unique = false;
  const NameFields sample{.path = "a.ply", .name = "a", .key = "a", .content = "00"};
  const std::string shown = expanded(text, [&](std::string_view field) {
    if (!field_value(field, sample)) {
      throw InvalidInput("--name: {" + std::string(field) +
                         "} is none of {stem} {name} {ext} {parent} {hash2} {hash8} {hash16} "
                         "{hash} {key8}");
    }
    unique = unique || field == "hash8" || field == "hash16" || field == "hash" || field == "key8";
    return std::string("x");
  });
  if (shown.empty() || shown.front() == '/' || shown.back() == '/' ||
      shown.find("//") != std::string::npos) {
    throw InvalidInput("--name: '" + std::string(text) + "' has a part without a name");
  }
  if (among_shards && !unique) {
    throw InvalidInput(
        "--name: shards need {hash8}, {hash16}, {hash} or {key8} in the name, since "
        "they cannot see each other's folders");
  }
}

std::string folder_name(std::string_view text, const NameFields& fields) {
  // Values hold no slash, so only the template's own slashes make folders.
  const std::string filled = expanded(
      text, [&](std::string_view field) { return field_value(field, fields).value_or("_"); });
  std::string folder;
  std::size_t from = 0;
  while (from <= filled.size()) {
    const std::size_t slash = std::min(filled.find('/', from), filled.size());
    folder += (folder.empty() ? "" : "/") +
              safe_part(std::string_view(filled).substr(from, slash - from));
    from = slash + 1;
  }
  return folder;
}

}  // namespace vantage::batch
