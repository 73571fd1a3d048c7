// SPDX-License-Identifier: MIT
// Any bytes as the view.json of a folder that is served (up to the first zero byte), and as the path
// of a request (the rest): a page, a file inside the folder, or nothing.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "vantage/core/error.h"

#include "batch/folder_site.h"
#include "scratch_folder.h"

namespace {

using vantage::batch::FolderSite;

std::ptrdiff_t tags(const std::string& page) {
  return std::count(page.begin(), page.end(), '<');
}

/// Of the index page of a folder with a plain result.
std::ptrdiff_t tags_of_plain_page() {
  const ScratchFolder folder;
  folder.write("view.json", R"({"vantage": "1", "model": {"name": "a"}, "best": {}})");
  return tags(FolderSite(folder.path().string()).find("/")->body);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ScratchFolder folder;
  static const std::string secret = folder.write("secret.png", "not for visitors");
  static const std::ptrdiff_t plain = tags_of_plain_page();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\0'), size);
  folder.write("site/view.json", text.substr(0, end));
  try {
    const FolderSite site((folder.path() / "site").string());
    const std::string request = "/" + std::string(text.substr(std::min(end + 1, size)));
    for (const std::string& path : {std::string("/"), request}) {
      const auto page = site.find(path);
      if (page && page->file && page->file->size() != std::min(end, text.size())) {
        std::abort();  // not the only file inside
      }
      if (page && path == "/" && tags(page->body) != plain) {
        std::abort();  // the file's words became markup
      }
    }
  } catch (const vantage::Error&) {
    return 0;
  }
  return 0;
}
