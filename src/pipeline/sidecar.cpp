// SPDX-License-Identifier: MIT
#include "vantage/pipeline/sidecar.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include <Eigen/Geometry>

#include "vantage/core/error.h"

#include "core/json_reader.h"
#include "io/files.h"

namespace vantage {
namespace {

constexpr std::size_t kLargest = std::size_t{64} * 1024;  // bytes

std::string_view checked_size(std::string_view bytes, std::string_view name) {
  if (bytes.size() > kLargest) {
    throw FormatError(name, "", "is longer than 64 KiB, too long for a sidecar");
  }
  return bytes;
}

class SidecarReader : JsonReader {
 public:
  SidecarReader(std::string_view bytes, std::string_view name)
      : JsonReader(checked_size(bytes, name), name) {}

  [[nodiscard]] Sidecar sidecar() const {
    if (!root().is_object()) {
      fail("must be an object like {\"up\": \"z\", \"front\": \"-y\"}");
    }
    Sidecar result;
    result.file = name();
    for (const auto& [member, value] : root().items()) {
      if (member == "up") {
        result.up = axis(value, member, kUpWords);
      } else if (member == "front") {
        result.front = axis(value, member, kFrontWords);
      } else if (member == "view") {
        result.view = unit_vector(value, "\"view\"");
      } else if (member == "style") {
        result.style = style(value);
      } else {
        fail("has the member \"" + member + "\"; known are up, front, view and style");
      }
    }
    if (result.up && result.up != UpAxis::Any && result.front &&
        std::abs(up_vector(*result.up).dot(up_vector(*result.front))) > 0.5) {
      fail("has up and front along the same axis");
    }
    return result;
  }

 private:
  /// Index of a word in "first|second|…".
  [[nodiscard]] std::optional<std::size_t> word(const Json& value, const char* words) const {
    return value.is_string() ? index_of_word(words, value.get<std::string>()) : std::nullopt;
  }

  /// \param words kUpWords or kFrontWords; their last is none.
  [[nodiscard]] std::optional<UpAxis> axis(const Json& value, const std::string& member,
                                           const char* words) const {
    const std::optional<std::size_t> index = word(value, words);
    if (!index) {
      fail("\"" + member + "\" must be one of x, y, z, -x, -y, -z, auto" +
           (member == "up" ? " and any" : ""));
    }
    const bool is_last = word_at(words, *index + 1) == word_at(words, *index);
    return is_last ? std::nullopt : std::optional(static_cast<UpAxis>(*index));
  }

  [[nodiscard]] Style style(const Json& value) const {
    const std::optional<std::size_t> index = word(value, "clay|asset|technical");
    if (!index) {
      fail("\"style\" must be one of clay, asset, technical");
    }
    return std::array{Style::Clay, Style::Asset, Style::Technical}[*index];
  }
};

/// Whether both are there and lie along one axis.
bool are_along(const std::optional<UpAxis>& a, const std::optional<UpAxis>& b) {
  return a && b && *a != UpAxis::Any && *b != UpAxis::Any &&
         up_vector(*a).cross(up_vector(*b)).isZero();
}

}  // namespace

void Sidecar::apply(ViewOptions& options) const {
  // An up along the front that is given has no room beside it, and the reverse.
  if (!options.up && !are_along(up, options.front)) {
    options.up = up;
  }
  if (!options.front && !are_along(front, options.up)) {
    options.front = front;
  }
  options.best_view = options.best_view ? options.best_view : view;
}

Sidecar parse_sidecar(std::string_view bytes, std::string_view name) {
  return SidecarReader(bytes, name).sidecar();
}

Sidecar sidecar_of(const std::string& model) {
  if (model == "-") {
    return {};
  }
  const std::filesystem::path path(model);
  const std::filesystem::path folder = path.parent_path();
  for (const std::filesystem::path& candidate :
       {std::filesystem::path(model + ".vantage.json"),
        folder / (path.stem().string() + ".vantage.json"), folder / "vantage.json"}) {
    std::error_code error;
    if (std::filesystem::exists(candidate, error)) {
      const std::uintmax_t size = std::filesystem::file_size(candidate, error);
      if (!error && size > kLargest) {
        throw FormatError(candidate.string(), "", "is longer than 64 KiB, too long for a sidecar");
      }
      return parse_sidecar(read_file(candidate.string()), candidate.string());
    }
  }
  return {};
}

}  // namespace vantage
