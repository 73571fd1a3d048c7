// SPDX-License-Identifier: MIT
#include "batch/content_hash.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sodium.h>
#include <unistd.h>

#include "vantage/core/error.h"

namespace vantage::batch {
namespace {

using Digest = std::array<unsigned char, crypto_hash_sha256_BYTES>;

constexpr std::size_t kBlock = 1 << 18;
constexpr std::size_t kLargestGltf = 64U << 20U;  // a larger one is hashed without its buffers

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

/// Feeds a file to the hash; `copy` receives its bytes as long as they fit.
void feed(crypto_hash_sha256_state& state, const std::string& path, std::string* copy) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    throw IoError(path, "cannot be read", errno);
  }
  std::vector<unsigned char> block(kBlock);
  while (true) {
    const ssize_t got = ::read(file, block.data(), block.size());
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      const int error = got < 0 ? errno : 0;
      ::close(file);
      if (error != 0) {
        throw IoError(path, "cannot be read", error);
      }
      return;
    }
    const auto count = static_cast<std::size_t>(got);
    crypto_hash_sha256_update(&state, block.data(), count);
    if (copy != nullptr && copy->size() + count <= kLargestGltf) {
      copy->append(reinterpret_cast<const char*>(block.data()), count);
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

void feed_gltf_buffers(crypto_hash_sha256_state& state, const std::string& path,
                       const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) {
    return;
  }
  const auto folder = std::filesystem::path(path).parent_path();
  for (const auto& buffer : json["buffers"]) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) {
      continue;
    }
    const std::string uri = percent_decoded(buffer["uri"].get<std::string>());
    std::error_code error;
    const auto file = folder / uri;
    if (!uri.starts_with("data:") && std::filesystem::is_regular_file(file, error)) {
      feed(state, file.string(), nullptr);
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
  const bool gltf = extension == ".gltf";
  std::string text;
  feed(state, path, gltf ? &text : nullptr);
  if (gltf) {
    feed_gltf_buffers(state, path, text);
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
