// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"

/// \file
/// A closed path over several views, with the eye never leaving the view sphere. docs/view_sets.md.

namespace vantage {

/// A closed round over directions.
struct Tour {
  std::vector<std::size_t> order{};  ///< Every index once, 0 first; of both senses the one whose
                                     ///< second index is less than its last.
  double length_rad = 0.0;           ///< Sum of the great-circle arcs, the way back included.
  bool optimal = false;              ///< Whether no shorter round exists.
};

/// The shortest round over the directions. Up to 12: exact (Held & Karp, 1962). More: nearest
/// neighbour from index 0, then 2-opt moves and moves of runs of up to three until neither shortens
/// it. \param directions at least one unit vector. \throw InvalidInput, Cancelled
Tour shortest_tour(std::span<const Vec3> directions, const RunContext& run = {});

/// Where the eye stands at one moment.
struct TourPose {
  Vec3 direction = Vec3::UnitZ();  ///< Unit vector from the centre to the eye.
  Vec3 up = Vec3::UnitY();         ///< Unit, orthogonal to `direction`.
};

/// Poses at equal distances on the round: pose i is where the eye is after i / count of the way, and
/// after the last comes the first again. Arcs are great circles; opposite stops are joined along the
/// equator. The picture stays upright except near the poles, where upright turns ever faster: there
/// the roll is smoothed over the way, so that it never jumps, also for a path straight over a pole.
/// \param stops in order, at least two different unit vectors. \param model_up unit axis.
/// \param count at least 3. \throw InvalidInput
std::vector<TourPose> tour_path(std::span<const Vec3> stops, const Vec3& model_up,
                                std::size_t count);

}  // namespace vantage
