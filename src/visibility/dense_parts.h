// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vantage/core/camera.h"

#include "spatial/eye_picture.h"
#include "visibility/surface.h"

/// \file
/// Small parts of a surface that hold many of its samples, as a tap in a house does. All of such a part
/// lies in few cells of the whole's picture, where each of its faces would be held against each of its
/// samples. So what its own faces hide is asked in a picture of its own.

namespace vantage {

class SampleScene;

struct DensePart {
  std::vector<std::uint32_t> samples{};  ///< Of the whole, ascending.
  std::vector<std::uint32_t> faces{};    ///< Of the whole: those between them, ascending.
  std::unique_ptr<SampleScene> scene{};  ///< Of part_of() these; may have dense parts in turn.
};

/// The samples of each dense part, ascending; none for most surfaces.
std::vector<std::vector<std::uint32_t>> dense_samples(std::span<const Vec3> samples);

/// The faces of which all corners are among the samples, ascending. \param samples ascending.
std::vector<std::uint32_t> faces_between(const Surface& whole,
                                         std::span<const std::uint32_t> samples);

/// A face of the whole and what it spans in a picture of all samples.
struct FaceBefore {
  std::uint32_t face = 0;
  EyePicture::Extent extent{};
};

/// The faces outside of a part that may hide one of its samples.
/// \param asked of each of the part's samples: whether it is asked about. \param picture laid out, of the whole.
std::vector<FaceBefore> faces_before(const DensePart& part, std::span<const std::uint8_t> asked,
                                     const Surface& whole, const EyePicture& picture);

/// Whether one of these faces hides the sample of the whole from the eye.
bool is_hidden_by(std::span<const FaceBefore> faces, std::uint32_t sample, const Surface& whole,
                  const EyePicture& picture, const Viewpoint& eye);

}  // namespace vantage
