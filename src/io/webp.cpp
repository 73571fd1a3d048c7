// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include <webp/encode.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

namespace vantage {
namespace {

// Quality of the colours, 0–100. [ours]: thin dark lines on white keep clean borders; 80, enough for
// frames that move, leaves a haze beside them.
constexpr float kQuality = 90.0F;

/// Frees what the library allocated.
struct WebpPicture {
  WebPPicture picture{};
  WebPMemoryWriter writer{};

  WebpPicture() { WebPMemoryWriterInit(&writer); }

  WebpPicture(const WebpPicture&) = delete;
  WebpPicture& operator=(const WebpPicture&) = delete;

  ~WebpPicture() {
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&writer);
  }
};

}  // namespace

std::string webp_bytes(const Image& image) {
  const auto width = static_cast<std::size_t>(image.width > 0 ? image.width : 0);
  const auto height = static_cast<std::size_t>(image.height > 0 ? image.height : 0);
  if (width == 0 || height == 0 || image.rgba.size() != 4 * width * height) {
    throw InvalidInput("a picture must have at least one pixel and four bytes for each");
  }
  if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION) {
    throw InvalidInput("a WebP picture has sides of at most 16383 pixels; write a PNG instead");
  }
  WebPConfig config;
  WebpPicture webp;
  if (WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, kQuality) == 0 ||
      WebPPictureInit(&webp.picture) == 0) {
    throw IoError("picture", "cannot be encoded: libwebp is of another version than its headers");
  }
  config.use_sharp_yuv = 1;  // colours of thin lines and of map borders do not bleed
  webp.picture.width = image.width;
  webp.picture.height = image.height;
  webp.picture.use_argb = 1;
  webp.picture.writer = WebPMemoryWrite;
  webp.picture.custom_ptr = &webp.writer;
  if (WebPPictureImportRGBA(&webp.picture, image.rgba.data(), 4 * image.width) == 0 ||
      WebPEncode(&config, &webp.picture) == 0) {
    throw IoError("picture", "cannot be encoded as WebP, error " +
                                 std::to_string(static_cast<int>(webp.picture.error_code)));
  }
  return {reinterpret_cast<const char*>(webp.writer.mem), webp.writer.size};
}

}  // namespace vantage
