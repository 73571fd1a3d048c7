// SPDX-License-Identifier: MIT
#include "batch/overview.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "vantage/core/image.h"
#include "vantage/io/write.h"

#include "batch/index_page.h"
#include "batch/runner.h"
#include "batch/thumbnail.h"

namespace vantage::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kRowsPerPage = 50'000;
constexpr int kColumns = 10;
constexpr int kRows = 8;
constexpr int kGap = 8;               // px around a thumbnail
constexpr std::size_t kSheets = 250;  // sheets are looked at by people: more would not be

std::string page_name(std::size_t page) {
  return page == 0 ? "index.html" : "index-" + std::to_string(page + 1) + ".html";
}

std::string sheet_name(std::size_t sheet) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "contact-sheet-%04zu.png", sheet + 1);
  return name.data();
}

/// White sheets that fill with thumbnails.
class ContactSheets {
 public:
  explicit ContactSheets(std::string folder) : folder_(std::move(folder)) {}

  void add(const Image& thumbnail) {
    if (sheet_ >= kSheets) {
      return;
    }
    if (image_.rgba.empty()) {
      image_.width = kColumns * (kThumbnailSide + kGap) + kGap;
      image_.height = kRows * (kThumbnailSide + kGap) + kGap;
      image_.rgba.assign(
          4 * static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height),
          255);
    }
    place(thumbnail, kGap + tile_ % kColumns * (kThumbnailSide + kGap),
          kGap + tile_ / kColumns * (kThumbnailSide + kGap));
    if (++tile_ == kColumns * kRows) {
      write();
    }
  }

  /// Writes the last sheet, and removes those of an earlier, longer batch. \return how many.
  std::size_t finish() {
    if (tile_ > 0) {
      write();
    }
    std::error_code error;
    for (std::size_t old = sheet_; fs::remove(fs::path(folder_) / sheet_name(old), error); ++old) {
    }
    return sheet_;
  }

 private:
  void place(const Image& thumbnail, int left, int top) {
    left += (kThumbnailSide - thumbnail.width) / 2;
    top += (kThumbnailSide - thumbnail.height) / 2;
    for (int y = 0; y < thumbnail.height; ++y) {
      for (int x = 0; x < thumbnail.width; ++x) {
        const std::uint8_t* from = thumbnail.pixel(x, y);
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
    // The last sheet is as long as it is full.
    image_.height = (tile_ + kColumns - 1) / kColumns * (kThumbnailSide + kGap) + kGap;
    image_.rgba.resize(4 * static_cast<std::size_t>(image_.width) *
                       static_cast<std::size_t>(image_.height));
    write_file((fs::path(folder_) / sheet_name(sheet_)).string(), png_bytes(image_));
    image_.rgba.clear();
    tile_ = 0;
    ++sheet_;
  }

  std::string folder_;
  Image image_{};
  int tile_ = 0;
  std::size_t sheet_ = 0;
};

/// One row of the page's table; see kIndexScript for the order of its cells.
Json row_of(const Statement& row, const fs::path& place) {
  std::error_code error;
  const bool has_folder = !row.text(5).empty();
  const auto shown = [&](const char* file, int bit) {
    return has_folder && fs::exists(place / file, error) ? bit : 0;
  };
  const auto number = [&](int column) {
    return row.is_null(column) ? Json(nullptr) : Json(row.number(column));
  };
  return Json::array({row.text(0), row.text(1), row.text(2), row.text(3), row.text(4), row.text(5),
                      number(6), number(7), row.is_null(8) ? Json(nullptr) : Json(row.integer(8)),
                      shown(kThumbnailFile, kHasThumbnail) | shown("best.png", kHasPicture) |
                          shown("report.html", kHasReport)});
}

Statement table_rows(ResultsStore& store) {
  return store.select(
      "key, name, status, duplicate_of, error, folder, best_fraction, best_score, vertices", "",
      "");
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

}  // namespace

Overview write_overview(const std::string& folder, ResultsStore& store, const RunContext& run) {
  ContactSheets sheets(folder);
  const StatusCounts counts = store.counts();
  const auto total = static_cast<std::size_t>(counts.done + counts.failed + counts.duplicates);
  const std::size_t pages = page_count(counts);
  Statement rows = table_rows(store);
  std::size_t done = 0;
  for (std::size_t page = 0; page < pages; ++page) {
    std::string data;
    for (std::size_t i = 0; i < kRowsPerPage && rows.step(); ++i) {
      run.advance("index", static_cast<double>(done++) / static_cast<double>(total + 1));
      const fs::path place = fs::path(models_folder(folder)) / rows.text(5);
      const auto thumbnail = !rows.text(5).empty() && rows.text(3).empty()
                                 ? read_png((place / kThumbnailFile).string(), kThumbnailSide)
                                 : std::nullopt;
      if (thumbnail) {
        sheets.add(*thumbnail);
      }
      data += (data.empty() ? "" : ",\n") + script_safe(row_of(rows, place).dump());
    }
    write_file((fs::path(folder) / page_name(page)).string(),
               index_page(data, page_names(pages), page, counts));
  }
  std::error_code error;
  for (std::size_t old = pages; fs::remove(fs::path(folder) / page_name(old), error); ++old) {
  }
  return {pages, sheets.finish()};
}

std::optional<std::string> overview_page(const std::string& folder, ResultsStore& store,
                                         std::size_t page) {
  const StatusCounts counts = store.counts();
  const std::size_t pages = page_count(counts);
  if (page >= pages) {
    return std::nullopt;
  }
  Statement rows = table_rows(store);
  for (std::size_t i = 0; i < page * kRowsPerPage && rows.step(); ++i) {
  }
  std::string data;
  for (std::size_t i = 0; i < kRowsPerPage && rows.step(); ++i) {
    const fs::path place = fs::path(models_folder(folder)) / rows.text(5);
    data += (data.empty() ? "" : ",\n") + script_safe(row_of(rows, place).dump());
  }
  return index_page(data, page_names(pages), page, counts);
}

}  // namespace vantage::batch
