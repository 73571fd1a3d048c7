// SPDX-License-Identifier: MIT
#include "io/mtl.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/number_parsing.h"
#include "io/obj_lines.h"

namespace vantage {
namespace {

/// The next number of a line; nothing, and the line left as it is, if no number comes next.
std::optional<double> next_number(std::string_view& rest) {
  std::string_view line = rest;
  const std::optional<double> value = number_from(take_token(line));
  if (!value || !std::isfinite(*value)) {
    return std::nullopt;
  }
  rest = line;
  return value;
}

double share(std::optional<double> value, double otherwise) {
  return value ? std::clamp(*value, 0.0, 1.0) : otherwise;
}

/// One to three numbers after an option; the third is of no use to pictures.
void read_pair(std::string_view& rest, std::array<double, 2>& pair) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> value = next_number(rest);
    if (value && i < 2) {
      pair[i] = *value;
    }
  }
}

/// Reads a map line: options, and what is left is the file's name, which may hold spaces.
MtlMap map_of(std::string_view rest) {
  MtlMap map;
  while (!trimmed(rest).empty() && trimmed(rest).front() == '-') {
    std::string_view line = rest;
    const std::string_view option = take_token(line);
    if (option == "-s") {
      read_pair(line, map.scale);
    } else if (option == "-o") {
      read_pair(line, map.offset);
    } else if (option == "-t") {
      std::array<double, 2> turbulence{};
      read_pair(line, turbulence);
    } else if (option == "-mm") {
      take_token(line);
      take_token(line);
    } else {
      const std::string_view value = take_token(line);
      map.clamp = option == "-clamp" ? value == "on" : map.clamp;
    }
    rest = line;
  }
  map.name = without_quotes(trimmed(rest));
  return map;
}

/// \param keyword in lower case: writers differ.
void read_line(std::string_view keyword, std::string_view rest, MtlMaterial& material) {
  if (keyword == "kd") {
    std::array<double, 3> colour{1.0, 1.0, 1.0};
    colour[0] = share(next_number(rest), -1.0);
    if (colour[0] >= 0.0) {  // not a spectral file
      colour[1] = share(next_number(rest), colour[0]);
      colour[2] = share(next_number(rest), colour[0]);
      material.colour = colour;
    }
  } else if (keyword == "d") {
    std::string_view line = rest;
    rest = take_token(line) == "-halo" ? line : rest;
    const std::optional<double> factor = next_number(rest);
    material.opacity = share(factor, material.opacity);
    material.has_d |= factor.has_value();
  } else if (keyword == "tr" && !material.has_d) {
    material.opacity = 1.0 - share(next_number(rest), 1.0 - material.opacity);
  } else if (keyword == "map_kd") {
    material.picture = map_of(rest);
  } else if (keyword == "map_d") {
    material.mask = map_of(rest);
  }
}

}  // namespace

std::map<std::string, MtlMaterial, std::less<>> parse_mtl(std::string_view text) {
  std::map<std::string, MtlMaterial, std::less<>> materials;
  ObjLines lines(text);
  MtlMaterial ignored;
  MtlMaterial* current = &ignored;
  while (const std::optional<std::string_view> line = lines.next()) {
    std::string_view rest = *line;
    const std::string keyword = lower_case(take_token(rest));
    if (keyword == "newmtl") {
      const auto [entry, is_new] = materials.try_emplace(std::string(trimmed(rest)));
      current = is_new ? &entry->second : &ignored;
    } else if (!keyword.empty()) {
      read_line(keyword, rest, *current);
    }
  }
  return materials;
}

}  // namespace vantage
