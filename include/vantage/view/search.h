// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "vantage/core/fields.h"
#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"
#include "vantage/spatial/directions.h"

/// \file
/// Searching the view sphere for the direction of largest, or smallest, score.
/// docs/search.md describes the strategies.

namespace vantage {

/// How the view sphere is searched.
enum class SearchStrategy {
  Rapid,       ///< The paper's: best corner of a base, then Loop refinement around it.
  Exhaustive,  ///< Every direction of a set.
  Global,      ///< Ours: finds what Dense finds at a fraction of its scores; docs/search.md.
  Dense,       ///< Ours: icosahedron level 5, then refinement around the best three. Slow.
  Gradient,    ///< Lee 2005: along the gradient from seeded random directions.
};

/// What is looked for.
enum class Goal {
  Best,     ///< The largest preference.
  Worst,    ///< The least score.
  Highest,  ///< The largest score, whatever is preferred.
};

/// Options of search_view() and search_best_and_worst().
struct SearchOptions {
  SearchStrategy strategy = SearchStrategy::Global;   ///< How to search.
  ViewSphereBase base = ViewSphereBase::Icosahedron;  ///< Of the start set.
  int subdivisions = 3;             ///< Of the base: start of rapid, set of exhaustive; 0–8.
  double epsilon = 0.001;           ///< Rapid stops when a ring gains less than this …
  bool epsilon_is_fraction = true;  ///< … as a fraction of ViewObjective::total, or as a raw sum.
  bool require_narrow_ring = true;  ///< Rapid also needs a ring narrower than 2° (ours).
  int starts = 8;          ///< Random directions that a gradient search starts from; 1–4096.
  std::uint64_t seed = 0;  ///< Of these directions.
};

/// Sets ε from "0.1" (a raw sum) or "0.1%" (of the total). \throw InvalidInput
void set_epsilon(SearchOptions& options, std::string_view text);
/// "0.1" or "0.1%".
std::string epsilon_text(const SearchOptions& options);

/// The table of SearchOptions.
inline constexpr auto kSearchFields = std::tuple{
    Choice{
        "search", &SearchOptions::strategy, "rapid|exhaustive|global|dense|gradient",
        "global: finds what dense finds, by a fraction of its scores; dense: 10242 directions, "
        "then refinement, slow; rapid: the paper's; exhaustive: a direction set; gradient: Lee's "
        "ascent from random starts"},
    Choice{"base", &SearchOptions::base, "cube|icosahedron",
           "polyhedron of the view sphere; a rapid search begins with the cube"},
    Field{"subdivisions", &SearchOptions::subdivisions, 0, 8,
          "times the base of the view sphere is split in four"},
    Field{"starts", &SearchOptions::starts, 1, 4096,
          "random directions that a gradient search starts from"},
    Field{"seed", &SearchOptions::seed, 0, UINT64_MAX,
          "start of random sequences: a gradient search draws its starts"},
    Text{"epsilon", set_epsilon, epsilon_text,
         "rapid search stops when a ring gains less: a raw sum, or a share of the total with %",
         TextForm::Share},
    Switch{"narrow-ring", &SearchOptions::require_narrow_ring, kNoFlag},
};

/// One scored direction of a search, in order of scoring.
struct SearchStep {
  int level = 0;                   ///< 0: the start set; then one per refinement.
  Vec3 direction = Vec3::UnitZ();  ///< Unit vector to the eye.
  double score = 0.0;              ///< As ViewObjective::score gave it.
};

/// One view found by a search.
struct FoundView {
  Vec3 direction = Vec3::UnitZ();   ///< Unit vector from the centre to the eye.
  double score = 0.0;               ///< As ViewObjective::score gave it.
  double preference = 0.0;          ///< What was maximised; the score unless there is a preference.
  std::size_t evaluations = 0;      ///< Directions scored for it; none is scored twice.
  std::size_t estimates = 0;        ///< Directions that the surrogate was asked for.
  std::vector<SearchStep> trace{};  ///< Each scored direction.
};

/// Result of search_best_and_worst().
struct FoundViews {
  FoundView best{};   ///< Of the largest preference.
  FoundView worst{};  ///< Of the least score; its trace holds only what the others had not scored.
  /// Of the largest score: the best itself unless something else is preferred; the same of its trace.
  FoundView highest{};
};

/// Scores a batch of directions; a pure function of each direction.
using ScoreBatch = std::function<std::vector<double>(const std::vector<Vec3>&)>;

/// What is looked for on the view sphere. KSSM, every measure, thumbnails and scores of your own
/// are searched by this one interface.
struct ViewObjective {
  ScoreBatch score{};  ///< Required; never NaN. −∞ of a view that is not to be taken.
  /// The score if everything were visible, ≥ 0, if there is such a thing: what SearchOptions::epsilon as a
  /// fraction refers to, unless a preference is maximised; unset, or of a preference, that is the largest
  /// size of a value in the start set. If it is given as 0 all scores are equal: a search ends after its
  /// start set, with the best of that.
  std::optional<double> total{};
  /// Nearly the score at a fraction of its cost: tells SearchStrategy::Global where to score.
  /// Unset: the score does.
  ScoreBatch surrogate{};
  /// Nearer to the score than the surrogate and cheaper than the score: SearchStrategy::Global climbs
  /// by it, and scores what it climbed to. Unset: it climbs by the score.
  ScoreBatch proxy{};
  /// What the best view maximises, of a direction and its score; called from many threads at once.
  /// Unset: the score.
  std::function<double(const Vec3& direction, double score)> preference{};
  int survey_level = 4;  ///< Icosahedron level that SearchStrategy::Global surveys first, 0–6.
  /// The score varies slowly: SearchStrategy::Global does not search within 8° of its best end again.
  bool has_smooth_score = false;
  bool has_smooth_preference = false;  ///< The same where the preference is maximised.
  std::size_t starts = 4;    ///< Directions of the survey that its ascent starts from, > 0.
  double finest_deg = 0.01;  ///< Its ascent ends with rings as narrow as this, > 0, …
  double finest_preferred_deg = 0.01;  ///< … and with these where the preference is maximised.
};

/// Searches the sphere for the view of largest preference or of least score. Ties go to the lowest
/// index of the set, then to what was found first. \throw InvalidInput, Cancelled
FoundView search_view(const ViewObjective& objective, Goal goal, const SearchOptions& options = {},
                      const RunContext& run = {});

/// Finds the best, the highest and the worst view; no direction is scored twice. \throw InvalidInput, Cancelled
FoundViews search_best_and_worst(const ViewObjective& objective, const SearchOptions& options = {},
                                 const RunContext& run = {});

}  // namespace vantage
