// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "vantage/core/error.h"

/// \file
/// One table per options struct: it drives the range check, the command line flags, their help
/// and the echo of the options in results, so that these cannot drift apart.

namespace vantage {

/// One number of an options struct: its name on the command line, where it lives, its range.
template <class Options, class Value>
struct Field {
  std::string_view name;   ///< Flag name without dashes, e.g. "contraction-growth".
  Value Options::*member;  ///< Where the value lives.
  Value low;               ///< Smallest allowed value.
  Value high;              ///< Largest allowed value.
  std::string_view help;   ///< One line: meaning, unit, source.
};

/// Deduces the struct and the type of the value; clang 14 needs it spelled out.
template <class Options, class Value>
Field(const char*, Value Options::*, std::type_identity_t<Value>, std::type_identity_t<Value>,
      const char*) -> Field<Options, Value>;

/// Calls `visit(field)` for each field of the table, in order.
template <class Table, class Visitor>
constexpr void for_each_field(const Table& table, Visitor&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, table);
}

/// Checks each field of `options` against its range; NaN is outside every range.
/// \throw InvalidInput naming the option, its value and its range.
template <class Options, class Table>
void check_fields(const Options& options, const Table& table) {
  for_each_field(table, [&](const auto& field) {
    const auto value = options.*(field.member);
    if (!(value >= field.low && value <= field.high)) {
      throw InvalidInput("option " + std::string(field.name) + " is " + std::to_string(value) +
                         " but must be between " + std::to_string(field.low) + " and " +
                         std::to_string(field.high));
    }
  });
}

}  // namespace vantage
