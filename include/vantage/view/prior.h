// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/fields.h"
#include "vantage/core/vec3.h"

/// \file
/// A prior on the view direction: what people look at a thing from, whatever its shape. The search
/// for the best view may multiply its score by it; docs/lab/2026-11-prior.md says what it is worth.

namespace vantage {

/// The upright prior: a smooth function of direction, in (0, 1].
/// With s, u, f the direction's components along side, up and front:
///     exp(−elevation_strength (u − elevation_sine)² − corner_strength (1 − 4 s² f²)
///         − front_strength (1 − f) − side_strength (1 − s))
/// All constants are ours. The first three were fitted to views that people chose, under the map of
/// an earlier version; scripts/fit_prior.py no longer gives them (docs/lab/2026-11-prior.md).
struct UprightPrior {
  double elevation_sine = 0.315;      ///< Sine of the elevation people prefer: 18°.
  double elevation_strength = 8.481;  ///< How much they do, ≥ 0.
  double corner_strength = 1.171;     ///< Preference for azimuths between front and side, ≥ 0.
  double front_strength = 0.08;       ///< Decides near-ties toward the front, ≥ 0; chosen.
  double side_strength = 0.04;        ///< Decides near-ties toward the right, ≥ 0; chosen.
};

/// Names, ranges and help of the numbers in UprightPrior.
inline constexpr auto kUprightPriorFields = std::tuple{
    Field{"elevation_sine", &UprightPrior::elevation_sine, -1.0, 1.0,
          "sine of the preferred elevation"},
    Field{"elevation_strength", &UprightPrior::elevation_strength, 0.0, 100.0,
          "preference for that elevation"},
    Field{"corner_strength", &UprightPrior::corner_strength, 0.0, 100.0,
          "preference for three-quarter views"},
    Field{"front_strength", &UprightPrior::front_strength, 0.0, 100.0, "preference for the front"},
    Field{"side_strength", &UprightPrior::side_strength, 0.0, 100.0, "preference for the right"},
};

/// A direction that a prior file favours.
struct PriorLobe {
  Vec3 direction = Vec3::UnitZ();  ///< Unit, components along side, up and front.
  double weight = 1.0;             ///< Height over the floor of 1, in [0, 1e6].
  double width_rad = 0.5;          ///< Where exp((cos θ − 1) / width²) puts it, in (0, π].
};

/// What the objective multiplies the score by.
struct ViewPrior {
  std::string name = "none";  ///< As reported: none, upright, or a file's name.
  bool is_uniform = true;     ///< The factor is 1 everywhere, whatever follows.
  UprightPrior upright{};     ///< Its constants.
  std::vector<PriorLobe> lobes{};  ///< The factor is also 1 + Σ weight · exp((cos θ − 1) / width²).

  /// The factor for a direction from the model's centre to the eye; > 0 and finite. \throw InvalidInput
  /// if it is zero or not finite, unless the prior is uniform
  [[nodiscard]] double factor(const UprightFrame& frame, const Vec3& direction) const;
};

/// `--prior none`: the pure measure.
ViewPrior no_prior();
/// `--prior upright`: the constants above.
ViewPrior upright_prior();

/// Reads a prior file; docs/lab/2026-11-prior.md describes it. JSON such as
///     {"vantage_prior": 1,
///      "upright": {"elevation_sine": 0.3, "elevation_strength": 4},
///      "lobes": [{"direction": [0, 0.3, 1], "weight": 2, "width_deg": 30}]}
/// Constants that `upright` leaves out are 0; both members may be missing.
/// \param name shown in messages and kept as the prior's name.
/// \throw FormatError naming the member.
ViewPrior parse_prior(std::string_view bytes, std::string_view name);

}  // namespace vantage
