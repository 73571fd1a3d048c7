// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
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
  Global,      ///< Ours: finds what Dense finds by a fraction of its scores; docs/search.md.
  Dense,       ///< Ours: icosahedron level 5, then refinement around the best three. Slow.
  Gradient,    ///< Lee 2005: along the gradient from seeded random directions.
};

/// Whether the largest or the smallest score is wanted.
enum class Goal { Best, Worst };

/// Options of search_view() and search_best_and_worst().
struct SearchOptions {
  SearchStrategy strategy = SearchStrategy::Global;   ///< How to search.
  ViewSphereBase base = ViewSphereBase::Icosahedron;  ///< Of the start set.
  int subdivisions = 3;             ///< Of the base: start of rapid, set of exhaustive; 0–8.
  double epsilon = 0.001;           ///< Rapid stops when a ring gains less than this …
  bool epsilon_is_fraction = true;  ///< … as a fraction of `total`, or as a raw sum.
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

/// One evaluated direction of a search, in order of evaluation.
struct SearchStep {
  int level = 0;                   ///< 0: the start set; then one per refinement.
  Vec3 direction = Vec3::UnitZ();  ///< Unit vector to the eye.
  double score = 0.0;              ///< As the scorer gave it.
};

/// One view found by a search.
struct FoundView {
  Vec3 direction = Vec3::UnitZ();  ///< Unit vector from the centre to the eye.
  double score = 0.0;              ///< As the scorer gave it.
  std::size_t evaluations = 0;     ///< Directions scored for it; none is scored twice.
  std::size_t estimates = 0;  ///< Directions that an estimate, or a nearby score, was asked for.
  std::vector<SearchStep> trace{};  ///< Each evaluated direction.
};

/// Result of search_best_and_worst().
struct FoundViews {
  FoundView best{};   ///< Of the largest score.
  FoundView worst{};  ///< Its evaluations and trace hold only what the best had not scored before.
};

/// Scores a batch of directions; must be a pure function of each direction.
using ScoreBatch = std::function<std::vector<double>(const std::vector<Vec3>&)>;

/// Directions around one, which comes first; each circle is in the midst of the one before.
using Circles = std::vector<std::vector<Vec3>>;

/// Scores directions in the midst of circles, the first of which is scored exactly: nearly right, and
/// much cheaper than a score. Pure in both.
using ScoreNearby =
    std::function<std::vector<double>(const Circles& circles, const std::vector<Vec3>& directions)>;

/// What a direction was estimated at and what it then scored.
struct KnownScore {
  Vec3 direction = Vec3::UnitZ();  ///< Unit vector from the centre to the eye.
  double estimate = 0.0;           ///< As SearchHints::estimate gave it.
  double score = 0.0;              ///< As the scorer gave it.
};

/// What helps the global search and does not change what it looks for.
struct SearchHints {
  /// If given, scores that are nearly right and much cheaper: the sphere is looked over by them, and
  /// exact scores are asked for only where they lead.
  ScoreBatch estimate{};
  /// If given, hills are climbed by these once some directions around are scored; what is found is
  /// scored.
  ScoreNearby nearby{};
  /// If given, told what nearby scores will be asked for amid, so that several can be made ready at a
  /// time.
  std::function<void(const std::vector<Circles>&)> expect_nearby{};
  /// Directions to look at whatever their neighbours say, such as landmark_directions().
  std::vector<Vec3> landmarks{};
  /// Directions to score whatever the estimate says, such as brink_directions().
  std::vector<Vec3> brinks{};
  /// What estimates are wrong by, from a search before: what they teach is not asked for again.
  std::vector<KnownScore> known{};
  /// Whether scores cost so little that the search may take many more of them, as of small models.
  bool scores_are_cheap = false;
};

/// Searches the sphere. Ties go to the lowest index of the set, then to what was found first.
/// \param score scores directions. \param total the score if everything were visible, ≥ 0: what
/// `epsilon` as a fraction refers to; at 0 all views are equal and the first direction is returned.
/// \throw InvalidInput, Cancelled
FoundView search_view(const ScoreBatch& score, double total, Goal goal,
                      const SearchOptions& options = {}, const RunContext& run = {},
                      const SearchHints& hints = {});

/// Both searches, sharing what they evaluate. The worst view is that of search_view() with what is known
/// of estimates by then.
/// \throw InvalidInput, Cancelled
FoundViews search_best_and_worst(const ScoreBatch& score, double total,
                                 const SearchOptions& options = {}, const RunContext& run = {},
                                 const SearchHints& hints = {});

}  // namespace vantage
