// SPDX-License-Identifier: MIT
#include "report/report_page.h"

#include <cstddef>

#ifdef VANTAGE_REPORT_PAGE

// The assembler reads the file: six hundred kilobytes as a C++ array would take it seconds.
// NOLINTNEXTLINE(hicpp-no-assembler): there is no #embed in C++20
__asm__(
    ".section .rodata\n"
    ".global vantage_report_page_begin\n"
    ".global vantage_report_page_end\n"
    "vantage_report_page_begin:\n"
    ".incbin \"" VANTAGE_REPORT_PAGE
    "\"\n"
    "vantage_report_page_end:\n"
    ".byte 0\n"
    ".previous\n");

// Symbols of the assembler: C's spelling, not ours.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" const char vantage_report_page_begin[];
extern "C" const char vantage_report_page_end[];

// NOLINTEND(readability-identifier-naming)

namespace vantage {

std::string_view report_page() {
  return {vantage_report_page_begin,
          static_cast<std::size_t>(vantage_report_page_end - vantage_report_page_begin)};
}

}  // namespace vantage

#else

namespace vantage {

std::string_view report_page() {
  return {};
}

}  // namespace vantage

#endif
