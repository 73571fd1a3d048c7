// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>

#include <archive.h>
#include <archive_entry.h>

/// A ZIP archive of these files, in the order of their names. \param is_packed by deflate
inline std::string zip_package(const std::map<std::string, std::string>& files, bool is_packed) {
  std::string bytes(1 << 16, '\0');
  std::size_t used = 0;
  archive* const zip = archive_write_new();
  archive_write_set_format_zip(zip);
  archive_write_set_options(zip, is_packed ? "zip:compression=deflate" : "zip:compression=store");
  archive_write_open_memory(zip, bytes.data(), bytes.size(), &used);
  archive_entry* const entry = archive_entry_new();
  for (const auto& [name, content] : files) {
    archive_entry_clear(entry);
    archive_entry_set_pathname(entry, name.c_str());
    archive_entry_set_size(entry, static_cast<la_int64_t>(content.size()));
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_write_header(zip, entry);
    archive_write_data(zip, content.data(), content.size());
  }
  archive_entry_free(entry);
  archive_write_close(zip);
  archive_write_free(zip);
  bytes.resize(used);
  return bytes;
}
