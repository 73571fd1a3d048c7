// SPDX-License-Identifier: MIT
#include "io/texture_loader.h"

#include <algorithm>
#include <utility>

#include "io/number_parsing.h"
#include "io/picture_decoding.h"

namespace vantage {

std::optional<Image> TextureLoader::embedded(std::string_view bytes, const std::string& label) {
  DecodedPicture picture =
      decode_picture(bytes, std::min({pixels_left_, decoded_left_, kMostPicturePixels}),
                     surroundings_.options.texture_side);
  decoded_left_ -= std::min(picture.pixels, decoded_left_);
  if (!picture.image) {
    complain(label, picture.problem);
    return std::nullopt;
  }
  pixels_left_ -= picture.image->rgba.size() / 4;
  return std::move(picture.image);
}

std::optional<Image> TextureLoader::beside(const std::string& path) {
  const std::string label = in_quotes(path);
  if (!surroundings_.side_files) {
    complain(label, "cannot be found without the model's folder; name the model by its path");
    return std::nullopt;
  }
  if (useless_.count(path) > 0) {
    return std::nullopt;
  }
  const SideFile file = surroundings_.side_files(path);
  std::optional<Image> image;
  if (file.bytes) {
    image = embedded(*file.bytes, label);
  } else {
    complain(label, file.problem);
  }
  if (!image) {
    useless_.insert(path);
  }
  return image;
}

void TextureLoader::complain(const std::string& label, const std::string& problem) {
  if (complaints_++ < kMostTextureNotes) {
    builder_.note("the texture " + label + " was left out: it " + problem);
  }
}

void TextureLoader::finish() {
  if (complaints_ > kMostTextureNotes) {
    builder_.note("more textures were left out: " +
                  std::to_string(complaints_ - kMostTextureNotes));
  }
}

}  // namespace vantage
