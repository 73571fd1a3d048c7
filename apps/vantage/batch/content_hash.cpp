// SPDX-License-Identifier: MIT
#include "batch/content_hash.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "vantage/core/error.h"

#include "batch/descriptor.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;
using Digest = std::array<unsigned char, crypto_hash_sha256_BYTES>;

constexpr std::size_t kBlock = 1 << 18;
constexpr std::size_t kLargestGltf = 64U << 20U;  // a larger one is hashed without its buffers
constexpr std::size_t kObjHead = 1U << 20U;       // where an OBJ names its materials
constexpr std::size_t kLargestMtl = 4U << 20U;    // a larger one is hashed without its pictures

std::string hexadecimal(const Digest& digest) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

Digest digest_of(std::string_view text) {
  Digest digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size());
  return digest;
}

/// Opens a regular file, and waits for nothing: a pipe or a device might never end.
Descriptor opened(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));

  struct stat status {};

  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) {
    throw IoError(path, "cannot be read", errno);
  }
  if (!S_ISREG(status.st_mode)) {
    throw IoError(path, "is not a regular file, and no model is read from others");
  }
  return file;
}

/// Feeds a file to the hash; `copy` receives its bytes as long as they fit.
void feed(crypto_hash_sha256_state& state, const Descriptor& file, const std::string& path,
          std::string* copy, std::size_t most = kLargestGltf) {
  std::vector<unsigned char> block(kBlock);
  while (true) {
    const ssize_t got = ::read(file.number(), block.data(), block.size());
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      throw IoError(path, "cannot be read", errno);
    }
    if (got == 0) {
      return;
    }
    const auto count = static_cast<std::size_t>(got);
    crypto_hash_sha256_update(&state, block.data(), count);
    if (copy != nullptr && copy->size() < most) {
      copy->append(reinterpret_cast<const char*>(block.data()),
                   std::min(count, most - copy->size()));
    }
  }
}

/// "a%20b.bin" → "a b.bin".
std::string percent_decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto digit = [&](std::size_t at) -> int {
      const char c = at < uri.size() ? uri[at] : '\0';
      return c >= '0' && c <= '9'   ? c - '0'
             : c >= 'a' && c <= 'f' ? c - 'a' + 10
             : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                    : -1;
    };
    if (uri[i] == '%' && digit(i + 1) >= 0 && digit(i + 2) >= 0) {
      text += static_cast<char>(digit(i + 1) * 16 + digit(i + 2));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// Where a buffer is; empty unless that is in the model's folder or below, also behind all links.
/// What the reader refuses for its looks alone, a scheme or "..", never gets further than that.
std::string place_inside(const fs::path& folder, const std::string& uri) {
  std::error_code error;
  const fs::path place = fs::canonical(folder / percent_decoded(uri), error);
  const fs::path inside = error ? fs::path() : place.lexically_relative(folder);
  return inside.empty() || *inside.begin() == ".." ? "" : place.string();
}

/// Feeds files that a model names, each once.
class FilesBeside {
 public:
  FilesBeside(crypto_hash_sha256_state& state, const std::string& model) : state_(&state) {
    std::error_code error;
    folder_ = fs::canonical(fs::absolute(model).parent_path(), error);
  }

  /// \return the first bytes of the file, at most `most`.
  std::string feed_named(const std::string& uri, std::size_t most = 0) {
    std::string head;
    const std::string place = uri.starts_with("data:") ? "" : place_inside(folder_, uri);
    if (!place.empty() && fed_.insert(place).second) {
      try {
        feed(*state_, opened(place), place, most > 0 ? &head : nullptr, most);
      } catch (const IoError&) {  // the reader will say what is wrong with it
      }
    }
    return head;
  }

 private:
  crypto_hash_sha256_state* state_;
  fs::path folder_{};
  std::set<std::string> fed_{};
};

/// The buffers and pictures of a glTF.
void feed_gltf_files(crypto_hash_sha256_state& state, const std::string& path,
                     const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  FilesBeside beside(state, path);
  for (const char* const list : {"buffers", "images"}) {
    if (!json.is_object() || !json.contains(list) || !json[list].is_array()) {
      continue;
    }
    for (const auto& file : json[list]) {
      if (file.is_object() && file.contains("uri") && file["uri"].is_string()) {
        beside.feed_named(file["uri"].get_ref<const std::string&>());
      }
    }
  }
}

/// What follows one of the words at the beginning of lines.
std::vector<std::string> values_of(const std::string& text,
                                   std::initializer_list<std::string_view> words) {
  std::vector<std::string> values;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(" \t");
    const std::size_t blank = std::min(line.find_first_of(" \t", begin), line.size());
    const std::size_t value = line.find_first_not_of(" \t", blank);
    if (begin == std::string::npos || value == std::string::npos) {
      continue;
    }
    const std::string_view word = std::string_view(line).substr(begin, blank - begin);
    if (std::find(words.begin(), words.end(), word) != words.end()) {
      values.push_back(line.substr(value, line.find_last_not_of(" \t\r") + 1 - value));
    }
  }
  return values;
}

/// The material libraries of an OBJ, and the pictures that these name, in the model's folder.
void feed_obj_files(crypto_hash_sha256_state& state, const std::string& path,
                    const std::string& head) {
  FilesBeside beside(state, path);
  for (const std::string& library : values_of(head, {"mtllib"})) {
    for (std::string picture :
         values_of(beside.feed_named(library, kLargestMtl), {"map_Kd", "map_d"})) {
      std::replace(picture.begin(), picture.end(), '\\', '/');
      beside.feed_named(picture);
      beside.feed_named(picture.substr(picture.find_last_of(" /") + 1));  // without options, folder
    }
  }
}

}  // namespace

std::string content_hash(const std::string& path) {
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  const bool is_gltf = extension == ".gltf";
  const bool is_obj = extension == ".obj";
  std::string text;
  feed(state, opened(path), path, is_gltf || is_obj ? &text : nullptr,
       is_gltf ? kLargestGltf : kObjHead);
  if (is_gltf) {
    feed_gltf_files(state, path, text);
  } else if (is_obj) {
    feed_obj_files(state, path, text);
  }
  Digest digest{};
  crypto_hash_sha256_final(&state, digest.data());
  return hexadecimal(digest);
}

std::string text_hash(std::string_view text) {
  return hexadecimal(digest_of(text));
}

std::uint64_t stable_number(std::string_view text) {
  const Digest digest = digest_of(text);
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    number = (number << 8U) | digest[i];
  }
  return number;
}

}  // namespace vantage::batch
