// SPDX-License-Identifier: MIT
#include "picture_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <CLI/CLI.hpp>

#include "vantage/io/write.h"

#include "output_file.h"

namespace vantage::cli {
namespace {

constexpr std::array<std::string_view, 12> kOtherFormats{".jpg",  ".jpeg", ".gif",  ".tif",
                                                         ".tiff", ".bmp",  ".avif", ".svg",
                                                         ".pdf",  ".exr",  ".tga",  ".ppm"};

}  // namespace

std::string checked_picture_name(const std::string& path, const std::string& option) {
  const std::string extension = suffix_of(path);
  if (std::find(kOtherFormats.begin(), kOtherFormats.end(), extension) != kOtherFormats.end()) {
    throw CLI::ValidationError(option, "pictures are written as .png or .webp, not " + extension +
                                           "; convert one of these");
  }
  return path;
}

std::string picture_bytes(const std::string& path, const Image& image) {
  return suffix_of(path) == ".webp" ? webp_bytes(image) : png_bytes(image);
}

void check_sides(const std::string& path, int width, int height, const std::string& option) {
  constexpr int kLargest = 16383;  // of the format, px
  if (suffix_of(path) == ".webp" && std::max(width, height) > kLargest) {
    throw CLI::ValidationError(
        option, "a WebP has sides of at most " + std::to_string(kLargest) + " pixels, not " +
                    std::to_string(std::max(width, height)) + "; write a PNG");
  }
}

void check_depth(const std::string& path, int depth) {
  if (depth != 8 && suffix_of(path) == ".webp") {
    throw CLI::ValidationError("--depth", "a WebP has 8 bits a channel; write a PNG");
  }
}

}  // namespace vantage::cli
