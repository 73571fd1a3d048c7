// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "vantage/pipeline/find_views.h"
#include "vantage/view/search.h"

#include "pipeline/preference.h"

/// \file
/// Views that a mirror plane of the model makes as good as the best.

namespace vantage {

/// Mirror images of `best` whose score is at least 98 % of its score, as the model's own
/// mirror planes make them; in the order of mirror_images().
std::vector<TwinView> twins_of(const Vec3& best, const ShapeAnalysis& shape,
                               const ScoreBatch& score, const Preference& preference);

/// Of the best view and its twins within 1 % of its objective, the one most toward the front,
/// then the one most to the side (of which there is one); swaps it with the best.
/// \pre `best` has its objective.
void settle_near_ties(TwinView& best, std::vector<TwinView>& twins, const UprightFrame& frame);

/// What a direction would be worth with a score.
using ScorePreference = std::function<double(const Vec3& direction, double score)>;

/// Of the best view and its mirror image on the other side takes the one on the right, if their objectives
/// were within 1 % with the same score: what scores of twins differ by is the mesh's doing.
void settle_sides(TwinView& best, std::vector<TwinView>& twins, const UprightFrame& frame,
                  const ScorePreference& preference);

}  // namespace vantage
