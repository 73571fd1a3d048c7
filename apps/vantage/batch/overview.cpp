// SPDX-License-Identifier: MIT
#include "batch/overview.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include "vantage/core/error.h"
#include "vantage/core/image.h"
#include "vantage/io/write.h"
#include "vantage/report/figures.h"

#include "batch/index_page.h"
#include "batch/json_text.h"
#include "batch/result_folders.h"
#include "batch/thumbnail.h"

namespace vantage::batch {
namespace {

constexpr std::size_t kRowsPerPage = 50'000;
constexpr int kTileColumns = 10;
constexpr int kRows = 8;
constexpr int kGap = 8;       // px around a thumbnail
constexpr int kCaption = 18;  // px, the name below it
constexpr int kTileHeight = kThumbnailSide + kCaption + kGap;
constexpr std::size_t kSheets = 250;  // sheets are looked at by people: more would not be

std::string page_name(std::size_t page) {
  return page == 0 ? "index.html" : "index-" + std::to_string(page + 1) + ".html";
}

std::string sheet_name(std::size_t sheet) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "contact-sheet-%04zu.png", sheet + 1);
  return name.data();
}

constexpr int width_of(int columns) {
  return columns * (kThumbnailSide + kGap) + kGap;
}

constexpr int kSheetWidth = width_of(kTileColumns);

/// Whether a file begins as a page of write_overview() does.
bool is_page(const ConfinedFolder& folder, const std::string& name) {
  constexpr std::size_t kEnough = 4096;
  return folder.beginning_of(name, kEnough).find("<title>Vantage: results</title>") !=
         std::string::npos;
}

/// Whether a file is a PNG of 8 bit RGBA of the size that only a contact sheet has.
bool is_sheet(const ConfinedFolder& folder, const std::string& name) {
  constexpr std::size_t kHeaderBytes = 26;
  const std::string head = folder.beginning_of(name, kHeaderBytes);
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) {
      value = (value & 0x7FFFFF) * 256 + static_cast<unsigned char>(head[i]);
    }
    return value;
  };
  if (head.size() != kHeaderBytes || !head.starts_with("\x89PNG\r\n\x1A\n") ||
      !head.ends_with("\x08\x06")) {
    return false;
  }
  const int width = number(16);
  const int height = number(20);
  if (width == kSheetWidth) {
    return height < kSheetWidth &&
           (height % kTileHeight == kGap ||
            height % (kThumbnailSide + kGap) == kGap);  // of version 0.1: without names
  }
  return width > kGap && width < kSheetWidth && width % (kThumbnailSide + kGap) == kGap &&
         height == kTileHeight + kGap;
}

using IsOurs = bool (*)(const ConfinedFolder&, const std::string&);

/// Refuses to replace somebody else's file.
void check_place(const ConfinedFolder& folder, const std::string& name, IsOurs is_ours) {
  if (folder.exists(name) && !is_ours(folder, name)) {
    throw IoError(folder.path_of(name),
                  "is not a file of vantage and would be replaced; move it away, or use "
                  "--no-overview");
  }
}

void write_checked(const ConfinedFolder& folder, const std::string& name, std::string_view bytes,
                   IsOurs is_ours) {
  check_place(folder, name, is_ours);
  folder.write(name, bytes);
}

/// Removes those of an earlier run from number `first` on.
void remove_pages(const ConfinedFolder& folder, std::size_t first) {
  while (is_page(folder, page_name(first)) && folder.remove(page_name(first))) {
    ++first;
  }
}

void remove_sheets(const ConfinedFolder& folder, std::size_t first) {
  while (is_sheet(folder, sheet_name(first)) && folder.remove(sheet_name(first))) {
    ++first;
  }
}

/// White sheets that fill with thumbnails.
class ContactSheets {
 public:
  explicit ContactSheets(const ConfinedFolder& folder) : folder_(folder) {}

