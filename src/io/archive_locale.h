// SPDX-License-Identifier: MIT
#pragma once

#include <locale.h>

namespace vantage {

/// While it lives, libarchive can hand names beyond ASCII over: it converts what an archive says is UTF-8
/// to the characters of the thread's locale, and gives no name at all where that has none for them. Only
/// characters are changed, of this thread alone: numbers keep their point, other threads their locale.
class ArchiveLocale {
 public:
  ArchiveLocale() : utf8_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
    if (utf8_ != nullptr) {
      before_ = ::uselocale(utf8_);
    }
  }

  ArchiveLocale(const ArchiveLocale&) = delete;
  ArchiveLocale& operator=(const ArchiveLocale&) = delete;

  ~ArchiveLocale() {
    if (utf8_ != nullptr) {
      ::uselocale(before_);
      ::freelocale(utf8_);
    }
  }

 private:
  locale_t utf8_;
  locale_t before_ = nullptr;
};

}  // namespace vantage
