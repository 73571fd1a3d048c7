// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// How large, how small and how far from the origin a model may be.

namespace vantage {

/// Largest magnitude of a coordinate that is computed with: products of four lengths, as are squares of
/// areas, stay finite.
inline constexpr double kLargestCoordinate = 1e60;
/// Smallest longest side of a model's box that is computed with: such products do not vanish for details
/// a million times smaller.
inline constexpr double kSmallestExtent = 1e-60;
/// A model must be at least this many steps across, from one double to the next at its largest coordinate:
/// else the middles of its edges are no places of their own. [ours]
inline constexpr double kFewestSteps = 1024.0;

/// "vertex 7 has a coordinate that is infinite or no number", of the first that has; empty if none has.
std::string finite_problem(std::span<const Vec3> points);

/// Of a mesh that a public function takes. \throw InvalidInput with finite_problem(), or the sentence "the
/// model …" of extent_problem() for the vertices that faces name, if there is one.
void check_coordinates(const TriMesh& mesh);

/// How many steps, from one double to the next at the largest coordinate, the points are across.
double steps_across(std::span<const Vec3> points);

/// Why nothing can be computed with the points, by the three limits above: continues "the model …". Empty
/// if nothing is in the way; a single place is no reason.
std::string extent_problem(std::span<const Vec3> points);

}  // namespace vantage
