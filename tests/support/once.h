// SPDX-License-Identifier: MIT
#pragma once

#include <map>

namespace vantage::test {

/// What `make` returns for a key, made once a process. Each place that calls it has answers of its own, as each lambda
/// is a type of its own.
template <typename Key, typename Make>
const auto& once(const Key& key, const Make& make) {
  static std::map<Key, decltype(make())> known;
  const auto found = known.find(key);
  return found != known.end() ? found->second : known.emplace(key, make()).first->second;
}

}  // namespace vantage::test