  void add(const Image& thumbnail, const std::string& name) {
    if (sheet_ >= kSheets) {
      return;
    }
    if (image_.rgba.empty()) {
      image_.width = kSheetWidth;
      image_.height = kRows * kTileHeight + kGap;
      image_.rgba.assign(
          4 * static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height),
          255);
    }
    const int left = kGap + tile_ % kTileColumns * (kThumbnailSide + kGap);
    const int top = kGap + tile_ / kTileColumns * kTileHeight;
    place(thumbnail, left + (kThumbnailSide - thumbnail.width) / 2,
          top + (kThumbnailSide - thumbnail.height) / 2);
    place(caption(name, kThumbnailSide, kCaption), left, top + kThumbnailSide);
    if (++tile_ == kTileColumns * kRows) {
      write();
    }
  }

  /// Writes the last sheet, and removes those of an earlier, longer batch.
  void finish() {
    if (tile_ > 0) {
      write();
    }
    remove_sheets(folder_, sheet_);
  }

 private:
  void place(const Image& tile, int left, int top) {
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        const std::uint8_t* from = tile.pixel(x, y);
        const auto at =
            static_cast<std::size_t>(image_.pixel(left + x, top + y) - image_.rgba.data());
        for (std::size_t c = 0; c < 3; ++c) {
          const int over = from[c] * from[3] + 255 * (255 - from[3]);
          image_.rgba[at + c] = static_cast<std::uint8_t>((over + 127) / 255);
        }
      }
    }
  }

  void write() {
    // The last sheet is as wide and as long as it is full.
    image_.height = (tile_ + kTileColumns - 1) / kTileColumns * kTileHeight + kGap;
    narrow(width_of(std::min(tile_, kTileColumns)));
    image_.rgba.resize(4 * static_cast<std::size_t>(image_.width) *
                       static_cast<std::size_t>(image_.height));
    write_checked(folder_, sheet_name(sheet_), png_bytes(image_), is_sheet);
    image_.rgba.clear();
    tile_ = 0;
    ++sheet_;
  }

  /// Cuts off what is right of a width.
  void narrow(int width) {
    const auto from = static_cast<std::ptrdiff_t>(image_.width) * 4;
    const auto to = static_cast<std::ptrdiff_t>(width) * 4;
    const auto begin = image_.rgba.begin();
    for (int y = 1; width < image_.width && y < image_.height; ++y) {
      std::copy_n(begin + y * from, to, begin + y * to);
    }
    image_.width = width;
  }

  const ConfinedFolder& folder_;
  Image image_{};
  int tile_ = 0;
  std::size_t sheet_ = 0;
};

Statement table_rows(ResultsStore& store) {
  return store.select(
      "key, name, status, duplicate_of, error, folder, best_fraction, best_score, vertices, "
      "doubts",
      "", "");
}

/// The end of a path: of "a/b/cup.ply" and 2 parts "b/cup.ply", or "b/cup".
std::string tail_of(const std::string& key, std::size_t parts, bool keeps_extension) {
  std::size_t begin = key.size();
  for (std::size_t i = 0; i < parts && begin != std::string::npos && begin > 0; ++i) {
    begin = key.rfind('/', begin - 1);
  }
  const std::string tail = begin == std::string::npos ? key : key.substr(begin + 1);
  const std::size_t dot = tail.rfind('.');
  return keeps_extension || dot == std::string::npos || dot < tail.rfind('/') + 1
             ? tail
             : tail.substr(0, dot);
}

/// What models are called where they stand side by side: their names, or if several have one, as much
/// of the ends of their paths as tells them apart.
std::map<std::string, std::string> labels_of(ResultsStore& store) {
  std::map<std::string, std::vector<std::string>> keys_of_name;
  Statement rows = table_rows(store);
  for (std::size_t shown = 0; shown < kSheets * kTileColumns * kRows && rows.step();) {
    if (rows.text(2) == "done" && rows.text(3).empty()) {
      keys_of_name[rows.text(1)].push_back(rows.text(0));
      ++shown;
    }
  }
  std::map<std::string, std::string> labels;
  for (const auto& [name, keys] : keys_of_name) {
    // cup.ply, b/cup, b/cup.ply, a/b/cup, …
    constexpr std::size_t kMostSteps = 16;
    for (std::size_t step = 1; keys.size() > 1 && step < kMostSteps; ++step) {
      std::set<std::string> tails;
      for (const std::string& key : keys) {
        labels[key] = tail_of(key, step / 2 + 1, step % 2 == 1);
        tails.insert(labels[key]);
      }
      if (tails.size() == keys.size()) {
        break;
      }
    }
  }
  return labels;
}

