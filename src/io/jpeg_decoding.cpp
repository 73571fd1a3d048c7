// SPDX-License-Identifier: MIT
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>  // jpeglib.h names FILE and does not include it

#include <jpeglib.h>

#include "io/picture_decoding.h"

namespace vantage {
namespace {

/// A progressive picture may refine itself in thousands of passes, each over all pixels. Encoders
/// write a dozen.
constexpr int kMostPasses = 100;

/// What libjpeg's callbacks share; the library's own struct must come first.
struct JpegErrors {
  jpeg_error_mgr base{};
  std::jmp_buf leave{};
};

[[noreturn]] void leave_decoder(j_common_ptr info) {
  std::longjmp(reinterpret_cast<JpegErrors*>(info->err)->leave, 1);
}

void say_nothing(j_common_ptr /*info*/) {}

void watch_passes(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMostPasses) {
    leave_decoder(info);
  }
}

/// Reads the header and chooses the size; false after an error. Like the next one it holds no object
/// with a destructor, because libjpeg leaves it by a long jump.
bool read_header(jpeg_decompress_struct* jpeg, JpegErrors* errors, const char* bytes,
                 std::size_t size, int wanted_side) {
  if (setjmp(errors->leave) != 0) {
    return false;
  }
  jpeg_mem_src(jpeg, reinterpret_cast<const unsigned char*>(bytes), size);
  if (jpeg_read_header(jpeg, TRUE) != JPEG_HEADER_OK) {
    return false;
  }
  const unsigned longer =
      jpeg->image_width > jpeg->image_height ? jpeg->image_width : jpeg->image_height;
  jpeg->scale_num = 1;
  jpeg->scale_denom = 1;
  while (wanted_side > 0 && jpeg->scale_denom < 8 &&
         longer / (2 * jpeg->scale_denom) >= static_cast<unsigned>(wanted_side)) {
    jpeg->scale_denom *= 2;
  }
  jpeg->out_color_space = JCS_EXT_RGBA;
  jpeg->dct_method = JDCT_ISLOW;  // the same bytes whatever the processor's instructions
  jpeg_calc_output_dimensions(jpeg);
  return true;
}

bool read_rows(jpeg_decompress_struct* jpeg, JpegErrors* errors, std::uint8_t* rgba) {
  if (setjmp(errors->leave) != 0) {
    return false;
  }
  jpeg_start_decompress(jpeg);
  const std::size_t stride = std::size_t{4} * jpeg->output_width;
  while (jpeg->output_scanline < jpeg->output_height) {
    JSAMPROW row = rgba + stride * jpeg->output_scanline;
    jpeg_read_scanlines(jpeg, &row, 1);
  }
  jpeg_finish_decompress(jpeg);
  return true;
}

}  // namespace

DecodedPicture decode_jpeg(std::string_view bytes, std::size_t most_pixels, int wanted_side) {
  JpegErrors errors;
  jpeg_decompress_struct jpeg{};
  jpeg.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = leave_decoder;
  errors.base.output_message = say_nothing;
  jpeg_create_decompress(&jpeg);
  jpeg_progress_mgr progress{};
  progress.progress_monitor = watch_passes;
  jpeg.progress = &progress;
  DecodedPicture result{std::nullopt, "is not a sound JPEG in grey or RGB"};
  if (read_header(&jpeg, &errors, bytes.data(), bytes.size(), wanted_side)) {
    // Also of the whole picture: progressive ones are held in full whatever the output's size.
    std::string problem = picture_size_problem(jpeg.image_width, jpeg.image_height, most_pixels);
    if (!problem.empty()) {
      result.problem = std::move(problem);
    } else {
      result.pixels = std::size_t{jpeg.image_width} * jpeg.image_height;
      Image image;
      image.width = static_cast<int>(jpeg.output_width);
      image.height = static_cast<int>(jpeg.output_height);
      image.rgba.resize(std::size_t{4} * jpeg.output_width * jpeg.output_height);
      if (read_rows(&jpeg, &errors, image.rgba.data())) {
        result.image = std::move(image);
        result.problem.clear();
      }
    }
  }
  jpeg_destroy_decompress(&jpeg);
  return result;
}

}  // namespace vantage
