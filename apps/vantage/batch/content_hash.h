// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vantage::batch {

/// SHA-256 of the file as `sha256sum` prints it, if the model is one file. Those that it consists of
/// besides, see FilesBeside, are hashed after it, each after its name and a zero byte.
/// \throw IoError
std::string content_hash(const std::string& path);

/// SHA-256 of a text, 64 hexadecimal digits.
std::string text_hash(std::string_view text);

/// The first eight bytes of the SHA-256 of a text, big-endian: a number that stays the same on
/// every machine and in every version, for shards.
std::uint64_t stable_number(std::string_view text);

}  // namespace vantage::batch
