// SPDX-License-Identifier: MIT
#include <cstdint>
#include <memory>
#include <utility>

#include <webp/encode.h>
#include <webp/mux.h>
#include <zlib.h>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"
#include "vantage/io/write.h"

namespace vantage {

class AnimationEncoder::Implementation {
 public:
  Implementation(int width, int height, int frame_count, int fps)
      : width_(width), height_(height), frame_count_(frame_count), fps_(fps) {}

  virtual ~Implementation() = default;
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void add(const Image& frame) {
    const std::size_t bytes =
        4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    if (frame.width != width_ || frame.height != height_ || frame.rgba.size() != bytes) {
      throw InvalidInput("all frames of a moving picture must have its size");
    }
    if (added_ == frame_count_) {
      throw InvalidInput("a moving picture was given more frames than it was made for");
    }
    encode(frame);
    ++added_;
  }

  std::string finish() {
    if (added_ != frame_count_) {
      throw InvalidInput("a moving picture was given fewer frames than it was made for");
    }
    return take_bytes();
  }

 protected:
  virtual void encode(const Image& frame) = 0;
  virtual std::string take_bytes() = 0;

  [[nodiscard]] int width() const { return width_; }

  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] int frame_count() const { return frame_count_; }

  [[nodiscard]] int added() const { return added_; }

  [[nodiscard]] int fps() const { return fps_; }

 private:
  int width_;
  int height_;
  int frame_count_;
  int fps_;
  int added_ = 0;
};

namespace {

constexpr int kMostFps = 60;
constexpr int kLargestSide = 16384;
// Quality of WebP, 0–100. [ours]: at 80 shading shows no blocks; 90 takes half as much again.
constexpr float kWebpQuality = 80.0F;

void append_big_endian(std::string& bytes, std::uint32_t value, int count = 4) {
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) {
    bytes += static_cast<char>((value >> static_cast<unsigned>(shift)) & 0xFFU);
  }
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) {
    value = value << 8U | static_cast<unsigned char>(c);
  }
  return value;
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view data) {
  append_big_endian(bytes, static_cast<std::uint32_t>(data.size()));
  std::string body(type);
  body += data;
  bytes += body;
  append_big_endian(bytes,
                    static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                                     static_cast<uInt>(body.size()))));
}

/// APNG 1.0: every frame is a PNG of ours whose data is moved into frame chunks.
class ApngEncoder : public AnimationEncoder::Implementation {
 public:
  using Implementation::Implementation;

 protected:
  void encode(const Image& frame) override {
    const std::string png = png_bytes(frame);
    constexpr std::size_t kSignature = 8;
    if (added() == 0) {
      bytes_ = png.substr(0, kSignature);
    }
    std::string_view rest = std::string_view(png).substr(kSignature);
    bool control_written = false;
    while (!rest.empty()) {
      const std::size_t size = big_endian(rest);
      const std::string_view type = rest.substr(4, 4);
      const std::string_view data = rest.substr(8, size);
      rest.remove_prefix(12 + size);
      if (type == "IDAT") {
        if (!control_written) {
          append_frame_control();
          control_written = true;
        }
        append_data(data);
      } else if (type != "IEND" && added() == 0) {
        append_chunk(bytes_, type, data);
        if (type == "IHDR") {
          std::string control;
          append_big_endian(control, static_cast<std::uint32_t>(frame_count()));
          append_big_endian(control, 0);  // loop for ever
          append_chunk(bytes_, "acTL", control);
        }
      }
    }
  }

  std::string take_bytes() override {
    append_chunk(bytes_, "IEND", {});
    return std::move(bytes_);
  }

 private:
  void append_frame_control() {
    std::string control;
    append_big_endian(control, sequence_++);
    append_big_endian(control, static_cast<std::uint32_t>(width()));
    append_big_endian(control, static_cast<std::uint32_t>(height()));
    append_big_endian(control, 0);  // left
    append_big_endian(control, 0);  // top
    append_big_endian(control, 1, 2);
    append_big_endian(control, static_cast<std::uint32_t>(fps()), 2);
    append_big_endian(control, 0, 1);  // leave the picture as it is …
    append_big_endian(control, 0, 1);  // … and replace all of it by the next frame
    append_chunk(bytes_, "fcTL", control);
  }

