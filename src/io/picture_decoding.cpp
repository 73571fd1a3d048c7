// SPDX-License-Identifier: MIT
#include "io/picture_decoding.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <png.h>
#include <webp/decode.h>

namespace vantage {
namespace {

/// A transparent picture of a size that was checked.
Image blank(std::size_t width, std::size_t height) {
  return {static_cast<int>(width), static_cast<int>(height),
          std::vector<std::uint8_t>(4 * width * height)};
}

/// Without what says how light its numbers mean, if it says so: in textures they are sRGB, whatever it says
/// (glTF 2.0, 3.9.2; other formats by custom).
std::optional<std::string> without_colour_space(std::string_view png) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kFrame = 12;  // length, name and checksum of a chunk
  std::string rest;
  std::size_t kept = 0;  // up to here of `png`
  for (std::size_t at = kSignature; at + kFrame <= png.size();) {
    const std::string_view name = png.substr(at + 4, 4);
    std::size_t length = kFrame;
    for (std::size_t i = 0; i < 4; ++i) {
      length += std::size_t{static_cast<std::uint8_t>(png[at + i])} << (24 - 8 * i);
    }
    if (name == "IDAT" || length > png.size() - at) {
      break;
    }
    if (name == "gAMA" || name == "cHRM" || name == "iCCP") {
      rest += png.substr(kept, at - kept);
      kept = at + length;
    }
    at += length;
  }
  return kept == 0 ? std::nullopt : std::optional(rest.append(png.substr(kept)));
}

}  // namespace

std::string picture_size_problem(std::size_t width, std::size_t height, std::size_t most_pixels) {
  constexpr std::size_t kSide = kLargestPictureSide;
  if (width == 0 || height == 0) {
    return "is empty";
  }
  const bool is_too_large = width > kSide || height > kSide || width * height > kMostPicturePixels;
  if (is_too_large || width * height > most_pixels) {
    return "is too large with " + std::to_string(width) + " × " + std::to_string(height) +
           " pixels" + (is_too_large ? "" : " beside the model's other pictures");
  }
  return {};
}

DecodedPicture decode_png(std::string_view bytes, std::size_t most_pixels) {
  const std::optional<std::string> plain = without_colour_space(bytes);
  bytes = plain ? *plain : bytes;
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    return {std::nullopt, std::string("is not a sound PNG: ") + png.message};
  }
  if (std::string problem = picture_size_problem(png.width, png.height, most_pixels);
      !problem.empty()) {
    png_image_free(&png);
    return {std::nullopt, std::move(problem)};
  }
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  png.format = PNG_FORMAT_RGBA;
  const std::size_t pixels = std::size_t{png.width} * png.height;
  Image image = blank(png.width, png.height);
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    return {std::nullopt, std::string("is not a sound PNG: ") + png.message, pixels};
  }
  return {std::move(image), {}, pixels};
}

DecodedPicture decode_webp(std::string_view bytes, std::size_t most_pixels) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  int width = 0;
  int height = 0;
  if (WebPGetInfo(data, bytes.size(), &width, &height) == 0 || width < 1 || height < 1) {
    return {std::nullopt, "is not a sound WebP"};
  }
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  if (std::string problem = picture_size_problem(columns, rows, most_pixels); !problem.empty()) {
    return {std::nullopt, std::move(problem)};
  }
  Image image = blank(columns, rows);
  if (WebPDecodeRGBAInto(data, bytes.size(), image.rgba.data(), image.rgba.size(), 4 * width) ==
      nullptr) {
    return {std::nullopt, "is not a sound WebP", columns * rows};
  }
  return {std::move(image), {}, columns * rows};
}

DecodedPicture decode_picture(std::string_view bytes, std::size_t most_pixels, int wanted_side) {
  if (bytes.starts_with("\x89PNG")) {
    return decode_png(bytes, most_pixels);
  }
  if (bytes.starts_with("\xFF\xD8")) {
    return decode_jpeg(bytes, most_pixels, wanted_side);
  }
  if (bytes.starts_with("RIFF") &&
      bytes.substr(std::min<std::size_t>(8, bytes.size()), 4) == "WEBP") {
    return decode_webp(bytes, most_pixels);
  }
  return {std::nullopt, "is neither PNG nor JPEG nor WebP; convert it to one of these"};
}

}  // namespace vantage
