// SPDX-License-Identifier: MIT
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <png.h>
#include <zlib.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

namespace vantage {
namespace {

// Pictures are smooth or flat: a pixel differs little from the one above it, and runs of no difference
// are all that is worth a search. Six of 480 000 pixels take 46 ms and 1.42 MB so; with differences
// from the left and zlib's level 3 they take 91 ms and 1.51 MB, with level 6 240 ms and 1.32 MB.
constexpr int kCompressionLevel = 1;

/// What libpng's callbacks share; it reports errors by a long jump past C++ frames.
struct PngOutput {
  std::string bytes{};
  std::string problem{};
};

void append_bytes(png_structp png, png_bytep data, std::size_t count) {
  auto* output = static_cast<PngOutput*>(png_get_io_ptr(png));
  output->bytes.append(reinterpret_cast<const char*>(data), count);
}

void flush_nothing(png_structp /*png*/) {}

[[noreturn]] void keep_error(png_structp png, png_const_charp message) {
  static_cast<PngOutput*>(png_get_error_ptr(png))->problem = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

struct PngSize {
  std::size_t width = 0;
  std::size_t height = 0;
  int depth = 8;  ///< Bits a channel.
};

/// Writes the picture; false after an error. Holds no object with a destructor, because libpng
/// leaves it by a long jump.
bool encode(png_structp png, png_infop info, const PngSize& size, png_bytepp rows,
            PngOutput* output) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_write_fn(png, output, append_bytes, flush_nothing);
  png_set_compression_level(png, kCompressionLevel);
  png_set_compression_strategy(png, Z_RLE);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_set_IHDR(png, info, static_cast<png_uint_32>(size.width),
               static_cast<png_uint_32>(size.height), size.depth, PNG_COLOR_TYPE_RGB_ALPHA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, nullptr);
  return true;
}

/// \param samples big-endian if they are of 16 bit.
std::string png_of(const PngSize& size, const png_byte* samples) {
  const std::size_t stride = 4 * size.width * static_cast<std::size_t>(size.depth) / 8;
  std::vector<png_bytep> rows(size.height);
  for (std::size_t y = 0; y < size.height; ++y) {
    rows[y] = const_cast<png_bytep>(samples + stride * y);  // libpng only reads them
  }
  PngOutput output;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, keep_error, ignore_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool done = info != nullptr && encode(png, info, size, rows.data(), &output);
  png_destroy_write_struct(&png, &info);
  if (!done) {
    throw IoError("picture", "cannot be encoded: " + output.problem);
  }
  return std::move(output.bytes);
}

template <class AnyImage>
PngSize checked_size(const AnyImage& image, int depth) {
  const auto width = static_cast<std::size_t>(image.width > 0 ? image.width : 0);
  const auto height = static_cast<std::size_t>(image.height > 0 ? image.height : 0);
  if (width == 0 || height == 0 || image.rgba.size() != 4 * width * height) {
    throw InvalidInput("a picture must have at least one pixel and four values for each");
  }
  return {width, height, depth};
}

}  // namespace

std::string png_bytes(const Image& image) {
  return png_of(checked_size(image, 8), image.rgba.data());
}

std::string png_bytes(const DeepImage& image) {
  const PngSize size = checked_size(image, 16);
  std::vector<png_byte> samples;
  samples.reserve(2 * image.rgba.size());
  for (const std::uint16_t value : image.rgba) {
    samples.push_back(static_cast<png_byte>(value >> 8U));
    samples.push_back(static_cast<png_byte>(value & 0xFFU));
  }
  return png_of(size, samples.data());
}

}  // namespace vantage