/// One row of the page's table; index_page.cpp has the order of its cells.
std::string row_of(const Statement& row, const ConfinedFolder& root) {
  const std::string folder = ConfinedFolder::is_name(row.text(5)) ? row.text(5) : "";
  const auto shown = [&](const char* file, int bit) {
    return root.exists(model_folder(folder) + "/" + file) ? bit : 0;
  };
  const auto number = [&](int column) {
    return row.is_null(column) ? Json(nullptr) : Json(row.number(column));
  };
  const Json cells = Json::array(
      {row.text(0), row.text(1), row.text(2), row.text(3), row.text(4), url_path(folder), number(6),
       number(7), row.is_null(8) ? Json(nullptr) : Json(row.integer(8)),
       shown(kThumbnailFile, kHasThumbnail) | shown("best.png", kHasPicture) |
           shown("report.html", kHasReport) |
           (row.is_null(9) || row.integer(9) == 0 ? 0 : kIsDoubted)});
  return script_safe(json_text(cells));
}

/// The small picture of a model that was really run.
std::optional<Image> thumbnail_in(const Statement& row, const ConfinedFolder& root) {
  constexpr std::size_t kLargest = 1U << 20U;
  return row.text(3).empty()
             ? parse_png(
                   root.beginning_of(model_folder(row.text(5)) + "/" + kThumbnailFile, kLargest),
                   kThumbnailSide)
             : std::nullopt;
}

std::size_t page_count(const StatusCounts& counts) {
  const auto total = static_cast<std::size_t>(counts.done + counts.failed + counts.duplicates);
  return std::max<std::size_t>(1, (total + kRowsPerPage - 1) / kRowsPerPage);
}

std::vector<std::string> page_names(std::size_t pages) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < pages; ++i) {
    names.push_back(page_name(i));
  }
  return names;
}

void write_overview(const ConfinedFolder& folder, ResultsStore& store, const RunContext& run) {
  ContactSheets sheets(folder);
  const StatusCounts counts = store.counts();
  const auto total = static_cast<std::size_t>(counts.done + counts.failed + counts.duplicates);
  const std::size_t pages = page_count(counts);
  const std::map<std::string, std::string> labels = labels_of(store);
  Statement rows = table_rows(store);
  std::size_t done = 0;
  for (std::size_t page = 0; page < pages; ++page) {
    std::string data;
    for (std::size_t i = 0; i < kRowsPerPage && rows.step(); ++i) {
      run.advance("index", static_cast<double>(done++) / static_cast<double>(total + 1));
      if (const std::optional<Image> thumbnail = thumbnail_in(rows, folder)) {
        const auto label = labels.find(rows.text(0));
        sheets.add(*thumbnail, label == labels.end() ? rows.text(1) : label->second);
      }
      data += (data.empty() ? "" : ",\n") + row_of(rows, folder);
    }
    write_checked(folder, page_name(page), index_page(data, page_names(pages), page, counts),
                  is_page);
  }
  remove_pages(folder, pages);
  sheets.finish();
}

}  // namespace

void check_overview(const ConfinedFolder& folder) {
  check_place(folder, page_name(0), is_page);
  check_place(folder, sheet_name(0), is_sheet);
}

void renew_overview(const ConfinedFolder& folder, ResultsStore& store, bool wanted,
                    const RunContext& run) {
  const std::int64_t changes = store.changes();  // before: others may put more meanwhile
  if (wanted) {
    write_overview(folder, store, run);
  } else {
    remove_pages(folder, 0);
    remove_sheets(folder, 0);
  }
  store.note_overview(changes);
}

void update_overview(const ConfinedFolder& folder, ResultsStore& store, bool wanted,
                     const RunContext& run) {
  if (!store.has_overview() || (wanted && !folder.exists(page_name(0)))) {
    renew_overview(folder, store, wanted, run);
  }
}

std::optional<std::string> overview_page(const std::string& folder, ResultsStore& store,
                                         std::size_t page) {
  const StatusCounts counts = store.counts();
  const std::size_t pages = page_count(counts);
  if (page >= pages) {
    return std::nullopt;
  }
  const ConfinedFolder root(folder);
  Statement rows = table_rows(store);
  for (std::size_t i = 0; i < page * kRowsPerPage && rows.step(); ++i) {
  }
  std::string data;
  for (std::size_t i = 0; i < kRowsPerPage && rows.step(); ++i) {
    data += (data.empty() ? "" : ",\n") + row_of(rows, root);
  }
  return index_page(data, page_names(pages), page, counts);
}

}  // namespace vantage::batch
