// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "vantage/core/vec3.h"
#include "vantage/view/scoring.h"

#include "core/wide_registers.h"
#include "view/sketch_coordinates.h"

/// \file
/// Where points lie in a sketch, several at a time.

// Functions that take or give wide registers are inlined, all of them, here and in the sources that
// include this: nobody else calls them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vantage {

template <unsigned Lanes>
using FloatsOf = typename Registers<Lanes>::Floats;
template <unsigned Lanes>
using IntsOf = typename Registers<Lanes>::Truths;

template <class Numbers, class Number>
VANTAGE_INLINE Numbers load(const Number* from) {
  Numbers values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

template <class Numbers, class Number>
VANTAGE_INLINE void store(const Numbers& values, Number* to) {
  std::memcpy(to, &values, sizeof values);
}

/// Whether it is true in one of the lanes.
template <class Truths>
VANTAGE_INLINE bool any_of(const Truths& truths) {
  std::array<std::uint64_t, sizeof(Truths) / sizeof(std::uint64_t)> pairs{};
  std::memcpy(pairs.data(), &truths, sizeof pairs);
  std::uint64_t any = 0;
  for (const std::uint64_t pair : pairs) {
    any |= pair;
  }
  return any != 0;
}

/// The first of the two if the second is no number, as of larger().
template <class Floats>
VANTAGE_INLINE Floats smaller(const Floats& a, const Floats& b) {
  return b < a ? b : a;
}

template <class Floats>
VANTAGE_INLINE Floats larger(const Floats& a, const Floats& b) {
  return a < b ? b : a;
}

/// How one eye draws.
struct SketchFrame {
  /// \param camera drawable().
  SketchFrame(const Vec3& direction, const ScoringCamera& camera, std::size_t cells);

  Eigen::Vector3f right, up, towards;
  Eigen::Vector3f eye;    ///< Its place, or `towards` in parallel projection.
  float distance = 0.0F;  ///< Of the eye, in radii.
  float slope = 0.0F;     ///< 1 in perspective, else 0.
  float per_cell = 1.0F;  ///< Cells to the unit.
  float middle = 0.0F;    ///< Of the picture, in cells.
};

/// A camera like this one that a picture in single precision can be drawn from: the eye not nearer
/// than 1.001 radii, and in parallel projection where it is farther than 1 000. [ours]
ScoringCamera drawable(ScoringCamera camera);

/// The size of planes' normals along the eye: how far it is over planes through the origin.
template <class Floats>
VANTAGE_INLINE Floats rise_along(const SketchCoordinates& axis, std::size_t i,
                                 const Eigen::Vector3f& eye) {
  return load<Floats>(axis.x.data() + i) * eye.x() + load<Floats>(axis.y.data() + i) * eye.y() +
         load<Floats>(axis.z.data() + i) * eye.z();
}

/// Places in the picture: x, y in cells; larger nearness is nearer to the eye, and it is linear in x
/// and y over a face: one over depth in perspective, else the height towards the eye.
template <class Numbers>
struct SketchSpots {
  Numbers x, y, nearness;
};

template <class Numbers>
VANTAGE_INLINE SketchSpots<Numbers> project(const SketchFrame& f, const SketchCoordinates& from,
                                            std::size_t i) {
  constexpr float kLeastDepth = 0.0009F;  // nothing that the sphere encloses is nearer to the eye
  const Numbers x = load<Numbers>(from.x.data() + i);
  const Numbers y = load<Numbers>(from.y.data() + i);
  const Numbers z = load<Numbers>(from.z.data() + i);
  const Numbers rise = x * f.towards.x() + y * f.towards.y() + z * f.towards.z();
  const Numbers depth = f.slope * (f.distance - rise) + (1.0F - f.slope);
  const Numbers shrink = 1.0F / larger(depth, Numbers{} + kLeastDepth);
  const Numbers across = x * f.right.x() + y * f.right.y() + z * f.right.z();
  const Numbers along = x * f.up.x() + y * f.up.y() + z * f.up.z();
  return {across * shrink * f.per_cell + f.middle, along * shrink * f.per_cell + f.middle,
          f.slope * shrink + (1.0F - f.slope) * rise};
}

}  // namespace vantage
