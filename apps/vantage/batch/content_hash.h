// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/io/import_stream.h"

#include "batch/model_record.h"

namespace vantage::batch {

/// What a model consists of.
struct Content {
  std::string hash{};                 ///< 64 hexadecimal digits.
  std::vector<StampBeside> beside{};  ///< The files besides its own, before they were hashed, and
                                      ///< those that are not there.
};

/// Names the pictures of the model of which content is wanted, see pictures_beside().
using PicturesOfImport = std::function<std::vector<std::string>(const ImportFormat& format)>;

/// SHA-256 of the file as `sha256sum` prints it, if the model is one file. Those that it consists of
/// besides, see FilesBeside, are hashed after it, each after its name and a zero byte.
/// \param pictures asked of an imported model. \throw IoError
Content content_of(const std::string& path, const PicturesOfImport& pictures = {});

/// SHA-256 of a text, 64 hexadecimal digits.
std::string text_hash(std::string_view text);

/// The first eight bytes of the SHA-256 of a text, big-endian: a number that stays the same on
/// every machine and in every version, for shards.
std::uint64_t stable_number(std::string_view text);

}  // namespace vantage::batch
