// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

/// \file
/// Keys of models and names of the folders that hold their results.

namespace vantage::batch {

/// The key of a path: its bytes as UTF-8 text, where a backslash becomes `\\` and a byte that is
/// no UTF-8 becomes `\xHH`; one to one, so that path_of_key() gives the path back.
std::string key_of_path(std::string_view path);

/// The path behind a key_of_path().
std::string path_of_key(std::string_view key);

/// What a naming template may use.
struct NameFields {
  std::string_view path{};     ///< Of the model, or of its entry in an archive.
  std::string_view name{};     ///< From the manifest; empty: the stem.
  std::string_view key{};      ///< Identity of the model.
  std::string_view content{};  ///< SHA-256, hexadecimal.
};

/// Throws unless the template is fit for use: known fields, no empty or climbing parts.
/// \param among_shards whether several processes that cannot see each other name folders: then the
///        template must hold {hash8}, {hash16}, {hash} or {key8}.
/// \throw InvalidInput
void check_template(std::string_view text, bool among_shards);

/// The folder of a model's results, relative and below where it is put: each part between slashes
/// is made of letters, digits, `._-` and UTF-8 beyond ASCII, at most 150 bytes, never starts with
/// a dot or a dash. Fields: {stem} {name} {ext} {parent} {hash2} {hash8} {hash16} {hash} {key8}.
/// \pre check_template() passed.
std::string folder_name(std::string_view text, const NameFields& fields);

}  // namespace vantage::batch
