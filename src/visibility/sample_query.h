// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"

#include "spatial/ray_scene.h"
#include "visibility/dense_parts.h"
#include "visibility/eye_grid.h"
#include "visibility/surface.h"

/// \file
/// What every visibility query stands on: a prepared surface, working memory that queries share,
/// and the two ways to find the faces that hide a point.

namespace vantage {

/// Working memory that queries borrow, so that it is reused; at most one per thread exists.
template <typename Memory>
class LentMemory {
 public:
  /// Some of it, given back at the end.
  class Loan {
   public:
    explicit Loan(LentMemory& owner) : owner_(owner) {
      const std::lock_guard lock(owner_.mutex_);
      if (owner_.free_.empty()) {
        memory_ = std::make_unique<Memory>();
      } else {
        memory_ = std::move(owner_.free_.back());
        owner_.free_.pop_back();
      }
    }

    ~Loan() {
      const std::lock_guard lock(owner_.mutex_);
      owner_.free_.push_back(std::move(memory_));
    }

    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    Memory& operator*() const { return *memory_; }

    Memory* operator->() const { return memory_.get(); }

   private:
    LentMemory& owner_;
    std::unique_ptr<Memory> memory_{};
  };

 private:
  std::mutex mutex_{};
  std::vector<std::unique_ptr<Memory>> free_{};
};

class SampleQuery;

/// Queries may run on many threads at once.
class SampleScene {
 public:
  explicit SampleScene(Surface prepared);

  [[nodiscard]] const Surface& surface() const { return surface_; }

  /// Whether a face hides the sample from the eye; asks the hierarchy in space, which is built when
  /// first needed. Whether a face at the sample is turned to the eye is not asked.
  bool hides_sample(std::uint32_t sample, const Viewpoint& eye);

  /// The same of a place on a face, in the surface's frame.
  bool hides_place(const Vec3& place, std::uint32_t face, const Viewpoint& eye);

 private:
  friend class SampleQuery;

  template <typename Holds>
  bool hidden(const Vec3& start, const Viewpoint& eye, const Holds& holds);

  Surface surface_;
  std::vector<DensePart> parts_{};

  /// Working memory of one query.
  struct QueryMemory {
    TurnedFaces turned{};
    EyeGrid grid{};
  };

  LentMemory<QueryMemory> memory_{};
  std::once_flag candidates_once_{};
  std::optional<CandidateScene> candidates_{};
};

/// What one eye sees; any number of queries. For one thread to call.
class SampleQuery {
 public:
  /// \param eye in the surface's frame. \param back_faces as EyeGrid::begin() takes them; none: those of
  ///            the surface.
  SampleQuery(SampleScene& scene, const Viewpoint& eye, const RunContext& run,
              std::span<const std::uint8_t> back_faces = {});

  /// Whether a side of the face that can be seen is turned to the eye.
  [[nodiscard]] bool is_turned(std::size_t face) const {
    const std::uint8_t turned = memory_->turned.of_face[face];
    return turned == 1 || (turned == 2 && scene_.surface_.sides[face] == FaceSides::Both);
  }

  /// Which side each face turns to the eye: 1 its front, 2 its back, 0 neither.
  [[nodiscard]] const std::vector<std::uint8_t>& turned() const { return memory_->turned.of_face; }

  /// 1 for each sample at which a face is turned to the eye and that no face hides.
  [[nodiscard]] std::vector<std::uint8_t> seen_samples();

  /// The same of those samples that have a 1.
  [[nodiscard]] std::vector<std::uint8_t> seen_among(std::span<const std::uint8_t> samples);

  /// seen_among() by SampleScene::hides_sample() alone.
  [[nodiscard]] std::vector<std::uint8_t> seen_by_segments(std::span<const std::uint8_t> samples);

  /// 1 for each sample asked about that no face hides. \param asked 1 for each such sample, else 0.
  [[nodiscard]] std::vector<std::uint8_t> not_hidden(std::vector<std::uint8_t> asked);

 private:
  [[nodiscard]] std::vector<std::uint8_t> turned_among(std::span<const std::uint8_t> samples) const;
  void clear_hidden(std::vector<std::uint8_t>& asked);
  void set_seen_of(const DensePart& part, std::span<const std::uint8_t> asked,
                   std::vector<std::uint8_t>& seen);

  SampleScene& scene_;
  Viewpoint eye_;
  RunContext run_;
  std::span<const std::uint8_t> back_faces_;
  LentMemory<SampleScene::QueryMemory>::Loan memory_;
};

}  // namespace vantage