  void append_data(std::string_view data) {
    if (added() == 0) {
      append_chunk(bytes_, "IDAT", data);
      return;
    }
    std::string numbered;
    append_big_endian(numbered, sequence_++);
    numbered += data;
    append_chunk(bytes_, "fdAT", numbered);
  }

  std::string bytes_{};
  std::uint32_t sequence_ = 0;
};

class WebpEncoder : public AnimationEncoder::Implementation {
 public:
  WebpEncoder(int width, int height, int frame_count, int fps)
      : Implementation(width, height, frame_count, fps) {
    WebPAnimEncoderOptions options;
    if (WebPConfigInit(&config_) == 0 || WebPAnimEncoderOptionsInit(&options) == 0) {
      throw IoError("moving picture", "cannot be encoded: libwebp has another version");
    }
    config_.quality = kWebpQuality;
    config_.thread_level = 0;
    options.anim_params.loop_count = 0;
    encoder_.reset(WebPAnimEncoderNew(width, height, &options));
    if (!encoder_) {
      throw IoError("moving picture", "does not fit into memory");
    }
  }

 protected:
  void encode(const Image& frame) override {
    WebPPicture picture;
    if (WebPPictureInit(&picture) == 0) {
      throw IoError("moving picture", "cannot be encoded: libwebp has another version");
    }
    picture.width = width();
    picture.height = height();
    picture.use_argb = 1;
    const bool done =
        WebPPictureImportRGBA(&picture, frame.rgba.data(), 4 * width()) != 0 &&
        WebPAnimEncoderAdd(encoder_.get(), &picture, milliseconds(added()), &config_) != 0;
    WebPPictureFree(&picture);
    if (!done) {
      fail();
    }
  }

  std::string take_bytes() override {
    WebPData data;
    WebPDataInit(&data);
    const bool done =
        WebPAnimEncoderAdd(encoder_.get(), nullptr, milliseconds(frame_count()), nullptr) != 0 &&
        WebPAnimEncoderAssemble(encoder_.get(), &data) != 0;
    std::string bytes =
        done ? std::string(reinterpret_cast<const char*>(data.bytes), data.size) : std::string();
    WebPDataClear(&data);
    if (!done) {
      fail();
    }
    return bytes;
  }

 private:
  struct Deleter {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
  };

  /// When frame i begins; whole milliseconds, so that the error never adds up.
  [[nodiscard]] int milliseconds(int i) const {
    return static_cast<int>((1000LL * i + fps() / 2) / fps());
  }

  [[noreturn]] void fail() {
    throw IoError("moving picture",
                  std::string("cannot be encoded: ") + WebPAnimEncoderGetError(encoder_.get()));
  }

  WebPConfig config_{};
  std::unique_ptr<WebPAnimEncoder, Deleter> encoder_{};
};

}  // namespace

AnimationEncoder::AnimationEncoder(AnimationFormat format, int width, int height, int frame_count,
                                   int fps) {
  const int largest = format == AnimationFormat::WebP ? WEBP_MAX_DIMENSION : kLargestSide;
  if (width < 1 || height < 1 || width > largest || height > largest) {
    throw InvalidInput("the sides of a moving picture must be between 1 and " +
                       std::to_string(largest) + " pixels");
  }
  if (frame_count < 1 || fps < 1 || fps > kMostFps) {
    throw InvalidInput("a moving picture needs at least one frame, and 1 to 60 a second");
  }
  if (format == AnimationFormat::WebP) {
    implementation_ = std::make_unique<WebpEncoder>(width, height, frame_count, fps);
  } else {
    implementation_ = std::make_unique<ApngEncoder>(width, height, frame_count, fps);
  }
}

AnimationEncoder::~AnimationEncoder() = default;
AnimationEncoder::AnimationEncoder(AnimationEncoder&&) noexcept = default;
AnimationEncoder& AnimationEncoder::operator=(AnimationEncoder&&) noexcept = default;

void AnimationEncoder::add(const Image& frame) {
  implementation_->add(frame);
}

std::string AnimationEncoder::finish() {
  return implementation_->finish();
}

}  // namespace vantage
