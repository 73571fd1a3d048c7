// SPDX-License-Identifier: MIT
#include "core/loaded_code.h"

#include <cstddef>

#include <link.h>

#include "core/fingerprint.h"

namespace vantage {
namespace {

struct Search {
  const void* place = nullptr;
  std::uintptr_t address = 0;  // of the place
  std::uint64_t hash = 0;
};

bool holds(const dl_phdr_info& object, const ElfW(Phdr) & part, std::uintptr_t address) {
  const std::uintptr_t begin = object.dlpi_addr + part.p_vaddr;
  return part.p_type == PT_LOAD && address >= begin && address - begin < part.p_memsz;
}

/// Reads what lies between variables too, which the address sanitizer would take for a mistake.
/// \return 1, which ends the walk, at the object that holds the address.
[[gnu::no_sanitize_address]] int hash_if_it_holds(dl_phdr_info* object, std::size_t /*size*/,
                                                  void* data) {
  auto& search = *static_cast<Search*>(data);
  bool is_here = false;
  for (std::size_t i = 0; i < object->dlpi_phnum; ++i) {
    is_here |= holds(*object, object->dlpi_phdr[i], search.address);
  }
  if (!is_here) {
    return 0;
  }
  Fingerprint fingerprint;
  for (std::size_t i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_W) != 0 || (part.p_flags & PF_R) == 0) {
      continue;
    }
    const auto before =
        static_cast<std::ptrdiff_t>(search.address - (object->dlpi_addr + part.p_vaddr));
    const unsigned char* bytes = static_cast<const unsigned char*>(search.place) - before;
    for (std::size_t k = 0; k < part.p_filesz; ++k) {
      fingerprint.add(bytes[k]);
    }
  }
  search.hash = fingerprint.value();
  return 1;
}

}  // namespace

std::uint64_t loaded_code(const void* address) {
  Search search{address, reinterpret_cast<std::uintptr_t>(address)};
  dl_iterate_phdr(hash_if_it_holds, &search);
  return search.hash;
}

std::uint64_t loaded_code() {
  static const char kHere = 0;
  static const std::uint64_t kHash = loaded_code(&kHere);
  return kHash;
}

}  // namespace vantage
