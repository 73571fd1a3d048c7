// SPDX-License-Identifier: MIT
#include "batch/content_hash.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "batch/descriptor.h"
#include "batch/file_stamp.h"
#include "batch/naming.h"

namespace vantage::batch {
namespace {

using Digest = std::array<unsigned char, crypto_hash_sha256_BYTES>;

constexpr std::size_t kBlock = 1 << 18;

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

/// Feeds a file to the hash, and what passes to `see`.
template <class See>
void feed(crypto_hash_sha256_state& state, const std::string& path, const See& see) {
  const Descriptor file = opened(path);
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
    see(std::string_view(reinterpret_cast<const char*>(block.data()), count));
  }
}

/// Feeds a file that the model names, with its name: one file may be there for another.
void feed_beside(crypto_hash_sha256_state& state, const FileBeside& file) {
  crypto_hash_sha256_update(&state, reinterpret_cast<const unsigned char*>(file.name.c_str()),
                            file.name.size() + 1);
  try {
    feed(state, file.path, [](std::string_view) {});
  } catch (const IoError&) {  // the reader will say what is wrong with it
  }
}

}  // namespace

Content content_of(const std::string& path, const PicturesOfImport& pictures) {
  Content content;
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  FilesBeside beside(path);
  feed(state, path, [&](std::string_view bytes) { beside.pass(bytes); });
  if (const ImportFormat* const format = beside.import_as(); format != nullptr && pictures) {
    beside.add_pictures(pictures(*format));
  }
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(path).parent_path();  // links resolved, as below
  for (const FileBeside& file : beside.find()) {
    if (file.path.empty()) {
      content.beside.push_back({key_of_path(file.name), {}});
      continue;
    }
    const std::filesystem::path place = std::filesystem::path(file.path).lexically_relative(folder);
    content.beside.push_back({key_of_path(place.string()), stamp_of(file.path)});
    feed_beside(state, file);
  }
  Digest digest{};
  crypto_hash_sha256_final(&state, digest.data());
  content.hash = hexadecimal(digest);
  return content;
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
