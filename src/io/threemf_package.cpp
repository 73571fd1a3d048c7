// SPDX-License-Identifier: MIT
#include "io/threemf_package.h"

#include <array>
#include <cstddef>
#include <memory>
#include <new>

#include <archive.h>
#include <archive_entry.h>

#include "io/archive_locale.h"
#include "io/gltf_uri.h"
#include "io/number_parsing.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

/// Bytes of text that may come out for each byte of the archive: real models have up to 20, and a
/// grid of zeros 60 [ours] …
constexpr std::size_t kMostTextPerByte = 100;
/// … and in any case. [ours]
constexpr std::size_t kMostTextOfSmallFile = 64'000'000;
/// Parts of a package; slicers write a dozen. [ours]
constexpr std::size_t kMostParts = 100'000;
constexpr std::size_t kBlock = 1 << 16;

struct CloseArchive {
  void operator()(archive* a) const { archive_read_free(a); }
};

using Reader = std::unique_ptr<archive, CloseArchive>;

std::string reason_of(archive* a) {
  const char* text = archive_error_string(a);
  return text == nullptr ? std::string("the archive is damaged") : in_quotes(text);
}

/// 3MF allows no other ways to pack, and some of them reserve gigabytes.
bool is_plain_or_deflated(archive* a) {
  const char* name = archive_format_name(a);
  const std::string_view way = name == nullptr ? "" : name;
  return way.find("(uncompressed)") != std::string_view::npos ||
         way.find("(deflation)") != std::string_view::npos;
}

/// Hands the entry at hand to the sink. \return how many bytes came out
std::size_t read_part(archive* a, const std::string& name, const PartSink& sink, std::size_t most,
                      const ModelBuilder& builder) {
  if (!is_plain_or_deflated(a)) {
    builder.fail("part " + in_quotes(name) +
                 " is packed in a way that is not read; write it with deflate");
  }
  std::array<char, kBlock> block{};
  std::size_t total = 0;
  for (;;) {
    const la_ssize_t got = archive_read_data(a, block.data(), block.size());
    if (got == 0) {
      break;
    }
    if (got < 0) {
      builder.fail("part " + in_quotes(name) + " cannot be unpacked: " + reason_of(a));
    }
    total += static_cast<std::size_t>(got);
    if (total > most) {
      builder.fail("unpacks to more than the size of the file allows");
    }
    sink.piece({block.data(), static_cast<std::size_t>(got)});
  }
  sink.end();
  return total;
}

}  // namespace

bool is_threemf(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04") &&
         bytes.find("3D/3dmodel.model") != std::string_view::npos;
}

std::string part_name(std::string_view name) {
  const std::string_view relative = name.starts_with('/') ? name.substr(1) : name;
  return lower_case(decode_percent(relative).value_or(std::string(relative)));
}

void read_package(std::string_view bytes, const PartSink& sink, const ModelBuilder& builder) {
  const ArchiveLocale names_beyond_ascii;
  const Reader reader(archive_read_new());
  if (reader == nullptr) {
    throw std::bad_alloc();
  }
  archive* const a = reader.get();
  archive_read_support_format_zip(a);
  if (archive_read_open_memory(a, bytes.data(), bytes.size()) != ARCHIVE_OK) {
    builder.fail("is no ZIP archive: " + reason_of(a));
  }
  std::size_t left = kMostTextOfSmallFile + kMostTextPerByte * bytes.size();
  archive_entry* entry = nullptr;
  int code = ARCHIVE_OK;
  for (std::size_t parts = 0;
       (code = archive_read_next_header(a, &entry)) == ARCHIVE_OK || code == ARCHIVE_WARN;
       ++parts) {
    if (parts == kMostParts) {
      builder.fail("the archive has more than " + std::to_string(kMostParts) + " parts");
    }
    const char* raw = archive_entry_pathname(entry);
    const std::string name = part_name(raw == nullptr ? "" : raw);
    if (archive_entry_filetype(entry) == AE_IFREG && sink.begin(name)) {
      left -= read_part(a, name, sink, left, builder);
    }
  }
  if (code != ARCHIVE_EOF) {
    builder.fail("the archive is damaged: " + reason_of(a));
  }
}

}  // namespace vantage
